// Section 4.3, Algorithm 2: new walls under what is not supported.
#pragma once

#include "ribvault/settings.hpp"
#include "ribvault/vault/cavity_boundary.hpp"
#include "ribvault/vault/support_forest.hpp"

namespace ribvault {

struct GrownSupports {
    SupportForest forest;
    bool full_bonus = false;     ///< a wall was added whose bonus of equation (4) counts in full
    bool quarter_bonus = false;  ///< one whose bonus counts a quarter (settings.quarter_bonus)
};

/// Adds walls to `propagated` until every point of `unsupported` (a region inside the cavity) lies within r + ρ of a
/// wall.
///
/// First, as the paper does with its pixels, the points of a lattice of settings.sampling_pitch, by increasing distance
/// to B_i (exact comparison), ties at random by `layer_seed`. Then what remains between them: cells are halved until
/// each lies within r + ρ of one wall or shows a point that is not covered, which becomes a candidate like any other.
/// Cells smaller than the slack are covered when their centre is covered with the slack to spare, so this ends.
GrownSupports grow_supports(SupportForest propagated, const Region& unsupported, const CavityBoundary& boundary,
                            std::uint64_t layer_seed, const Settings& settings);

}  // namespace ribvault
