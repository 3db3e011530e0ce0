// The boundary of an unsupported region as SVG path data, its arcs as arcs.
#pragma once

#include <string>

#include "ribvault/verify/region_boundary.hpp"

namespace ribvault {

/// Which way y runs in the picture. On a canvas that is turned over it is upwards, as on the bed.
enum class YAxis { down, up };

/// All loops, mm, three decimals: M, L and A commands, each loop closed. Outer loops and holes run against each other,
/// so both fill rules give the region. Pieces shorter than a micrometre may be left out.
std::string boundary_data(const RegionBoundary& boundary, YAxis y);

}  // namespace ribvault
