// Whether the print, with skirt and brim, stays on the bed.
#pragma once

#include "ribvault/mesh/mesh.hpp"
#include "ribvault/print/track_settings.hpp"
#include "ribvault/settings.hpp"

namespace ribvault {

/// Throws Error (does_not_fit) when the placed mesh, enlarged by skirt and brim, leaves the bed: a rectangle, or a disc of
/// diameter bed_x when `printer.round_bed`. Heights are checked by place().
void check_bed(const Mesh& mesh, const Placement& placement, const Settings& settings, const TrackSettings& tracks, const PrinterSettings& printer);

}  // namespace ribvault
