// Second roots of long trees.
#include "ribvault/vault/brace_trees.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

#include "grown_scene.hpp"
#include "ribvault/vault/shrink_supports.hpp"
#include "ribvault/vault/tree_walk.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

constexpr Unit mm = units_per_mm;
const Region room{rectangle(0, 0, 40 * mm, 30 * mm)};

/// A wall of 20 mm along the middle of the room that turns towards the far side for its last 10 mm.
SupportForest bent() {
    return forest_of({{{0, 15 * mm}, {20 * mm, 15 * mm}, {20 * mm, 25 * mm}}, {0}, {{0, 1}, {1, 2}}});
}

int roots_of(const SupportForest& forest) {
    int roots = 0;
    for (auto [v, end] = vertices(forest); v != end; ++v) roots += forest[*v].root;
    return roots;
}

}  // namespace

TEST_CASE("a long tree gets its second root where the shell is nearest to its tip") {
    const CavityBoundary boundary = prepare_boundary(room);
    SupportForest forest = bent();
    CHECK(brace_trees(forest, boundary, 30 * mm) == 0);  // exactly as long
    CHECK(brace_trees(forest, boundary, 0) == 0);        // off
    REQUIRE(brace_trees(forest, boundary, 30 * mm - 1) == 1);
    CHECK(has_wall(forest, {20 * mm, 25 * mm}, {20 * mm, 30 * mm}));
    CHECK(roots_of(forest) == 2);
    CHECK(brace_trees(forest, boundary, 10 * mm) == 0);  // it has two
}

TEST_CASE("a brace stands away from the first root and goes through no wall") {
    const CavityBoundary boundary = prepare_boundary(room);
    // The tip's nearest shell is beside its own root.
    SupportForest hook = forest_of(
        {{{0, 15 * mm}, {20 * mm, 15 * mm}, {20 * mm, 18 * mm}, {1 * mm, 18 * mm}}, {0}, {{0, 1}, {1, 2}, {2, 3}}});
    REQUIRE(brace_trees(hook, boundary, 20 * mm) == 1);
    for (auto [v, end] = vertices(hook); v != end; ++v)
        if (hook[*v].root && *v != 0) CHECK(length(hook[*v].at - Point{0, 15 * mm}) >= 10.0 * mm);
    // A wall between tip and shell, with a gap at its far end.
    SupportForest barred = bent();
    const auto a = add_vertex({.at = {40 * mm, 27 * mm}, .root = true}, barred),
               b = add_vertex({.at = {15 * mm, 27 * mm}}, barred);
    add_edge(a, b, barred);
    REQUIRE(brace_trees(barred, boundary, 29 * mm) == 1);
    CHECK_FALSE(has_wall(barred, {20 * mm, 25 * mm}, {20 * mm, 30 * mm}));
    CHECK(crossings(barred).first.empty());
}

TEST_CASE("braces of random supports: long trees have two roots, nothing that was there moves, nothing crosses") {
    Random g(31);
    int braces = 0, long_trees = 0;
    for (int k = 0; k < 40; ++k) {
        GrownScene scene(g);
        if (num_edges(scene.forest) == 0) continue;
        const std::vector<Segment> before = centre_lines(scene.forest);
        SupportForest forest = scene.forest;
        const int added = brace_trees(forest, scene.boundary, mm);
        braces += added;
        CHECK(num_edges(forest) == before.size() + static_cast<std::size_t>(added));
        for (const Segment& s : before) CHECK((has_wall(forest, s.a, s.b) || s.a == s.b));
        CHECK(crossings(forest).first.empty());
        CHECK(leaving_wall(forest, scene.boundary).empty());
        for (auto [v, end] = vertices(forest); v != end; ++v) {
            if (!forest[*v].root) continue;
            const TreeWalk tree = walk_from(*v, forest);
            const auto roots =
                std::count_if(tree.order.begin(), tree.order.end(), [&](std::size_t w) { return forest[w].root; });
            long_trees += roots == 1 && tree.distance[tree.farthest()] > static_cast<double>(mm);
        }
    }
    CHECK(braces > 100);
    CHECK(long_trees < braces / 2);  // those without room for a brace
}

TEST_CASE("a braced tree is cut between its roots only where no part stays longer than what is braced") {
    const CavityBoundary boundary = prepare_boundary(room);
    const SupportForest across = forest_of({{{10 * mm, 0}, {10 * mm, 30 * mm}}, {0, 1}, {{0, 1}}});
    const auto pieces = [&](Unit braced) {
        const SupportForest shrunk = shrink_supports(across, boundary, 20000, 0, braced).forest;
        return num_vertices(shrunk) - num_edges(shrunk);
    };
    CHECK(pieces(0) == 2);
    CHECK(pieces(15 * mm) == 2);
    CHECK(pieces(15 * mm - 10) == 1);
}
