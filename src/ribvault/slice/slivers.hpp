// What of a slice is finer than the lattice tells: slits of air, slivers of material.
#pragma once

#include "ribvault/slice/slice.hpp"

namespace ribvault {

/// Whether the rounded slice has slits or slivers up to 0.4 µm wide, which Clipper's rounding may close or tear: a
/// contour has vanished or is nowhere wider than rounding makes it, turns back on itself, or comes so near to another
/// one or to itself (but round a corner). Time: a search in a tree of the edges for each edge.
bool has_slivers(const Slice& slice);

/// The slice without them, as parts of a mesh have them between each other that touch but for rounding: slits are
/// filled, slivers go. Its vertices are lattice points now (a choice, made here once, for all of this slice), its sides
/// at most some 20 nm from where they were, a corner's tip by that over the sine of half its angle; corners sharper
/// than 0.12° are cut. `exact` is what it is now.
Slice without_slivers(const Slice& slice);

}  // namespace ribvault
