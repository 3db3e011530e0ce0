// Section 4.3 wall by wall: which point, what was nearest to it, where its wall went.
#pragma once

#include "result_json.hpp"
#include "ribvault/vault/cavity_boundary.hpp"

namespace ribvault::steps {

/// The walls that grow_supports added to `propagated`, in its order, found by adding them again: "point", "shell"
/// (nearest point of B_i), "wall" (nearest point of S_i as it then was; null when there is none), "joint", "joint_kind"
/// (shell, wall, vertex), "valence" of the joint before, distances (a wall runs from its point to its joint) in lattice
/// units. "fields": D_B and D_BS of equation (4) inside the cavity, exact distances rounded to lattice units, for the
/// supports as they are when half of the walls stand. Throws std::logic_error when adding them again does not give
/// `grown`.
Json growth_json(const SupportForest& propagated, const SupportForest& grown, const CavityBoundary& boundary,
                 const Settings& settings);

}  // namespace ribvault::steps
