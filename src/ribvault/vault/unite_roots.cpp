#include "ribvault/vault/unite_roots.hpp"

#include <algorithm>

#include "ribvault/vault/root_pairs.hpp"

namespace ribvault {
namespace {

constexpr Unit steps_apart = 10;  ///< roots farther apart than so many steps do not go towards each other

}  // namespace

RootMeetings::RootMeetings(MovingSupports& supports)
    : supports_(supports), partner_(supports.nodes.size(), MovingSupports::none) {
    if (!supports.boundary.has_shell()) return;
    for (bool united = true; united;) {
        pair_roots();
        united = false;
        for (std::size_t v = 0; v < partner_.size(); ++v) united = (has(v) && meet(v)) || united;
    }
}

void RootMeetings::pair_roots() {
    std::vector<TreeRoot> roots;
    std::vector<std::size_t> node;
    const std::vector<std::size_t> tree = supports_.trees();
    for (std::size_t v = 0; v < supports_.nodes.size(); ++v) {
        const MovingSupports::Node& n = supports_.nodes[v];
        partner_[v] = MovingSupports::none;
        if (!n.root || n.gone || n.free || n.stays || n.walls.empty()) continue;
        roots.push_back({n.at, trunk_of(v), tree[v], away_from(v)});
        node.push_back(v);
    }
    const std::vector<std::size_t> partner =
        ribvault::pair_roots(roots, supports_.boundary, steps_apart * supports_.step);
    for (std::size_t r = 0; r < roots.size(); ++r)
        if (partner[r] != no_root) partner_[node[r]] = node[partner[r]];
}

Vec RootMeetings::away_from(std::size_t v) const {
    Vec sum;
    for (const std::uint32_t w : supports_.nodes[v].walls) {
        const Vec d = vec(supports_.nodes[supports_.other(w, v)].at) - vec(supports_.nodes[v].at);
        sum = sum + (1 / std::max(norm(d), 1.0)) * d;
    }
    return sum;
}

double RootMeetings::trunk_of(std::size_t root) const {
    double longest = 0;
    for (const std::uint32_t w : supports_.nodes[root].walls) longest = std::max(longest, trunk_of(root, w));
    return longest;
}

double RootMeetings::trunk_of(std::size_t v, std::uint32_t w) const {
    double sum = 0;
    for (;;) {
        const std::size_t u = supports_.other(w, v);
        sum += length(supports_.nodes[u].at - supports_.nodes[v].at);
        const std::vector<std::uint32_t>& walls = supports_.nodes[u].walls;
        if (walls.size() != 2) return sum;
        w = walls[walls.front() == w ? 1 : 0], v = u;
    }
}

bool RootMeetings::meet(std::size_t v) {
    const std::size_t u = partner_[v];
    const Point middle = supports_.on_shell(0.5 * (vec(supports_.nodes[v].at) + vec(supports_.nodes[u].at))),
                was = supports_.nodes[u].at;
    if (!supports_.reachable(supports_.nodes[v], middle) || !supports_.reachable(supports_.nodes[u], middle) ||
        supports_.collides(u, middle, MovingSupports::none))
        return false;
    supports_.nodes[u].at = middle;
    if (supports_.collides(v, middle, MovingSupports::none) || supports_.runs_over(v, u)) {
        supports_.nodes[u].at = was;
        return false;
    }
    supports_.merge(v, u, {});
    partner_[v] = partner_[u] = MovingSupports::none;
    return true;
}

bool RootMeetings::approach(std::size_t v) {
    const Point there = supports_.nodes[partner_[v]].at;
    return meet(v) || supports_.go_along_shell(v, vec(there), there, 0.5 * length(there - supports_.nodes[v].at));
}

void unite_roots_in_place(MovingSupports& supports) {
    std::vector<MovingSupports::Node>& nodes = supports.nodes;
    const auto on_shell = [&](std::size_t v) { return nodes[v].root && !nodes[v].free; };
    for (std::size_t v = 0; v < nodes.size(); ++v)
        for (std::size_t first = 0; first < nodes[v].walls.size(); ++first)
            for (std::size_t k = nodes[v].walls.size(); k-- > first + 1;) {
                const std::uint32_t kept = nodes[v].walls[first], same = nodes[v].walls[k];
                const std::size_t a = supports.other(kept, v), b = supports.other(same, v);
                if (a == b || nodes[a].at != nodes[b].at || !on_shell(a) || !on_shell(b)) continue;
                std::erase(nodes[v].walls, same);
                std::erase(nodes[b].walls, same);
                supports.walls[same].alive = false, supports.walls[same].merged = kept;
                supports.merge(b, a, {});
            }
}

}  // namespace ribvault
