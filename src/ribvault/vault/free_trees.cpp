#include "ribvault/vault/free_trees.hpp"

#include <boost/graph/connected_components.hpp>

#include <algorithm>
#include <limits>

#include "ribvault/vault/tree_walk.hpp"

namespace ribvault {
namespace {

using Vertex = std::size_t;

/// The middle of a tree: on the edge from `vertex` to `next` of its longest path, `along` units from the former.
struct Middle {
    Vertex vertex, next;
    double along;
};
Middle middle_of(Vertex any, const SupportForest& forest) {
    const TreeWalk first = walk_from(any, forest);
    const TreeWalk path = walk_from(first.order[first.farthest()], forest);
    std::size_t at = path.farthest();
    const double half = path.distance[at] / 2;
    while (path.distance[at] > half) {
        const std::size_t up = path.parent[at];
        if (path.distance[up] <= half) return {path.order[up], path.order[at], half - path.distance[up]};
        at = up;
    }
    return {path.order[at], path.order[at], 0};
}

Vertex middle_vertex(Vertex any, const SupportForest& forest) {
    const Middle middle = middle_of(any, forest);
    return 2 * middle.along > length(forest[middle.next].at - forest[middle.vertex].at) ? middle.next : middle.vertex;
}

/// The track of a tree on all layers down to the bed while its tips run back to the root.
double track_down(Vertex root, const SupportForest& forest, int layers, Unit step) {
    const TreeWalk walk = walk_from(root, forest);
    std::vector<double> reach(walk.order.size(), 0);
    double sum = 0;
    for (std::size_t k = walk.order.size(); k-- > 1;) {
        const std::size_t up = walk.parent[k];
        const double l = walk.distance[k] - walk.distance[up];
        sum += l * std::min(static_cast<double>(layers), (reach[k] + l / 2) / static_cast<double>(step));
        reach[up] = std::max(reach[up], reach[k] + l);
    }
    return sum;
}

}  // namespace

SpareLengths spare_lengths(const SupportForest& forest, Unit pillar_length) {
    SpareLengths lengths{std::vector<std::size_t>(num_vertices(forest)), {}};
    lengths.spare.resize(boost::connected_components(forest, lengths.tree.data()),
                         std::numeric_limits<double>::infinity());
    for (auto [v, end] = vertices(forest); v != end; ++v)
        if (forest[*v].free) lengths.of(*v) = -static_cast<double>(pillar_length);
    for (auto [e, end] = edges(forest); e != end; ++e)
        lengths.of(source(*e, forest)) += length(forest[target(*e, forest)].at - forest[source(*e, forest)].at);
    return lengths;
}

void root_trees(SupportForest& forest) {
    std::vector<char> seen(num_vertices(forest), 0);
    for (auto [v, end] = vertices(forest); v != end; ++v) {
        if (seen[*v]) continue;
        const TreeWalk tree = walk_from(*v, forest);
        Vertex shell = forest.null_vertex(), free = shell;
        for (const Vertex w : tree.order) {
            seen[w] = 1;
            Vertex& first = forest[w].free ? free : shell;
            if (forest[w].root && first == forest.null_vertex()) first = w;
            forest[w].root = forest[w].free = false;
        }
        if (shell != forest.null_vertex()) {
            forest[shell].root = true;
            continue;
        }
        if (free == forest.null_vertex()) free = middle_vertex(*v, forest);
        forest[free].root = forest[free].free = true;
    }
}

void free_where_cheaper(SupportForest& forest, int layers, Unit step,
                        const std::function<double(std::size_t)>& track_of_pillar) {
    if (step <= 0) return;
    for (auto [v, end] = vertices(forest); v != end; ++v) {
        if (!forest[*v].root || forest[*v].free || out_degree(*v, forest) == 0) continue;
        const Vertex middle = middle_vertex(*v, forest);
        if (track_of_pillar(middle) + track_down(middle, forest, layers, step) >= track_down(*v, forest, layers, step))
            continue;
        forest[*v].root = false;
        forest[middle].root = forest[middle].free = true;
    }
}

void centre_free_trees(SupportForest& forest) {
    std::vector<Vertex> free;
    for (auto [v, end] = vertices(forest); v != end; ++v)
        if (forest[*v].free) free.push_back(*v);
    for (const Vertex v : free) {
        const Middle middle = middle_of(v, forest);
        forest[v].root = forest[v].free = false;
        Vertex centre = middle.vertex;
        if (middle.along > 0) {
            const Point a = forest[middle.vertex].at, b = forest[middle.next].at,
                        at = part_way(a, b, middle.along / length(b - a));
            if (at == b) centre = middle.next;
            else if (at != a) {
                centre = add_vertex(vertex_between(forest[middle.vertex], forest[middle.next], at), forest);
                remove_edge(middle.vertex, middle.next, forest);
                add_edge(middle.vertex, centre, forest);
                add_edge(centre, middle.next, forest);
            }
        }
        forest[centre].root = forest[centre].free = true;
    }
}

}  // namespace ribvault
