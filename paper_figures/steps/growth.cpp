#include "growth.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "ribvault/vault/growing_supports.hpp"

namespace ribvault::steps {
namespace {

constexpr int field_columns = 240;  // of the distance fields, along the cavity's longer side

std::vector<Segment> walls_of(const SupportForest& forest) {
    std::vector<Segment> walls;
    for (auto [e, end] = edges(forest); e != end; ++e)
        walls.push_back({forest[source(*e, forest)].at, forest[target(*e, forest)].at});
    return walls;
}

Unit rounded(const SquaredDistance& d) { return round_to_lattice(std::sqrt(d.value())); }

/// Equation (4) for one vertex: does it attract?
bool attracts(std::size_t v, const SupportForest& forest, const Settings& s) {
    return s.branch_bonus && out_degree(v, forest) > 0 &&
           out_degree(v, forest) < static_cast<std::size_t>(s.valence_limit);
}

class Replay {
public:
    Replay(const SupportForest& propagated, const CavityBoundary& boundary, const Settings& settings)
        : boundary_(boundary), settings_(settings), growing_(propagated, boundary.location.box(), boundary, settings) {}

    SupportForest forest() const {
        GrowingSupports copy = growing_;
        return copy.take();
    }

    /// A wall's new vertex was not covered when it was added; a root lies on the shell, a split point on a wall.
    bool is_tip(const SupportVertex& vertex) const {
        return !vertex.root && !growing_.covers(vertex.at, static_cast<double>(settings_.nozzle) / 2);
    }

    Json add(Point p) {
        const SupportForest before = forest();
        Json step = {{"point", json_of(p)}};
        const NearestSegment::Hit shell = boundary_.edges.nearest(p);
        step["shell"] = json_of(nearest_point(p, boundary_.edges.segments()[shell.index]));
        step["shell_distance"] = rounded(shell.distance);
        step["wall"] = nullptr;
        if (num_edges(before) > 0) {
            const NearestSegment walls(walls_of(before));
            const NearestSegment::Hit wall = walls.nearest(p);
            step["wall"] = json_of(nearest_point(p, walls.segments()[wall.index]));
            step["wall_distance"] = rounded(wall.distance);
        }
        growing_.add_wall(p, settings_.branch_bonus ? settings_.branch_bonus_length : 0);
        const std::size_t joint = growing_.new_walls().back().joint;
        const SupportForest after = forest();
        const bool is_new = joint >= num_vertices(before);
        step["joint"] = json_of(after[joint].at);
        step["joint_kind"] = !is_new ? "vertex" : after[joint].root ? "shell" : "wall";
        step["valence"] = is_new ? 0 : out_degree(joint, before);
        step["joint_distance"] = round_to_lattice(length(after[joint].at - p));
        return step;
    }

private:
    const CavityBoundary& boundary_;
    const Settings& settings_;
    GrowingSupports growing_;
};

Json fields_json(const SupportForest& forest, const CavityBoundary& boundary, const Settings& settings) {
    const Box& box = boundary.location.box();
    const Unit pitch = std::max(box.hi.x - box.lo.x, box.hi.y - box.lo.y) / field_columns + 1;
    const std::vector<Segment> walls = walls_of(forest);
    const NearestSegment nearest_wall(walls);
    Json shell = Json::array(), both = Json::array();
    Unit columns = 0, rows = 0;
    for (Unit y = box.lo.y + pitch / 2; y < box.hi.y; y += pitch, ++rows) {
        columns = 0;
        for (Unit x = box.lo.x + pitch / 2; x < box.hi.x; x += pitch, ++columns) {
            const Point p{x, y};
            if (boundary.location.locate(p) != Side::inside) {
                shell.push_back(nullptr), both.push_back(nullptr);
                continue;
            }
            const Unit to_shell = rounded(boundary.edges.nearest(p).distance);
            Unit to_both = to_shell;
            if (!walls.empty()) to_both = std::min(to_both, rounded(nearest_wall.nearest(p).distance));
            for (auto [v, end] = vertices(forest); v != end; ++v)
                if (attracts(*v, forest, settings))
                    to_both =
                        std::min(to_both, round_to_lattice(length(forest[*v].at - p)) - settings.branch_bonus_length);
            shell.push_back(to_shell), both.push_back(to_both);
        }
    }
    return {{"origin", json_of({box.lo.x + pitch / 2, box.lo.y + pitch / 2})},
            {"pitch", pitch},
            {"columns", columns},
            {"rows", rows},
            {"shell", shell},
            {"both", both},
            {"supports", json_of(forest)}};
}

/// The same vertices and walls in the same order (flags that the layer below decides left out).
bool same(const SupportForest& a, const SupportForest& b) {
    if (num_vertices(a) != num_vertices(b)) return false;
    for (auto [v, end] = vertices(a); v != end; ++v)
        if (a[*v].at != b[*v].at || a[*v].root != b[*v].root) return false;
    return std::ranges::equal(walls_of(a), walls_of(b),
                              [](const Segment& s, const Segment& t) { return s.a == t.a && s.b == t.b; });
}

}  // namespace

Json growth_json(const SupportForest& propagated, const SupportForest& grown, const CavityBoundary& boundary,
                 const Settings& settings) {
    Replay replay(propagated, boundary, settings);
    Json walls = Json::array();
    std::vector<SupportForest> states{replay.forest()};
    for (std::size_t v = num_vertices(propagated); v < num_vertices(grown); ++v) {
        if (!replay.is_tip(grown[v])) continue;
        walls.push_back(replay.add(grown[v].at));
        states.push_back(replay.forest());
    }
    if (!same(states.back(), grown))
        throw std::logic_error("growth: the walls added again are not those that were grown");
    return {{"walls", walls}, {"fields", fields_json(states[states.size() / 2], boundary, settings)}};
}

}  // namespace ribvault::steps
