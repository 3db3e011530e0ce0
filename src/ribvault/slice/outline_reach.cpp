#include "ribvault/slice/outline_reach.hpp"

#include <algorithm>
#include <optional>
#include <vector>

#include "ribvault/slice/exact_polygons.hpp"

namespace ribvault {
namespace {

using Number = ExactKernel::FT;
using ExactPoint = ExactKernel::Point_2;
using ExactSegment = ExactKernel::Segment_2;

struct Edge {
    ExactSegment segment;
    CGAL::Bbox_2 box;
};

/// Edges between corners.
std::vector<Edge> edges_of(const ExactPolygons& outline) {
    std::vector<Edge> edges;
    // Where a facet's diagonal crosses the plane an edge has vertices on it, at another place in each slice: they are
    // left out.
    for_each_boundary(outline, [&](const ExactPolygon& polygon) {
        std::vector<ExactPoint> corners;
        const std::size_t n = polygon.size();
        for (std::size_t k = 0; k < n; ++k)
            if (!CGAL::collinear(polygon[(k + n - 1) % n], polygon[k], polygon[(k + 1) % n]))
                corners.push_back(polygon[k]);
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const ExactSegment edge(corners[k], corners[(k + 1) % corners.size()]);
            edges.push_back({edge, edge.bbox()});
        }
    });
    return edges;
}

bool apart(const CGAL::Bbox_2& a, const CGAL::Bbox_2& b, double by) {
    return a.xmin() > b.xmax() + by || a.xmax() < b.xmin() - by || a.ymin() > b.ymax() + by || a.ymax() < b.ymin() - by;
}

/// The part of a segment in a box, or nothing.
std::optional<ExactSegment> clipped(const ExactSegment& s, const ExactPoint& lo, const ExactPoint& hi) {
    Number from = 0, to = 1;
    const auto d = s.target() - s.source();
    const auto cut = [&](const Number& a, const Number& step, const Number& least, const Number& most) {
        if (step == 0) return a >= least && a <= most;
        Number first = (least - a) / step, second = (most - a) / step;
        if (first > second) std::swap(first, second);
        from = std::max(from, first), to = std::min(to, second);
        return from <= to;
    };
    if (!cut(s.source().x(), d.x(), lo.x(), hi.x()) || !cut(s.source().y(), d.y(), lo.y(), hi.y())) return std::nullopt;
    return ExactSegment(s.source() + from * d, s.source() + to * d);
}

bool within(const ExactPoint& a, const ExactPoint& b, const std::vector<const Edge*>& near, const Number& square,
            int depth) {
    for (const Edge* e : near)
        if (CGAL::squared_distance(a, e->segment) <= square && CGAL::squared_distance(b, e->segment) <= square)
            return true;
    if (depth == 8 || a == b) return false;
    const ExactPoint middle = CGAL::midpoint(a, b);
    return within(a, middle, near, square, depth + 1) && within(middle, b, near, square, depth + 1);
}

}  // namespace

struct OutlineReach::Edges {
    std::vector<Edge> upper, lower;
};

OutlineReach::OutlineReach(const ExactPolygons& upper, const ExactPolygons& lower, Unit radius)
    : upper_(upper), lower_(lower), radius_(radius) {}
OutlineReach::~OutlineReach() = default;

bool OutlineReach::holds_in(const Box& box) {
    if (!edges_) edges_ = std::make_unique<Edges>(Edges{edges_of(upper_), edges_of(lower_)});
    const ExactPoint lo(exact_mm(box.lo.x), exact_mm(box.lo.y)), hi(exact_mm(box.hi.x), exact_mm(box.hi.y));
    const CGAL::Bbox_2 around = lo.bbox() + hi.bbox();
    const Number square = exact_mm(radius_) * exact_mm(radius_);
    for (const Edge& e : edges_->upper) {
        if (apart(e.box, around, 0)) continue;
        const std::optional<ExactSegment> piece = clipped(e.segment, lo, hi);
        if (!piece) continue;
        const CGAL::Bbox_2 at = piece->source().bbox() + piece->target().bbox();
        std::vector<const Edge*> near;
        for (const Edge& other : edges_->lower)
            if (!apart(other.box, at, to_mm(radius_) + 1e-6)) near.push_back(&other);
        if (!within(piece->source(), piece->target(), near, square, 0)) return false;
    }
    return true;
}

}  // namespace ribvault
