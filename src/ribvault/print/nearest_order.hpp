// Greedy travel: from where the nozzle stands to the nearest start that is left.
#pragma once

#include <cstddef>
#include <vector>

#include "ribvault/print/tool_path.hpp"

namespace ribvault {

/// Where a group of tracks is entered and left.
struct PathEnds {
    Point start;
    Point end;
};

/// The order in which to print the groups when the nozzle stands at `from`: always the one with the nearest start, the
/// smaller index on ties. Quadratic in their number. Returns a permutation of 0 .. groups.size() - 1.
std::vector<std::size_t> nearest_order(const std::vector<PathEnds>& groups, Point from);

/// Where the nozzle stands after what a layer holds so far; the bed's origin when that is nothing.
Point nozzle_after(const LayerPaths& layer);

}  // namespace ribvault
