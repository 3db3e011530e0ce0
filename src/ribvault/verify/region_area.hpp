// How large a part of printed tracks lies outside the dilated tracks below: doubles with margins. Light.
#pragma once

#include <span>

#include "ribvault/verify/greatest_distance.hpp"

namespace ribvault::verify {

/// Enclosure of the area, mm², and the largest square found that is uncovered as a whole.
struct RegionArea {
    double lo = 0, hi = 0;
    double x = 0, y = 0, half = 0;  ///< half 0: none
};

/// The area of the union of the stadiums `pieces` outside all tracks below dilated by `rho`, to about 1 % or as far as
/// about `max_cells` cells go.
RegionArea enclose_region_area(std::span<const PreparedTrack> pieces, const LowerTracks& lower, double rho,
                               int max_cells);

}  // namespace ribvault::verify
