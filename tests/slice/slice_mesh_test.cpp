// Slices of solids whose cross-sections are known in closed form.
#include <catch2/catch.hpp>

#include "exact_areas.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

/// Section of the parallelepiped spanned by u, v, w (z-components > 0) at height z above its corner:
/// |det| / (2 a b c) times the alternating sum of max(0, z - s)^2 over the sums s of subsets of the heights a, b, c.
Rational parallelepiped_section(const Corner& u, const Corner& v, const Corner& w, const Rational& z) {
    const Rational a(u[2]), b(v[2]), c(w[2]);
    const auto q = [](double d) { return Rational(d); };
    const Rational det = q(u[0]) * (q(v[1]) * c - b * q(w[1])) - q(u[1]) * (q(v[0]) * c - b * q(w[0])) +
                         a * (q(v[0]) * q(w[1]) - q(v[1]) * q(w[0]));
    Rational sum = 0;
    for (int set = 0; set < 8; ++set) {
        Rational s = 0;
        if (set & 1) s += a;
        if (set & 2) s += b;
        if (set & 4) s += c;
        const Rational over = z - s;
        if (over > 0)
            sum += ((set & 1) + (set >> 1 & 1) + (set >> 2)) % 2 ? Rational(-over * over) : Rational(over * over);
    }
    return abs(det) * sum / (2 * a * b * c);
}

std::vector<Triangle> parallelepiped(const Corner& u, const Corner& v, const Corner& w) {
    const auto corner = [&](int x, int y, int z) {
        Corner c;
        for (std::size_t i = 0; i < 3; ++i) c[i] = x * u[i] + y * v[i] + z * w[i];
        return c;
    };
    std::vector<std::vector<Corner>> faces;
    for (int side = 0; side < 2; ++side) {
        faces.push_back({corner(0, 0, side), corner(1, 0, side), corner(1, 1, side), corner(0, 1, side)});
        faces.push_back({corner(0, side, 0), corner(1, side, 0), corner(1, side, 1), corner(0, side, 1)});
        faces.push_back({corner(side, 0, 0), corner(side, 1, 0), corner(side, 1, 1), corner(side, 0, 1)});
    }
    return convex(faces);
}

}  // namespace

TEST_CASE("planes lie in the middle of their layers, exactly as written") {
    Settings settings = layers_of("0.2");
    settings.first_layer_height = parse_length("0.3", "");
    const Mesh cube = weld(box({0, 0, 0}, {20, 20, 20}));
    const Slicer slicer(cube, Placement{}, settings);
    CHECK(slicer.plane_height(0) == Rational(3, 20));
    CHECK(slicer.plane_height(1) == Rational(2, 5));
    CHECK(slicer.plane_height(7) == Rational(3, 10) + Rational(13, 10));
    // z_i = 0.3 + 0.2 (i - 1/2) < 20 for i <= 98; z_99 = 20 lies in the top face, and what is just below counts.
    CHECK(slicer.layer_count() == 100);
    CHECK(signed_area(slicer.slice(99).rounded) == signed_area(slicer.slice(98).rounded));
    CHECK(Slicer(cube, Placement{}, layers_of("0.2")).layer_count() == 100);
}

TEST_CASE("every slice of a cube is the square") {
    const Mesh cube = weld(box({0, 0, 0}, {20, 20, 20}));
    const Slicer slicer(cube, Placement{}, layers_of("0.2"));
    for (int i = 0; i < slicer.layer_count(); ++i) {
        const Slice slice = slicer.slice(i);
        REQUIRE(slice.layer == i);
        REQUIRE(slice.exact->polygons.size() == 1);
        REQUIRE(area_of(*slice.exact) == 400);
        REQUIRE(signed_area(slice.rounded) == Approx(400e10));
    }
}

TEST_CASE("placement is exact: scaled by 1/2.4, moved by a third") {
    const Mesh cube = weld(box({0, 0, 0}, {20, 20, 20}));
    Placement placement;
    placement.scale = parse_rational("1/2.4", "");
    placement.offset = {Rational(1, 3), Rational(-2, 7), Rational(0)};
    const Slicer slicer(cube, placement, layers_of("0.2"));
    CHECK(slicer.layer_count() == 42);  // 8.333 mm; z_41 = 8.3
    for (const int i : {0, 17, 41}) {
        const Slice slice = slicer.slice(i);
        CHECK(area_of(*slice.exact) == squared(Rational(25, 3)));
        const auto& corner = *slice.exact->polygons.front().outer_boundary().left_vertex();
        CHECK(rational(corner.x()) == Rational(1, 3));
        CHECK(rational(corner.y()) == Rational(-2, 7));
        const Box box = bounding_box(slice.rounded);
        CHECK(box.lo == Point{33333, -28571});
        CHECK(box.hi == Point{866667, 804762});
    }
}

TEST_CASE("slices of tilted cubes and boxes are the exact polygons of three to six corners") {
    // Edge vectors of cubes turned by Pythagorean angles, times a whole number; and a box that is no cube.
    const std::vector<std::array<Corner, 3>> solids = {{{{36, 15, 52}, {-25, 60, 0.5}, {-48, -20, 39}}},
                                                       {{{12, 4, 3}, {-3, 12, 4}, {-4, -3, 12}}},
                                                       {{{7, 4, 4}, {-4, 8, 1}, {-4, -1, 8}}}};
    for (const auto& [u, v, w] : solids) {
        const Mesh mesh = weld(parallelepiped(u, v, w));
        const Slicer slicer(mesh, Placement{}, layers_of("0.3"));
        const Rational top(u[2] + v[2] + w[2]);
        CHECK(slicer.plane_height(slicer.layer_count() - 1) < top);
        CHECK(slicer.plane_height(slicer.layer_count()) >= top);
        for (int i = 0; i < slicer.layer_count(); ++i)
            REQUIRE(slice_area(slicer, i) == parallelepiped_section(u, v, w, slicer.plane_height(i)));
    }
}

TEST_CASE("slices of tetrahedra shrink with the square of the height") {
    const Rational full(7 * 11, 2), height = 9;
    const std::vector<std::vector<Corner>> upright = {{{0, 0, 0}, {7, 0, 0}, {0, 11, 0}},
                                                      {{0, 0, 0}, {7, 0, 0}, {2, -3, 9}},
                                                      {{7, 0, 0}, {0, 11, 0}, {2, -3, 9}},
                                                      {{0, 0, 0}, {0, 11, 0}, {2, -3, 9}}};
    const Mesh mesh = weld(convex(upright));
    const Slicer slicer(mesh, Placement{}, layers_of("0.2"));
    Placement upside_down;
    upside_down.sign = {1, 1, -1};
    upside_down.offset[2] = 9;
    const Slicer inverted(mesh, upside_down, layers_of("0.2"));
    REQUIRE(slicer.layer_count() == 45);
    REQUIRE(inverted.layer_count() == 45);
    for (int i = 0; i < 45; ++i) {
        const Rational z = slicer.plane_height(i);
        REQUIRE(slice_area(slicer, i) == full * squared(1 - z / height));
        REQUIRE(slice_area(inverted, i) == full * squared(z / height));
    }
}

TEST_CASE("slices of an octahedron and of bumpy balls have the area that their triangles give") {
    const Mesh octa = weld(octahedron({10, 10, 8}, 8));
    const Slicer slicer(octa, Placement{}, layers_of("0.2"));
    REQUIRE(slicer.layer_count() == 80);
    for (int i = 0; i < 80; ++i)
        REQUIRE(slice_area(slicer, i) == 2 * squared(8 - abs(Rational(slicer.plane_height(i) - 8))));

    std::mt19937_64 random(5);
    for (int k = 0; k < 12; ++k) {
        std::vector<double> heights{0.03};
        while (heights.size() < 8)
            heights.push_back(heights.back() + std::uniform_real_distribution<double>(0.1, 1)(random));
        const Mesh ball = weld(bumpy_ball(random, heights, 11, 0.07));
        const Slicer balls(ball, Placement{}, layers_of("0.1"));
        REQUIRE(balls.layer_count() > 10);
        for (int i = 0; i < balls.layer_count(); ++i)
            REQUIRE(slice_area(balls, i) == area_by_triangles(ball, Placement{}, balls.plane_height(i)));
    }
}

TEST_CASE("all 48 ways to turn and mirror a mesh give its sections") {
    std::mt19937_64 random(6);
    const Mesh ball = weld(bumpy_ball(random, {-4, -3.1, -1.7, 0.2, 2.9, 4.1}, 9, 0.11));
    std::array<int, 3> axis{0, 1, 2};
    do {
        for (int signs = 0; signs < 8; ++signs) {
            Placement placement;
            placement.axis = axis;
            placement.sign = {signs & 1 ? -1 : 1, signs & 2 ? -1 : 1, signs & 4 ? -1 : 1};
            placement.offset = {Rational(5), Rational(5), Rational(8)};
            placement.scale = Rational(9, 7);
            const Slicer slicer(ball, placement, layers_of("0.9"));
            for (int i = 0; i < slicer.layer_count(); ++i)
                REQUIRE(slice_area(slicer, i) == area_by_triangles(ball, placement, slicer.plane_height(i)));
        }
    } while (std::next_permutation(axis.begin(), axis.end()));
}

TEST_CASE("vertices of slices are rounded to their nearest lattice point") {
    std::mt19937_64 random(7);
    const Mesh ball = weld(bumpy_ball(random, {0, 1.3, 2.7, 4}, 17, 0.09));
    const Slicer slicer(ball, Placement{}, layers_of("0.2"));
    for (int i = 0; i < slicer.layer_count(); ++i) {
        const Slice slice = slicer.slice(i);
        REQUIRE(slice.exact->polygons.size() == 1);
        const ExactPolygon& exact = slice.exact->polygons.front().outer_boundary();
        REQUIRE(slice.rounded.size() == 1);
        for (auto v = exact.vertices_begin(); v != exact.vertices_end(); ++v) {
            const auto near = [&](Unit u, const ExactKernel::FT& mm) {
                return abs(Rational(rational(mm) * units_per_mm - static_cast<long>(u))) <= Rational(50001, 100000);
            };
            REQUIRE(std::any_of(slice.rounded.front().begin(), slice.rounded.front().end(),
                                [&](Point p) { return near(p.x, v->x()) && near(p.y, v->y()); }));
        }
    }
}

TEST_CASE("enclosures of a slice's vertices do not change when somebody asks for the exact value") {
    std::mt19937_64 random(7);
    const Mesh ball = weld(bumpy_ball(random, {0, 1.3, 2.7, 4}, 17, 0.09));
    const Slicer slicer(ball, Placement{}, layers_of("0.2"));
    for (int i = 0; i < slicer.layer_count(); ++i) {
        const Slice slice = slicer.slice(i);
        const ExactPolygon& exact = slice.exact->polygons.front().outer_boundary();
        for (auto v = exact.vertices_begin(); v != exact.vertices_end(); ++v) {
            const auto x = tight_enclosure(v->x()), y = tight_enclosure(v->y());
            CGAL::exact(*v);
            REQUIRE((tight_enclosure(v->x()) == x && tight_enclosure(v->y()) == y));
        }
    }
}
