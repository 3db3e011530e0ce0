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

enum class Side { inside, on, outside, unknown };

/// Where a point lies relative to a closed stadium, using stages up to `last`.
Side side_of_stadium(Located& v, const Stadium& stadium, Stage last);

/// Exact orientation of (vertex a, vertex b, v): 1 when v is to the left.
int orientation_sign(Located& v, int a, int b, Stage last);

/// Exact decision at v, with all stages. Precondition: v lies outside K's region or strictly inside a site of `near`.
/// When the answer is `uncovered`, `hint` is a unit direction along which M \ K leaves v (or touches the ray).
Local decide_locally(Located& v, const Surroundings& near, Vec<double>& hint);

/// Winding number at `to` minus that at (from_x, from_y) for the oriented edges all[which...]. Precondition: no other edge of
/// that boundary meets the segment between the two points, `to` is on none of the edges, `from` on none of their lines.
int crossings(std::span<const Edge> all, std::span<const int> which, double from_x, double from_y, Located& to);

/// The point (x, y) of a problem, for the predicates above. Coordinates in lattice units, exactly these binary floats.
Located double_point(const CoverProblem& problem, double x, double y);

/// Whether intervals certify that (x, y) is on none of the lines of all[which...].
bool off_lines(const CoverProblem& problem, std::span<const Edge> all, std::span<const int> which, double x, double y);

}  // namespace ribvault::verify
