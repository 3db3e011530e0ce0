// Winding numbers by what a ray or a path crosses; each caller brings its own exact predicates.
#pragma once

#include <span>

#include "ribvault/verify/cover_problem.hpp"

namespace ribvault::verify {

/// How the ray from p to +x crosses the edge from a to b: 1 upwards, -1 downwards, 0 not at all. The sum over all edges
/// of closed boundaries, which p is on none of, is their winding number about p. `a_above`, `b_above`: whether the end
/// is as high as p or higher; `side()`: the sign of the orientation of (a, b, p), asked for only where that decides.
template <class Side>
int ray_crossing(bool a_above, bool b_above, const Side& side) {
    if (a_above == b_above) return 0;
    const int way = b_above ? 1 : -1;
    return side() == way ? way : 0;
}

/// The winding number at the end of a straight path minus that at its start, for the oriented edges all[which...].
/// `from_side(e)` and `to_side(e)`: on which side of the line of all[e] the path starts and ends, neither 0;
/// `left_of_path(v)`: whether vertex v is to the left of the line of the path, or on it. Precondition: no other edge of
/// that boundary meets the path.
template <class Which, class FromSide, class ToSide, class LeftOfPath>
int winding_change(std::span<const Edge> all, const Which& which, const FromSide& from_side, const ToSide& to_side,
                   const LeftOfPath& left_of_path) {
    int winding = 0;
    for (const int e : which) {
        const Edge& edge = all[static_cast<std::size_t>(e)];
        const int side = to_side(e);
        if (side == from_side(e) || left_of_path(edge.a) == left_of_path(edge.b)) continue;
        winding += side;
    }
    return winding;
}

}  // namespace ribvault::verify
