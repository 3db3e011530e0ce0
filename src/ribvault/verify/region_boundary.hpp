// The exact boundary of what is not supported, as line segments and circular arcs. Light: no CGAL.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "ribvault/exact/rational.hpp"

namespace ribvault {

/// A whole circle or line on which pieces of the boundary lie. Coordinates and radius in mm, exact.
struct BoundaryCurve {
    bool line = false;
    bool above = false;     ///< of a track above (radius: half its width), else of one below (plus ρ)
    std::size_t track = 0;  ///< one of the tracks of that layer whose stadium has the curve
    std::array<Rational, 2> a, b;  ///< circle: its centre a == b. Line: the parallel at distance `radius` to the right
                                   ///< of the line from a to b, the track's centre line or that turned round
    Rational radius;               ///< > 0
};

/// An end of pieces: where two curves meet.
struct BoundaryVertex {
    std::size_t first = 0, second = 0;  ///< indices into RegionBoundary::curves
    int root = 0;  ///< 0: they meet in this point only. Circle and line: 1 is the point farther along the line's
                   ///< direction from a to b. Two circles: 1 is left of the way from the first's centre to the second's
    std::array<double, 2> x{0, 0}, y{0, 0};  ///< mm; [lo, hi] that contain the coordinates
};

/// A piece of a curve, run through with the region on its left.
struct BoundaryPiece {
    static constexpr std::size_t nowhere = static_cast<std::size_t>(-1);
    std::size_t curve = 0;
    std::size_t from = nowhere, to = nowhere;  ///< vertices; equal: a whole circle, `nowhere`: one without a vertex
    int turn = 0;      ///< 1: counterclockwise arc, -1: clockwise arc, 0: line segment
    double angle = 0;  ///< arcs: how far round, more than 0 and at most 2 pi but for rounding
};

/// A closed loop: each piece begins where the one before ends, the first where the last does. It may touch itself in
/// points.
using BoundaryLoop = std::vector<BoundaryPiece>;

/// A connected component of the interior of the region, with the loops that bound it.
struct RegionComponent {
    std::vector<BoundaryLoop> loops;  ///< the outer one, counterclockwise, then the holes, clockwise
    double area_lo = 0, area_hi = 0;  ///< mm²; enclosure
};

struct RegionBoundary {
    std::vector<BoundaryCurve> curves;
    std::vector<BoundaryVertex> vertices;
    std::vector<RegionComponent> components;
};

}  // namespace ribvault
