#include "standard_infill.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <cmath>
#include <numbers>

#include "ribvault/slice/cavity.hpp"
#include "ribvault/slice/lattice_clip.hpp"

namespace ribvault::baselines {
namespace {

using ClipperLib::Paths;

Paths grid(const Box& box, double spacing) {
    const double cx = static_cast<double>(box.lo.x + box.hi.x) / 2, cy = static_cast<double>(box.lo.y + box.hi.y) / 2;
    const double reach =
        std::hypot(static_cast<double>(box.hi.x - box.lo.x), static_cast<double>(box.hi.y - box.lo.y)) / 2;
    Paths lines;
    for (const double side : {1.0, -1.0})
        for (double t = -std::floor(reach / spacing) * spacing; t <= reach; t += spacing) {
            const double c = std::numbers::sqrt2 / 2, ux = c, uy = side * c, nx = -uy, ny = ux;
            const auto at = [&](double s) {
                return ClipperLib::IntPoint(round_to_lattice(cx + t * nx + s * ux),
                                            round_to_lattice(cy + t * ny + s * uy));
            };
            lines.push_back({at(-reach), at(reach)});
        }
    return lines;
}

/// Hexagons of side a, one corner up: zigzags along x at y = 1.5 a k, joined by vertical sides of length a.
Paths honeycomb(const Box& box, double a) {
    const double half = a * std::numbers::sqrt3 / 2;
    const auto x0 = static_cast<double>(box.lo.x), y0 = static_cast<double>(box.lo.y);
    Paths lines;
    const auto point = [](double x, double y) {
        return ClipperLib::IntPoint(round_to_lattice(x), round_to_lattice(y));
    };
    const auto columns = static_cast<int>(static_cast<double>(box.hi.x - box.lo.x) / half) + 2;
    const auto rows = static_cast<int>(static_cast<double>(box.hi.y - box.lo.y) / (1.5 * a)) + 2;
    for (int k = 0; k < rows; ++k) {
        const double y = y0 + 1.5 * a * k;
        ClipperLib::Path zigzag;
        for (int j = 0; j < columns; ++j) {
            const bool high = (j + k) % 2 == 0;
            zigzag.push_back(point(x0 + half * j, y + (high ? a / 4 : -a / 4)));
            if (high) lines.push_back({zigzag.back(), point(x0 + half * j, y + a * 1.25)});
        }
        lines.push_back(zigzag);
    }
    return lines;
}

std::vector<Segment> cut(const Paths& lines, const Region& room) {
    ClipperLib::Clipper clipper;
    clipper.AddPaths(lines, ClipperLib::ptSubject, false);
    clipper.AddPaths(to_clipper(room), ClipperLib::ptClip, true);
    ClipperLib::PolyTree tree;
    clipper.Execute(ClipperLib::ctIntersection, tree, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
    Paths open;
    ClipperLib::OpenPathsFromPolyTree(tree, open);
    std::vector<Segment> tracks;
    for (const ClipperLib::Path& path : open)
        for (std::size_t j = 0; j + 1 < path.size(); ++j)
            tracks.push_back({{path[j].X, path[j].Y}, {path[j + 1].X, path[j + 1].Y}});
    return tracks;
}

}  // namespace

Hollowed standard_infill(const Stack& stack, Pattern pattern, double density, const Settings& settings) {
    Box box;
    for (const Slice& slice : stack.slices)
        for (const Contour& c : slice.rounded)
            for (Point p : c) box.add(p);
    const double spacing = static_cast<double>(settings.nozzle) / density;
    const Paths lines =
        pattern == Pattern::grid ? grid(box, 2 * spacing) : honeycomb(box, 2 * spacing / std::numbers::sqrt3);
    Hollowed result;
    result.tracks.resize(stack.slices.size());
    result.cavities.resize(stack.slices.size());
    oneapi::tbb::parallel_for(std::size_t{0}, stack.slices.size(), [&](std::size_t i) {
        result.cavities[i] = make_cavity(static_cast<int>(i), stack.room[i], settings).region;
        if (!result.cavities[i].empty()) result.tracks[i] = cut(lines, result.cavities[i]);
    });
    for (std::size_t i = 0; i < result.tracks.size(); ++i) {
        const double section = to_mm(settings.nozzle) * to_mm(settings.height_of(i));
        for (const Segment& s : result.tracks[i]) result.track_volume_mm3 += length(s) / units_per_mm * section;
    }
    return result;
}

double track_length_mm(const Hollowed& hollowed) {
    double sum = 0;
    for (const std::vector<Segment>& layer : hollowed.tracks)
        for (const Segment& s : layer) sum += length(s) / units_per_mm;
    return sum;
}

}  // namespace ribvault::baselines
