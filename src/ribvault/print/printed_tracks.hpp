// A layer's plan as the verifier sees it.
#pragma once

#include "ribvault/print/layer_plan.hpp"
#include "ribvault/verify/printed_layer.hpp"

namespace ribvault {

/// A length of the lattice in mm, exactly.
Millimetres printed_length(Unit length);

/// Every extrusion of the plan, straight piece by straight piece, in its order: `feature` is the TrackKind, `line` the
/// index of the track in the plan, `outline` set on closed outer perimeters. Exact: the lattice's coordinates in mm.
PrintedLayer printed_layer(const LayerPlan& plan);

}  // namespace ribvault
