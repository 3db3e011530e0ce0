// Thrifty strategy: which roots go towards each other along the shell, so that their trees become one.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "ribvault/exact/real_vector.hpp"
#include "ribvault/vault/cavity_boundary.hpp"

namespace ribvault {

/// A root on the shell.
struct TreeRoot {
    Point at;
    double trunk;      ///< length of its tree from here to the first junction or the tip, lattice units
    std::size_t tree;  ///< roots of the same tree have the same; below the number of vertices
    Vec away;          ///< where its walls lead, of any length
};

inline constexpr std::size_t no_root = std::numeric_limits<std::size_t>::max();

/// For each root the one it goes towards, or no_root; mutual. Pairs are neighbours along a contour of the boundary, of
/// trees that no other pairs make one, in the same place or with trunks at most 60° apart, and no farther from each
/// other than `farthest` nor than twice the shorter trunk: both come closer by the step that a tip loses on a layer, so
/// they are one before that trunk would have run back, and from then on one trunk does for two. Closer pairs first;
/// ties go by the place along the boundary. Precondition: the boundary has edges.
std::vector<std::size_t> pair_roots(const std::vector<TreeRoot>& roots, const CavityBoundary& boundary, Unit farthest);

}  // namespace ribvault
