#include "ribvault/slice/slivers.hpp"

#include <algorithm>
#include <cmath>

#include "ribvault/exact/nearest_segment.hpp"
#include "ribvault/slice/lattice_clip.hpp"
#include "ribvault/slice/nest_contours.hpp"

namespace ribvault {
namespace {

constexpr Unit half_width = 20;    // of what is too narrow
constexpr double sharpest = 1000;  // corners from 0.12 degrees on keep their tips

/// Whether the contour turns back at vertex i and runs beside itself no wider apart than rounding makes it.
bool turns_back(const Contour& contour, std::size_t i) {
    const std::size_t n = contour.size();
    const Point in = contour[(i + n - 1) % n] - contour[i], out = contour[(i + 1) % n] - contour[i];
    const auto [shorter, longer] = std::minmax({squared_length(in), squared_length(out)});
    const std::int64_t ahead = in.x * out.x + in.y * out.y, beside = in.x * out.y - in.y * out.x;
    constexpr auto rounding = static_cast<Unit>(clip_rounding);
    return ahead > 0 && shorter > 4 * rounding * rounding &&
           static_cast<Int128>(beside) * beside <= static_cast<Int128>(rounding * rounding) * longer;
}

}  // namespace

bool has_slivers(const Slice& slice) {
    if (slice.lost_contours) return true;
    std::vector<Segment> edges;
    std::vector<std::size_t> starts;  // of the contours in `edges`
    std::vector<double> along;        // how far along its contour each begins
    for (const Contour& contour : slice.rounded) {
        starts.push_back(edges.size());
        double sum = 0;
        for (std::size_t i = 0; i < contour.size(); ++i) {
            if (turns_back(contour, i)) return true;
            edges.push_back({contour[i], contour[(i + 1) % contour.size()]});
            along.push_back(sum);
            sum += length(edges.back());
        }
        if (std::abs(signed_area({contour})) <= 2 * clip_rounding * sum) return true;  // nowhere wider than that
    }
    starts.push_back(edges.size());
    const NearestSegment tree(edges);
    for (std::size_t c = 0; c + 1 < starts.size(); ++c) {
        const std::size_t begin = starts[c], end = starts[c + 1];
        const double around = along[end - 1] + length(edges[end - 1]);
        // The way along the contour from the end of the earlier edge to the later one, and round the other way.
        const auto way = [&](std::size_t i, std::size_t j) {
            if (j < begin || j >= end) return HUGE_VAL;
            const auto [first, second] = std::minmax(i, j);
            const double between = along[second] - along[first] - length(edges[first]);
            return std::min(between, around - (along[second] + length(edges[second])) + along[first]);
        };
        for (std::size_t i = begin; i < end; ++i) {
            bool near = false;
            tree.visit(bounding_box(edges[i], 2 * half_width), [&](std::uint32_t j) {
                near = near || (j > i && way(i, j) > 8 * half_width &&
                                compare_distance(edges[i], edges[j], 2 * half_width) <= 0);
            });
            if (near) return true;
        }
    }
    return false;
}

Slice without_slivers(const Slice& slice) {
    Slice clean;
    clean.layer = slice.layer;
    clean.slivers_removed = true;
    // A contour without area may have any orientation, by which the offset of all would go the other way.
    Region region = clip(ClipperLib::ctUnion, slice.rounded, {});
    for (const Unit distance : {half_width, -2 * half_width, half_width})
        region = offset(region, static_cast<double>(distance), ClipperLib::jtMiter, 0, sharpest);
    std::vector<ExactContour> contours;
    for (const Contour& contour : region) {
        ExactContour exact;
        for (const Point p : contour) {
            exact.push_back(exact_mm(p));
            CGAL::exact(exact.back());
        }
        contours.push_back(std::move(exact));
    }
    set_contours(clean, contours);
    return clean;
}

}  // namespace ribvault
