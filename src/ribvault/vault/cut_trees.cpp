#include "ribvault/vault/cut_trees.hpp"

#include <algorithm>

namespace ribvault {

void cut_between_roots(MovingSupports& supports, Unit braced) {
    const std::size_t n = supports.nodes.size();
    std::vector<std::int64_t> owner(n, -1);
    std::vector<double> distance(n, 0);
    // Shortest way along the tree to a root: the walls where two roots' parts meet are cut.
    std::vector<std::pair<double, std::size_t>> heap;
    const auto later = [](const auto& a, const auto& b) { return a > b; };
    for (std::size_t v = 0; v < n; ++v)
        if (supports.nodes[v].root && !supports.nodes[v].walls.empty())
            owner[v] = static_cast<std::int64_t>(v), heap.push_back({0, v});
    std::vector<char> done(n, 0);
    std::make_heap(heap.begin(), heap.end(), later);
    while (!heap.empty()) {
        std::pop_heap(heap.begin(), heap.end(), later);
        const auto [d, v] = heap.back();
        heap.pop_back();
        if (done[v]) continue;
        done[v] = 1;
        for (const std::uint32_t w : supports.nodes[v].walls) {
            const std::size_t u = supports.other(w, v);
            const double l = d + length(supports.nodes[u].at - supports.nodes[v].at);
            if (owner[u] >= 0 && distance[u] <= l) continue;
            owner[u] = owner[v], distance[u] = l;
            heap.push_back({l, u});
            std::push_heap(heap.begin(), heap.end(), later);
        }
    }
    const std::size_t count = supports.walls.size();
    for (std::size_t w = 0; w < count; ++w) {
        const std::size_t a = supports.walls[w].a, b = supports.walls[w].b;
        if (owner[a] < 0 || owner[b] < 0 || owner[a] == owner[b]) continue;
        const double l = length(supports.nodes[b].at - supports.nodes[a].at), at = (distance[b] + l - distance[a]) / 2;
        if (l < 4 || (braced > 0 && distance[a] + at > static_cast<double>(braced))) continue;
        const double t = std::clamp(at / l, 1 / l, 1 - 1 / l);
        const Point p =
            rounded(vec(supports.nodes[a].at) + t * (vec(supports.nodes[b].at) - vec(supports.nodes[a].at)));
        if (p == supports.nodes[a].at || p == supports.nodes[b].at) continue;
        // Two tips in the same place, each free to run back from there.
        const std::size_t tip_a = supports.nodes.size();
        const SupportVertex cut = vertex_between(supports.nodes[a].was, supports.nodes[b].was, p);
        supports.nodes.push_back({p, false, {p}, {}, cut});
        supports.nodes.push_back({p, false, {p}, {}, cut});
        std::erase(supports.nodes[b].walls, static_cast<std::uint32_t>(w));
        supports.walls[w].a = a, supports.walls[w].b = tip_a, supports.walls[w].was = {supports.nodes[a].at, p};
        supports.nodes[tip_a].walls.push_back(static_cast<std::uint32_t>(w));
        supports.add_wall(tip_a + 1, b, w);
    }
}

}  // namespace ribvault
