// What is extruded is held up by what is extruded below: supports printed so that equation (2) holds for the print.
#pragma once

#include <memory>
#include <vector>

#include "ribvault/print/judge_print.hpp"
#include "ribvault/print/layer_plan.hpp"
#include "ribvault/settings.hpp"
#include "ribvault/slice/cavity.hpp"
#include "ribvault/vault/support_forest.hpp"
#include "ribvault/verify/printed_layer.hpp"

namespace ribvault {

/// What external supports hold up through a gap of layers: the print of layer j outside the outline of layer j - 1.
struct PrintOverGap {
    std::shared_ptr<const PrintedLayer> hanging;
    std::vector<PrintedTrack> object;  ///< of the layers of the gap, as they count below (counted_below)
};

/// Something judged over a layer.
struct PrintPart {
    std::shared_ptr<const PrintedLayer> above;  ///< what `judgement` is of, where it is not all of the layer above
    PrintJudgement judgement;
    bool over_gap = false;  ///< it is of what hangs over a gap
    bool inside = false;    ///< it is of what lies inside the outline alone (settings.outside_apart())
    bool on_supports = false;  ///< it is of external supports over such alone (settings.bed_only)
};

/// A layer that has another one on it.
struct HeldLayer {
    LayerPlan plan;
    std::shared_ptr<const PrintedLayer> printed;  ///< the plan's extrusions
    std::vector<PrintPart> parts;  ///< what was judged over `printed`; nothing when there is no layer above
    int closed_gaps = 0;  ///< branches printed from their junction, or by bends, as a gap would have let something hang
    int patches = 0;            ///< short tracks added where closing gaps was not enough
    Unit patch_length = 0;      ///< length of track that patches add, lattice units; dots count as none
    std::vector<Segment> patch_tracks;  ///< their centre lines; dots as segments of no length
};

/// Completes `shell`, the plan of layer i's perimeters and covers, with the tracks of S_i (`forest`) so that every
/// point of `above`, the print of layer i + 1 (nullptr: there is none), that lies inside the outline of this layer has
/// material within ρ (verify/outside_outline.hpp). `above` and `settings` must outlive the judgement.
///
/// Of the shell's spare tracks (print/gap_strips.hpp) those parts are printed that may hold up what hangs without them.
/// Walls of one line whose root has one wall go on through what stays open of the shell until they overlap its next
/// track by d / 4, with any gaps.
///
/// With Gaps::proved, paths in cavities go by the tips of short branches, which then need no track of their own
/// (print/bent_path.hpp).
///
/// First with the gaps of Section 4.4. Where the verifier finds something of `above` that these leave unsupported, the
/// branches nearby are printed up to their junction (settings.gaps == Gaps::proved; with Gaps::paper nothing is done
/// and the verdict will say what the gaps cost, with Gaps::none there are none from the start). Where that is not
/// enough (where the tracks of the shell leave a place open that B_i has, the root of a vanished tree, which
/// Gaps::proved does not print, held something up, or a path that bends to a tip leaves its wall), patches follow: the
/// dot nearest to the tracks that holds up all that hangs there (print/place_dot.hpp) or, where there is none and in
/// the last rounds of mending, what hangs, one layer lower, each end moved by up to ρ towards material, so that what
/// the patches need below them shrinks to nothing like a wall's tip does. They are printed with the tracks they touch
/// (print/lay_patches.hpp). Patches lie inside the outline. Deterministic.
///
/// With external supports (settings.outside()) all of `above` counts, inside the outline or not, and patches may lie
/// outside it, where `outside` (slice/outside.hpp) lets walls stand. With a removal gap the object holds up more
/// outside the outline than inside (Settings::reach_of_object), so the two are judged apart. Where they stand on the
/// bed alone, or leave a gap of layers, external supports are judged over what may hold them up; with a gap, what hangs
/// over `over_gap` counts in place of what hangs over this layer. `walls_below_gap`: where supports may stand that hold
/// up through the gap what hangs over this layer (nullptr: not known): what they can reach needs no patches here.
HeldLayer hold_print(LayerPlan shell, const SupportForest& forest, const PrintedLayer* above, const Settings& settings,
                     const Cavity* outside = nullptr, const PrintOverGap* over_gap = nullptr,
                     const Region* walls_below_gap = nullptr);

}  // namespace ribvault
