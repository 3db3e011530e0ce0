// Thrifty strategy: two walls at a narrow corner become one from there on.
#pragma once

#include "ribvault/vault/moving_supports.hpp"

namespace ribvault {

/// The narrowest corner of a junction with four walls or more, or of a root with two or more, below 120°, and of a
/// junction with three walls below 20°: its two walls get a common beginning, as long as what lies on both can meet
/// in one step, which grows from layer to layer.
void zip_corners(MovingSupports& supports);

}  // namespace ribvault
