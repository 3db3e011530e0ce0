// Supports that stand free: one root a tree, in its middle; what erosion leaves; walls or pillars by the track they
// need.
#include "ribvault/vault/free_trees.hpp"

#include <catch2/catch.hpp>

#include "forest_checks.hpp"
#include "random_cavities.hpp"
#include "ribvault/slice/outside.hpp"
#include "ribvault/vault/erode_supports.hpp"
#include "ribvault/vault/growing_supports.hpp"
#include "ribvault/vault/next_layer.hpp"
#include "ribvault/vault/shrink_supports.hpp"
#include "within.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

const Box frame{{-4000000, -4000000}, {4000000, 4000000}};

SupportForest chain(std::vector<Point> points) {
    SupportForest forest;
    std::size_t last = 0;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const std::size_t v = add_vertex(SupportVertex{points[k]}, forest);
        if (k > 0) add_edge(last, v, forest);
        last = v;
    }
    return forest;
}

std::vector<std::size_t> roots(const SupportForest& forest) {
    std::vector<std::size_t> found;
    for (auto [v, end] = vertices(forest); v != end; ++v)
        if (forest[*v].root) found.push_back(*v);
    return found;
}

Cavity beside(int layer, Region slice, const Settings& settings) {
    return make_outside({layer, nullptr, std::move(slice)}, frame, settings);
}

/// The supports of `layer` under a square of `half` units about p, beside a block that reaches to x = 0.
LayerSupports under_a_square(int layer, Point p, Unit half, const Settings& settings) {
    SupportForest none;
    return next_layer(none, beside(layer, {rectangle(-1000000, -1000000, 0, 1000000)}, settings),
                      {rectangle(p.x - half, p.y - half, p.x + half, p.y + half)}, settings);
}

}  // namespace

TEST_CASE("every tree keeps one root: the shell's before a free one, else the vertex in its middle") {
    SupportForest forest = chain({{0, 0}, {100000, 0}, {250000, 0}, {300000, 0}});
    root_trees(forest);
    CHECK(roots(forest) == std::vector<std::size_t>{1});  // the middle is at 150000
    CHECK(forest[1].free);
    root_trees(forest);
    CHECK(roots(forest) == std::vector<std::size_t>{1});
    forest[3].root = true;
    root_trees(forest);
    CHECK(roots(forest) == std::vector<std::size_t>{3});
    CHECK_FALSE(forest[1].free);
    forest[0].root = true;
    root_trees(forest);
    CHECK(roots(forest) == std::vector<std::size_t>{0});
}

TEST_CASE("the root of a free tree moves to the middle of its longest path, trees on the shell stay") {
    SupportForest forest = chain({{0, 0}, {400000, 0}});
    forest[0].root = forest[0].free = true;
    centre_free_trees(forest);
    const std::vector<std::size_t> root = roots(forest);
    REQUIRE(root.size() == 1);
    CHECK(forest[root[0]].at == Point{200000, 0});
    CHECK(forest[root[0]].free);
    CHECK(num_edges(forest) == 2);
    CHECK(length(forest) == 400000);
    centre_free_trees(forest);
    CHECK(num_edges(forest) == 2);
    SupportForest rooted = chain({{0, 0}, {400000, 0}});
    rooted[0].root = true;
    centre_free_trees(rooted);
    CHECK(roots(rooted) == std::vector<std::size_t>{0});
}

TEST_CASE("a tree on the shell stands free where the track down to the bed says so") {
    // A wall of 2 x 25 mm that loses 0.2 mm a layer. On n layers each half counts until its middle is reached: min(n,
    // 187.5) and min(n, 62.5) times 25 mm from the shell, twice the latter from the wall's middle, and 4 mm of pillar a
    // layer.
    SupportForest wall = chain({{0, 0}, {2500000, 0}, {5000000, 0}});
    wall[0].root = true;
    for (const auto& [layers, stands_free] :
         {std::pair{10, false}, {50, false}, {70, false}, {80, true}, {150, true}, {600, true}, {2500, false}}) {
        SupportForest tree = wall;
        free_where_cheaper(tree, layers, 20000, [n = layers](std::size_t) { return 400000.0 * n; });
        INFO(layers << " layers");
        CHECK(tree[1].free == stands_free);
        CHECK(roots(tree).size() == 1);
        CHECK(tree[0].root == !stands_free);
    }
}

TEST_CASE("erosion leaves a pillar's length of a free tree, layer after layer, and of others nothing") {
    SupportForest forest = chain({{-700000, 0}, {0, 0}, {0, 900000}});
    forest[1].root = forest[1].free = true;
    SupportForest rooted = forest;
    rooted[1].free = false;
    for (int layer = 0; layer < 60; ++layer) {
        const double before = length(forest);
        forest = erode_supports(forest, 20000, 400000).forest;
        rooted = erode_supports(rooted, 20000, 400000).forest;
        CHECK(length(forest) <= before);
        CHECK(length(forest) >= 400000);
        CHECK(roots(forest).size() == 1);
    }
    CHECK(length(forest) <= 400000 + 4);
    CHECK(length(rooted) == 0);
}

TEST_CASE("shrinking leaves a free tree that is no longer than a pillar alone, and others their root") {
    const CavityBoundary room = prepare_boundary(beside(5, {}, {}));
    REQUIRE(room.edges.empty());
    SupportForest forest = chain({{-700000, 0}, {0, 0}, {0, 900000}});
    forest[1].root = forest[1].free = true;
    for (int layer = 0; layer < 60; ++layer) {
        const double before = length(forest);
        const ShrunkSupports shrunk = shrink_supports(forest, room, 20000, 400000);
        CHECK(length(shrunk.forest) <= before);
        if (before <= 400000) CHECK(length(shrunk.forest) == before);
        forest = shrunk.forest;
        REQUIRE(roots(forest).size() == 1);
        CHECK(forest[roots(forest)[0]].free);
        CHECK(forest[roots(forest)[0]].at == Point{0, 0});
    }
    CHECK(length(forest) > 360000 - 4);  // two tips may each have taken a step from a little more than a pillar
    CHECK(length(forest) <= 400000);
}

TEST_CASE("a wall to the object where that takes less track down to the bed, a pillar where it takes more") {
    const Settings settings;
    // 4 mm of pillar on each of n layers against the triangle of a wall of length L: L² / 0.4 mm, cut off by the bed.
    struct Case {
        int layer;
        Unit distance;
        bool wall;
    };
    for (const Case& c : {Case{100, 1000000, true}, Case{100, 1350000, false}, Case{10, 400000, true},
                          Case{10, 600000, false}, Case{400, 2400000, true}}) {
        const LayerSupports supports = under_a_square(c.layer, {c.distance, 0}, 10000, settings);
        INFO("layer " << c.layer << ", " << to_mm(c.distance) << " mm");
        CHECK(forest_fault(supports.forest) == "");
        const std::vector<std::size_t> root = roots(supports.forest);
        REQUIRE(root.size() == 1);
        CHECK(supports.forest[root[0]].free == !c.wall);
        CHECK(length(supports.forest) == Approx(c.wall ? static_cast<double>(c.distance) : 400000.0).margin(20000));
        for (auto [v, end] = vertices(supports.forest); v != end; ++v) CHECK(supports.forest[*v].outside);
    }
}

TEST_CASE(
    "free supports go down to the bed as one tree each, no wall farther than the erosion step from the wall above") {
    for (const Unit gap : {0, 20000}) {
        Settings settings;
        settings.support = Support::external;
        settings.support_gap = gap;
        LayerSupports above = under_a_square(80, {2000000, 0}, 200000, settings);
        const std::size_t trees = component_count(above.forest);
        for (int layer = 79; layer >= 0; --layer) {
            const LayerSupports below = next_layer(
                above.forest, beside(layer, {rectangle(-1000000, -1000000, 0, 1000000)}, settings), {}, settings);
            CHECK(forest_fault(below.forest) == "");
            CHECK(component_count(below.forest) == trees);
            CHECK(length(below.forest) <= length(above.forest) + 4);
            CHECK(length(below.forest) >= 0.9 * 400000);  // straightening takes a little
            for (const Segment& s : centre_lines(above.forest))
                CHECK(within(s, NearestSegment(centre_lines(below.forest)), settings.support_radius));
            above = below;
        }
        CHECK(length(above.forest) <= static_cast<double>(trees) * 400000 + 4);
    }
}

TEST_CASE("a free tree that its region cuts to less than half a pillar joins another one or grows arms anew") {
    Settings settings;
    settings.support = Support::external;
    settings.support_gap = 20000;
    Cavity outside = beside(50, {rectangle(-1000000, -1000000, 0, 1000000)}, settings);
    outside.walls = Region{rectangle(50000, -3000000, 3000000, 3000000)};
    SupportForest stub = chain({{60000, 0}, {61000, 0}});
    stub[0].root = stub[0].free = true;

    // Alone: arms along and away from the object, down to the bed as much track as a pillar.
    SupportForest above = stub;
    SupportForest mended = next_layer(above, outside, {}, settings).forest;
    CHECK(forest_fault(mended) == "");
    CHECK(component_count(mended) == 1);
    CHECK(length(mended) > 0.5 * 400000);
    CHECK(length(mended) <= 400000);
    for (const Segment& s : centre_lines(mended))
        for (const Point p : {s.a, s.b}) CHECK(p.x > 50000);

    // 2 mm beside a longer one: a wall leads there.
    above = stub;
    for (const Point p : {Point{60000, 200000}, Point{60000, 900000}})
        add_vertex(SupportVertex{.at = p, .root = p.y == 200000, .free = p.y == 200000}, above);
    add_edge(2, 3, above);
    mended = next_layer(above, outside, {}, settings).forest;
    CHECK(forest_fault(mended) == "");
    CHECK(component_count(mended) == 1);

    // At one and the same place: one of them is enough.
    above = chain({{60000, 0}, {60250, 0}});
    above[0].root = above[0].free = true;
    const auto second = add_vertex(SupportVertex{.at = {60000, 300}, .root = true, .free = true}, above);
    add_edge(second, add_vertex(SupportVertex{.at = {60250, 300}}, above), above);
    mended = next_layer(above, outside, {}, settings).forest;
    CHECK(component_count(mended) == 1);
    CHECK(length(mended) <= 400000);
}

TEST_CASE("what rounding put beside the region grows on its side of the object") {
    Settings settings;
    settings.support = Support::external;
    settings.support_gap = 20000;
    Cavity outside = beside(50, {rectangle(-10000, -3000000, 10000, 3000000)}, settings);
    outside.walls =
        Region{rectangle(50000, -3000000, 3000000, 3000000), rectangle(-3000000, -3000000, -50000, 3000000)};
    CavityBoundary boundary = prepare_boundary(outside);
    boundary.free_trees = true;
    SupportForest forest = chain({{49999, 0}, {50000, 1000}});
    forest[0].root = forest[0].free = true;
    // The nearest wall is behind the object, and no edge between: both ends are beside the region by a unit.
    for (const Point p : {Point{-49999, 0}, Point{-49999, 900000}})
        add_vertex(SupportVertex{.at = p, .root = p.y == 0, .free = p.y == 0}, forest);
    add_edge(2, 3, forest);
    GrowingSupports supports(forest, boundary.location.box(), boundary, settings);
    supports.mend_free_tree(0);
    forest = supports.take();
    CHECK(forest_fault(forest) == "");
    CHECK(component_count(forest) == 2);
    CHECK(length(forest) > 900000 + 200000);
    for (const Segment& s : centre_lines(forest)) CHECK((s.a.x > 0) == (s.b.x > 0));
}

TEST_CASE("at the tip of a spike without a lattice point inside a pillar stands a little farther in") {
    Settings settings;
    settings.support = Support::external;
    Cavity outside = beside(50, {}, settings);
    outside.walls = Region{{{0, 0}, {100000, 1000}, {100000, 4000}}};
    CavityBoundary boundary = prepare_boundary(outside);
    boundary.free_trees = true;
    GrowingSupports supports({}, boundary.location.box(), boundary, settings);
    const Point at{-39500, -800};
    supports.add_wall(at, 0);
    CHECK(supports.covers(at, settings.reach_of_support() - settings.slack));
    const SupportForest forest = supports.take();
    REQUIRE(num_vertices(forest) > 0);
    for (auto [v, end] = vertices(forest); v != end; ++v)
        CHECK(boundary.location.locate(forest[*v].at) == Side::inside);
}

TEST_CASE("a root that the object leaves behind without another in reach stands free") {
    Settings settings;
    settings.support = Support::external;
    SupportForest above = under_a_square(50, {300000, 0}, 10000, settings).forest;
    REQUIRE(roots(above).size() == 1);
    REQUIRE_FALSE(above[roots(above)[0]].free);
    const SupportForest in_the_air = next_layer(above, beside(49, {}, settings), {}, settings).forest;
    REQUIRE(roots(in_the_air).size() == 1);
    CHECK(in_the_air[roots(in_the_air)[0]].free);
}

TEST_CASE("a wide wall that comes out of a cavity has one line outside") {
    Settings settings;
    settings.support = Support::both;
    settings.wall_lines = 2;
    SupportForest above;
    const auto root = add_vertex({.at = {100000, 0}, .root = true, .wide = true}, above),
               tip = add_vertex({.at = {900000, 0}, .wide = true}, above);
    add_edge(root, tip, above);
    const SupportForest below = next_layer(above, beside(49, {}, settings), {}, settings).forest;
    REQUIRE(num_edges(below) > 0);
    for (auto [v, end] = vertices(below); v != end; ++v) CHECK((below[*v].outside && !below[*v].wide));
}
