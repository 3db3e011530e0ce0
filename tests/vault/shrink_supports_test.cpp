// The descent of length: no point moves farther than its step, trees stay rooted and planar, and get shorter.
#include "ribvault/vault/shrink_supports.hpp"

#include <catch2/catch.hpp>

#include "grown_scene.hpp"
#include "within.hpp"

using namespace ribvault;
using namespace ribvault::test;

TEST_CASE(
    "every point of grown supports lies within the step of the shrunk ones, which are rooted, planar and shorter") {
    Random g(73);
    int layers = 0, moved_junctions = 0;
    double shrunk_length = 0, before_length = 0;
    for (int k = 0; k < 25; ++k) {
        GrownScene scene(g);
        SupportForest forest = scene.forest;
        for (int layer = 0; layer < 10 && num_edges(forest) > 0; ++layer, ++layers) {
            const Unit step = pick(g, 1, 3) * 10000;
            const ShrunkSupports shrunk = shrink_supports(forest, scene.boundary, step);
            const NearestSegment left(centre_lines(shrunk.forest));
            for (const Segment& s : centre_lines(forest)) {
                INFO("scene " << k << ", layer " << layer << ": " << text(s));
                REQUIRE(within(s, left, step));
            }
            REQUIRE(forest_fault(shrunk.forest).empty());
            REQUIRE(crossings(shrunk.forest).count <= crossings(forest).count);
            REQUIRE(shrunk.survives.size() == num_edges(forest));
            const double was = length(forest), is = length(shrunk.forest);
            REQUIRE(is < was);
            before_length += was, shrunk_length += is;
            for (auto [v, end] = vertices(forest); v != end; ++v)
                moved_junctions += out_degree(*v, forest) > 2 && !has_vertex(shrunk.forest, forest[*v].at);
            forest = shrunk.forest;
        }
    }
    CHECK(layers > 100);
    CHECK(moved_junctions > 100);
    CHECK(shrunk_length < 0.97 * before_length);
}

namespace {

CavityBoundary square() { return prepare_boundary({rectangle(0, 0, 2000000, 2000000)}); }

}  // namespace

TEST_CASE("a wall between two roots is cut in its middle and runs back on both sides") {
    const SupportForest wall = forest_of({{{0, 1000000}, {2000000, 1000000}}, {0, 1}, {{0, 1}}});
    const ShrunkSupports cut = shrink_supports(wall, square(), 20000);
    CHECK(num_edges(cut.forest) == 2);
    CHECK(component_count(cut.forest) == 2);
    CHECK(length(cut.forest) == Approx(2000000 - 40000).margin(10));
    CHECK(cut.survives == std::vector<char>{1});
}

TEST_CASE("two walls from one root are zipped up from it") {
    const SupportForest fork = forest_of({{{0, 1000000}, {400000, 1100000}, {400000, 900000}}, {0}, {{0, 1}, {0, 2}}});
    const ShrunkSupports zipped = shrink_supports(fork, square(), 20000);
    CHECK(num_edges(zipped.forest) == 3);
    // Both tips run back by the step, and a stem of about the step replaces what the two walls had there.
    CHECK(length(zipped.forest) < length(fork) - 2 * 19000 - 15000);
}

TEST_CASE("a root slides along the shell towards its wall") {
    const SupportForest oblique =
        forest_of({{{0, 1000000}, {300000, 1300000}, {600000, 1300000}}, {0}, {{0, 1}, {1, 2}}});
    const ShrunkSupports slid = shrink_supports(oblique, square(), 20000);
    for (auto [v, end] = vertices(slid.forest); v != end; ++v)
        if (slid.forest[*v].root) {
            CHECK(slid.forest[*v].at.x <= 0);
            CHECK(slid.forest[*v].at.y > 1015000);
            CHECK(slid.forest[*v].at.y <= 1020000);
        }
}

TEST_CASE("a tree that is used up leaves its root as a dot; a step of nothing changes nothing") {
    const SupportForest stub = forest_of({{{0, 1000000}, {15000, 1000000}}, {0}, {{0, 1}}});
    const ShrunkSupports dot = shrink_supports(stub, square(), 20000);
    CHECK(num_edges(dot.forest) == 0);
    CHECK(dots_of(dot.forest) == 1);
    CHECK(dot.survives == std::vector<char>{0});
    CHECK(length(shrink_supports(stub, square(), 0).forest) == 15000);
}

TEST_CASE("neighbouring walls become one tree by their roots, and are zipped up") {
    SupportForest comb =
        forest_of({{{0, 1000000}, {900000, 1000000}, {0, 1079800}, {900000, 1079800}}, {0, 2}, {{0, 1}, {2, 3}}});
    const CavityBoundary shell = square();
    const double before = length(comb);
    for (int layer = 0; layer < 8; ++layer) {
        comb = shrink_supports(comb, shell, 20000).forest;
        CHECK(component_count(comb) == (layer < 1 ? 2u : 1u));
    }
    // Apart, each would have lost eight steps.
    CHECK(before - length(comb) > 2 * 2 * 8 * 20000);
}

TEST_CASE("walls whose roots are in the same place are zipped up from it") {
    const SupportForest fork =
        forest_of({{{0, 1000000}, {400000, 1005000}, {0, 1000000}, {400000, 995000}}, {0, 2}, {{0, 1}, {2, 3}}});
    const ShrunkSupports zipped = shrink_supports(fork, square(), 20000);
    CHECK(component_count(zipped.forest) == 1);
    CHECK(num_edges(zipped.forest) == 3);
    CHECK(length(zipped.forest) < 0.6 * length(fork));
}

TEST_CASE("two roots of a braced tree in one place become one, and what was there twice is there once") {
    const SupportForest twice = forest_of(
        {{{0, 1000000}, {0, 1000000}, {300000, 1000000}, {900000, 1000000}}, {0, 1}, {{0, 2}, {1, 2}, {2, 3}}});
    const ShrunkSupports once = shrink_supports(twice, square(), 20000, 0, 100000);
    CHECK(component_count(once.forest) == 1);
    CHECK(length(once.forest) == Approx(880000).margin(5));
    CHECK(once.survives == std::vector<char>{1, 1, 1});
    // In two places both stay.
    const SupportForest apart = forest_of(
        {{{0, 1000000}, {0, 1400000}, {300000, 1200000}, {900000, 1200000}}, {0, 1}, {{0, 2}, {1, 2}, {2, 3}}});
    const SupportForest held = shrink_supports(apart, square(), 20000, 0, 100000).forest;
    int roots = 0;
    for (auto [v, end] = vertices(held); v != end; ++v) roots += held[*v].root;
    CHECK(roots == 2);
}

TEST_CASE("a corner is zipped as far when one of its walls has just been cut between two roots") {
    const SupportForest fork =
        forest_of({{{0, 1000000}, {2000000, 1010000}, {900000, 990000}}, {0, 1}, {{0, 1}, {0, 2}}});
    const SupportForest zipped = shrink_supports(fork, square(), 20000).forest;
    CHECK(component_count(zipped) == 2);
    CHECK(length(zipped) < length(fork) - 700000);
}

TEST_CASE("what is left of a zipped corner is zipped on the next layers, while it is narrow") {
    SupportForest fork = forest_of({{{0, 1000000}, {900000, 1040000}, {900000, 960000}}, {0}, {{0, 1}, {0, 2}}});
    const CavityBoundary shell = square();
    for (int layer = 0; layer < 3; ++layer) fork = shrink_supports(fork, shell, 20000).forest;
    // A stem, and of each wall little more than leads aside.
    CHECK(length(fork) < 1000000);
}

TEST_CASE("trees in another cavity stay apart, however near their roots are and wherever they lead") {
    const CavityBoundary rooms =
        prepare_boundary({rectangle(0, 0, 1000000, 2000000), rectangle(1060000, 0, 2080000, 2000000)});
    // Both lead along the partition, almost.
    const SupportForest sides = forest_of(
        {{{1000000, 1000000}, {990000, 1500000}, {1060000, 1000000}, {1070000, 1500000}}, {0, 2}, {{0, 1}, {2, 3}}});
    ShrunkSupports shrunk = shrink_supports(sides, rooms, 20000);
    CHECK(component_count(shrunk.forest) == 2);
    // In one room they go towards each other.
    const CavityBoundary room = prepare_boundary({rectangle(0, 0, 2080000, 2000000)});
    SupportForest floor =
        forest_of({{{1000000, 0}, {990000, 500000}, {1039000, 0}, {1049000, 500000}}, {0, 2}, {{0, 1}, {2, 3}}});
    CHECK(component_count(shrink_supports(floor, room, 20000).forest) == 1);
    // Not when they may be braced.
    CHECK(component_count(shrink_supports(floor, room, 20000, 0, 300000).forest) == 2);
}

TEST_CASE("what a zipped corner leaves of a wall and its stem survive with it, and carry what stood there") {
    SupportForest fork = forest_of({{{0, 1000000}, {25000, 1001000}, {400000, 999000}}, {0}, {{0, 1}, {0, 2}}});
    fork[0].standing = 60, fork[1].standing = fork[2].standing = 4;
    const ShrunkSupports zipped = shrink_supports(fork, square(), 20000);
    CHECK(zipped.survives == std::vector<char>{1, 1});  // the first is all stem now
    fork = forest_of({{{0, 1000000}, {400000, 1002000}, {400000, 998000}}, {0}, {{0, 1}, {0, 2}}});
    fork[0].standing = 60, fork[1].standing = fork[2].standing = 4;
    const SupportForest shrunk = shrink_supports(fork, square(), 20000).forest;
    int joints = 0;
    for (auto [v, end] = vertices(shrunk); v != end; ++v)
        if (shrunk[*v].at.x > 300000) {
            ++joints;
            CHECK(shrunk[*v].standing < 20);
        }
    CHECK(joints > 0);
}

TEST_CASE("a corner into which another wall reaches is not zipped up") {
    const auto fork_and = [](Unit tip) {
        return forest_of({{{0, 1000000}, {400000, 1100000}, {400000, 900000}, {2000000, 1000000}, {tip, 1000000}},
                          {0, 3},
                          {{0, 1}, {0, 2}, {3, 4}}});
    };
    const SupportForest far = shrink_supports(fork_and(300000), square(), 20000).forest,
                        near = shrink_supports(fork_and(20000), square(), 20000).forest;
    CHECK(num_edges(far) == 4);
    CHECK(num_edges(near) == 3);
    CHECK(crossings(near).count == 0);
}

TEST_CASE("the stem of a zipped corner is wide where one of its walls was, and carries what stood on the taller one") {
    for (const std::size_t of : {1u, 2u}) {
        SupportForest fork = forest_of({{{0, 1000000}, {400000, 1100000}, {400000, 900000}}, {0}, {{0, 1}, {0, 2}}});
        fork[0].standing = fork[of].standing = 60, fork[3 - of].standing = 20;
        fork[of].wide = true;
        const SupportForest zipped = shrink_supports(fork, square(), 20000).forest;
        int joints = 0;
        for (auto [v, end] = vertices(zipped); v != end; ++v) {
            if (out_degree(*v, zipped) != 3) continue;
            ++joints;
            CHECK(zipped[*v].wide);
            CHECK(zipped[*v].standing == 60);
        }
        CHECK(joints == 1);
    }
}

TEST_CASE("fans of narrow corners at both ends of their walls keep within the step") {
    Random g(311);
    int zipped = 0;
    for (int k = 0; k < 300; ++k) {
        // A root with several walls, which end in junctions with several more, all of them narrow.
        ForestPlan plan{{{0, 1000000}}, {0}, {}};
        const Unit reach = pick(g, 1, 12) * 30000;
        const auto fan = [&](std::size_t from, Unit length, Unit apart, int count) {
            const Point at = plan.vertices[from];
            for (int j = 0; j < count; ++j) {
                plan.walls.push_back({from, plan.vertices.size()});
                plan.vertices.push_back({at.x + length + pick(g, 0, 2000), at.y + (2 * j - count + 1) * apart / 2});
            }
        };
        const int count = static_cast<int>(pick(g, 2, 4));
        const Unit apart = pick(g, 1, 8) * 10000;
        fan(0, reach, apart, count);
        for (std::size_t v = 1; v <= static_cast<std::size_t>(count); ++v)
            fan(v, reach, apart / static_cast<Unit>(count + 1), static_cast<int>(pick(g, 0, 4)));
        const SupportForest forest = forest_of(plan);
        const Unit step = pick(g, 1, 3) * 10000;
        const ShrunkSupports shrunk = shrink_supports(forest, square(), step);
        const NearestSegment left(centre_lines(shrunk.forest));
        for (const Segment& s : centre_lines(forest)) {
            INFO("fan " << k << ": " << text(s));
            REQUIRE(within(s, left, step));
        }
        REQUIRE(forest_fault(shrunk.forest).empty());
        REQUIRE(crossings(shrunk.forest).count <= crossings(forest).count);
        zipped += num_edges(shrunk.forest) > num_edges(forest);
    }
    CHECK(zipped > 50);
}
