// Copying supports to the layer below: clipped, prolonged, split by inner walls (Figure 11).
#include "ribvault/vault/copy_supports.hpp"

#include <catch2/catch.hpp>

#include "grown_scene.hpp"
#include "within.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

CavityBoundary room(Unit x0, Unit y0, Unit x1, Unit y1) { return prepare_boundary({rectangle(x0, y0, x1, y1)}); }

/// A trunk up from (0, 0) with a branch to the right.
const SupportForest tree =
    forest_of({{{0, 0}, {0, 100000}, {0, 200000}, {50000, 150000}}, {0}, {{0, 1}, {1, 2}, {1, 3}}});

}  // namespace

TEST_CASE("in the same cavity supports stay what they are") {
    const CopiedSupports copy = copy_supports(tree, room(-300000, 0, 300000, 300000), true);
    CHECK(num_edges(copy.forest) == 3);
    CHECK(length(copy.forest) == length(tree));
    CHECK(copy.origin == std::vector<std::int32_t>{0, 1, 2});
    for (auto [v, end] = vertices(copy.forest); v != end; ++v)
        CHECK(copy.forest[*v].root == (copy.forest[*v].at == Point{0, 0}));
}

TEST_CASE("a trunk is clipped where the shell has come in, and rooted there") {
    const CavityBoundary boundary = room(-300000, 40000, 300000, 300000);
    const CopiedSupports copy = copy_supports(tree, boundary, true);
    CHECK(has_wall(copy.forest, {0, 40000}, {0, 100000}));
    CHECK(num_edges(copy.forest) == 3);
    CHECK(forest_fault(copy.forest).empty());
    CHECK(placement_fault(copy.forest, boundary).empty());
    // The shell has come in over the junction: two trees.
    const CopiedSupports apart = copy_supports(tree, room(-300000, 120000, 300000, 300000), true);
    CHECK(num_edges(apart.forest) == 2);
    CHECK(component_count(apart.forest) == 2);
    CHECK(has_wall(apart.forest, {0, 120000}, {0, 200000}));
    CHECK(has_wall(apart.forest, {20000, 120000}, {50000, 150000}));
    CHECK(apart.origin == std::vector<std::int32_t>{1, 2});
}

TEST_CASE("a trunk is prolonged straight on to the shell that went back") {
    const CavityBoundary boundary = room(-300000, -50000, 300000, 300000);
    const CopiedSupports copy = copy_supports(tree, boundary, true);
    CHECK(has_wall(copy.forest, {0, -50000}, {0, 100000}));
    CHECK(num_edges(copy.forest) == 3);
    CHECK(placement_fault(copy.forest, boundary).empty());
    // What is inherited is the wall above, not its prolongation.
    double length_above = 0;
    for (const Segment& s : copy.inherited) length_above += length(s);
    CHECK(length_above == length(tree));
}

TEST_CASE("a trunk that does not point at the shell goes to its nearest point") {
    // Parallel to the shell that went back; straight on is too far.
    const SupportForest along = forest_of({{{0, 10000}, {90000, 10000}}, {0}, {{0, 1}}});
    const CavityBoundary boundary = room(-900000, -20000, 300000, 300000);
    const CopiedSupports copy = copy_supports(along, boundary, true);
    CHECK(has_wall(copy.forest, {0, -20000}, {0, 10000}));
    CHECK(has_wall(copy.forest, {0, 10000}, {90000, 10000}));
    REQUIRE(copy.origin.size() == 2);
    CHECK(std::count(copy.origin.begin(), copy.origin.end(), -1) == 1);
    CHECK(forest_fault(copy.forest).empty());
}

TEST_CASE("a prolonged trunk joins another tree that stands in its way") {
    const SupportForest two =
        forest_of({{{0, 10000}, {90000, 10000}, {-50000, -20000}, {50000, 0}}, {0, 2}, {{0, 1}, {2, 3}}});
    const CavityBoundary boundary = room(-900000, -20000, 300000, 300000);
    const CopiedSupports copy = copy_supports(two, boundary, true);
    CHECK(component_count(copy.forest) == 1);
    CHECK(crossings(copy.forest).count == 0);
    CHECK(forest_fault(copy.forest).empty());
    CHECK(num_edges(copy.forest) == 4);
}

TEST_CASE("a root that its own tree keeps from the shell becomes a tip when the tree has another root") {
    // A hook whose first root hangs above its own wall; the second root stays on the shell at the right.
    const SupportForest hook = forest_of({{{0, 30000}, {0, 90000}, {-80000, 90000}, {-80000, 10000}, {200000, 10000}},
                                          {0, 4},
                                          {{0, 1}, {1, 2}, {2, 3}, {3, 4}}});
    const CavityBoundary boundary = room(-900000, -20000, 200000, 300000);
    const CopiedSupports copy = copy_supports(hook, boundary, true);
    CHECK(num_edges(copy.forest) == 4);
    CHECK(length(copy.forest) == length(hook));
    CHECK(crossings(copy.forest).count == 0);
    CHECK(forest_fault(copy.forest).empty());
}

TEST_CASE("a trunk cut off but for two units still stands on the shell") {
    for (const bool turned : {false, true}) {  // both ends of the edge
        const SupportForest trunk = forest_of(
            {{{0, 0}, {0, 100000}, {0, 200000}},
             {0},
             {turned ? std::pair<std::size_t, std::size_t>{1, 0} : std::pair<std::size_t, std::size_t>{0, 1}, {1, 2}}});
        const CavityBoundary boundary = room(-300000, 99998, 300000, 300000);
        const CopiedSupports copy = copy_supports(trunk, boundary, true);
        CHECK(num_edges(copy.forest) == 1);
        CHECK(forest_fault(copy.forest).empty());
        CHECK(placement_fault(copy.forest, boundary).empty());
    }
}

TEST_CASE("an inner wall cuts a tree in two, each rooted on it") {
    const CavityBoundary walled = prepare_boundary(
        {rectangle(-300000, 0, 300000, 300000), reversed(rectangle(-400000 + 150000, 120000, 200000, 130000))});
    const CopiedSupports copy = copy_supports(tree, walled, true);
    CHECK(forest_fault(copy.forest).empty());
    CHECK(placement_fault(copy.forest, walled).empty());
    CHECK(component_count(copy.forest) == 3);  // below the wall, and trunk and branch above it
    CHECK(has_wall(copy.forest, {0, 130000}, {0, 200000}));
    CHECK(has_wall(copy.forest, {0, 100000}, {0, 120000}));
    CHECK(has_wall(copy.forest, {30000, 130000}, {50000, 150000}));
}

TEST_CASE("a dot in the shell is gone, in the cavity it is prolonged; a tree in the shell is gone") {
    const SupportForest dot = forest_of({{{0, 0}}, {0}, {}});
    CHECK(num_vertices(copy_supports(dot, room(-100000, 0, 100000, 100000), true).forest) == 0);
    CHECK(num_vertices(copy_supports(dot, room(-100000, 500, 100000, 100000), true).forest) == 0);
    const CavityBoundary wider = room(-100000, -5000, 100000, 100000);
    const CopiedSupports prolonged = copy_supports(dot, wider, true);
    CHECK(has_wall(prolonged.forest, {0, -5000}, {0, 0}));
    CHECK(forest_fault(prolonged.forest).empty());
    REQUIRE(prolonged.inherited.size() == 1);
    CHECK(prolonged.inherited[0].a == prolonged.inherited[0].b);
    CHECK(num_vertices(copy_supports(tree, room(500000, 0, 900000, 900000), true).forest) == 0);
}

TEST_CASE("with ρ < r walls that meet the shell are inherited whole") {
    const CopiedSupports copy = copy_supports(tree, room(-300000, 40000, 300000, 300000), false);
    double length_above = 0;
    for (const Segment& s : copy.inherited) length_above += length(s);
    CHECK(length_above == length(tree));
}

TEST_CASE("copies in drifted cavities are rooted forests; no wall above inside the cavity is lost") {
    Random g(81);
    int pieces = 0;
    for (int k = 0; k < 60; ++k) {
        GrownScene scene(g);
        const Cavity below = make_cavity(0, scene.shapes.at(static_cast<int>(pick(g, -3, 3))), scene.settings);
        if (below.region.empty()) continue;
        const CavityBoundary boundary = prepare_boundary(below.region);
        const CopiedSupports copy = copy_supports(scene.forest, boundary, true);
        INFO("scene " << k);
        REQUIRE(forest_fault(copy.forest) == "");
        REQUIRE(placement_fault(copy.forest, boundary) == "");
        REQUIRE(leaving_wall(copy.forest, boundary) == "");
        REQUIRE(copy.origin.size() == num_edges(copy.forest));
        const NearestSegment inherited(copy.inherited), tracks(centre_lines(copy.forest));
        const std::vector<Segment> above = centre_lines(scene.forest);
        for (const std::int32_t o : copy.origin) REQUIRE(o < static_cast<std::int32_t>(num_edges(scene.forest)));
        for (const Segment& s : above)
            for (int q = 0; q <= 20; ++q) {
                const Point p{s.a.x + (s.b.x - s.a.x) * q / 20, s.a.y + (s.b.y - s.a.y) * q / 20};
                if (boundary.location.locate(p) != Side::inside) continue;
                if (compare_distance(p, boundary.edges.segments()[boundary.edges.nearest(p).index],
                                     2 * root_tolerance) <= 0)
                    continue;
                ++pieces;
                REQUIRE(compare_distance(p, inherited.segments()[inherited.nearest(p).index], 2) <= 0);
                REQUIRE(compare_distance(p, tracks.segments()[tracks.nearest(p).index], root_tolerance + 1) <= 0);
            }
    }
    CHECK(pieces > 5000);
}
