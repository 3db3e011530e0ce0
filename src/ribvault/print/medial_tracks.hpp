// Tracks of varying width along the middle of narrow areas.
#pragma once

#include "ribvault/print/layer_plan.hpp"

namespace ribvault {

/// Tracks along the medial axis of an area, where that is between d / 2 and 3 d / 2 wide, d = `width`.
///
/// The axis comes from the Voronoi diagram of the area's edges (Boost.Polygon, integer input, robust). A piece of it is
/// as wide as the area is there, rounded down to multiples of d / 20, so that its material stays inside; a chain of
/// pieces is one planned track, a path for every change of width. Side branches shorter than d, towards corners, and
/// chains shorter than d are left out; with `however_short` chains from one end of the axis to another stay: their
/// material begins and ends half its width farther out. Curved pieces of the axis are replaced by their chords; ends
/// are rounded to the lattice: these are choices. `area`: outer contours counter-clockwise, holes clockwise, not
/// crossing. Tracks may be entered at either end.
std::vector<PlannedTrack> medial_tracks(const Region& area, Unit width, TrackKind kind, bool however_short = false);

}  // namespace ribvault
