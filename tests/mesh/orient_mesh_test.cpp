#include "ribvault/mesh/orient_mesh.hpp"

#include <catch2/catch.hpp>
#include <random>

#include "ribvault/mesh/examine_mesh.hpp"

using namespace ribvault;

namespace {

Mesh cube() {
    Mesh mesh;
    mesh.vertices.resize(3, 8);
    for (int v = 0; v < 8; ++v) mesh.vertices.col(v) << (v & 1), (v >> 1 & 1), (v >> 2 & 1);
    mesh.triangles.resize(3, 12);
    mesh.triangles << 0, 0, 4, 4, 0, 0, 2, 2, 0, 0, 1, 1,  //
        2, 3, 5, 7, 1, 5, 6, 7, 4, 6, 3, 7,               //
        3, 1, 7, 6, 5, 4, 7, 3, 6, 2, 7, 5;
    return mesh;
}

}  // namespace

TEST_CASE("a consistently oriented mesh is left alone") {
    Mesh mesh = cube();
    REQUIRE(examine(mesh, {}).closed());
    CHECK(orient_consistently(mesh) == 0);
    CHECK(examine(mesh, {}).volume_mm3 == Approx(1));
}

TEST_CASE("any minority of turned triangles is turned back") {
    std::mt19937 random(7);
    for (int round = 0; round < 50; ++round) {
        Mesh mesh = cube();
        std::vector<int> order(12);
        for (int t = 0; t < 12; ++t) order[static_cast<std::size_t>(t)] = t;
        std::shuffle(order.begin(), order.end(), random);
        const std::size_t turned = 1 + random() % 5;
        for (std::size_t k = 0; k < turned; ++k) std::swap(mesh.triangles(0, order[k]), mesh.triangles(1, order[k]));
        REQUIRE_FALSE(examine(mesh, {}).closed());
        CHECK(orient_consistently(mesh) == turned);
        CHECK(examine(mesh, {}).closed());
        CHECK(examine(mesh, {}).volume_mm3 == Approx(1));
    }
}

TEST_CASE("four triangles at an edge say nothing about each other's orientation, whatever their order") {
    // Two cubes with a common edge, both well oriented.
    Mesh one = cube(), two;
    two.vertices.resize(3, 14);
    two.triangles.resize(3, 24);
    two.vertices.leftCols(8) = one.vertices;
    std::vector<int> number;
    int next = 8;
    for (int v = 0; v < 8; ++v) {
        const bool shared = (v & 3) == 0;  // the second cube's edge x = y = 0 is the first one's x = y = 1
        number.push_back(shared ? v + 3 : next++);
        two.vertices.col(number.back()) << (v & 1) + 1, (v >> 1 & 1) + 1, (v >> 2 & 1);
    }
    two.triangles.leftCols(12) = one.triangles;
    for (int t = 0; t < 12; ++t)
        for (int k = 0; k < 3; ++k) two.triangles(k, t + 12) = number[static_cast<std::size_t>(one.triangles(k, t))];
    REQUIRE(examine(two, {}).closed());
    REQUIRE(examine(two, {}).non_manifold_edges == 1);
    std::mt19937 random(3);
    for (int round = 0; round < 50; ++round) {
        for (int t = 23; t > 0; --t) two.triangles.col(t).swap(two.triangles.col(static_cast<int>(random() % (t + 1))));
        CHECK(orient_consistently(two) == 0);
        CHECK(examine(two, {}).volume_mm3 == Approx(2));
    }
}

TEST_CASE("a wholly inverted part keeps its orientation") {
    Mesh mesh = cube();
    mesh.triangles.row(0).swap(mesh.triangles.row(1));
    CHECK(orient_consistently(mesh) == 0);
    CHECK(examine(mesh, {}).volume_mm3 == Approx(-1));
}
