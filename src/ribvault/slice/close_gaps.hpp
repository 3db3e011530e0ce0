// Open contours of a slice, joined over small gaps.
#pragma once

#include "ribvault/slice/exact_polygons.hpp"
#include "ribvault/slice/slice_mesh.hpp"

namespace ribvault {

using ExactPoint = ExactKernel::Point_2;
using ExactContour = std::vector<ExactPoint>;  ///< closed: the last point joins the first

struct ClosedGaps {
    std::vector<ExactContour> contours;
    std::vector<GapClosing> closings;  ///< gaps that were closed
    std::vector<GapClosing> open;      ///< gaps that are too wide: from the end of a chain to the nearest open start
};

/// Joins ends of chains to starts of chains (a chain's own included), the nearest pair first, by straight segments no
/// longer than max_gap (decided exactly). Chains that stay open are not among the contours.
ClosedGaps close_gaps(std::vector<ExactContour> chains, int layer, Unit max_gap);

}  // namespace ribvault
