// Planes exactly through vertices, edges and faces: the slice is the limit of the slices just below, no plane is moved.
#include <catch2/catch.hpp>

#include "exact_areas.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

// Layers of 0.25 mm: the planes z_i = 0.125 + 0.25 i are binary numbers, so vertices can lie on them.
const Settings quarters = layers_of("0.25");
double plane(int i) { return 0.125 + 0.25 * i; }

}  // namespace

TEST_CASE("a plane through the middle vertices of an octahedron") {
    const Mesh mesh = weld(octahedron({0, 0, plane(20)}, 4));
    const Slicer slicer(mesh, Placement{}, quarters);
    CHECK(slice_area(slicer, 20) == 32);
    CHECK(slice_area(slicer, 19) == 2 * squared(4 - Rational(1, 4)));
    CHECK(slice_area(slicer, 21) == 2 * squared(4 - Rational(1, 4)));
    CHECK(slicer.slice(20).exact->polygons.front().outer_boundary().size() == 4);
}

TEST_CASE("a plane through a tip gives nothing") {
    const Mesh mesh = weld(octahedron({0, 0, plane(20)}, 4));  // tips on planes 4 and 36
    const Slicer slicer(mesh, Placement{}, quarters);
    CHECK(slicer.slice(4).exact->polygons.empty());
    CHECK(slicer.slice(4).rounded.empty());
    CHECK(slice_area(slicer, 5) == Rational(1, 8));
    CHECK(slice_area(slicer, 35) == Rational(1, 8));
    if (slicer.layer_count() > 36) CHECK(slicer.slice(36).exact->polygons.empty());
}

TEST_CASE("a plane through a ridge or a keel gives nothing") {
    // A prism with its lowest edge on plane 4, and one with its highest edge there.
    for (const double up : {1.0, -1.0}) {
        const double z = plane(4), side = z + up;
        const std::vector<Corner> front{{0, 0, z}, {-2, 0, side}, {2, 0, side}},
            back{{0, 5, z}, {-2, 5, side}, {2, 5, side}};
        const Mesh mesh = weld(convex({front,
                                       back,
                                       {front[0], front[1], back[1], back[0]},
                                       {front[0], front[2], back[2], back[0]},
                                       {front[1], front[2], back[2], back[1]}}));
        const Slicer slicer(mesh, Placement{}, quarters);
        if (slicer.layer_count() > 4) CHECK(slicer.slice(4).exact->polygons.empty());
        CHECK(slice_area(slicer, up > 0 ? 5 : 3) == 5);  // 0.25 from the edge, width 1
    }
}

TEST_CASE("a plane in a bottom face gives nothing, in a top face all of it") {
    const Mesh mesh = weld(box({0, 0, plane(2)}, {3, 3, plane(9)}));
    const Slicer slicer(mesh, Placement{}, quarters);
    CHECK(slicer.slice(0).exact->polygons.empty());
    CHECK(slicer.slice(2).exact->polygons.empty());
    CHECK(slice_area(slicer, 3) == 9);
    CHECK(slice_area(slicer, 8) == 9);
    if (slicer.layer_count() > 9) CHECK(slice_area(slicer, 9) == 9);
    CHECK(slicer.layer_count() <= 10);
}

TEST_CASE("a plane in the step between a wide and a narrow box gives the one below") {
    const Mesh wide_below = weld(box({0, 0, 0}, {6, 6, plane(5)}) + box({1, 1, plane(5)}, {3, 3, 4}));
    const Slicer below(wide_below, Placement{}, quarters);
    CHECK(slice_area(below, 5) == 36);
    CHECK(slice_area(below, 6) == 4);
    const Mesh wide_above = weld(box({1, 1, 0}, {3, 3, plane(5)}) + box({0, 0, plane(5)}, {6, 6, 4}));
    const Slicer above(wide_above, Placement{}, quarters);
    CHECK(slice_area(above, 5) == 4);
    CHECK(slice_area(above, 6) == 36);
}

TEST_CASE("two tetrahedra that stand on one vertex in the plane") {
    const Corner tip{0, 0, plane(4)};
    std::vector<Triangle> both;
    for (const double z : {plane(8), plane(0)}) {
        const std::vector<Corner> base{{2, 0, z}, {-2, 2, z}, {-2, -2, z}};
        both = both + convex({base, {base[0], base[1], tip}, {base[1], base[2], tip}, {base[2], base[0], tip}});
    }
    const Mesh mesh = weld(both);
    const Slicer slicer(mesh, Placement{}, quarters);
    CHECK(slicer.slice(4).exact->polygons.empty());
    CHECK(slice_area(slicer, 3) == Rational(1, 2));
    CHECK(slice_area(slicer, 5) == Rational(1, 2));
}

TEST_CASE("rings of vertices on the planes: every slice is the limit from below") {
    std::mt19937_64 random(9);
    int on_plane = 0;
    for (int k = 0; k < 30; ++k) {
        std::vector<double> heights{plane(0)};
        while (heights.size() < 7)
            heights.push_back(heights.back() + 0.125 * std::uniform_int_distribution<int>(1, 4)(random));
        const Mesh ball = weld(bumpy_ball(random, heights, 7, 0.25));
        const Slicer slicer(ball, Placement{}, quarters);
        for (int i = 0; i < slicer.layer_count(); ++i) {
            const Rational z = slicer.plane_height(i);
            for (const double h : heights) on_plane += Rational(h) == z;
            const Rational tiny(1, mpz_class(1) << 80);
            // Sections of these balls grow by less than 2^20 mm² per mm between two heights.
            const Rational off = slice_area(slicer, i) - area_by_triangles(ball, Placement{}, z - tiny);
            INFO("ball " << k << ", layer " << i << ": " << off.get_d());
            REQUIRE(abs(off) <= tiny * (1 << 20));
        }
    }
    CHECK(on_plane > 50);
}

TEST_CASE("a vertex one binary place below a plane or above it is told from one on it") {
    // The narrow upper box begins at the plane, just below or just above it.
    for (const int place : {-1, 0, 1}) {
        double z = plane(5);
        if (place != 0) z = std::nextafter(z, place * 10.0);
        const Mesh mesh = weld(box({0, 0, 0}, {6, 6, z}) + box({1, 1, z}, {3, 3, 4}));
        CHECK(slice_area(Slicer(mesh, Placement{}, quarters), 5) == (place < 0 ? 4 : 36));
    }
    // 0.3 is no binary number: the double next to it lies below the plane z_1 = 3/10 of layers of 0.2 mm.
    const Mesh mesh = weld(box({0, 0, 0}, {6, 6, 0.3}) + box({1, 1, 0.3}, {3, 3, 4}));
    REQUIRE(Rational(0.3) < Rational(3, 10));
    CHECK(slice_area(Slicer(mesh, Placement{}, layers_of("0.2")), 1) == 4);
}

TEST_CASE("a step moved exactly onto a plane, and by 2^-100 mm off it, for any layer height and scale") {
    std::mt19937_64 random(10);
    const auto pick = [&](int lo, int hi) { return std::uniform_int_distribution<int>(lo, hi)(random); };
    const Rational tiny(1, mpz_class(1) << 100);
    for (int k = 0; k < 300; ++k) {
        Settings settings;
        settings.layer_height = pick(1000, 40000);
        settings.first_layer_height = pick(1000, 40000);
        const double z = std::uniform_real_distribution<double>(0.5, 30)(random);
        const Mesh mesh = weld(box({0, 0, 0}, {6, 6, z}) + box({1, 1, z}, {3, 3, 40}));
        Placement placement;
        placement.scale = Rational(pick(1, 50), 7 * pick(1, 3));
        placement.scale.canonicalize();
        const int layer = pick(0, 200);
        const Rational at = Slicer(mesh, placement, settings).plane_height(layer) - placement.scale * Rational(z);
        for (const int side : {-1, 0, 1}) {
            placement.offset[2] = at + side * tiny;
            const Rational area = slice_area(Slicer(mesh, placement, settings), layer);
            INFO("box " << k << ", side " << side);
            REQUIRE(area == squared(placement.scale) * (side < 0 ? 4 : 36));
        }
    }
}
