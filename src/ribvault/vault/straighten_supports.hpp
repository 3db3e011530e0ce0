// Section 4.1, Reduction: the straightening operator (Figures 13 and 14).
#pragma once

#include "ribvault/vault/cavity_boundary.hpp"
#include "ribvault/vault/support_forest.hpp"

namespace ribvault {

struct StraightenedSupports {
    SupportForest forest;
    bool left_cavity = false;  ///< some moved wall meets the boundary of C_i and must be clipped again
    int blocked = 0;           ///< chains some vertices of which stayed, lest they cross another wall
};

/// Every maximal chain without branches keeps its ends; each vertex between them moves by at most `step` towards the
/// point at the same fraction of the chain's length on the chord. A chain that arrives becomes one segment. So every
/// point of the input lies within `step` of the output. Vertices marked in `pinned` (where erosion has just taken a
/// branch, which they alone hold up) count as ends. The supports stay planar: vertices whose walls would cross another
/// wall stay.
StraightenedSupports straighten_supports(const SupportForest& forest, const std::vector<char>& pinned,
                                         const CavityBoundary& boundary, Unit step);

}  // namespace ribvault
