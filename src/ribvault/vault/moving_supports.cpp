#include "ribvault/vault/moving_supports.hpp"

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>

#include "ribvault/vault/free_trees.hpp"
#include "ribvault/vault/wall_contacts.hpp"

namespace ribvault {

MovingSupports::MovingSupports(const SupportForest& forest, const CavityBoundary& boundary, Unit step,
                               Unit pillar_length)
    : boundary(boundary),
      step(step),
      grid_(bounding_box(forest), units_per_mm, 2 * step + 2) {  // what begins between walls may move twice as far
    for (auto [v, end] = vertices(forest); v != end; ++v)
        nodes.push_back({forest[*v].at, forest[*v].root, {forest[*v].at}, {}, forest[*v]});
    for (auto [e, end] = edges(forest); e != end; ++e) add_wall(source(*e, forest), target(*e, forest), walls.size());
    input_walls = walls.size();
    SpareLengths lengths = spare_lengths(forest, pillar_length);
    for (std::size_t v = 0; v < nodes.size(); ++v) nodes[v].free = forest[v].free, nodes[v].stays = lengths.of(v) <= 0;
}

void MovingSupports::add_wall(std::size_t a, std::size_t b, std::size_t origin) {
    const auto id = static_cast<std::uint32_t>(walls.size());
    walls.push_back({a, b, {nodes[a].at, nodes[b].at}, origin});
    nodes[a].walls.push_back(id);
    nodes[b].walls.push_back(id);
    grid_.insert(id, segment(walls.back()));
}

std::size_t MovingSupports::split(std::size_t w, Point at) {
    const std::size_t a = walls[w].a, b = walls[w].b;
    for (const std::size_t end : {a, b})
        if (nodes[end].at == at) return end;
    const double whole = length(segment(walls[w]));
    const Segment was = walls[w].was;
    const Point from = part_way(was.a, was.b, std::min(1.0, length(at - nodes[a].at) / whole));
    const std::size_t joint = nodes.size();
    nodes.push_back(
        {at, false, {from}, {static_cast<std::uint32_t>(w)}, vertex_between(nodes[a].was, nodes[b].was, from)});
    std::erase(nodes[b].walls, static_cast<std::uint32_t>(w));
    walls[w].b = joint, walls[w].was.b = from;
    add_wall(joint, b, walls[w].origin);
    walls.back().was = {from, was.b};
    return joint;
}

std::vector<std::size_t> MovingSupports::trees() const {
    boost::disjoint_sets_with_storage<> sets(nodes.size());
    for (const Wall& w : walls)
        if (w.alive) sets.union_set(w.a, w.b);
    std::vector<std::size_t> tree(nodes.size());
    for (std::size_t v = 0; v < tree.size(); ++v) tree[v] = sets.find_set(v);
    return tree;
}

bool MovingSupports::reachable(const Node& node, Point p) const {
    return std::all_of(node.from.begin(), node.from.end(),
                       [&](Point f) { return squared_length(p - f) <= step * step; });
}

bool MovingSupports::collides(std::size_t v, Point p, std::size_t merged) const {
    for (const std::uint32_t w : nodes[v].walls) {
        const std::size_t u = other(w, v);
        if (u == merged) continue;
        const Segment s{p, nodes[u].at};
        if (s.a == s.b) return true;
        bool hit = false;
        grid_.visit(bounding_box(s), [&](std::uint32_t k) {
            if (hit || !walls[k].alive || k == w) return;
            const Wall& o = walls[k];
            if (o.a == v || o.b == v) {
                // Both end in v: they may not run over each other.
                const std::size_t x = o.a == v ? o.b : o.a;
                if (x == merged) return;
                hit = lie_on_each_other(p, nodes[u].at, nodes[x].at);
                return;
            }
            hit = collide(s, segment(o));
        });
        if (hit) return true;
    }
    return false;
}

bool MovingSupports::runs_over(std::size_t v, std::size_t u) const {
    const Point p = nodes[u].at;
    for (const std::uint32_t w : nodes[v].walls)
        for (const std::uint32_t k : nodes[u].walls) {
            const std::size_t x = other(w, v), y = other(k, u);
            if (x == u || y == v) continue;
            if (lie_on_each_other(p, nodes[x].at, nodes[y].at)) return true;
        }
    return false;
}

void MovingSupports::merge(std::size_t v, std::size_t u, std::optional<std::uint32_t> between) {
    if (between) {
        walls[*between].alive = false;
        std::erase(nodes[u].walls, *between);
    }
    for (const std::uint32_t w : nodes[v].walls) {
        if (w == between) continue;
        (walls[w].a == v ? walls[w].a : walls[w].b) = u;
        nodes[u].walls.push_back(w);
    }
    for (const Point f : nodes[v].from)
        if (std::find(nodes[u].from.begin(), nodes[u].from.end(), f) == nodes[u].from.end()) nodes[u].from.push_back(f);
    nodes[u].was.wide = nodes[u].was.wide || nodes[v].was.wide;
    nodes[u].was.standing = std::max(nodes[u].was.standing, nodes[v].was.standing);
    nodes[v].gone = true;
    nodes[v].walls.clear();
}

Point MovingSupports::on_shell(Vec at) const {
    const Point p = rounded(at);
    const Segment& edge = boundary.edges.segments()[boundary.edges.nearest(p).index];
    return place_root(nearest_point(p, edge), boundary);
}

bool MovingSupports::go_along_shell(std::size_t v, Vec wish, Point nearer_to, double farthest) {
    const Node& node = nodes[v];
    const Vec here = vec(node.at), way = wish - here;
    const double before = length(nearer_to - node.at);
    if (norm(way) < 2) return false;
    double reach = std::min(farthest, static_cast<double>(step) - 4);
    for (int attempt = 0; attempt < 3; ++attempt, reach /= 2) {
        const Point p = on_shell(here + (reach / norm(way)) * way);
        if (p == node.at || !reachable(node, p) || length(nearer_to - p) >= before - 1 || collides(v, p, none))
            continue;
        nodes[v].at = p;
        return true;
    }
    return false;
}

}  // namespace ribvault
