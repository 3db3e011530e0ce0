// The box tree against looking at every segment.
#include "ribvault/exact/nearest_segment.hpp"

#include <catch2/catch.hpp>
#include <set>

#include "rationals.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

std::vector<Segment> random_segments(Random& g, std::size_t count, Unit size, Unit length) {
    std::vector<Segment> segments;
    while (segments.size() < count) {
        const Point a{pick(g, -size, size), pick(g, -size, size)};
        segments.push_back({a, {a.x + pick(g, -length, length), a.y + pick(g, -length, length)}});
    }
    return segments;
}

void check_nearest(const NearestSegment& tree, Point p) {
    std::uint32_t best = 0;
    Rational least = rational_squared_distance(p, tree.segments()[0]);
    for (std::uint32_t k = 1; k < tree.segments().size(); ++k) {
        const Rational d = rational_squared_distance(p, tree.segments()[k]);
        if (d < least) best = k, least = d;
    }
    const NearestSegment::Hit hit = tree.nearest(p);
    REQUIRE(hit.index == best);
    const SquaredDistance own = squared_distance(p, tree.segments()[best]);
    REQUIRE(hit.distance.numerator == own.numerator);
    REQUIRE(hit.distance.denominator == own.denominator);
}

}  // namespace

TEST_CASE("the nearest segment is the first of the nearest ones") {
    Random g(21);
    for (int k = 0; k < 60; ++k) {
        const Unit size = k % 3 == 0 ? 12 : k % 3 == 1 ? 400000 : 900000000;
        const NearestSegment tree(random_segments(g, static_cast<std::size_t>(pick(g, 1, 150)), size, size / 10));
        for (int q = 0; q < 20; ++q) check_nearest(tree, {pick(g, -size, size), pick(g, -size, size)});
    }
}

TEST_CASE("ties: the centre of a regular grid, and the same segment several times") {
    std::vector<Segment> grid;
    for (Unit x = -40; x <= 40; x += 10)
        for (Unit y = -40; y <= 40; y += 10) grid.push_back({{x, y}, {x, y}});
    for (int copy = 0; copy < 5; ++copy) grid.push_back({{-45, 3}, {45, 3}});
    const NearestSegment tree(grid);
    for (Unit x = -50; x <= 50; x += 5)
        for (Unit y = -50; y <= 50; y += 1) check_nearest(tree, {x, y});
}

TEST_CASE("distances that doubles cannot tell apart") {
    Random g(23);
    for (int k = 0; k < 200; ++k) {
        // From the point c below their common end, the segments lie c m / sqrt(m^2 + 1) away.
        const Unit c = pick(g, 10000, 900000000);
        std::vector<Segment> segments;
        for (int n = 0; n < 20; ++n) segments.push_back({{0, 0}, {pick(g, 300000000, 900000000), -1}});
        check_nearest(NearestSegment(segments), {0, -c});
        // Points on a circle about it, each rounded to the lattice.
        std::vector<Segment> points;
        for (int n = 0; n < 40; ++n) {
            const double angle = std::uniform_real_distribution<double>(0, 6.28)(g), r = static_cast<double>(c);
            const Point p{round_to_lattice(r * std::cos(angle)), round_to_lattice(r * std::sin(angle))};
            points.push_back({p, p});
        }
        check_nearest(NearestSegment(points), {0, 0});
    }
}

TEST_CASE("the box query finds every segment whose box it meets, once, and no other") {
    Random g(22);
    for (int k = 0; k < 100; ++k) {
        const Unit size = k % 2 ? 20 : 300000;
        const NearestSegment tree(random_segments(g, static_cast<std::size_t>(pick(g, 1, 200)), size, size / 5));
        for (int q = 0; q < 10; ++q) {
            const Point lo{pick(g, -size, size), pick(g, -size, size)};
            const Box box{lo, {lo.x + pick(g, 0, size / 2), lo.y + pick(g, 0, size / 2)}};
            std::multiset<std::uint32_t> found, truth;
            tree.visit(box, [&](std::uint32_t i) { found.insert(i); });
            for (std::uint32_t i = 0; i < tree.segments().size(); ++i) {
                Box own;
                own.add(tree.segments()[i].a), own.add(tree.segments()[i].b);
                if (own.lo.x <= box.hi.x && own.hi.x >= box.lo.x && own.lo.y <= box.hi.y && own.hi.y >= box.lo.y)
                    truth.insert(i);
            }
            REQUIRE(found == truth);
        }
    }
}

TEST_CASE("the edges of a region, contour by contour") {
    const std::vector<Segment> edges = edges_of({{{0, 0}, {4, 0}, {4, 4}}, {}, {{1, 1}, {2, 2}, {3, 1}}});
    REQUIRE(edges.size() == 6);
    CHECK(edges[2].a == Point{4, 4});
    CHECK(edges[2].b == Point{0, 0});
    CHECK(edges[5].b == Point{1, 1});
    CHECK(NearestSegment().empty());
    CHECK(NearestSegment(std::vector<Segment>{}).empty());
    int visited = 0;
    NearestSegment().visit({{-9, -9}, {9, 9}}, [&](std::uint32_t) { ++visited; });
    CHECK(visited == 0);
}
