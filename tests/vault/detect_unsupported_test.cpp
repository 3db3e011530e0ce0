// Detection is a superset: what is missing from it is held up.
#include "ribvault/vault/detect_unsupported.hpp"

#include <catch2/catch.hpp>

#include "grown_scene.hpp"
#include "within.hpp"

using namespace ribvault;
using namespace ribvault::test;

TEST_CASE("no point of a wall above that neither wall nor shell below holds up is missed") {
    Random g(101);
    int unsupported = 0, held = 0;
    for (int k = 0; k < 60; ++k) {
        GrownScene scene(g);
        if (scene.cavity.region.empty() || num_edges(scene.forest) == 0) continue;
        // Below, some of the walls are gone and the others have moved by up to a bit more than ρ.
        const std::vector<Segment> above = centre_lines(scene.forest);
        SupportForest below;
        for (const Segment& s : above) {
            if (pick(g, 0, 5) == 0) continue;
            const Point by = pick(g, 0, 1) ? Point{0, 0} : Point{pick(g, -16000, 16000), pick(g, -16000, 16000)};
            const auto a = add_vertex(SupportVertex{s.a + by, true}, below),
                       b = add_vertex(SupportVertex{s.b + by, false}, below);
            add_edge(a, b, below);
        }
        const Region region = unsupported_walls(above, below, &scene.cavity.deep, scene.settings);
        const PointLocation found(edges_of(region), 50000);
        const NearestSegment tracks(centre_lines(below));
        const Unit r = 20000, rho = 20000;
        for (int q = 0; q < 1500; ++q) {
            const Segment& s = above[static_cast<std::size_t>(pick(g, 0, static_cast<Unit>(above.size()) - 1))];
            const Point around = near_segment(g, s), point = around + Point{pick(g, -r, r), pick(g, -r, r)};
            if (compare_distance(point, s, r) > 0 || scene.boundary.location.locate(point) != Side::inside) continue;
            const bool by_shell =
                compare_distance(point, scene.boundary.edges.segments()[scene.boundary.edges.nearest(point).index],
                                 rho) <= 0;
            const bool by_wall = compare_distance(point, tracks.segments()[tracks.nearest(point).index], r + rho) <= 0;
            ++(by_shell || by_wall ? held : unsupported);
            INFO("scene " << k << ", point " << text(point));
            if (!by_shell && !by_wall) REQUIRE(found.locate(point) != Side::outside);
        }
    }
    CHECK(unsupported > 200);
    CHECK(held > 2000);
}

TEST_CASE("a wall that has moved by exactly ρ is held up, by a unit more it is detected") {
    const Settings settings;
    const Cavity cavity = make_cavity(0, {rectangle(-1000000, 0, 1000000, 1000000)}, settings);
    const Segment wall{{0, 0}, {0, 500000}}, slanted{{100000, 100000}, {500000, 400000}};  // along 4-3-5
    const auto below = [](const Segment& s, Point by) { return forest_of({{s.a + by, s.b + by}, {0}, {{0, 1}}}); };
    CHECK(unsupported_walls({wall}, below(wall, {20000, 0}), &cavity.deep, settings).empty());
    CHECK(unsupported_walls({wall}, below(wall, {12000, 16000}), &cavity.deep, settings).empty());
    CHECK(unsupported_walls({slanted}, below(slanted, {-12000, 16000}), &cavity.deep, settings).empty());
    CHECK_FALSE(unsupported_walls({wall}, below(wall, {20001, 0}), &cavity.deep, settings).empty());
    CHECK_FALSE(unsupported_walls({slanted}, below(slanted, {-12001, 16000}), &cavity.deep, settings).empty());
    CHECK_FALSE(unsupported_walls({wall}, {}, &cavity.deep, settings).empty());
    // The wall's own stadium, where the shell does not hold it up.
    const double area = signed_area(unsupported_walls({slanted}, {}, &cavity.deep, settings)),
                 true_area = 40000.0 * 500000 + M_PI * 20000 * 20000;
    CHECK(area >= true_area);
    CHECK(area < 1.01 * true_area);
}

TEST_CASE("a dot holds up the stub above it") {
    const Settings settings;
    const Cavity cavity = make_cavity(0, {rectangle(-1000000, 0, 1000000, 1000000)}, settings);
    const SupportForest dot = forest_of({{{0, 0}}, {0}, {}});
    CHECK(unsupported_walls({{{0, 0}, {0, 20000}}}, dot, &cavity.deep, settings).empty());
    CHECK_FALSE(unsupported_walls({{{0, 0}, {0, 20000}}}, {}, &cavity.deep, settings).empty());
    CHECK_FALSE(unsupported_walls({{{0, 0}, {0, 20001}}}, dot, &cavity.deep, settings).empty());
    CHECK(unsupported_walls({}, dot, &cavity.deep, settings).empty());
}
