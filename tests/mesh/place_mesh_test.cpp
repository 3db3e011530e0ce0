#include "mesh/solids.hpp"
#include "ribvault/error.hpp"
#include "ribvault/mesh/examine_mesh.hpp"
#include "ribvault/mesh/place_mesh.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

using Exact = std::array<Rational, 3>;

Exact on_bed(const Mesh& mesh, const Placement& p, int vertex) {
    Exact point;
    for (std::size_t k = 0; k < 3; ++k)
        point[k] = p.scale * p.sign[k] * Rational(mesh.vertices(p.axis[k], vertex)) + p.offset[k];
    return point;
}

struct Bounds {
    Exact lo, hi;
};

Bounds exact_bounds(const Mesh& mesh, const Placement& p) {
    Bounds b{on_bed(mesh, p, 0), on_bed(mesh, p, 0)};
    for (int v = 1; v < mesh.vertices.cols(); ++v) {
        const Exact point = on_bed(mesh, p, v);
        for (std::size_t k = 0; k < 3; ++k) {
            if (point[k] < b.lo[k]) b.lo[k] = point[k];
            if (point[k] > b.hi[k]) b.hi[k] = point[k];
        }
    }
    return b;
}

/// Coordinates that are no short decimals and far from round numbers.
Mesh awkward() { return weld(box({-1.0 / 3, 0.1, 7.7}, {22.0 / 7, 3.3, 9.1})); }

void check_refused(Mesh mesh, const PlacementOptions& options, ErrorKind kind, const std::string& what) {
    try {
        place(mesh, options);
        FAIL("was placed, not refused with: " + what);
    } catch (const Error& error) {
        CHECK(error.kind() == kind);
        CHECK_THAT(error.what(), Catch::Contains(what));
    }
}

}  // namespace

TEST_CASE("placed meshes stand on the bed exactly, in its middle, whatever the turn") {
    for (const char up : {'x', 'y', 'z'})
        for (const int degrees : {0, 90, -90, 180, 270, 450, 30, -3600030}) {
            INFO("up " << up << ", " << degrees << " degrees");
            Mesh mesh = awkward();
            PlacementOptions options;
            options.up = up;
            options.scale = Rational(5, 3);
            options.rotate_degrees = {Rational(degrees), Rational(90), Rational(-degrees)};
            options.bed_x = 210.1;
            options.bed_corner = {3.3, -125};
            const Placement placement = place(mesh, options);
            CHECK(placement.scale == Rational(5, 3));
            const Bounds b = exact_bounds(mesh, placement);
            CHECK(b.lo[2] == 0);
            CHECK(b.lo[0] + b.hi[0] == Rational(2167, 10));
            CHECK(b.lo[1] + b.hi[1] == 0);
        }
}

TEST_CASE("a model as high, wide and deep as the bed fits, whatever double its decimals are") {
    for (const double side : {20.09, 20.1, 33.33333, 149.99999}) {
        PlacementOptions options;
        options.bed_x = options.bed_y = options.bed_z = side;
        options.height_mm = Rational(round_to_lattice(side * units_per_mm), units_per_mm);
        options.height_mm->canonicalize();
        Mesh cube = weld(box({0, 0, 0}, {1, 1, 1}));
        CHECK_NOTHROW(place(cube, options));
        *options.height_mm += Rational(1, units_per_mm);
        check_refused(cube, options, ErrorKind::does_not_fit, "the bed");
    }
}

TEST_CASE("the option --height is met exactly") {
    for (const char up : {'x', 'y', 'z'})
        for (const int degrees : {0, 90, 45}) {
            Mesh mesh = awkward();
            PlacementOptions options;
            options.up = up;
            options.rotate_degrees[1] = degrees;
            options.height_mm = Rational(499, 10);
            const Bounds b = exact_bounds(mesh, place(mesh, options));
            CHECK(b.lo[2] == 0);
            CHECK(b.hi[2] == Rational(499, 10));
        }
}

TEST_CASE("quarter turns and --up exchange axes and leave the mesh alone") {
    const auto placed = [](char up, std::array<int, 3> degrees) {
        Mesh mesh = awkward();
        PlacementOptions options;
        options.up = up;
        for (std::size_t k = 0; k < 3; ++k) options.rotate_degrees[k] = degrees[k];
        const Placement placement = place(mesh, options);
        CHECK(mesh.vertices == awkward().vertices);
        return placement;
    };
    const auto check = [&](char up, std::array<int, 3> degrees, std::array<int, 3> axis, std::array<int, 3> sign) {
        const Placement p = placed(up, degrees);
        CHECK(p.axis == axis);
        CHECK(p.sign == sign);
    };
    check('z', {0, 0, 0}, {0, 1, 2}, {1, 1, 1});
    check('y', {0, 0, 0}, {2, 0, 1}, {1, 1, 1});
    check('x', {0, 0, 0}, {1, 2, 0}, {1, 1, 1});
    check('z', {90, 0, 0}, {0, 2, 1}, {1, -1, 1});
    check('z', {0, 90, 0}, {2, 1, 0}, {1, 1, -1});
    check('z', {0, 0, 90}, {1, 0, 2}, {-1, 1, 1});
    check('z', {0, 0, -270}, {1, 0, 2}, {-1, 1, 1});
    check('z', {180, 180, 180}, {0, 1, 2}, {1, 1, 1});
    check('z', {90, 0, 90}, {2, 0, 1}, {1, 1, 1});  // X first: the file's y points up, as after --up y
}

TEST_CASE("every quarter turn keeps the orientation") {
    for (int x = 0; x < 4; ++x)
        for (int y = 0; y < 4; ++y)
            for (int z = 0; z < 4; ++z) {
                Mesh mesh = awkward();
                PlacementOptions options;
                options.rotate_degrees = {Rational(90 * x), Rational(90 * y), Rational(90 * z)};
                const double volume = examine(awkward(), Placement{}).volume_mm3;
                CHECK(examine(mesh, place(mesh, options)).volume_mm3 == Approx(volume));
            }
}

TEST_CASE("sizes that no number holds once they are scaled are refused") {
    for (const double size : {1e150, 1e307, 1e-150}) {
        Mesh mesh = awkward();
        mesh.vertices *= size;
        PlacementOptions options;
        options.height_mm = Rational(20);
        for (const int degrees : {0, 30}) {
            options.rotate_degrees[0] = Rational(degrees);
            Mesh turned = mesh;
            CHECK_THROWS_WITH(place(turned, options), Catch::Contains("no solid is"));
        }
    }
}

TEST_CASE("other angles turn the mesh once, rigidly, and leave the axis alone") {
    Mesh mesh = awkward();
    PlacementOptions options;
    options.rotate_degrees[2] = Rational(75, 2);
    const Placement placement = place(mesh, options);
    CHECK(placement.axis == std::array<int, 3>{0, 1, 2});
    CHECK(mesh.vertices.row(2) == awkward().vertices.row(2));
    REQUIRE(placement.rotation);
    for (Eigen::Index row = 0; row < 3; ++row) {
        const auto& r = (*placement.rotation)[static_cast<std::size_t>(row)];
        CHECK((Eigen::RowVector3d(r[0], r[1], r[2]) * awkward().vertices - mesh.vertices.row(row)).norm() < 1e-9);
    }
    for (int a = 0; a < 8; ++a)
        for (int b = 0; b < a; ++b)
            CHECK((mesh.vertices.col(a) - mesh.vertices.col(b)).norm() ==
                  Approx((awkward().vertices.col(a) - awkward().vertices.col(b)).norm()));
    const Eigen::Vector3d first = awkward().vertices.col(0), turned = mesh.vertices.col(0);
    CHECK(std::atan2(first[0] * turned[1] - first[1] * turned[0], first[0] * turned[0] + first[1] * turned[1]) ==
          Approx(37.5 * 3.14159265358979323846 / 180));
}

TEST_CASE("what fills the bed fits, what is larger does not") {
    Mesh full = weld(box({-125, 0, 3}, {125, 250, 253}));
    CHECK_NOTHROW(place(full, {}));
    const Mesh higher = weld(box({0, 0, 0}, {10, 10, std::nextafter(250.0, 300.0)}));
    check_refused(higher, {}, ErrorKind::does_not_fit, "the bed 250 x 250 x 250 mm");
    check_refused(weld(box({0, 0, 0}, {1000, 20, 30})), {}, ErrorKind::does_not_fit,
                  "the model is 1000 x 20 x 30 mm, the bed 250 x 250 x 250 mm; use --scale 0.25 or less");
    PlacementOptions options;
    options.scale = Rational(3);
    check_refused(weld(box({0, 0, 0}, {299, 20, 30})), options, ErrorKind::does_not_fit, "use --scale 0.836 or less");
}

TEST_CASE("flat or tiny models are named") {
    Mesh flat = awkward();
    flat.vertices.row(2).setConstant(1);
    check_refused(flat, {}, ErrorKind::does_not_fit, "flat");
    PlacementOptions high;
    high.height_mm = 10;
    check_refused(flat, high, ErrorKind::does_not_fit, "flat");
    check_refused(weld(box({0, 0, 0}, {0.05, 0.02, 0.5})), {}, ErrorKind::does_not_fit, "metres or inches");
    check_refused(Mesh{}, {}, ErrorKind::bad_geometry, "no triangles");
    Mesh thin = weld(box({0, 0, 0}, {20, 20, 0.5}));
    CHECK_NOTHROW(place(thin, {}));
}

TEST_CASE("options that cannot be are usage errors") {
    PlacementOptions options;
    options.scale = Rational(1);
    options.height_mm = Rational(1);
    check_refused(awkward(), options, ErrorKind::usage, "exclude each other");
    options.height_mm.reset();
    for (const int scale : {0, -1}) {
        options.scale = Rational(scale);
        check_refused(awkward(), options, ErrorKind::usage, "--scale must be greater than 0");
    }
    options.scale.reset();
    options.height_mm = Rational(0);
    check_refused(awkward(), options, ErrorKind::usage, "--height must be greater than 0");
    options.height_mm.reset();
    options.up = 'w';
    check_refused(awkward(), options, ErrorKind::usage, "--up is 'w'");
    options.up = 'z';
    for (const double length : {0.0, -5.0, 1e9, std::nan("")}) {
        options.bed_y = length;
        check_refused(awkward(), options, ErrorKind::usage, "no size of a printer");
    }
    options = {};
    for (const std::array<double, 2> corner : {std::array{9751.0, 0.0}, {0.0, -10001.0}, {std::nan(""), 0.0}}) {
        options.bed_corner = corner;
        check_refused(awkward(), options, ErrorKind::usage, "--bed-corner: the bed must lie within 10000 mm");
    }
}
