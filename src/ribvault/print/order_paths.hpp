// From the tracks of a layer to the order in which they are printed.
#pragma once

#include "ribvault/print/layer_plan.hpp"

namespace ribvault {

/// The stages of an island, printed one after the other.
enum class PrintStage { perimeters, inside };
PrintStage stage_of(TrackKind kind);

/// The layer's paths in printing order, with little travel (Section 4.4; short_tour).
///
/// Island after island of the slice (`outline`: its rounded contours), in each the perimeters, then what they enclose
/// (thin walls, covers, supports), from where the perimeters have ended. Every track comes after its `after`. Islands
/// follow each other on a short way from the rearmost one, then come all external supports; on odd layers all that
/// backwards, so that a layer begins on the island, or with the supports, with which the one below has ended: a second
/// tool for supports is changed once a layer.
///
/// With `alternate` odd layers print the perimeters last: an even layer goes from the seam to wherever that way ends,
/// an odd one begins where it would end itself if it were even; that ends at the seam, near which the next even one
/// begins. Without it every layer begins at the seam, and ends as near to it as its tracks allow. So no layer needs to
/// know its neighbours, and layers can be ordered concurrently. Tracks are turned around or rotated as their `entry`
/// allows. Deterministic. An `after` in another stage or island does not count: these have their own order.
LayerPaths order_paths(LayerPlan plan, const Region& outline, bool alternate = false);

}  // namespace ribvault
