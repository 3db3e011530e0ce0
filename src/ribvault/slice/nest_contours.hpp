// From closed contours to polygons with holes.
#pragma once

#include <optional>

#include "ribvault/slice/close_gaps.hpp"

namespace ribvault {

/// Polygons with holes of contours that are simple and pairwise disjoint (decided exactly); nothing when they are not
/// (touching counts as not). Solid is where the winding number is not zero; contours between two solid or two empty
/// regions are dropped.
std::optional<ExactPolygons> nest_contours(const std::vector<ExactContour>& contours);

/// The same for contours that cross, touch or overlap, by an arrangement of their edges (regularise.cpp).
ExactPolygons regularise(const std::vector<ExactContour>& contours);

/// Makes these contours, which may cross, the slice's.
void set_contours(Slice& slice, const std::vector<ExactContour>& contours);

}  // namespace ribvault
