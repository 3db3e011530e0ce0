// Trees that stand free: outside, where no shell is near enough or none may be touched, on the layer below alone.
#pragma once

#include <functional>
#include <vector>

#include "ribvault/vault/support_forest.hpp"

namespace ribvault {

/// How much track every tree may lose, lattice units: of one that stands free what exceeds a pillar, of others all.
struct SpareLengths {
    std::vector<std::size_t> tree;  ///< per vertex: the number of its tree
    std::vector<double> spare;      ///< per tree
    double& of(std::size_t vertex) { return spare[tree[vertex]]; }
};
SpareLengths spare_lengths(const SupportForest& forest, Unit pillar_length);

/// Leaves every tree one root: the first on the shell, if it has one, else the first free one, else a free one at the
/// vertex nearest to the middle of the tree. Its other roots become what they are without it, so that erosion may take
/// them.
void root_trees(SupportForest& forest);

/// Has trees that are rooted on the shell stand free, on the vertex nearest to their middle, where that takes less
/// track on all `layers` down to the bed: each wall lasts until the tips behind it have run back to it, one `step` a
/// layer, and what stays of a tree with this middle takes `track_of_pillar(middle)` in all, lattice units.
/// Precondition: every tree has one root.
void free_where_cheaper(SupportForest& forest, int layers, Unit step,
                        const std::function<double(std::size_t)>& track_of_pillar);

/// Moves the root of every free tree to the middle of the tree's longest path, where a new vertex is made if need be
/// (rounded to the lattice): its tips have the shortest way to it.
void centre_free_trees(SupportForest& forest);

}  // namespace ribvault
