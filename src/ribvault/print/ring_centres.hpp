// Where closed tracks side by side run, and where they have no room for it.
#pragma once

#include "ribvault/exact/lattice.hpp"

namespace ribvault {

/// Lattice units: keeps Clipper away from nearly coincident borders.
inline constexpr double border_margin = 10;

/// A region without parts of it and a little more around them: along borders that they share rounding leaves slivers.
Region without(const Region& region, const Region& parts);

/// The centre lines `centres` of a ring of width w but where there is no room for two of them side by side, at most
/// 3/2 w between the rings before: that is left to a track of its own width (print/medial_tracks.hpp). Of tips shorter
/// than 3 w only stubs are, which a track of their own fills better than the ring does there and back: wedges would
/// only be cut off. The ring lies w / 2 inside of what is `inset` inside of the outline.
Region with_room(const Region& centres, const Region& outline, double inset, Unit w);

/// Where the centre lines of ring j of width w run in an outline, 0 the outermost; with `room_only` where they have
/// room.
Region ring_centres(const Region& outline, int j, Unit w, bool room_only);

}  // namespace ribvault
