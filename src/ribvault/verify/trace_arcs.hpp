// The pieces of curves that bound a region. Exact. Heavy: include in .cpp files only.
#pragma once

#include "ribvault/verify/curve_order.hpp"

namespace ribvault::verify {

/// A stretch of a curve between neighbouring vertices, with the region on one side of it and not on the other.
struct TraceArc {
    int curve = 0;
    int from = -1,
        to = -1;  ///< vertices, in the direction in which the region is on the left; -1: a circle without one
    bool forward = true;     ///< whether that is the curve's own direction
    double angle = 0;        ///< circles: how far round, 0 to 2 pi, rounded
    CurvePoint sample;       ///< a point of it, no end
};

/// All of them, curve by curve. Unites vertices that are one point.
std::vector<TraceArc> find_trace_arcs(TraceProblem& trace);

}  // namespace ribvault::verify
