#include "ribvault/slice/nest_contours.hpp"

#include <algorithm>
#include <cmath>

namespace ribvault {
namespace {

/// Enclosure of an edge in machine numbers.
struct Bounds {
    double x0, y0, x1, y1;
    bool meets(const Bounds& o) const { return x0 <= o.x1 && o.x0 <= x1 && y0 <= o.y1 && o.y0 <= y1; }
    void add(const Bounds& o) {
        x0 = std::min(x0, o.x0), y0 = std::min(y0, o.y0), x1 = std::max(x1, o.x1), y1 = std::max(y1, o.y1);
    }
};
constexpr Bounds no_bounds{1e300, 1e300, -1e300, -1e300};

Bounds bounds_of(const ExactPoint& p) {
    const auto x = CGAL::to_interval(p.x()), y = CGAL::to_interval(p.y());
    return {x.first, y.first, x.second, y.second};
}

struct Edge {
    const ExactPoint *a, *b;
    std::uint32_t contour, index;
    Bounds bounds;
};

/// All edges of all contours in a uniform grid over their enclosures.
class EdgeGrid {
public:
    explicit EdgeGrid(const std::vector<ExactContour>& contours) {
        std::size_t n = 0;
        for (const ExactContour& c : contours) n += c.size();
        edges_.reserve(n);
        for (std::uint32_t c = 0; c < contours.size(); ++c) {
            contour_bounds_.push_back(no_bounds);
            std::vector<Bounds> points;
            for (const ExactPoint& p : contours[c]) points.push_back(bounds_of(p));
            for (std::uint32_t i = 0; i < contours[c].size(); ++i) {
                const std::size_t j = i + 1 == contours[c].size() ? 0 : i + 1;
                Bounds b = points[i];
                b.add(points[j]);
                edges_.push_back({&contours[c][i], &contours[c][j], c, i, b});
                contour_bounds_.back().add(b);
            }
            all_.add(contour_bounds_.back());
        }
        side_ = static_cast<std::uint32_t>(std::clamp(std::sqrt(static_cast<double>(n)), 1.0, 1024.0));
        starts_.assign(static_cast<std::size_t>(side_) * side_ + 1, 0);
        for (const Edge& e : edges_) for_cells(e.bounds, [&](std::size_t cell) { ++starts_[cell + 1]; });
        for (std::size_t k = 0; k + 1 < starts_.size(); ++k) starts_[k + 1] += starts_[k];
        members_.resize(starts_.back());
        std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
        for (std::uint32_t k = 0; k < edges_.size(); ++k)
            for_cells(edges_[k].bounds, [&](std::size_t cell) { members_[next[cell]++] = k; });
    }

    /// Do any two edges meet elsewhere than neighbours at their common point? Exact.
    bool any_meet(const std::vector<ExactContour>& contours) const {
        for (std::size_t cell = 0; cell + 1 < starts_.size(); ++cell)
            for (std::uint32_t i = starts_[cell]; i < starts_[cell + 1]; ++i)
                for (std::uint32_t j = i + 1; j < starts_[cell + 1]; ++j) {
                    const Edge &e = edges_[members_[i]], &f = edges_[members_[j]];
                    if (e.bounds.meets(f.bounds) && meet(e, f, contours)) return true;
                }
        return false;
    }

    /// Winding number of one contour around p, which is on none of its edges. Exact. `b`: bounds of p.
    int winding(std::uint32_t contour, std::size_t first_edge, std::size_t count, const ExactPoint& p,
                const Bounds& b) const {
        if (!contour_bounds_[contour].meets(b)) return 0;
        int winding = 0;
        for (std::size_t k = first_edge; k < first_edge + count; ++k) {
            const Edge& e = edges_[k];
            if (e.bounds.y1 < b.y0 || e.bounds.y0 > b.y1 || e.bounds.x1 < b.x0) continue;
            const bool from = e.a->y() <= p.y(), to = e.b->y() <= p.y();
            if (from == to) continue;
            const CGAL::Orientation side = CGAL::orientation(*e.a, *e.b, p);
            if (from && side == CGAL::LEFT_TURN) ++winding;
            if (to && side == CGAL::RIGHT_TURN) --winding;
        }
        return winding;
    }

    const Bounds& bounds(std::uint32_t contour) const { return contour_bounds_[contour]; }

private:
    template <class Visit>
    void for_cells(const Bounds& b, Visit&& visit) const {
        const double wx = std::max(all_.x1 - all_.x0, 1e-300), wy = std::max(all_.y1 - all_.y0, 1e-300);
        const auto cell = [&](double v, double lo, double w) {
            return static_cast<std::uint32_t>(std::clamp((v - lo) / w * side_, 0.0, static_cast<double>(side_ - 1)));
        };
        const std::uint32_t x0 = cell(b.x0, all_.x0, wx), x1 = cell(b.x1, all_.x0, wx);
        const std::uint32_t y0 = cell(b.y0, all_.y0, wy), y1 = cell(b.y1, all_.y0, wy);
        for (std::uint32_t y = y0; y <= y1; ++y)
            for (std::uint32_t x = x0; x <= x1; ++x) visit(static_cast<std::size_t>(y) * side_ + x);
    }

    static bool meet(const Edge& e, const Edge& f, const std::vector<ExactContour>& contours) {
        if (e.contour == f.contour) {
            const auto n = static_cast<std::uint32_t>(contours[e.contour].size());
            // Neighbours share a point; they overlap when one turns back along the other.
            if ((e.index + 1) % n == f.index) return turns_back(*e.a, *e.b, *f.b);
            if ((f.index + 1) % n == e.index) return turns_back(*f.a, *f.b, *e.b);
        }
        return CGAL::do_intersect(ExactKernel::Segment_2(*e.a, *e.b), ExactKernel::Segment_2(*f.a, *f.b));
    }
    static bool turns_back(const ExactPoint& a, const ExactPoint& b, const ExactPoint& c) {
        return CGAL::orientation(a, b, c) == CGAL::COLLINEAR && CGAL::angle(a, b, c) == CGAL::ACUTE;
    }

    std::vector<Edge> edges_;
    std::vector<Bounds> contour_bounds_;
    Bounds all_ = no_bounds;
    std::uint32_t side_ = 1;
    std::vector<std::uint32_t> starts_, members_;
};

Contour rounded(const ExactPolygon& polygon) {
    Contour contour;
    for (auto v = polygon.vertices_begin(); v != polygon.vertices_end(); ++v) {
        const Point p{round_to_lattice(approximate(v->x()) * units_per_mm),
                      round_to_lattice(approximate(v->y()) * units_per_mm)};
        if (contour.empty() || contour.back() != p) contour.push_back(p);
    }
    while (contour.size() > 1 && contour.front() == contour.back()) contour.pop_back();
    return contour;
}

}  // namespace

std::optional<ExactPolygons> nest_contours(const std::vector<ExactContour>& contours) {
    const EdgeGrid grid(contours);
    if (grid.any_meet(contours)) return std::nullopt;

    std::vector<ExactPolygon> polygons;
    std::vector<int> turn;  // +1 counter-clockwise, -1 clockwise
    std::vector<std::size_t> first_edge;
    std::size_t edges = 0;
    for (const ExactContour& c : contours) {
        polygons.emplace_back(c.begin(), c.end());
        turn.push_back(polygons.back().orientation() == CGAL::COUNTERCLOCKWISE ? 1 : -1);
        first_edge.push_back(edges);
        edges += c.size();
    }
    const auto n = static_cast<std::uint32_t>(contours.size());
    std::vector<std::vector<std::uint32_t>> around(n);  // the contours around each
    ExactPolygons result;
    std::vector<int> outside(n, 0);
    std::vector<std::int64_t> polygon_of(n, -1);
    for (std::uint32_t c = 0; c < n; ++c) {
        const ExactPoint& p = contours[c].front();
        const Bounds b = bounds_of(p);
        for (std::uint32_t d = 0; d < n; ++d) {
            if (c == d) continue;
            const int w = grid.winding(d, first_edge[d], contours[d].size(), p, b);
            outside[c] += w;
            if (w != 0) around[c].push_back(d);
        }
    }
    const auto kept = [&](std::uint32_t c) { return (outside[c] == 0) != (outside[c] + turn[c] == 0); };
    for (std::uint32_t c = 0; c < n; ++c) {
        if (!kept(c) || outside[c] != 0) continue;
        if (turn[c] < 0) polygons[c].reverse_orientation();
        polygon_of[c] = static_cast<std::int64_t>(result.polygons.size());
        result.polygons.emplace_back(polygons[c]);
    }
    for (std::uint32_t c = 0; c < n; ++c) {
        if (!kept(c) || outside[c] == 0) continue;
        // The outer contour nearest around this hole is itself inside all others that are around it.
        std::int64_t owner = -1;
        std::size_t depth = 0;
        for (const std::uint32_t d : around[c])
            if (polygon_of[d] >= 0 && (owner < 0 || around[d].size() > depth)) owner = d, depth = around[d].size();
        if (turn[c] > 0) polygons[c].reverse_orientation();
        result.polygons[static_cast<std::size_t>(polygon_of[static_cast<std::size_t>(owner)])].add_hole(polygons[c]);
    }
    return result;
}

void set_contours(Slice& slice, const std::vector<ExactContour>& contours) {
    std::optional<ExactPolygons> polygons = nest_contours(contours);
    slice.exact = std::make_shared<const ExactPolygons>(polygons ? std::move(*polygons) : regularise(contours));
    for_each_boundary(*slice.exact, [&](const ExactPolygon& boundary) {
        Contour contour = rounded(boundary);
        if (contour.size() < 3)
            slice.lost_contours = true;
        else
            slice.rounded.push_back(std::move(contour));
    });
}

}  // namespace ribvault
