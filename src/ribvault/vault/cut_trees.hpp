// Thrifty strategy: trees with several roots fall apart.
#pragma once

#include "ribvault/vault/moving_supports.hpp"

namespace ribvault {

/// Cuts every tree with several roots in the middle of the way between two of them: two tips in the same place, each
/// free to run back from there. `braced` > 0: only where no part is longer than that.
void cut_between_roots(MovingSupports& supports, Unit braced);

}  // namespace ribvault
