// Section 4.2: what the propagated supports and the shell leave without support.
#pragma once

#include <vector>

#include "ribvault/settings.hpp"
#include "ribvault/vault/cavity_boundary.hpp"
#include "ribvault/vault/support_forest.hpp"

namespace ribvault {

/// The part of layer i + 1's supports that the supports of layer i may not hold up, as a region: `inherited` are the
/// walls of the layer above inside C_i. A wall with both ends within ρ of one and the same wall below is held up (the
/// set within ρ of a segment is convex; exact, ties included). For the others the region is their stadium of radius r,
/// circumscribed, inside `within`: cavity.deep, or nothing where the shell holds up no support and all of it counts.
/// Together with overhang_over_cavity a superset of U_{i+1}.
Region unsupported_walls(const std::vector<Segment>& inherited, const SupportForest& propagated, const Region* within,
                         const Settings& settings);

}  // namespace ribvault
