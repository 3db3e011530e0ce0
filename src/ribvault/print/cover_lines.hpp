// Straight fill of an area with tracks at 45° or 135°, linked in a zigzag.
#pragma once

#include <vector>

#include "ribvault/exact/lattice.hpp"

namespace ribvault {

/// Centre lines of straight tracks that fill one connected area.
///
/// The lines run at 45° (`falling`: at 135°), `width` apart, centred in the area's extent across them, so that an area
/// with an inside gets at least one line unless it is only lattice units wide. They end on the boundary, at the last
/// lattice point inside. Neighbouring lines are joined along the boundary between their ends where that way is no
/// longer than two widths; with `monotonic` only upwards, to a line of which all neighbours below are printed, so that
/// every line is printed after all that touch it from below.
/// `area`: one outer contour with its holes, simple, as Clipper gives them; `width` in lattice units, positive.
/// Returns open polylines; every point lies in the closed area, exactly.
std::vector<Contour> cover_lines(const Region& area, Unit width, bool falling, bool monotonic = false);

}  // namespace ribvault
