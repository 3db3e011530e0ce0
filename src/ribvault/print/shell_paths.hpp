// From the shell B_i to tracks: perimeters along the slice's boundary, thin walls, covers.
#pragma once

#include "ribvault/print/gap_strips.hpp"
#include "ribvault/print/layer_plan.hpp"
#include "ribvault/print/track_settings.hpp"
#include "ribvault/slice/slice.hpp"

namespace ribvault {

/// Appends the tracks of B_i = O_i \ C_i to a plan. w is d = `settings.nozzle`, on layer 0 the first layer's width.
///
/// Perimeters: closed tracks of width w whose centre lines run at distance (j + 1/2) w inside O_i (`slice.rounded`),
/// j = 0 .. p - 1; corners are mitred up to twice the distance. Each comes after the one beside it that is nearer to
/// the outside (with `inner_first`: to the inside), if its island has one. Outer ones start where `tracks.seam` says,
/// inner ones anywhere. In place of a ring shorter than w / 2 there is a dot (TrackKind::thin_wall), unless another
/// perimeter or dot comes within 3/4 w of it.
///
/// Thin walls: what of O_i no outer perimeter fills because it is narrower than w gets medial_tracks where it is at
/// least w / 2 wide, as far into the perimeters that they meet as reach_perimeters says; where a dot would be more
/// material, the widest dot that there is room for, up to w / 4 into a perimeter beside it. Places still narrower, and
/// what a dot leaves where that is more than half, are counted in the plan with their area, as are all without
/// `tracks.thin_walls`.
///
/// Gaps: strips of the shell between perimeters, covers and cavity that are too narrow for a cover, at most 3/2 w wide,
/// and those that the lines of a cover leave beside its border get medial_tracks alike as `tracks.fill_gaps` says; with
/// GapFill::needed those that do not show become `plan.spare`, as append_strips finds from `covering`. The area of all
/// that stays open is added to the plan (`unfilled_area`).
///
/// What is too narrow for a w above d, walls and strips alike, gets what it would with d.
///
/// Covers: what the perimeters and the cavity C_i (`cavity`) leave of O_i is filled by `tracks.covers`: straight tracks
/// of width w, w apart, at 45° on even layers and at 135° on odd ones, or closed ones along the border with
/// medial_tracks where two side by side have no room. Their centre lines keep w / 2 from the border of this area, so
/// that their material stays in it. Tracks shorter than w / 2 are left out.
///
/// Postcondition: centre lines of perimeters and covers lie at least w / 2 inside O_i, but for two lattice units
/// (20 nm) of rounding; the same holds for covers and the complement of the cavity.
void append_shell_paths(const Slice& slice, const Region& cavity, const Settings& settings, const TrackSettings& tracks,
                        LayerPlan& plan, const Covering& covering = {});

}  // namespace ribvault
