// Straightening moves no point farther than its step and keeps the supports planar.
#include "ribvault/vault/straighten_supports.hpp"

#include <catch2/catch.hpp>

#include "grown_scene.hpp"
#include "ribvault/vault/erode_supports.hpp"
#include "within.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

const CavityBoundary wide = prepare_boundary({rectangle(-9000000, 0, 9000000, 9000000)});

/// Vertices that may not move: junctions, tips, roots, pinned ones.
bool fixed(const SupportForest& forest, std::size_t v, const std::vector<char>& pinned) {
    return out_degree(v, forest) != 2 || forest[v].root || pinned[v];
}

void check_step(const SupportForest& forest, const std::vector<char>& pinned, const StraightenedSupports& after,
                Unit step) {
    const NearestSegment tracks(centre_lines(after.forest));
    for (const Segment& s : centre_lines(forest)) {
        INFO(text(s));
        REQUIRE(within(s, tracks, step));
    }
    for (std::size_t v = 0; v < num_vertices(forest); ++v)
        if (fixed(forest, v, pinned)) REQUIRE(tracks.nearest(forest[v].at).distance.numerator == 0);
    for (auto [w, end] = vertices(after.forest); w != end; ++w) {
        bool near = false;
        for (auto [v, last] = vertices(forest); v != last; ++v)
            near = near || squared_length(after.forest[*w].at - forest[*v].at) <= step * step;
        REQUIRE(near);
    }
    REQUIRE(length(after.forest) <= length(forest) + 2.0 * static_cast<double>(num_edges(forest)));
    REQUIRE(forest_fault(after.forest).empty());
}

}  // namespace

TEST_CASE("every point of grown supports lies within the step of the straightened ones, which cross nowhere") {
    Random g(71);
    int moved = 0, blocked = 0;
    for (int k = 0; k < 25; ++k) {
        GrownScene scene(g);
        SupportForest forest = scene.forest;
        for (int layer = 0; layer < 10 && num_vertices(forest) > 0; ++layer) {
            const Unit step = pick(g, 1, 3) * 10000 + pick(g, -1, 1);
            ErodedSupports eroded = erode_supports(forest, 20000);
            REQUIRE(crossings(eroded.forest).count == 0);
            const StraightenedSupports after = straighten_supports(eroded.forest, eroded.pinned, scene.boundary, step);
            INFO("scene " << k << ", layer " << layer);
            check_step(eroded.forest, eroded.pinned, after, step);
            const Crossings crossed = crossings(after.forest);
            INFO(crossed.first);
            REQUIRE(crossed.count == 0);
            REQUIRE(component_count(after.forest) == component_count(eroded.forest));
            if (!after.left_cavity) REQUIRE(leaving_wall(after.forest, scene.boundary).empty());
            moved += length(after.forest) < length(eroded.forest);
            blocked += after.blocked;
            if (after.left_cavity) break;  // such supports are clipped again before they go on
            forest = after.forest;
        }
    }
    CHECK(moved > 50);
    CHECK(blocked > 10);
}

TEST_CASE("a zigzag becomes its chord, step by step as in Figure 13, its ends fixed") {
    SupportForest chain = forest_of({{{0, 0}, {60000, 50000}, {-60000, 100000}, {60000, 150000}, {0, 200000}},
                                     {0},
                                     {{0, 1}, {1, 2}, {2, 3}, {3, 4}}});
    int layers = 0;
    for (; num_edges(chain) > 1 && layers < 20; ++layers) {
        const std::vector<char> pinned(num_vertices(chain), 0);
        const StraightenedSupports after = straighten_supports(chain, pinned, wide, 20000);
        check_step(chain, pinned, after, 20000);
        CHECK_FALSE(after.left_cavity);
        CHECK(length(after.forest) < length(chain));
        chain = after.forest;
    }
    CHECK(layers >= 3);
    CHECK(layers <= 5);
    CHECK(has_wall(chain, {0, 0}, {0, 200000}));
}

TEST_CASE("a vertex exactly the step from its place arrives, one a unit farther does not") {
    for (const Unit more : {0, 1}) {
        const SupportForest bend = forest_of({{{0, 0}, {20000 + more, 50000}, {0, 100000}}, {0}, {{0, 1}, {1, 2}}});
        const StraightenedSupports after = straighten_supports(bend, {0, 0, 0}, wide, 20000);
        CHECK(num_edges(after.forest) == (more == 0 ? 1u : 2u));
        if (more) CHECK(has_vertex(after.forest, {1, 50000}));
    }
}

TEST_CASE("junctions, roots and pinned vertices stay where they are") {
    const SupportForest bend = forest_of({{{0, 0}, {30000, 50000}, {0, 100000}}, {0}, {{0, 1}, {1, 2}}});
    CHECK(has_vertex(straighten_supports(bend, {0, 1, 0}, wide, 20000).forest, {30000, 50000}));
    const SupportForest root = forest_of({{{0, 0}, {30000, 50000}, {0, 100000}}, {0, 1}, {{0, 1}, {1, 2}}});
    CHECK(has_vertex(straighten_supports(root, {0, 0, 0}, wide, 20000).forest, {30000, 50000}));
    const SupportForest fork =
        forest_of({{{0, 0}, {30000, 50000}, {0, 100000}, {90000, 60000}}, {0}, {{0, 1}, {1, 2}, {1, 3}}});
    CHECK(has_vertex(straighten_supports(fork, {0, 0, 0, 0}, wide, 20000).forest, {30000, 50000}));
}

TEST_CASE("a chain does not move across a wall in its way") {
    // The tip of another tree stands between the bend and the chord.
    const SupportForest forest = forest_of(
        {{{0, 0}, {40000, 50000}, {0, 100000}, {-90000, 0}, {30000, 50000}}, {0, 3}, {{0, 1}, {1, 2}, {3, 4}}});
    const StraightenedSupports after = straighten_supports(forest, {0, 0, 0, 0, 0}, wide, 20000);
    CHECK(after.blocked == 1);
    CHECK(crossings(after.forest).count == 0);
    CHECK(component_count(after.forest) == 2);
}

TEST_CASE("a chord over the boundary of the cavity is reported") {
    // The shell comes in between the bend and the chord.
    const CavityBoundary notch = prepare_boundary({{{-500000, 0},
                                                    {500000, 0},
                                                    {500000, 300000},
                                                    {-500000, 300000},
                                                    {-500000, 60000},
                                                    {10000, 60000},
                                                    {10000, 40000},
                                                    {-500000, 40000}}});
    const SupportForest bend = forest_of({{{0, 0}, {20000, 50000}, {0, 100000}}, {0}, {{0, 1}, {1, 2}}});
    CHECK(straighten_supports(bend, {0, 0, 0}, notch, 20000).left_cavity);
    CHECK_FALSE(straighten_supports(bend, {0, 0, 0}, notch, 2000).left_cavity);
}
