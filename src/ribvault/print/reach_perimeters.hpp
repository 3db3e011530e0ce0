// Thin walls overlap the perimeters that they grow out of.
#pragma once

#include <vector>

#include "ribvault/exact/nearest_segment.hpp"
#include "ribvault/print/layer_plan.hpp"

namespace ribvault {

/// How far the end of a wall's centre line may be from that of a perimeter of width w when their material touches, or
/// nearly (w / 8).
inline double touching(Unit w, Unit wall) { return static_cast<double>(w + wall) / 2 + static_cast<double>(w) / 8; }

/// Ends of `walls` whose material touches that of a perimeter go on until their centre line reaches
/// its edge, w / 2 from the centre lines `perimeters`: the round end lies in the perimeter's track, half the wall's
/// width deep, a quarter of w at least, and as much filament is pushed as the wall has room for. They go on straight,
/// or, where the outline is in the way, towards the perimeter if that lies ahead: their material comes no nearer to the
/// slice's border (`outline`) than half its width, or than it was, but for two lattice units. Other ends stay: there a
/// wall ends at the border. Placements, rounded to the lattice.
void reach_perimeters(std::vector<PlannedTrack>& walls, const NearestSegment& perimeters, const NearestSegment& outline,
                      Unit w);

}  // namespace ribvault
