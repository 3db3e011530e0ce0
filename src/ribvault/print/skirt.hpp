// Skirt and brim: tracks beside the object on the first layer.
#pragma once

#include "ribvault/print/tool_path.hpp"
#include "ribvault/print/track_settings.hpp"

namespace ribvault {

/// The tracks around the first layer (`object`: its slice; `supports`: centre lines beside it), in printing order: the
/// skirt's loops from the outside in around everything, then the brim's from the outside in, the last of which touches
/// the object. Of the first layer's width, one width apart. The brim runs around outer contours only, never into holes.
/// Empty when neither is asked for.
std::vector<ToolPath> skirt_and_brim(const Region& object, const Settings& settings, const TrackSettings& tracks,
                                      const std::vector<Segment>& supports = {});

/// How far skirt and brim reach beyond the object, lattice units.
Unit reach_of_skirt_and_brim(const Settings& settings, const TrackSettings& tracks);

}  // namespace ribvault
