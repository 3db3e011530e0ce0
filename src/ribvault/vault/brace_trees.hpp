// Long trees get a second root, so that they are held at both ends (beyond the paper).
#pragma once

#include "ribvault/vault/cavity_boundary.hpp"
#include "ribvault/vault/support_forest.hpp"

namespace ribvault {

/// Every tree that reaches farther than `longest` (lattice units, along its walls) from its only root gets a wall to a
/// second one on the shell: from that vertex on the way to its farthest tip from which the brace and what of the way is
/// left to the tip are shortest together. The new root lies at least half of `longest` away from the first one, the
/// brace is no longer than the tree reaches, and meets no wall and no shell on its way; a tree for which there is no
/// such brace stays as it is. Nothing that was there moves, so what was held up still is.
///
/// Precondition: the trees stand in a cavity, their roots on its shell. How many braces were added.
int brace_trees(SupportForest& forest, const CavityBoundary& boundary, Unit longest);

}  // namespace ribvault
