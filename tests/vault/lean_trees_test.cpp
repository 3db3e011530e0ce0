// Trees that stand free in a cavity lean: to the shell, on which they are rooted then, or to each other; by no more
// than a step a layer, and with the track that they must keep.
#include "ribvault/vault/lean_trees.hpp"

#include <catch2/catch.hpp>

#include "grown_scene.hpp"
#include "ribvault/vault/free_trees.hpp"
#include "ribvault/vault/next_layer.hpp"
#include "ribvault/vault/shrink_supports.hpp"
#include "within.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

constexpr Unit step = 20000;

/// A room of 20 mm x 20 mm in which trees lean.
CavityBoundary room(const Leaning& leaning) {
    CavityBoundary boundary = prepare_boundary({rectangle(0, 0, 2000000, 2000000)});
    boundary.free_trees = true, boundary.layers_below = 1000, boundary.leaning = leaning;
    return boundary;
}

SupportForest standing_free(SupportForest forest) {
    root_trees(forest);
    return forest;
}

std::size_t free_roots(const SupportForest& forest) {
    const auto [begin, end] = vertices(forest);
    return static_cast<std::size_t>(std::count_if(begin, end, [&](std::size_t v) { return forest[v].free; }));
}

/// What must hold from one layer to the next; the supports of the next.
SupportForest next(const SupportForest& forest, const CavityBoundary& boundary) {
    const ShrunkSupports shrunk = shrink_supports(forest, boundary, step);
    const NearestSegment left(centre_lines(shrunk.forest));
    for (const Segment& s : centre_lines(forest)) {
        INFO(text(s));
        REQUIRE(within(s, left, step));
    }
    REQUIRE(forest_fault(shrunk.forest) == "");
    REQUIRE(crossings(shrunk.forest).count == 0);
    SupportForest below = shrunk.forest;
    for (auto [v, end] = vertices(below); v != end; ++v) ++below[*v].standing;
    return below;
}

}  // namespace

TEST_CASE("a short wall that stands free goes a step a layer to the shell and runs back into it") {
    const CavityBoundary boundary = room({100000, 0});
    SupportForest wall = standing_free(forest_of({{{500000, 900000}, {500000, 1000000}}, {}, {{0, 1}}}));
    REQUIRE(free_roots(wall) == 1);
    int layers = 0;
    for (; free_roots(wall) > 0; ++layers) {
        REQUIRE(layers < 30);
        wall = next(wall, boundary);
        if (free_roots(wall) > 0) CHECK(length(wall) >= 100000);
        CHECK(length(wall) < 100000 + 2 * step);
    }
    CHECK(layers >= 25);  // 5 mm
    REQUIRE(num_edges(wall) >= 1);
    for (auto [v, end] = vertices(wall); v != end; ++v)
        if (wall[*v].root) CHECK(wall[*v].at.x <= 0);
    for (int k = 0; k < 10 && num_edges(wall) > 0; ++k) wall = next(wall, boundary);
    CHECK(num_edges(wall) == 0);
}

TEST_CASE("a long wall that stands free shrinks from both ends before it goes anywhere") {
    SupportForest wall = standing_free(forest_of({{{500000, 500000}, {500000, 1500000}}, {}, {{0, 1}}}));
    const double before = length(wall);
    wall = next(wall, room({100000, 0}));
    CHECK(length(wall) == Approx(before - 2 * step).margin(10));
    for (auto [v, end] = vertices(wall); v != end; ++v) CHECK(wall[*v].at.x == 500000);
}

TEST_CASE("two trees that are nearer to each other than to the shell become one") {
    const CavityBoundary boundary = room({100000, 0});
    SupportForest pair = standing_free(forest_of(
        {{{900000, 950000}, {900000, 1050000}, {1100000, 950000}, {1100000, 1050000}}, {}, {{0, 1}, {2, 3}}}));
    REQUIRE(component_count(pair) == 2);
    int layers = 0;
    for (; component_count(pair) == 2; ++layers) {
        REQUIRE(layers < 10);
        pair = next(pair, boundary);
    }
    CHECK(layers >= 5);  // 2 mm, from both sides
    CHECK(free_roots(pair) == 1);
    for (int k = 0; k < 20; ++k) pair = next(pair, boundary);
    CHECK(length(pair) < 100000 + 2 * step);
    CHECK(length(pair) >= 100000);
}

TEST_CASE("a tree joins one that is rooted on the shell") {
    const CavityBoundary boundary = room({100000, 0});
    SupportForest forest =
        forest_of({{{0, 1000000}, {1500000, 1000000}, {700000, 1050000}, {700000, 1150000}}, {0}, {{0, 1}, {2, 3}}});
    root_trees(forest);
    REQUIRE(free_roots(forest) == 1);
    for (int k = 0; k < 3; ++k) forest = next(forest, boundary);
    CHECK(component_count(forest) == 1);
    CHECK(free_roots(forest) == 0);
}

TEST_CASE("tips that face each other within a step become one, once") {
    SupportForest line = standing_free(forest_of(
        {{{900000, 1000000}, {990000, 1000000}, {1000000, 1000000}, {1090000, 1000000}}, {}, {{0, 1}, {2, 3}}}));
    const SupportForest joined = next(line, room({100000, 0}));
    CHECK(component_count(joined) == 1);
    CHECK(num_edges(joined) >= 1);
    CHECK(length(joined) > 100000);
}

TEST_CASE("a tree that would lie on another, or cross a third, stays where it is") {
    const CavityBoundary boundary = room({200000, 0});
    // The head is a tenth of a millimetre from the other wall, in whose line its own wall would come to lie.
    SupportForest over =
        forest_of({{{950000, 1010000}, {1100000, 1000000}, {0, 1000000}, {1000000, 1000000}}, {2}, {{0, 1}, {2, 3}}});
    root_trees(over);
    CHECK(component_count(next(over, boundary)) == 2);
    // The third one's tip is between where the wall is and where it would be, once its head has joined or come nearer.
    for (const Unit below : {15000, 90000}) {
        SupportForest three = forest_of({{{900000, 1000000},
                                          {1100000, 1000000},
                                          {1000000, 995000},
                                          {1000000, 0},
                                          {0, 1000000 - below},
                                          {950000, 1000000 - below}},
                                         {3, 4},
                                         {{0, 1}, {2, 3}, {4, 5}}});
        root_trees(three);
        REQUIRE(free_roots(three) == 1);
        MovingSupports supports(three, boundary, step, 0);
        LeaningTrees(supports).lead();
        INFO(below);
        CHECK_FALSE(segments_touch(supports.segment(supports.walls[0]), supports.segment(supports.walls[1])));
        CHECK((supports.nodes[0].at == Point{900000, 1000000}) == (below == 15000));
        CHECK_FALSE(supports.nodes[0].gone);
    }
}

TEST_CASE("a tree that comes near the shell, or another tree, does not go through it") {
    const CavityBoundary boundary = room({200000, 0});
    for (const Unit away : {step - 3, step - 1}) {
        const SupportForest wall = standing_free(forest_of({{{away, 1000000}, {100000, 1000000}}, {}, {{0, 1}}}));
        MovingSupports supports(wall, boundary, step, 0);
        LeaningTrees(supports).lead();
        INFO(away);
        CHECK(supports.nodes[0].at.x > 0);
        CHECK(supports.nodes[0].at.x < 10);
        CHECK_FALSE(supports.nodes[0].root);
    }
}

TEST_CASE("two trees become one at one end only") {
    const SupportForest side_by_side = standing_free(forest_of({{{919000, 1003000},
                                                                 {950000, 985000},
                                                                 {985000, 1002000},
                                                                 {900000, 1010000},
                                                                 {950000, 1010000},
                                                                 {1000000, 1010000}},
                                                                {},
                                                                {{0, 1}, {1, 2}, {3, 4}, {4, 5}}}));
    CHECK(component_count(next(side_by_side, room({200000, 0}))) == 1);
}

TEST_CASE("a dot that stands free goes to the shell too") {
    const CavityBoundary boundary = room({100000, 0});
    SupportForest dot = standing_free(forest_of({{{50000, 1000000}}, {}, {}}));
    for (int layer = 0; layer < 3; ++layer) {
        REQUIRE(free_roots(dot) == 1);
        dot = next(dot, boundary);
        REQUIRE(num_vertices(dot) == 1);
    }
    CHECK(free_roots(dot) == 0);
    CHECK(dot[0].at.x <= 0);
}

TEST_CASE("a wall of which one end has moved is split where it is, and what was there is known") {
    SupportForest wall = forest_of({{{0, 0}, {100000, 0}}, {0}, {{0, 1}}});
    wall[1].standing = 10;
    const CavityBoundary boundary = room({100000, 0});
    MovingSupports supports(wall, boundary, step, 0);
    supports.nodes[1].at = {100000, 10000};
    CHECK(supports.split(0, {100000, 10000}) == 1);
    const std::size_t joint = supports.split(0, {50000, 5000});
    REQUIRE(joint == 2);
    CHECK(supports.nodes[joint].at == Point{50000, 5000});
    CHECK(supports.nodes[joint].from == std::vector<Point>{{50000, 0}});
    CHECK(supports.nodes[joint].walls == std::vector<std::uint32_t>{0, 1});
    CHECK(supports.nodes[0].walls == std::vector<std::uint32_t>{0});
    CHECK(supports.nodes[1].walls == std::vector<std::uint32_t>{1});
    CHECK(supports.walls[0].was.b == Point{50000, 0});
    CHECK(supports.walls[1].was.a == Point{50000, 0});
    CHECK(supports.walls[1].was.b == Point{100000, 0});
    CHECK(supports.walls[1].origin == 0);
    CHECK(supports.trees() == std::vector<std::size_t>(3, supports.trees()[0]));
}

TEST_CASE("the higher a leaning tree stands, the more track it has") {
    const CavityBoundary boundary = room({100000, 5000});
    SupportForest wall = standing_free(forest_of({{{1000000, 950000}, {1000000, 1050000}}, {}, {{0, 1}}}));
    for (int layer = 1; layer <= 40; ++layer) {
        wall = next(wall, boundary);
        INFO("layer " << layer);
        CHECK(length(wall) >= std::max(100000.0, 5000.0 * layer));
        CHECK(length(wall) < std::max(100000.0, 5000.0 * layer) + 2 * step);
    }
}

TEST_CASE("a wall leaves the shell where it takes less track until it is there again") {
    // One of length L takes L² / 2 step; from its middle L² / 4 step, 1 mm for three quarters of L / step layers, and
    // 1 mm² / 2 step to run back: less from (3 + √17) / 2 mm on.
    for (const Unit whole : {200000, 350000, 362000, 1500000}) {
        SupportForest wall = forest_of({{{0, 1000000}, {whole / 2, 1000000}, {whole, 1000000}}, {0}, {{0, 1}, {1, 2}}});
        lean_where_cheaper(wall, room({100000, 0}), step);
        INFO(whole);
        CHECK(wall[1].free == (whole > 356155));
        CHECK(wall[0].root == (whole < 356155));
    }
}

TEST_CASE("grown supports that lean move by no more than a step, stay planar and vanish") {
    Random g(1221);
    int layers = 0, leant = 0, vanished = 0;
    for (int k = 0; k < 12; ++k) {
        GrownScene scene(g);
        scene.boundary.free_trees = true, scene.boundary.layers_below = 400;
        scene.boundary.leaning = {pick(g, 1, 3) * 20000, static_cast<double>(pick(g, 0, 1) * 2000)};
        SupportForest forest = scene.forest;
        for (int layer = 0; layer < 60 && num_edges(forest) > 0; ++layer, ++layers) {
            INFO("scene " << k << ", layer " << layer);
            root_trees(forest);
            lean_where_cheaper(forest, scene.boundary, step);
            leant += free_roots(forest) > 0;
            forest = next(forest, scene.boundary);
        }
        vanished += num_edges(forest) == 0;
    }
    CHECK(layers > 100);
    CHECK(leant > 50);
    CHECK(vanished > 8);
}
