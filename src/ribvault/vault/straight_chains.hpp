// Thrifty strategy: straight walls are one wall each.
#pragma once

#include "ribvault/vault/moving_supports.hpp"

namespace ribvault {

/// Takes out vertices of two walls, no roots, that lie on the way between their neighbours but for rounding (20 nm):
/// one wall goes from neighbour to neighbour. Only where every point that was on the two is within the step of it,
/// where it meets no other wall, and where no wall stands there that is higher by more than a layer than its ends say.
/// What was a junction once would otherwise be a corner of the print for as long as the wall lasts.
void drop_straight_vertices(MovingSupports& supports);

}  // namespace ribvault
