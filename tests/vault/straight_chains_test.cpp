// Vertices that straight walls do not need go, and only those.
#include "ribvault/vault/straight_chains.hpp"

#include <catch2/catch.hpp>

#include "grown_scene.hpp"
#include "ribvault/vault/shrink_supports.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

constexpr Unit step = 20000;

const CavityBoundary room = prepare_boundary({rectangle(0, -2000000, 2000000, 2000000)});

/// A chain of walls from a root at its first point.
SupportForest chain_of(const std::vector<Point>& points) {
    ForestPlan plan{points, {0}, {}};
    for (std::size_t v = 1; v < points.size(); ++v) plan.walls.push_back({v - 1, v});
    return forest_of(plan);
}

std::size_t walls_left(MovingSupports& supports) {
    drop_straight_vertices(supports);
    std::size_t walls = 0, ends = 0;
    for (std::size_t w = 0; w < supports.walls.size(); ++w) walls += supports.walls[w].alive;
    for (const MovingSupports::Node& node : supports.nodes) {
        ends += node.walls.size();
        CHECK((!node.gone || node.walls.empty()));
    }
    CHECK(ends == 2 * walls);
    return walls;
}

}  // namespace

TEST_CASE("a straight chain becomes one wall, and all of its walls survive in it") {
    const ShrunkSupports shrunk =
        shrink_supports(chain_of({{0, 0}, {200000, 1}, {500000, 0}, {700000, -1}, {900000, 0}}), room, step);
    CHECK(num_edges(shrunk.forest) == 1);
    CHECK(length(shrunk.forest) == Approx(880000).margin(5));
    CHECK(shrunk.survives == std::vector<char>{1, 1, 1, 1});
}

TEST_CASE("what is off the way by more than rounding stays, and roots and junctions do") {
    const auto left = [](Unit off, bool root, bool branch) {
        SupportForest forest = chain_of({{0, 0}, {200000, off}, {400000, 0}});
        forest[1].root = root;
        if (branch) add_edge(1, add_vertex(SupportVertex{{200000, 300000}}, forest), forest);
        MovingSupports supports(forest, room, step, 0);
        return walls_left(supports);
    };
    CHECK(left(2, false, false) == 1);
    CHECK(left(3, false, false) == 2);
    CHECK(left(0, true, false) == 2);
    CHECK(left(0, false, true) == 3);
}

TEST_CASE("every point that was on a wall stays within the step of it") {
    const auto left = [](Unit from) {
        MovingSupports supports(chain_of({{0, 0}, {200000, 0}, {400000, 0}}), room, step, 0);
        supports.nodes[1].from = {{200000, from}};
        return walls_left(supports);
    };
    CHECK(left(step) == 1);
    CHECK(left(step + 1) == 2);
    // The second vertex takes the wall a little away from where the first one was.
    MovingSupports supports(chain_of({{0, 0}, {100000, 0}, {200000, 0}, {300000, 3}}), room, step, 0);
    supports.nodes[1].from = {{100000, -step}};
    CHECK(walls_left(supports) == 2);
    // Or the one before it, which comes later.
    MovingSupports turned(forest_of({{{0, 3}, {200000, 0}, {100000, 0}, {300000, 0}}, {0}, {{0, 2}, {2, 1}, {1, 3}}}),
                          room, step, 0);
    turned.nodes[1].from = {{200000, -step}};
    CHECK(walls_left(turned) == 2);
}

TEST_CASE("no wall is laid over another") {
    // A tip between the chain and the way, from below, itself a wall that was two.
    for (const Unit tip : {1, -1}) {
        SupportForest forest = chain_of({{900000, -1000000}, {900000, -900000}, {900000, tip}});
        const std::size_t first = num_vertices(forest);
        for (const Point p : {Point{800000, 0}, Point{900000, 2}, Point{1000000, 0}})
            add_vertex(SupportVertex{.at = p, .root = p.x == 800000}, forest);
        add_edge(first, first + 1, forest), add_edge(first + 1, first + 2, forest);
        MovingSupports supports(forest, room, step, 0);
        CHECK(walls_left(supports) == (tip > 0 ? 3u : 2u));
    }
    // Another tree's wall in the same place.
    SupportForest twice = chain_of({{0, 0}, {200000, 2}, {400000, 0}});
    add_edge(add_vertex(SupportVertex{.at = {0, 0}, .root = true}, twice),
             add_vertex(SupportVertex{{400000, 0}}, twice), twice);
    MovingSupports same(twice, room, step, 0);
    CHECK(walls_left(same) == 3);
    // A branch at its end that runs back along the way.
    SupportForest forest = chain_of({{0, 0}, {200000, 2}, {400000, 0}});
    add_edge(2, add_vertex(SupportVertex{{300000, 0}}, forest), forest);
    MovingSupports supports(forest, room, step, 0);
    CHECK(walls_left(supports) == 3);
}

TEST_CASE("what stands higher than the ends of the wall say stays known") {
    const auto left = [](int standing) {
        SupportForest forest = chain_of({{0, 0}, {200000, 0}, {400000, 0}});
        forest[0].standing = 12, forest[1].standing = standing, forest[2].standing = 8;
        MovingSupports supports(forest, room, step, 0);
        return walls_left(supports);
    };
    CHECK(left(3) == 1);
    CHECK(left(11) == 1);
    CHECK(left(12) == 2);
    // Also once it lies on a wall: 15 may go by itself, and would be 3 too many between the ends.
    SupportForest forest = chain_of({{0, 0}, {100000, 0}, {200000, 0}, {300000, 0}});
    const int standing[] = {4, 15, 25, 36};
    for (std::size_t v = 0; v < 4; ++v) forest[v].standing = standing[v];
    forest[1].standing = 16, forest[2].standing = 26;
    MovingSupports supports(forest, room, step, 0);
    CHECK(walls_left(supports) == 2);
}
