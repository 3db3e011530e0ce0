#include "ribvault/vault/straight_chains.hpp"

#include <algorithm>

#include "ribvault/vault/wall_contacts.hpp"

namespace ribvault {
namespace {

constexpr Unit rounding = 2;  ///< units that places of a straight wall may be off it

/// Do two walls that begin in the same place lie on each other from there?
bool overlap(const Segment& s, const Segment& t) {
    for (const auto& [end, far] : {std::pair(s.a, s.b), std::pair(s.b, s.a)})
        for (const auto& [same, other] : {std::pair(t.a, t.b), std::pair(t.b, t.a)})
            if (same == end && lie_on_each_other(end, far, other)) return true;
    return false;
}

/// Would a wall there meet any other wall than those that end in v?
bool meets_walls(const MovingSupports& supports, const Segment& way, std::size_t v) {
    bool meets = false;
    supports.visit_walls(bounding_box(way), [&](std::uint32_t k) {
        const MovingSupports::Wall& wall = supports.walls[supports.now(k)];
        if (meets || !wall.alive || wall.a == v || wall.b == v) return;
        const Segment other = supports.segment(wall);
        meets = collide(way, other) || overlap(way, other);
    });
    return meets;
}

}  // namespace

void drop_straight_vertices(MovingSupports& supports) {
    std::vector<MovingSupports::Node>& nodes = supports.nodes;
    std::vector<MovingSupports::Wall>& walls = supports.walls;
    for (std::size_t v = 0; v < nodes.size(); ++v) {
        MovingSupports::Node& node = nodes[v];
        if (node.gone || node.root || node.stays || node.walls.size() != 2) continue;
        const std::uint32_t first = node.walls[0], second = node.walls[1];
        const std::size_t a = supports.other(first, v), b = supports.other(second, v);
        const Segment way{nodes[a].at, nodes[b].at};
        if (way.a == way.b || compare_distance(node.at, way, rounding) > 0) continue;
        std::vector<MovingSupports::Passed> passed = walls[first].passed;
        passed.insert(passed.end(), walls[second].passed.begin(), walls[second].passed.end());
        for (const Point from : node.from) passed.push_back({from, node.was.standing});
        const auto lost = [&](const MovingSupports::Passed& p) {
            return compare_distance(p.from, way, supports.step) > 0 ||
                   p.standing > vertex_between(nodes[a].was, nodes[b].was, p.from).standing + 1;
        };
        if (std::any_of(passed.begin(), passed.end(), lost) || meets_walls(supports, way, v)) continue;
        (walls[first].a == v ? walls[first].a : walls[first].b) = b;
        walls[first].passed = std::move(passed);
        walls[second].alive = false, walls[second].merged = first;
        std::replace(nodes[b].walls.begin(), nodes[b].walls.end(), second, first);
        node.gone = true;
        node.walls.clear();
    }
}

}  // namespace ribvault
