// Section 4.1, Reduction: free tips are shortened.
#pragma once

#include <vector>

#include "ribvault/vault/support_forest.hpp"

namespace ribvault {

struct ErodedSupports {
    SupportForest forest;
    std::vector<char> survives;  ///< per edge of the input, in its order: something of it is left
    std::vector<char> pinned;  ///< per vertex of forest: a branch vanished here, so straightening must not move it yet
};

/// Shortens every free tip (valence 1, not a root) by `step` along its path, through vertices of valence 2; a branch
/// shorter than that vanishes up to its junction, which becomes a tip only on the next layer; a tree shorter than that
/// leaves its root as a dot. Every point that is removed lies within `step` of what is left or of the root.
///
/// A tree that stands free (a root of it is) loses nothing that would leave less than `pillar_length` of it.
ErodedSupports erode_supports(const SupportForest& forest, Unit step, Unit pillar_length = 0);

}  // namespace ribvault
