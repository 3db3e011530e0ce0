// Narrow strips of the shell that nobody sees are printed as far as something stands on them.
#pragma once

#include <memory>
#include <vector>

#include "ribvault/print/layer_plan.hpp"
#include "ribvault/print/place_dot.hpp"
#include "ribvault/settings.hpp"
#include "ribvault/slice/slice.hpp"
#include "ribvault/vault/support_forest.hpp"

namespace ribvault {

/// The slices that cover layer i, i - k .. i + k without i (MODEL: sets), at least one on either side; none when any of
/// them is missing, or when the layer is solid whatever they are.
using Covering = std::vector<std::shared_ptr<const Slice>>;

/// Enters tracks of strips between perimeters, covers and cavity in a plan: what shows in its tracks, the rest in
/// `plan.spare`, whose area (about: length by width) counts as unfilled. Without `covering` all shows.
///
/// A place that lies in all covering slices and not in the cavity is less than p·d from the border of one: that one's
/// perimeters pass over or under it, so from there it cannot be seen. On a slope that recedes by less than d over the
/// covering layers, all of the strip is of this kind, and what closes the roof are perimeters alone. Tracks are taken
/// in pieces of at most d; one shows when any of its material does. Pieces between others that show, or at an end, no
/// longer than d together, are printed with them.
void append_strips(std::vector<PlannedTrack> strips, const Covering& covering, Unit d, LayerPlan& plan);

/// Something of the layer above that hangs: the part of a centre line, and how far from it what holds it up may be.
struct StripReach {
    Segment stretch;
    double reach;  ///< lattice units: half the width of what hangs, and ρ
};

/// What of the tracks `above` seems to hang without the plan's spare tracks and near these: around samples of their
/// centre lines, at most d / 2 apart, those of eight points at half the track's width that are not within ρ of the
/// nearest track of the plan and of `walls` (d wide). A guess, so that few strips are missing, and few are printed in
/// vain, when the verifier looks; it decides.
std::vector<StripReach> seem_to_hang(const std::vector<Lane>& above, const std::vector<Segment>& walls,
                                     const LayerPlan& plan, const Settings& settings);

/// Prints the parts of the plan's spare tracks that may hold up any of `hanging`: they become tracks of the plan, the
/// others stay spare. Two parts of one strip less than 5 d apart are one: at usual speeds that takes less time
/// than a travel. Parts begin and end at most d from where they must, at points of the lattice (a choice). Are there
/// any?
bool print_strips_under(const std::vector<StripReach>& hanging, Unit d, LayerPlan& plan);

/// Walls in cavities that end at a strip in which the plan prints nothing go on through it until they overlap the next
/// track of the object by d / 4, as slicers let their infill overlap perimeters: their root moves there (a placement)
/// and where it was stays a vertex. Strips up to 2 d wide are bridged, and only at roots with one wall.
void reach_over_strips(const LayerPlan& plan, Unit d, SupportForest& forest);

}  // namespace ribvault
