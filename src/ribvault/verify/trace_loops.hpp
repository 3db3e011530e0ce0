// Arcs joined to closed loops, their areas, and which loop lies in which. Exact. Heavy: include in .cpp files only.
#pragma once

#include <array>

#include "ribvault/verify/trace_arcs.hpp"

namespace ribvault::verify {

/// Successive arcs on one curve in one direction, with nothing else at the points between.
struct TracePiece {
    int curve = 0;
    int from = -1, to = -1;  ///< vertices; -1: a whole circle without one
    bool forward = true;
    double angle = 0;        ///< circles: how far round, rounded
    int arc = 0;             ///< one of its arcs
};
using TraceLoop = std::vector<TracePiece>;

/// The loops that run along the boundary of one component of the region's interior each, the region on their left.
/// Every arc is in one of them.
std::vector<TraceLoop> join_arcs(TraceProblem& trace, const std::vector<TraceArc>& arcs);

/// Enclosure of the area to the left of the loops, a hole's being negative; square local units, 1e-9 of it wide or
/// less. Precondition: it is not 0, as that of one loop, or of a component's loops, is not.
std::array<Rational, 2> loops_area(TraceProblem& trace, std::span<const TraceLoop* const> loops);

/// How often the loop runs round the point, which is not on it. Exact.
int winding_number(TraceProblem& trace, const TraceLoop& loop, const CurvePoint& p);

}  // namespace ribvault::verify
