// Whether the print, with skirt and brim, stays on the bed.
#pragma once

#include "ribvault/mesh/mesh.hpp"
#include "ribvault/print/track_settings.hpp"
#include "ribvault/settings.hpp"

namespace ribvault {

/// How far external supports reach beyond the object at most, lattice units.
Unit reach_of_supports(const Settings& settings);
/// The placed mesh's box and what supports may reach beyond it.
Box support_frame(const Mesh& mesh, const Placement& placement, const Settings& settings);

/// Throws Error (does_not_fit) when the placed mesh, enlarged by skirt, brim and external supports, leaves the bed: a
/// rectangle, or a disc of diameter bed_x when `printer.round_bed`. The model's height is checked by place().
void check_bed(const Mesh& mesh, const Placement& placement, const Settings& settings, const TrackSettings& tracks,
               const PrinterSettings& printer);

/// Throws Error (does_not_fit) when the top of the last of so many layers is higher than the printer: up to half a
/// layer over the model's own height, which place() has checked.
void check_height(int layers, const Settings& settings, const PrinterSettings& printer);

}  // namespace ribvault
