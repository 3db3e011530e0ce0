#include "mesh/solids.hpp"
#include "ribvault/mesh/examine_mesh.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

MeshFacts facts_of(const std::vector<Triangle>& triangles, const Placement& placement = {}) {
    return examine(weld(triangles), placement);
}

const std::vector<Triangle> cube = box({0, 0, 0}, {10, 10, 10});

}  // namespace

TEST_CASE("a cube has no defects") {
    const MeshFacts facts = facts_of(cube);
    CHECK(facts.triangles == 12);
    CHECK(facts.vertices == 8);
    CHECK(facts.size_mm == std::array<double, 3>{10, 10, 10});
    CHECK(facts.volume_mm3 == Approx(1000));
    CHECK(facts.components == 1);
    CHECK(facts.boundary_edges + facts.non_manifold_edges + facts.unbalanced_edges == 0);
    CHECK(facts.duplicate_triangles + facts.degenerate_triangles + facts.inverted_components == 0);
    CHECK(facts.closed());
}

TEST_CASE("the volume does not depend on where the solid lies, and scales with the cube of the size") {
    CHECK(facts_of(box({1e6, -1e6, 3e5}, {1e6 + 2, -1e6 + 3, 3e5 + 4})).volume_mm3 == Approx(24));
    Placement half;
    half.scale = Rational(1, 2);
    half.axis = {2, 0, 1};
    const MeshFacts facts = facts_of(box({0, 0, 0}, {2, 4, 6}), half);
    CHECK(facts.volume_mm3 == Approx(6));
    CHECK(facts.size_mm == std::array<double, 3>{3, 1, 2});
    Placement mirror;
    mirror.sign = {-1, 1, 1};
    CHECK(facts_of(cube, mirror).volume_mm3 == Approx(-1000));
    CHECK(facts_of(cube, mirror).inverted_components == 1);
}

TEST_CASE("two cubes apart are two components, sharing an edge they are one with a non-manifold edge") {
    const MeshFacts apart = facts_of(cube + box({20, 0, 0}, {30, 10, 10}));
    CHECK(apart.components == 2);
    CHECK(apart.volume_mm3 == Approx(2000));
    CHECK(apart.closed());
    const MeshFacts touching = facts_of(cube + box({10, 10, 0}, {20, 20, 10}));
    CHECK(touching.components == 1);
    CHECK(touching.non_manifold_edges == 1);
    CHECK(touching.unbalanced_edges == 0);
    CHECK(touching.closed());
    const MeshFacts corner = facts_of(cube + box({10, 10, 10}, {20, 20, 20}));
    CHECK(corner.components == 2);
    CHECK(corner.vertices == 15);
}

TEST_CASE("an inward cube is a void inside a solid and an inverted component elsewhere") {
    const MeshFacts hollow = facts_of(cube + box({2, 2, 2}, {4, 4, 4}, true));
    CHECK(hollow.inverted_components == 0);
    CHECK(hollow.volume_mm3 == Approx(992));
    const MeshFacts beside = facts_of(cube + box({12, 2, 2}, {14, 4, 4}, true));
    CHECK(beside.inverted_components == 1);
    CHECK(beside.volume_mm3 == Approx(992));
    CHECK(facts_of(box({0, 0, 0}, {1, 1, 1}, true)).inverted_components == 1);
}

TEST_CASE("an open cube has a boundary") {
    std::vector<Triangle> open = cube;
    open.resize(10);  // without the side x = 10
    const MeshFacts facts = facts_of(open);
    CHECK(facts.boundary_edges == 4);
    CHECK(facts.unbalanced_edges == 4);
    CHECK_FALSE(facts.closed());
    CHECK(facts_of(cube + open).inverted_components == 0);
    // Turned inside out it is a void inside out only where it is closed.
    std::vector<Triangle> inward = box({12, 2, 2}, {14, 4, 4}, true);
    CHECK(facts_of(cube + inward).inverted_components == 1);
    inward.erase(inward.begin(), inward.begin() + 2);  // its floor; what is left encloses -4 mm3 about the middle
    CHECK(facts_of(cube + inward).inverted_components == 0);
}

TEST_CASE("a turned triangle unbalances its three edges") {
    std::vector<Triangle> turned = cube;
    std::swap(turned[0][0], turned[0][1]);
    const MeshFacts facts = facts_of(turned);
    CHECK(facts.unbalanced_edges == 3);
    CHECK(facts.boundary_edges == 0);
    CHECK_FALSE(facts.closed());
}

TEST_CASE("duplicates are counted in any order and orientation") {
    std::vector<Triangle> doubled = cube;
    doubled.push_back({cube[3][1], cube[3][2], cube[3][0]});
    CHECK(facts_of(doubled).duplicate_triangles == 1);
    CHECK(facts_of(doubled).non_manifold_edges == 3);
    CHECK_FALSE(facts_of(doubled).closed());
    doubled.push_back({cube[3][1], cube[3][0], cube[3][2]});
    CHECK(facts_of(doubled).duplicate_triangles == 2);
    CHECK(facts_of(doubled).closed());
    CHECK(facts_of(cube + cube).duplicate_triangles == 12);
}

TEST_CASE("no triangles, no facts") {
    const MeshFacts facts = examine(Mesh{}, Placement{});
    CHECK(facts.triangles == 0);
    CHECK(facts.components == 0);
}
