#include "ribvault/vault/cavity_boundary.hpp"

#include <algorithm>

namespace ribvault {

CavityBoundary prepare_boundary(const Region& cavity) {
    std::vector<Segment> edges = edges_of(cavity);
    CavityBoundary boundary;
    boundary.edges = NearestSegment(edges);
    boundary.location = PointLocation(std::move(edges), units_per_mm / 2);
    return boundary;
}

std::vector<Segment> edges_off_frame(const Region& region) {
    std::vector<Segment> edges = edges_of(region);
    const Box frame = bounding_box(region);
    std::erase_if(edges, [&](const Segment& e) {
        return (e.a.x == e.b.x && (e.a.x == frame.lo.x || e.a.x == frame.hi.x)) ||
               (e.a.y == e.b.y && (e.a.y == frame.lo.y || e.a.y == frame.hi.y));
    });
    return edges;
}

CavityBoundary prepare_boundary(const Cavity& cavity) {
    if (!cavity.outside) return prepare_boundary(cavity.region);
    const Region& region = cavity.walls ? *cavity.walls : cavity.region;
    return {NearestSegment(edges_off_frame(region)), PointLocation(edges_of(region), units_per_mm / 2), true,
            !cavity.walls, cavity.layer};
}

Point place_root(Point p, const CavityBoundary& boundary) {
    if (boundary.location.locate(p) != Side::inside) return p;
    for (Unit ring = 1; ring <= root_tolerance - 1; ++ring) {
        Point best = p;
        for (Unit dy = -ring; dy <= ring; ++dy)
            for (Unit dx = -ring; dx <= ring; ++dx) {
                const Point q{p.x + dx, p.y + dy};
                if ((best == p || squared_length(q - p) < squared_length(best - p)) &&
                    boundary.location.locate(q) != Side::inside)
                    best = q;
            }
        if (best != p) return best;
    }
    // Only where more than one rounding met; the nearest vertex of the boundary is on it.
    const Segment& edge = boundary.edges.segments()[boundary.edges.nearest(p).index];
    return squared_length(edge.a - p) <= squared_length(edge.b - p) ? edge.a : edge.b;
}

}  // namespace ribvault
