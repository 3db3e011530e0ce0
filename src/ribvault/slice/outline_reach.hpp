// Whether the outline of one slice stays within a distance of another one, exactly: what recedes by exactly ρ holds, by
// a nanometre more not.
#pragma once

#include <memory>

#include "ribvault/exact/lattice.hpp"

namespace ribvault {

struct ExactPolygons;  // slice/exact_polygons.hpp

/// Edges are looked up by their boxes; made when first asked.
class OutlineReach {
public:
    /// All must outlive it. radius: lattice units.
    OutlineReach(const ExactPolygons& upper, const ExactPolygons& lower, Unit radius);
    ~OutlineReach();

    /// Is every point of upper's outline in this box (lattice units) within the radius of lower's outline? Exact when
    /// it says yes: a piece of an edge whose two ends are within the radius of the same edge is, because the set within
    /// a radius of a segment is convex. Says no when halving eight times does not find such pieces.
    bool holds_in(const Box& box);

private:
    struct Edges;
    const ExactPolygons& upper_;
    const ExactPolygons& lower_;
    Unit radius_;
    std::unique_ptr<Edges> edges_;
};

}  // namespace ribvault
