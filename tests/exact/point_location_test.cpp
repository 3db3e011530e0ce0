// Point location against winding numbers counted quadrant by quadrant.
#include "ribvault/exact/point_location.hpp"

#include <catch2/catch.hpp>

#include "rationals.hpp"
#include "ribvault/exact/nearest_segment.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

/// How often the contours turn about p, in quarter turns from quadrant to quadrant; nothing is said of points on them.
int winding_number(const Region& region, Point p) {
    const auto quadrant = [&](Point q) { return q.x > p.x ? (q.y > p.y ? 0 : 3) : (q.y > p.y ? 1 : 2); };
    int quarters = 0;
    for (const Contour& c : region)
        for (std::size_t i = 0; i < c.size(); ++i) {
            const Point a = c[i], b = c[(i + 1) % c.size()];
            int step = (quadrant(b) - quadrant(a) + 4) % 4;
            if (step == 2) step = wedge(rational(a) - rational(p), rational(b) - rational(p)) > 0 ? 2 : -2;
            quarters += step == 3 ? -1 : step;
        }
    CHECK(quarters % 4 == 0);
    return quarters / 4;
}

Side brute_force(const Region& region, Point p) {
    for (const Segment& e : edges_of(region))
        if (rational_squared_distance(p, e) == 0) return Side::boundary;
    return winding_number(region, p) != 0 ? Side::inside : Side::outside;
}

/// Does the segment meet the closed box? By clipping it to the four half planes in rationals.
bool meets(const Segment& s, const Box& box) {
    Rational lo = 0, hi = 1;
    const auto clip = [&](Unit at, Unit to, Unit from_side, Unit to_side) {
        const Rational d(whole(to - at));
        if (d == 0) {
            if (at < from_side || at > to_side) hi = -1;
            return;
        }
        Rational enter = Rational(whole(from_side - at)) / d, leave = Rational(whole(to_side - at)) / d;
        if (enter > leave) std::swap(enter, leave);
        if (enter > lo) lo = enter;
        if (leave < hi) hi = leave;
    };
    clip(s.a.x, s.b.x, box.lo.x, box.hi.x);
    clip(s.a.y, s.b.y, box.lo.y, box.hi.y);
    return lo <= hi;
}

/// Contours of a few corners that cross themselves and each other, some of them twice the same or inverted.
Region tangle(Random& g, Unit size) {
    Region region;
    const int contours = static_cast<int>(pick(g, 1, 4));
    for (int k = 0; k < contours; ++k) {
        Contour c;
        for (Unit n = pick(g, 3, 9); n > 0; --n) {
            Point p{pick(g, -size, size), pick(g, -size, size)};
            if (!c.empty() && pick(g, 0, 3) == 0) p.y = c.back().y;  // horizontal edges
            c.push_back(p);
        }
        region.push_back(c);
        if (pick(g, 0, 3) == 0) region.push_back(pick(g, 0, 1) ? c : Contour(c.rbegin(), c.rend()));
    }
    return region;
}

/// A point of the lattice that tells most: a corner, a point on an edge or next to it, on a corner's level, or
/// anywhere.
Point telling_point(Random& g, const std::vector<Segment>& edges, Unit size) {
    const Segment& e = edges[static_cast<std::size_t>(pick(g, 0, static_cast<Unit>(edges.size()) - 1))];
    switch (pick(g, 0, 3)) {
        case 0:
            return e.a;
        case 1:
            return near_segment(g, e);
        case 2:
            return {pick(g, -size - 1, size + 1), e.a.y};
        default:
            return {pick(g, -size - 1, size + 1), pick(g, -size - 1, size + 1)};
    }
}

}  // namespace

TEST_CASE("points of random tangles lie where their winding number says, boundary points on the boundary") {
    Random g(11);
    int count[3] = {0, 0, 0};
    for (int k = 0; k < 1500; ++k) {
        const Unit size = k % 3 == 0 ? 6 : k % 3 == 1 ? 300000 : lattice_bound;
        const Region region = tangle(g, size);
        const Unit strips[] = {1, size / 7 + 1, 4 * size};
        const PointLocation location(edges_of(region), strips[pick(g, 0, 2)]);
        for (int q = 0; q < 25; ++q) {
            const Point p = telling_point(g, location.edges(), size);
            const Side truth = brute_force(region, p);
            ++count[static_cast<int>(truth)];
            INFO("tangle " << k << ", point (" << p.x << ", " << p.y << ")");
            REQUIRE(location.locate(p) == truth);
        }
    }
    for (const int n : count) CHECK(n > 2000);
}

TEST_CASE("boxes meet an edge exactly when clipping says so") {
    Random g(12);
    int meeting = 0, missing = 0;
    for (int k = 0; k < 800; ++k) {
        const Unit size = k % 2 ? 9 : 400000;
        const Region region = tangle(g, size);
        const PointLocation location(edges_of(region), size / 3 + 1);
        for (int q = 0; q < 20; ++q) {
            const Point lo = telling_point(g, location.edges(), size);
            const Box box{lo, {lo.x + pick(g, 0, size / 3), lo.y + pick(g, 0, size / 3)}};
            bool truth = false;
            for (const Segment& e : location.edges()) truth = truth || meets(e, box);
            ++(truth ? meeting : missing);
            REQUIRE(location.edge_meets(box) == truth);
        }
    }
    CHECK(meeting > 1000);
    CHECK(missing > 500);
}

TEST_CASE("the crossings of a horizontal line add up to winding numbers") {
    Random g(13);
    for (int k = 0; k < 300; ++k) {
        const Region region = tangle(g, 5000);
        const PointLocation location(edges_of(region), 700);
        const Unit y = pick(g, -5100, 5100), x = pick(g, -5100, 5100);
        if (brute_force(region, {x, y}) == Side::boundary) continue;
        int winding = 0, all = 0;
        location.visit_crossings(y, [&](const Segment& e, int way) {
            REQUIRE(std::min(e.a.y, e.b.y) <= y);
            REQUIRE(std::max(e.a.y, e.b.y) >= y);
            all += way;
            if (orientation(e.a, e.b, {x, y}) == way) winding += way;
        });
        REQUIRE(all == 0);
        REQUIRE(winding == winding_number(region, {x, y}));
    }
}

TEST_CASE("points of a square with a hole") {
    const Region ring{{{0, 0}, {9, 0}, {9, 9}, {0, 9}}, {{3, 3}, {3, 6}, {6, 6}, {6, 3}}};
    for (const Unit strip : {1, 4, 100}) {
        const PointLocation location(edges_of(ring), strip);
        for (const Point p : {Point{0, 0}, {9, 9}, {9, 4}, {3, 3}, {6, 5}, {4, 3}, {0, 5}})
            CHECK(location.locate(p) == Side::boundary);
        for (const Point p : {Point{1, 1}, {8, 8}, {1, 3}, {7, 6}, {2, 9 - 1}})
            CHECK(location.locate(p) == Side::inside);
        for (const Point p : {Point{4, 4}, {5, 5}, {-1, 0}, {10, 9}, {5, 10}, {-1, 3}})
            CHECK(location.locate(p) == Side::outside);
        CHECK(location.edge_meets({{1, 1}, {8, 8}}));
        CHECK_FALSE(location.edge_meets({{1, 1}, {2, 8}}));
        CHECK_FALSE(location.edge_meets({{4, 4}, {5, 5}}));
        CHECK(location.edge_meets({{9, 9}, {12, 12}}));
    }
}

TEST_CASE("nothing is everywhere outside") {
    for (const PointLocation& nothing : {PointLocation(), PointLocation({}, 10)}) {
        CHECK(nothing.empty());
        CHECK(nothing.locate({0, 0}) == Side::outside);
        CHECK_FALSE(nothing.edge_meets({{-5, -5}, {5, 5}}));
    }
}
