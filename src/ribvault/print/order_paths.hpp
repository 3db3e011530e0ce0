// From the tracks of a layer to the order in which they are printed.
#pragma once

#include "ribvault/print/layer_plan.hpp"

namespace ribvault {

/// The stages of an island, printed one after the other.
enum class PrintStage { perimeters, thin_walls, covers, supports };
PrintStage stage_of(TrackKind kind);

/// The layer's paths in printing order, with little travel (Section 4.4; short_tour).
///
/// Island after island of the slice (`outline`: its rounded contours), in each the perimeters, the thin walls, the covers,
/// then the supports, each stage from where the one before has ended. Every track comes after its `after`. Islands follow
/// each other on a short way from the rearmost one, on odd layers backwards, so that a layer begins on the island on which
/// the one below has ended; the supports of the last island end near the seam of its first perimeter, near which the next
/// layer begins. So no layer needs to know its neighbours. Tracks are turned around or rotated as their `entry` allows.
/// Deterministic. Precondition: `after` names tracks of the same stage and island.
LayerPaths order_paths(LayerPlan plan, const Region& outline);

}  // namespace ribvault
