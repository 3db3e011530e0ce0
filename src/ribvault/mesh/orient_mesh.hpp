// Makes neighbouring triangles agree on which side is outside.
#pragma once

#include <cstddef>

#include "ribvault/mesh/mesh.hpp"

namespace ribvault {

/// Turns triangles over until any two that alone share an edge run through it in opposite directions, where that is
/// possible; within each connected part as few are turned as can be. Which side of a part is outside stays its
/// majority's. Returns how many were turned. O(n log n).
std::size_t orient_consistently(Mesh& mesh);

}  // namespace ribvault
