// Where the winding numbers of two boundaries can differ at all: consecutive layers are alike nearly everywhere.
#pragma once

#include <optional>
#include <vector>

#include "ribvault/verify/cover_problem.hpp"
#include "ribvault/verify/subdivide.hpp"

namespace ribvault::verify {

/// Windows (lattice units) that hold every point with different winding numbers about `moved` and about `fixed` that is
/// farther than `distance` from every edge of `fixed`. Nothing when the edges are not closed chains, one after the
/// other.
///
/// Both boundaries are walked along side by side. A stretch of both, of which each point of one is within `distance` of
/// its partner in the other, can be moved from one to the other along the segments between partners; these meet no such
/// point, so its winding number does not change. What is left are closed curves: stretches without such a partner,
/// joined by segments between partners. A point with another winding number is inside one of them, and so in its box
/// (docs/verifier.md, 4). Which partners are chosen decides how large the windows are and nothing else. Doubles, with a
/// margin far above their errors.
std::optional<std::vector<Window>> windows_of_change(std::span<const Vertex> vertices, std::span<const Edge> moved,
                                                     std::span<const Edge> fixed, double distance);

}  // namespace ribvault::verify
