// Sparse infill as every slicer has it, on the whole inside.
#pragma once

#include "judge.hpp"

namespace ribvault::baselines {

enum class Pattern { grid, honeycomb };

/// `density` is the share of the inside's area that tracks would fill if they did not cross: both patterns have
/// density / d of centre line per area. Grid: two families of parallel lines at ±45°. Honeycomb: every side of the
/// hexagons once. The same on every layer, cut to the room that shell and covers leave.
Hollowed standard_infill(const Stack& stack, Pattern pattern, double density, const Settings& settings);

/// Length of all tracks in mm.
double track_length_mm(const Hollowed& hollowed);

}  // namespace ribvault::baselines
