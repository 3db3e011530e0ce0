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
