// A walk through one tree of the supports.
#pragma once

#include <vector>

#include "ribvault/vault/support_forest.hpp"

namespace ribvault {

/// A tree's vertices, each after the one by which it is reached.
struct TreeWalk {
    std::vector<std::size_t> order;   ///< the first is where the walk starts
    std::vector<std::size_t> parent;  ///< the position of that one, by position in `order`; of the first: 0
    std::vector<double> distance;     ///< along the tree from the start, lattice units, by position in `order`
    /// The position of the vertex that is farthest from the start.
    std::size_t farthest() const;
};
TreeWalk walk_from(std::size_t start, const SupportForest& forest);

}  // namespace ribvault
