// Erosion takes no more than its step: every point that was there lies within the step of what is left.
#include "ribvault/vault/erode_supports.hpp"

#include <catch2/catch.hpp>

#include "grown_scene.hpp"
#include "within.hpp"

using namespace ribvault;
using namespace ribvault::test;

TEST_CASE("every point of grown supports lies within the step of the eroded ones") {
    Random g(61);
    int removed = 0, dots = 0;
    for (int k = 0; k < 25; ++k) {
        GrownScene scene(g);
        SupportForest forest = scene.forest;
        for (int layer = 0; layer < 12 && num_vertices(forest) > 0; ++layer) {
            const Unit step = pick(g, 1, 3) * 10000 + pick(g, -1, 1);
            const ErodedSupports eroded = erode_supports(forest, step);
            const NearestSegment left(centre_lines(eroded.forest));
            for (const Segment& s : centre_lines(forest)) {
                INFO("scene " << k << ", layer " << layer << ": " << text(s));
                REQUIRE(within(s, left, step));
            }
            REQUIRE(forest_fault(eroded.forest).empty());
            REQUIRE(eroded.survives.size() == num_edges(forest));
            REQUIRE(eroded.pinned.size() == num_vertices(eroded.forest));
            REQUIRE(std::count(eroded.survives.begin(), eroded.survives.end(), 1) ==
                    static_cast<long>(num_edges(eroded.forest)));
            // What is left is part of what was: every vertex within a rounding of it.
            const NearestSegment before(centre_lines(forest));
            for (const Segment& s : left.segments())
                for (const Point p : {s.a, s.b})
                    REQUIRE(compare_distance(p, before.segments()[before.nearest(p).index], 1) <= 0);
            removed += static_cast<int>(num_edges(forest) - num_edges(eroded.forest));
            dots += dots_of(eroded.forest);
            forest = eroded.forest;
        }
    }
    CHECK(removed > 1000);
    CHECK(dots > 20);
}

TEST_CASE("a wall loses the step at its tip and nothing at its root") {
    const SupportForest wall = forest_of({{{0, 0}, {0, 100000}}, {0}, {{0, 1}}});
    const SupportForest left = erode_supports(wall, 20000).forest;
    REQUIRE(num_edges(left) == 1);
    CHECK(has_vertex(left, {0, 0}));
    // One unit short of the limit: rounding may not go beyond it.
    CHECK(has_vertex(left, {0, 80001}));
    CHECK(length(erode_supports(wall, 0).forest) == 100000);
    const SupportForest between_shells = forest_of({{{0, 0}, {0, 100000}}, {0, 1}, {{0, 1}}});
    CHECK(length(erode_supports(between_shells, 20000).forest) == 100000);
}

TEST_CASE("the step goes on through vertices of valence 2, measured along the path") {
    const SupportForest bent =
        forest_of({{{0, 0}, {0, 50000}, {8000, 50000}, {8000, 57000}}, {0}, {{0, 1}, {1, 2}, {2, 3}}});
    const ErodedSupports eroded = erode_supports(bent, 20000);
    CHECK(num_edges(eroded.forest) == 1);
    CHECK(has_vertex(eroded.forest, {0, 45001}));
    CHECK(eroded.survives == std::vector<char>{1, 0, 0});
}

TEST_CASE("a short branch vanishes up to its junction, which stays and is pinned") {
    const SupportForest tree =
        forest_of({{{0, 0}, {0, 50000}, {15000, 50000}, {0, 200000}}, {0}, {{0, 1}, {1, 2}, {1, 3}}});
    const ErodedSupports eroded = erode_supports(tree, 20000);
    CHECK(num_edges(eroded.forest) == 2);
    CHECK(has_wall(eroded.forest, {0, 0}, {0, 50000}));
    CHECK(has_vertex(eroded.forest, {0, 180001}));
    for (auto [v, end] = vertices(eroded.forest); v != end; ++v)
        CHECK((eroded.pinned[*v] != 0) == (eroded.forest[*v].at == Point{0, 50000}));
    // A fork whose two arms vanish together leaves the whole trunk: the junction is a tip on the next layer only.
    const SupportForest fork =
        forest_of({{{0, 0}, {0, 50000}, {9000, 59000}, {-9000, 59000}}, {0}, {{0, 1}, {1, 2}, {1, 3}}});
    CHECK(length(erode_supports(fork, 20000).forest) == 50000);
}

TEST_CASE("a tree that is used up leaves its root as a dot, and a dot stays one") {
    const SupportForest stub = forest_of({{{0, 0}, {0, 20000}}, {0}, {{0, 1}}});
    const SupportForest dot = erode_supports(stub, 20000).forest;
    REQUIRE(num_vertices(dot) == 1);
    CHECK(dot[0].root);
    CHECK(dot[0].at == Point{0, 0});
    CHECK(num_vertices(erode_supports(dot, 20000).forest) == 1);
}
