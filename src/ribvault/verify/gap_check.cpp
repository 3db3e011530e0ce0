#include "ribvault/verify/gap_check.hpp"

#include "ribvault/slice/exact_polygons.hpp"
#include "ribvault/verify/winding.hpp"

namespace ribvault {
namespace {

using Number = ExactKernel::FT;

/// An edge of the outline with a box around it.
struct OutlineEdge {
    ExactKernel::Segment_2 edge;
    CGAL::Bbox_2 box;
};
std::vector<OutlineEdge> edges_of(const ExactPolygons& outline) {
    std::vector<OutlineEdge> edges;
    for_each_boundary(outline, [&](const ExactPolygon& polygon) {
        for (auto e = polygon.edges_begin(); e != polygon.edges_end(); ++e) edges.push_back({*e, e->bbox()});
    });
    return edges;
}

/// By the parity of edges that the ray to the right crosses.
bool inside(const std::vector<OutlineEdge>& edges, const ExactKernel::Point_2& p) {
    bool odd = false;
    const CGAL::Bbox_2 at = p.bbox();
    for (const OutlineEdge& e : edges) {
        if (e.box.ymax() < at.ymin() || e.box.ymin() > at.ymax() || e.box.xmax() < at.xmin()) continue;
        const auto &a = e.edge.source(), &b = e.edge.target();
        const auto side = [&] { return static_cast<int>(CGAL::orientation(a, b, p)); };
        if (verify::ray_crossing(a.y() >= p.y(), b.y() >= p.y(), side) != 0) odd = !odd;
    }
    return odd;
}

}  // namespace

std::optional<Segment> find_too_near(const ExactPolygons& outline, const std::vector<Segment>& tracks, Unit distance) {
    const std::vector<OutlineEdge> edges = edges_of(outline);
    const Number least = exact_mm(distance) * exact_mm(distance);
    const double by = to_mm(distance) + 1e-6;
    for (const Segment& track : tracks) {
        const ExactKernel::Point_2 a = exact_mm(track.a), b = exact_mm(track.b);
        const CGAL::Bbox_2 box = a.bbox() + b.bbox();
        for (const OutlineEdge& e : edges) {
            if (e.box.xmin() > box.xmax() + by || e.box.xmax() < box.xmin() - by || e.box.ymin() > box.ymax() + by ||
                e.box.ymax() < box.ymin() - by)
                continue;
            const Number d = track.a == track.b ? CGAL::squared_distance(a, e.edge)
                                                : CGAL::squared_distance(ExactKernel::Segment_2(a, b), e.edge);
            if (d < least) return track;
        }
        if (inside(edges, a)) return track;
    }
    return std::nullopt;
}

std::optional<Segment> find_too_near(const NearestSegment& object, const std::vector<Segment>& tracks, Unit distance) {
    for (const Segment& track : tracks) {
        bool near = false;
        object.visit(bounding_box(track, distance), [&](std::uint32_t k) {
            near = near || compare_distance(object.segments()[k], track, distance) < 0;
        });
        if (near) return track;
    }
    return std::nullopt;
}

}  // namespace ribvault
