// A cavity of random shapes and the supports that grow under all of its ceiling.
#pragma once

#include "exact/rationals.hpp"
#include "forest_checks.hpp"
#include "random_cavities.hpp"
#include "ribvault/vault/grow_supports.hpp"

namespace ribvault::test {

struct GrownScene {
    Settings settings;
    DriftingShapes shapes;
    Cavity cavity;
    CavityBoundary boundary;
    SupportForest forest;

    explicit GrownScene(Random& g, Unit size = 800000, Unit drift = 15000)
        : shapes(g, 2, 2, size, drift),
          cavity(make_cavity(0, shapes.at(0), settings)),
          boundary(prepare_boundary(cavity.region)) {
        if (!cavity.region.empty()) forest = grow_supports({}, cavity.deep, boundary, g(), settings).forest;
    }
};

/// Vertices in order, which of them are roots, and walls between their numbers.
struct ForestPlan {
    std::vector<Point> vertices;
    std::vector<std::size_t> roots;
    std::vector<std::pair<std::size_t, std::size_t>> walls;
};
inline SupportForest forest_of(const ForestPlan& plan) {
    SupportForest forest(plan.vertices.size());
    for (std::size_t v = 0; v < plan.vertices.size(); ++v) forest[v].at = plan.vertices[v];
    for (const std::size_t v : plan.roots) forest[v].root = true;
    for (const auto& [a, b] : plan.walls) add_edge(a, b, forest);
    return forest;
}

inline bool has_vertex(const SupportForest& forest, Point p) {
    for (auto [v, end] = vertices(forest); v != end; ++v)
        if (forest[*v].at == p) return true;
    return false;
}
inline bool has_wall(const SupportForest& forest, Point a, Point b) {
    for (const Segment& s : centre_lines(forest))
        if ((s.a == a && s.b == b) || (s.a == b && s.b == a)) return true;
    return false;
}
inline int dots_of(const SupportForest& forest) {
    int dots = 0;
    for (auto [v, end] = vertices(forest); v != end; ++v) dots += out_degree(*v, forest) == 0;
    return dots;
}

/// Walls that leave the cavity otherwise than at a root: empty, or the first one.
inline std::string leaving_wall(const SupportForest& forest, const CavityBoundary& boundary) {
    for (auto [e, end] = edges(forest); e != end; ++e) {
        const SupportVertex &a = forest[source(*e, forest)], &b = forest[target(*e, forest)];
        const Segment s{a.at, b.at};
        Box box;
        box.add(s.a), box.add(s.b);
        std::string fault;
        boundary.edges.visit(box, [&](std::uint32_t k) {
            const Segment& edge = boundary.edges.segments()[k];
            const auto at_root = [&](const SupportVertex& v) {
                return v.root && compare_distance(v.at, edge, 2 * root_tolerance) <= 0;
            };
            if (segments_cross(s, edge) && !at_root(a) && !at_root(b)) fault = text(s);
        });
        if (!fault.empty()) return fault;
    }
    return {};
}

}  // namespace ribvault::test
