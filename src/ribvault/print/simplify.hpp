// Outlines with fewer vertices, for tool paths.
#pragma once

#include "ribvault/exact/lattice.hpp"

namespace ribvault {

/// The region's contours with only some of their vertices, no point of either border farther than `tolerance` (lattice
/// units) from the other along its contour (Douglas and Peucker, from the lowest of the leftmost vertices). A contour
/// that would be left with fewer than three vertices stays whole. 0: the region itself. Contours may touch or cross
/// afterwards within the tolerance: for proposals, not for proofs.
Region simplify(const Region& region, Unit tolerance);

}  // namespace ribvault
