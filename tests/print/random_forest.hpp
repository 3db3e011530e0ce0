// Random support forests: segments attached to existing vertices inside a square.
#pragma once

#include <random>
#include <set>

#include "ribvault/vault/support_forest.hpp"

namespace ribvault::test {

/// `trees` trees of `edges` edges each in a 20 mm square; edges are between `shortest` and `longest` units long. All
/// vertices lie at different places. Vertices are numbered at random, so that roots need not come first.
inline SupportForest random_forest(std::mt19937_64& random, int trees, int edges, Unit shortest, Unit longest,
                                   double share_first_layer) {
    const auto uniform = [&](Unit lo, Unit hi) { return std::uniform_int_distribution<Unit>(lo, hi)(random); };
    const Unit side = 20 * units_per_mm;
    struct Edge {
        std::size_t a, b;
    };
    std::vector<SupportVertex> vertices;
    std::vector<Edge> all;
    std::set<Point> taken;
    for (int t = 0; t < trees; ++t) {
        const std::size_t first = vertices.size();
        Point root{uniform(-side, side), -side};
        while (!taken.insert(root).second) ++root.x;
        vertices.push_back({root, true});
        for (int e = 0; e < edges; ++e) {
            const auto from =
                static_cast<std::size_t>(uniform(static_cast<Unit>(first), static_cast<Unit>(vertices.size()) - 1));
            const Unit reach = uniform(shortest, longest);
            const double angle = std::uniform_real_distribution<double>(0, 6.283185307179586)(random);
            const Point at = vertices[from].at + Point{round_to_lattice(static_cast<double>(reach) * std::cos(angle)),
                                                       round_to_lattice(static_cast<double>(reach) * std::sin(angle))};
            if (std::abs(at.x) > side || std::abs(at.y) > side || !taken.insert(at).second) continue;
            vertices.push_back({at, uniform(0, 19) == 0});
            all.push_back({from, vertices.size() - 1});
        }
    }
    std::vector<std::size_t> number(vertices.size());
    for (std::size_t i = 0; i < number.size(); ++i) number[i] = i;
    std::shuffle(number.begin(), number.end(), random);
    std::shuffle(all.begin(), all.end(), random);
    SupportForest forest(vertices.size());
    for (std::size_t i = 0; i < number.size(); ++i) forest[number[i]] = vertices[i];
    for (const Edge& e : all)
        add_edge(number[e.a], number[e.b], SupportEdge{std::bernoulli_distribution(share_first_layer)(random)}, forest);
    return forest;
}

}  // namespace ribvault::test
