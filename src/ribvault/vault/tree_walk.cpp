#include "ribvault/vault/tree_walk.hpp"

#include <algorithm>

namespace ribvault {

std::size_t TreeWalk::farthest() const {
    return static_cast<std::size_t>(std::max_element(distance.begin(), distance.end()) - distance.begin());
}

TreeWalk walk_from(std::size_t start, const SupportForest& forest) {
    TreeWalk walk{{start}, {0}, {0}};
    for (std::size_t k = 0; k < walk.order.size(); ++k) {
        const std::size_t v = walk.order[k], from = walk.order[walk.parent[k]];
        const double here = walk.distance[k];
        bool parent_met = k == 0;
        for (auto [w, end] = adjacent_vertices(v, forest); w != end; ++w) {
            if (!parent_met && *w == from) {
                parent_met = true;
                continue;
            }
            walk.order.push_back(*w), walk.parent.push_back(k);
            walk.distance.push_back(here + length(forest[*w].at - forest[v].at));
        }
    }
    return walk;
}

}  // namespace ribvault
