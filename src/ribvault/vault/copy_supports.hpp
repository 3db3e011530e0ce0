// Section 4.1, Copy: the supports of the layer above, fitted to this layer's cavity (Figure 11).
#pragma once

#include "ribvault/vault/cavity_boundary.hpp"
#include "ribvault/vault/support_forest.hpp"

namespace ribvault {

struct CopiedSupports {
    SupportForest forest;
    /// Per edge of forest, in its order: the edge above it is a piece of, -1 for prolongations.
    std::vector<std::int32_t> origin;
    std::vector<Segment> inherited;    ///< the pieces of the layer above inside the cavity, where they were
    std::vector<char> inherited_outside;  ///< of each: its tree stood outside
};

/// Clips every wall to C_i; where the clip cuts, a root is placed on the shell, so that a tree cut by an inner wall
/// becomes two. A root left hanging inside C_i is prolonged: straight on when the shell is met within twice its
/// distance, else to the nearest point of the shell, or to another tree's wall that stands in the way; when the way is
/// barred by its own tree, which has another root, it is a root no longer. A dot vanishes when its place is shell on
/// this layer, and is prolonged like any root when it is not.
///
/// Free roots (vault/free_trees.hpp) stay what they are, and where there is no shell to reach, any root becomes one.
/// Where the boundary is none of the shell's (removal gap), a clipped wall ends in a tip, and a tree may have no root.
///
/// shell_holds_tracks: ρ >= r, so that a wall inside the shell is held up by it over its whole width; otherwise walls
/// in the shell and those that meet the boundary are inherited whole.
CopiedSupports copy_supports(const SupportForest& above, const CavityBoundary& boundary, bool shell_holds_tracks);

}  // namespace ribvault
