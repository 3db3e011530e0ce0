// The boundary of a group of open parts, traced exactly. Heavy: include in .cpp files only.
#pragma once

#include "ribvault/verify/printed_pair.hpp"
#include "ribvault/verify/region_boundary.hpp"

namespace ribvault::verify {

/// The boundary of what of the tracks `tracks` above is outside K and in the stadiums of `parts`, which contain whole
/// components of it (docs/verifier.md). Exact. Under upward rounding.
RegionBoundary trace_region(const PrintedPair& pair, std::span<const int> tracks, std::vector<PreparedTrack> parts);

}  // namespace ribvault::verify
