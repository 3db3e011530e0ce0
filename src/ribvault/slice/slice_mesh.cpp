#include "ribvault/slice/slice_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>

#include "ribvault/error.hpp"
#include "ribvault/slice/close_gaps.hpp"
#include "ribvault/slice/edge_crossings.hpp"
#include "ribvault/slice/nest_contours.hpp"
#include "ribvault/slice/slivers.hpp"

namespace ribvault {
namespace {

std::string describe(const std::vector<GapClosing>& gaps) {
    std::ostringstream text;
    for (std::size_t k = 0; k < std::min<std::size_t>(gaps.size(), 3); ++k)
        text << (k ? "; " : "") << gaps[k].length << " mm wide on layer " << gaps[k].layer << " at (" << gaps[k].x
             << ", " << gaps[k].y << ") mm";
    if (gaps.size() > 3) text << "; ...";
    return text.str();
}

[[noreturn]] void refuse_open(std::vector<GapClosing> gaps, const std::string& where, const Settings& settings) {
    std::stable_sort(gaps.begin(), gaps.end(),
                     [](const GapClosing& a, const GapClosing& b) { return a.length > b.length; });
    std::ostringstream text;
    text << "the mesh is open: " << gaps.size() << (gaps.size() == 1 ? " gap" : " gaps") << " wider than "
         << to_mm(settings.max_gap) << " mm " << where << " (" << describe(gaps)
         << "); repair the mesh, or allow wider gaps with --max-gap";
    throw Error(ErrorKind::bad_geometry, text.str());
}

/// What a crossed triangle leads through: from one mesh edge to another, material to the left seen from above.
struct Link {
    std::int32_t from, to;
    bool operator<(const Link& o) const { return from != o.from ? from < o.from : to < o.to; }
};

/// Links joined to chains of mesh edges.
class ChainTracer {
public:
    explicit ChainTracer(std::vector<Link> links) : links_(std::move(links)), used_(links_.size(), 0) {
        std::sort(links_.begin(), links_.end());
    }
    std::vector<std::vector<std::int32_t>> closed, open;  ///< open: with both ends

    /// Open chains first, from edges that more links leave than reach.
    void run() {
        std::vector<std::int32_t> reached(links_.size());
        std::transform(links_.begin(), links_.end(), reached.begin(), [](const Link& l) { return l.to; });
        std::sort(reached.begin(), reached.end());
        for (std::size_t k = 0; k < links_.size();) {
            std::size_t same = k;
            while (same < links_.size() && links_[same].from == links_[k].from) ++same;
            const auto arriving = std::equal_range(reached.begin(), reached.end(), links_[k].from);
            for (std::ptrdiff_t surplus = static_cast<std::ptrdiff_t>(same - k) - (arriving.second - arriving.first);
                 surplus > 0; --surplus) {
                const std::size_t link = first_unused_from(links_[k].from);
                if (link < links_.size()) walk(link);
            }
            k = same;
        }
        for (std::size_t k = 0; k < links_.size(); ++k)
            if (!used_[k]) walk(k);
    }

private:
    /// The first unused link that starts on the edge; none: links_.size().
    std::size_t first_unused_from(std::int32_t edge) const {
        auto it = std::lower_bound(links_.begin(), links_.end(), Link{edge, std::numeric_limits<std::int32_t>::min()});
        for (; it != links_.end() && it->from == edge; ++it)
            if (!used_[static_cast<std::size_t>(it - links_.begin())])
                return static_cast<std::size_t>(it - links_.begin());
        return links_.size();
    }
    void walk(std::size_t link) {
        std::vector<std::int32_t> chain{links_[link].from};
        while (link < links_.size()) {
            used_[link] = 1;
            chain.push_back(links_[link].to);
            if (chain.back() == chain.front()) break;
            link = first_unused_from(chain.back());
        }
        const bool is_closed = chain.back() == chain.front();
        if (is_closed) chain.pop_back();
        (is_closed ? closed : open).push_back(std::move(chain));
    }

    std::vector<Link> links_;
    std::vector<char> used_;
};

}  // namespace

/// Contours of one layer as mesh edges in order: closed ones, and chains with two ends.
struct Slicer::Contours {
    std::vector<std::vector<std::int32_t>> closed, open;
};

Rational Slicer::plane_height(int layer) const {
    Rational first(settings_.first_layer_height, units_per_mm), height(settings_.layer_height, units_per_mm);
    first.canonicalize(), height.canonicalize();
    if (layer == 0) return first / 2;
    return first + height * Rational(2 * layer - 1, 2);
}

Slicer::Slicer(const Mesh& mesh, const Placement& placement, const Settings& settings)
    : mesh_(mesh), placement_(placement), settings_(settings), grid_bits_(mesh_grid_bits(mesh)) {
    const auto vertices = static_cast<std::size_t>(mesh.vertices.cols()),
               triangles = static_cast<std::size_t>(mesh.triangles.cols());
    const auto height = [&](std::size_t v) {
        return placement_.sign[2] * mesh_.vertices(placement_.axis[2], static_cast<Eigen::Index>(v));
    };
    // In the file's units, plane i lies at base + i * step for i >= 1. A vertex's count of planes is exact: the double
    // quotient is off by far less than one, and whether the nearest plane lies at or below is compared exactly.
    const Rational base = (plane_height(1) - placement_.offset[2]) / placement_.scale -
                          (plane_height(2) - plane_height(1)) / placement_.scale;
    const Rational step = (plane_height(2) - plane_height(1)) / placement_.scale;
    const Rational lowest = (plane_height(0) - placement_.offset[2]) / placement_.scale;
    const double base_d = base.get_d(), step_d = step.get_d();
    const auto plane = [&](std::int64_t i) {
        return i == 0 ? lowest : Rational(base + step * Rational(static_cast<long>(i)));
    };
    planes_below_.resize(vertices);
    for (std::size_t v = 0; v < vertices; ++v) {
        const double z = height(v), quotient = (z - base_d) / step_d;
        std::int64_t count =
            static_cast<std::int64_t>(std::floor(std::clamp(quotient, 0.0, 1e9))) + 1;  // planes 0 .. floor
        // base_d and step_d are cut off (2^-52), difference and quotient rounded (2^-53): together less than this.
        const double bound = 0x1p-49 * ((std::fabs(z) + std::fabs(base_d)) / step_d + std::fabs(quotient) + 1);
        if (quotient < 1.5 || std::fabs(quotient - std::round(quotient)) <= bound) {
            const Rational exact(z);
            while (count > 0 && plane(count - 1) > exact) --count;
            while (plane(count) <= exact) ++count;
        }
        planes_below_[v] = static_cast<std::int32_t>(count);
        // A plane through the top vertex alone cuts nothing; such layers are left out below.
        layers_ = std::max(layers_, static_cast<int>(count));
    }

    edge_of_.resize(3 * triangles);
    std::vector<std::uint32_t> order(3 * triangles);
    std::iota(order.begin(), order.end(), 0u);
    const auto ends = [&](std::uint32_t k) {
        const auto t = static_cast<Eigen::Index>(k / 3);
        const std::int32_t a = mesh_.triangles(k % 3, t), b = mesh_.triangles((k + 1) % 3, t);
        return std::array<std::int32_t, 2>{std::min(a, b), std::max(a, b)};
    };
    std::vector<std::array<std::int32_t, 2>> corner_ends(order.size());
    for (std::uint32_t k = 0; k < order.size(); ++k) corner_ends[k] = ends(k);
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return corner_ends[a] < corner_ends[b]; });
    for (std::size_t k = 0; k < order.size(); ++k) {
        if (k == 0 || corner_ends[order[k]] != corner_ends[order[k - 1]]) edge_ends_.push_back(corner_ends[order[k]]);
        edge_of_[order[k]] = static_cast<std::int32_t>(edge_ends_.size()) - 1;
    }

    const auto span = [&](std::size_t t) {
        std::int32_t lo = std::numeric_limits<std::int32_t>::max(), hi = 0;
        for (int k = 0; k < 3; ++k) {
            const std::int32_t c =
                planes_below_[static_cast<std::size_t>(mesh_.triangles(k, static_cast<Eigen::Index>(t)))];
            lo = std::min(lo, c), hi = std::max(hi, c);
        }
        return std::pair(lo, hi);
    };
    layer_starts_.assign(static_cast<std::size_t>(layers_) + 1, 0);
    for (std::size_t t = 0; t < triangles; ++t)
        for (auto [i, hi] = span(t); i < hi; ++i) ++layer_starts_[static_cast<std::size_t>(i) + 1];
    for (std::size_t i = 0; i < static_cast<std::size_t>(layers_); ++i) layer_starts_[i + 1] += layer_starts_[i];
    layer_triangles_.resize(layer_starts_.back());
    std::vector<std::uint32_t> next(layer_starts_.begin(), layer_starts_.end() - 1);
    for (std::size_t t = 0; t < triangles; ++t)
        for (auto [i, hi] = span(t); i < hi; ++i)
            layer_triangles_[next[static_cast<std::size_t>(i)]++] = static_cast<std::uint32_t>(t);
    while (layers_ > 0 &&
           layer_starts_[static_cast<std::size_t>(layers_)] == layer_starts_[static_cast<std::size_t>(layers_) - 1])
        --layers_;
}

Slicer::Contours Slicer::trace(int layer) const {
    const bool mirrored = handedness(placement_) < 0;
    std::vector<Link> links;
    const auto index = static_cast<std::size_t>(layer);
    for (std::uint32_t k = layer_starts_[index]; k < layer_starts_[index + 1]; ++k) {
        const std::uint32_t t = layer_triangles_[k];
        bool above[3];
        for (int c = 0; c < 3; ++c)
            above[c] =
                planes_below_[static_cast<std::size_t>(mesh_.triangles(c, static_cast<Eigen::Index>(t)))] > layer;
        // The sides on which the triangle's boundary rises above and falls below the plane.
        int rising = -1, falling = -1;
        for (int c = 0; c < 3; ++c) {
            if (!above[c] && above[(c + 1) % 3]) rising = c;
            if (above[c] && !above[(c + 1) % 3]) falling = c;
        }
        Link link{edge_of_[3 * t + static_cast<std::uint32_t>(falling)],
                  edge_of_[3 * t + static_cast<std::uint32_t>(rising)]};
        if (mirrored) std::swap(link.from, link.to);
        links.push_back(link);
    }
    ChainTracer tracer(std::move(links));
    tracer.run();
    return {std::move(tracer.closed), std::move(tracer.open)};
}

namespace {

void drop_repeated(ExactContour& contour, bool closed) {
    contour.erase(std::unique(contour.begin(), contour.end()), contour.end());
    while (closed && contour.size() > 1 && contour.front() == contour.back()) contour.pop_back();
}

ClosedGaps close_contours(const std::vector<std::vector<std::int32_t>>& closed,
                          const std::vector<std::vector<std::int32_t>>& open,
                          const std::vector<std::array<std::int32_t, 2>>& edge_ends, const EdgeCrossings& crossings,
                          int layer, Unit max_gap) {
    const auto points = [&](const std::vector<std::int32_t>& edges, bool is_closed) {
        ExactContour contour;
        contour.reserve(edges.size());
        for (const std::int32_t e : edges) contour.push_back(crossings.at(edge_ends[static_cast<std::size_t>(e)]));
        drop_repeated(contour, is_closed);
        return contour;
    };
    ClosedGaps result;
    if (!open.empty()) {
        std::vector<ExactContour> chains;
        for (const auto& chain : open) chains.push_back(points(chain, false));
        result = close_gaps(std::move(chains), layer, max_gap);
        for (ExactContour& contour : result.contours) drop_repeated(contour, true);
    }
    for (const auto& contour : closed) result.contours.push_back(points(contour, true));
    std::erase_if(result.contours, [](const ExactContour& c) { return c.size() < 3; });
    return result;
}

}  // namespace

Slice Slicer::slice(int layer, std::vector<GapClosing>* closings) const {
    const EdgeCrossings crossings(mesh_, placement_, plane_height(layer), grid_bits_);
    const Contours contours = trace(layer);
    ClosedGaps gaps = close_contours(contours.closed, contours.open, edge_ends_, crossings, layer, settings_.max_gap);
    if (!gaps.open.empty()) refuse_open(gaps.open, "on layer " + std::to_string(layer), settings_);
    if (closings) closings->insert(closings->end(), gaps.closings.begin(), gaps.closings.end());

    Slice slice;
    slice.layer = layer;
    set_contours(slice, gaps.contours);
    if (has_slivers(slice)) return without_slivers(slice);
    return slice;
}

std::vector<GapClosing> Slicer::open_gaps(int layer) const {
    const Contours contours = trace(layer);
    if (contours.open.empty()) return {};
    const EdgeCrossings crossings(mesh_, placement_, plane_height(layer), grid_bits_);
    return close_contours({}, contours.open, edge_ends_, crossings, layer, settings_.max_gap).open;
}

void require_closed_contours(const Slicer& slicer, const Settings& settings) {
    std::vector<GapClosing> gaps;
    for (int layer = 0; layer < slicer.layer_count(); ++layer) {
        const std::vector<GapClosing> here = slicer.open_gaps(layer);
        gaps.insert(gaps.end(), here.begin(), here.end());
    }
    if (!gaps.empty()) refuse_open(std::move(gaps), "on all layers together", settings);
}

}  // namespace ribvault
