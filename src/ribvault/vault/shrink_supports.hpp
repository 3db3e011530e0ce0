// Thrifty strategy: erosion and straightening as one descent of the supports' length (in place of Section 4.1,
// Reduction).
#pragma once

#include <vector>

#include "ribvault/vault/cavity_boundary.hpp"
#include "ribvault/vault/support_forest.hpp"

namespace ribvault {

struct ShrunkSupports {
    SupportForest forest;
    std::vector<char> survives;  ///< per edge of the input, in its order: something of it is left
    bool left_cavity = false;    ///< some wall meets the boundary of C_i and must be clipped again
};

/// Shortens the supports as far as points that move by at most `step` can: tips run back, junctions move too, roots
/// slide along the shell, neighbouring trees by their roots towards each other until they are one
/// (vault/root_pairs.hpp), vertices that meet merge, the narrowest corner of a crowded junction or root, and any below
/// 20°, is zipped up as far as both its walls can come together, and a tree with several roots is cut apart between
/// them.
///
/// Every point of a wall stays within `step` of what has become of the wall (a segment whose ends moved by at most
/// `step`, decided exactly, or a point within `step` of both its ends), so equation (1) holds as for the paper's two
/// operators; where a wall is zipped or cut in between, the place on it is rounded to the lattice (0.7 units, 7 nm). No
/// two walls cross that did not before.
///
/// `braced` > 0 (vault/brace_trees.hpp): a tree is cut between its roots only where no part would be longer, two of its
/// roots that have come to the same place become one, and trees do not become one.
///
/// Roots of trees that stand free stay where they are, and of such a tree that has no more than `pillar_length`
/// everything does. With boundary.leaning they lean instead (vault/lean_trees.hpp), and every tree, of which each must
/// have one root, is left one.
ShrunkSupports shrink_supports(const SupportForest& forest, const CavityBoundary& boundary, Unit step,
                               Unit pillar_length = 0, Unit braced = 0);

}  // namespace ribvault
