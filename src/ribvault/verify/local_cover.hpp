// The local test: is a neighbourhood of a point in M covered by K? Exact at any point (docs/verifier.md, "Local test").
#pragma once

#include <span>

#include "ribvault/verify/candidate.hpp"

namespace ribvault::verify {

/// What of a problem can be near a point: everything that meets a cell around it, outside K's region.
struct Surroundings {
    std::span<const int> sites;   ///< every stadium of K that meets the cell
    std::span<const int> edges;   ///< every edge of M's region that meets the cell
    std::span<const int> pieces;  ///< every stadium of M that meets the cell
    double x = 0, y = 0;          ///< a point of the cell on no line of an edge in `edges`
    int winding = 0;              ///< of M's region there
};

enum class Local {
    not_in_m,   ///< the point is outside the closed set M
    covered,    ///< every point of M near it is in K
    uncovered,  ///< M \ K has points in every neighbourhood of it
    unknown     ///< only when stages are limited
};

/// How M \ K leaves a point: the direction rot90^turns of (vertex b - vertex a), or of (vertex a - point) when b < 0,
/// and on which side of that ray its points are, near v + s d + c s^2 n for small s > 0, n being the unit normal on
/// that side.
struct Leaving {
    int a = -1, b = -1, turns = 0;  ///< a < 0: in all directions
    int side = 0;                   ///< 1: left, -1: right
    double c = 0;                   ///< in between the curvatures, for a unit vector d; 0: any small c
};

/// Exact decision at v, with all stages. Precondition: v lies outside K's region or strictly inside a site of `near`.
/// When the answer is `uncovered`, `hint` is a unit direction along which M \ K leaves v (or touches the ray).
Local decide_locally(Located& v, const Surroundings& near, Vec<double>& hint, Leaving* leaving = nullptr);

}  // namespace ribvault::verify
