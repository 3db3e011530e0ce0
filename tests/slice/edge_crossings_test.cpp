#include "ribvault/slice/edge_crossings.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

using namespace ribvault;

namespace {

/// The crossing by the formula, in rational arithmetic.
std::array<Rational, 2> expected(const Mesh& mesh, const Placement& placed, const Rational& plane, int a, int b) {
    const auto bed = [&](int k, int v) {
        const auto i = static_cast<std::size_t>(k);
        return Rational(placed.scale * placed.sign[i] * Rational(mesh.vertices(placed.axis[i], v)) + placed.offset[i]);
    };
    const Rational t = (plane - bed(2, a)) / (bed(2, b) - bed(2, a));
    return {bed(0, a) + t * (bed(0, b) - bed(0, a)), bed(1, a) + t * (bed(1, b) - bed(1, a))};
}

void check(const Mesh& mesh, const Placement& placed, const Rational& plane) {
    const EdgeCrossings crossings(mesh, placed, plane, mesh_grid_bits(mesh));
    const ExactKernel::Point_2 there = crossings.at({0, 1}), back = crossings.at({1, 0});
    const std::array<Rational, 2> wanted = expected(mesh, placed, plane, 0, 1);
    REQUIRE(Rational(CGAL::exact(there).x()) == wanted[0]);
    REQUIRE(Rational(CGAL::exact(there).y()) == wanted[1]);
    REQUIRE(there == back);
    for (const auto& [coordinate, value] : {std::pair{there.x(), wanted[0]}, std::pair{there.y(), wanted[1]}}) {
        const auto [lo, hi] = CGAL::to_interval(coordinate);
        REQUIRE(Rational(lo) <= value);
        REQUIRE(value <= Rational(hi));
        REQUIRE(hi <= std::nextafter(lo, INFINITY));
    }
}

Mesh edge(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    Mesh mesh;
    mesh.vertices.resize(3, 2);
    mesh.vertices.col(0) = a, mesh.vertices.col(1) = b;
    return mesh;
}

}  // namespace

TEST_CASE("crossings are the exact ones, whatever the magnitudes") {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> mantissa(-1, 1);
    std::uniform_int_distribution<int> exponent(-60, 20), axis(0, 2), sign(0, 1), ratio(1, 50);
    for (int round = 0; round < 2000; ++round) {
        const auto number = [&] { return std::ldexp(mantissa(random), exponent(random)); };
        Eigen::Vector3d a(number(), number(), number()), b(number(), number(), number());
        if (round % 5 == 0) b[round % 3] = a[round % 3];
        Placement placed;
        const int first = axis(random);
        for (int k = 0; k < 3; ++k) {
            placed.axis[static_cast<std::size_t>(k)] = (first + k) % 3;
            placed.sign[static_cast<std::size_t>(k)] = sign(random) ? 1 : -1;
            placed.offset[static_cast<std::size_t>(k)] = Rational(ratio(random), ratio(random));
            placed.offset[static_cast<std::size_t>(k)].canonicalize();
        }
        placed.scale = Rational(ratio(random), ratio(random));
        placed.scale.canonicalize();
        if (a[placed.axis[2]] == b[placed.axis[2]]) continue;
        Rational plane(ratio(random), 10);
        plane.canonicalize();
        check(edge(a, b), placed, plane);
    }
}

TEST_CASE("crossings of edges with coordinates of all sizes that doubles have") {
    check(edge({0x1p-1074, 1e300, 0}, {-1e5, 0x1p-1000, 1}), {}, Rational(1, 3));
    check(edge({0, 0, 0}, {0, 0, 0x1p-1074}), {}, Rational(0x1p-1074) / 2);
    check(edge({3, 4, -1}, {3, 4, 1}), {}, Rational(0));
}

TEST_CASE("the grid is as coarse as the coordinates allow") {
    CHECK(mesh_grid_bits(edge({0, 2, 1024}, {-3, 5, 7})) == 0);
    CHECK(mesh_grid_bits(edge({0.5, 2, 1024}, {-3.25, 5, 7})) == 2);
    CHECK(mesh_grid_bits(edge({0x1p-1074, 2, 1024}, {-3.25, 5, 7})) == 1074);
    CHECK(mesh_grid_bits(Mesh{}) == 0);
}
