// Trees that stand free: outside, where no shell is near enough or none may be touched, on the layer below alone.
#pragma once

#include "ribvault/vault/support_forest.hpp"

namespace ribvault {

/// Leaves every tree one root: the first on the shell, if it has one, else the first free one, else a free one at the vertex
/// nearest to the middle of the tree. Its other roots become what they are without it, so that erosion may take them.
void root_trees(SupportForest& forest);

/// Moves the root of every free tree to the middle of the tree's longest path, where a new vertex is made if need be (rounded to
/// the lattice): its tips have the shortest way to it.
void centre_free_trees(SupportForest& forest);

}  // namespace ribvault
