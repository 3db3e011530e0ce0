// What is extruded is held up by what is extruded below: supports printed so that equation (2) holds for the print.
#pragma once

#include <array>

#include "ribvault/print/layer_plan.hpp"
#include "ribvault/settings.hpp"
#include "ribvault/vault/support_forest.hpp"
#include "ribvault/verify/printed_layer.hpp"
#include "ribvault/verify/verdict.hpp"

namespace ribvault {

/// A layer that has another one on it.
struct HeldLayer {
    LayerPlan plan;
    PrintedLayer printed;       ///< the plan's extrusions
    PrintVerdict verdict;       ///< of the layer above over this one
    int closed_gaps = 0;        ///< branches printed up to their junction because the gap would have let something hang
    int patches = 0;            ///< short tracks added where closing gaps was not enough
    Unit patch_length = 0;      ///< lattice units
};

/// Completes `shell`, the plan of layer i's perimeters and covers, with the tracks of S_i (`forest`) so that every point of
/// `above`, the print of layer i + 1 (nullptr: there is none), that lies inside the outline of this layer has material
/// within ρ (verify/outside_outline.hpp).
///
/// First with the gaps of Section 4.4. Where the verifier finds something of `above` that these leave unsupported, the
/// branches nearby are printed up to their junction (settings.gaps == Gaps::proved; with Gaps::paper nothing is done and the
/// verdict says what the gaps cost, with Gaps::none there are none from the start). Where that is not enough (where the
/// tracks of the shell leave a place open that B_i has), patches follow: what hangs, one layer lower, each end moved by up to
/// ρ towards material, so that what the patches need below them shrinks to nothing like a wall's tip does.
/// Patches lie inside the outline. Deterministic.
HeldLayer hold_print(LayerPlan shell, const SupportForest& forest, const PrintedLayer* above, const Settings& settings);

}  // namespace ribvault
