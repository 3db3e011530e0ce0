#include "ribvault/vault/cavity_boundary.hpp"

namespace ribvault {

CavityBoundary prepare_boundary(const Region& cavity) {
    std::vector<Segment> edges = edges_of(cavity);
    return {NearestSegment(edges), PointLocation(std::move(edges), units_per_mm / 2)};
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
