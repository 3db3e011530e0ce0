#include "ribvault/vault/erode_supports.hpp"

#include <algorithm>

#include "ribvault/vault/free_trees.hpp"

namespace ribvault {

ErodedSupports erode_supports(const SupportForest& forest, Unit step, Unit pillar_length) {
    const std::size_t n = num_vertices(forest);
    struct Edge {
        std::size_t a, b;
        bool alive = true;
    };
    std::vector<Edge> list;
    std::vector<std::vector<std::uint32_t>> at(n);
    for (auto [e, end] = edges(forest); e != end; ++e) {
        const std::size_t a = source(*e, forest), b = target(*e, forest);
        at[a].push_back(static_cast<std::uint32_t>(list.size()));
        at[b].push_back(static_cast<std::uint32_t>(list.size()));
        list.push_back({a, b});
    }
    SpareLengths lengths = spare_lengths(forest, pillar_length);
    std::vector<Point> place(n);
    std::vector<char> lost_branch(n, false);
    for (std::size_t v = 0; v < n; ++v) place[v] = forest[v].at;

    for (std::size_t tip = 0; step > 0 && tip < n; ++tip) {
        if (at[tip].size() != 1 || forest[tip].root) continue;
        double& spare = lengths.of(tip);
        if (spare <= 0) continue;
        double left = std::min(static_cast<double>(step), spare);
        spare -= left;  // at least what goes
        std::size_t v = tip;
        std::uint32_t edge = at[tip][0];
        while (true) {
            const std::size_t next = list[edge].a == v ? list[edge].b : list[edge].a;
            const double l = length(forest[next].at - forest[v].at);
            if (l > left) {
                // One unit short of the limit, so that the rounding to the lattice stays within it.
                const double t = left > 1 ? (left - 1) / l : 0;
                place[v] = part_way(forest[v].at, forest[next].at, t);
                break;
            }
            list[edge].alive = false;
            left -= l;
            if (forest[next].root || at[next].size() != 2) {
                lost_branch[next] = true;
                break;
            }
            edge = at[next][0] == edge ? at[next][1] : at[next][0];
            v = next;
        }
    }

    ErodedSupports result;
    result.survives.resize(list.size());
    std::vector<std::int64_t> vertex(n, -1);
    const auto keep = [&](std::size_t v) {
        if (vertex[v] < 0) {
            vertex[v] = static_cast<std::int64_t>(add_vertex(forest[v], result.forest));
            result.forest[static_cast<std::size_t>(vertex[v])].at = place[v];
            result.pinned.push_back(lost_branch[v]);
        }
        return static_cast<std::size_t>(vertex[v]);
    };
    for (std::size_t e = 0; e < list.size(); ++e) {
        // A tip that came to lie on its neighbour is gone; a wall that had no length before still joins two parts.
        const bool used_up = place[list[e].a] == place[list[e].b] && forest[list[e].a].at != forest[list[e].b].at;
        result.survives[e] = list[e].alive && !used_up;
        if (!result.survives[e]) continue;
        const std::size_t a = keep(list[e].a), b = keep(list[e].b);
        add_edge(a, b, result.forest);
    }
    for (std::size_t v = 0; v < n; ++v)
        if (forest[v].root && vertex[v] < 0) keep(v);
    return result;
}

}  // namespace ribvault
