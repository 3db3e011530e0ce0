// Thrifty strategy: new walls end as early as what they are there for allows.
#pragma once

#include "ribvault/vault/growing_supports.hpp"
#include "ribvault/vault/unsupported_cells.hpp"

namespace ribvault {

/// Shortens the walls that were added to `supports`, the last one first, or takes them away again, while every point of
/// the unsupported region stays covered. A wall to which another was joined later stays as it is, unless that one went.
/// Ends are found by bisection to 10 µm. Precondition: all of the region is covered. Postcondition: it still is.
void trim_walls(GrowingSupports& supports, const UnsupportedCells& unsupported, const Settings& settings);

}  // namespace ribvault
