#include <catch2/catch.hpp>
#include <random>

#include "print/geometry.hpp"
#include "ribvault/print/travel_map.hpp"
#include "ribvault/slice/lattice_clip.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

constexpr Unit mm = units_per_mm;

LayerPaths perimeters_of(const Region& outline) {
    LayerPaths layer;
    for (Contour& c : offset(outline, -20000, ClipperLib::jtMiter))
        layer.paths.push_back({TrackKind::outer_perimeter, 40000, true, std::move(c)});
    return layer;
}

/// A U of 30 mm with a slit 10 mm wide.
const Region u{{{0, 0},
                {30 * mm, 0},
                {30 * mm, 30 * mm},
                {20 * mm, 30 * mm},
                {20 * mm, 10 * mm},
                {10 * mm, 10 * mm},
                {10 * mm, 30 * mm},
                {0, 30 * mm}}};

}  // namespace

TEST_CASE("a travel that would leave the island goes around inside it, when that is not too long") {
    const TravelMap map(u, {}, perimeters_of(u));
    const Point from{9 * mm, 13 * mm}, to{21 * mm, 13 * mm};
    CHECK_FALSE(map.sees(from, to));
    const Travel around = map.travel(from, to, 10 * mm);
    CHECK_FALSE(around.leaves_island);
    REQUIRE(around.via.size() > 1);
    CHECK(around.via.back() == to);
    Point at = from;
    double sum = 0;
    for (Point p : around.via) {
        CHECK(distance(std::vector<Segment>{{at, p}}, segments(u)) > 0);
        sum += length(p - at), at = p;
    }
    CHECK(sum == Approx(around.length));
    CHECK(around.length < 20 * mm);
    const Travel straight = map.travel(from, to, 2 * mm);
    CHECK(straight.leaves_island);
    CHECK(straight.via == std::vector<Point>{to});
    CHECK(straight.length == 12 * mm);
}

TEST_CASE("a travel past a hole goes around it on the shorter side") {
    Contour hole{{10 * mm, 8 * mm}, {10 * mm, 16 * mm}, {14 * mm, 16 * mm}, {14 * mm, 8 * mm}};
    const Region region{{{0, 0}, {24 * mm, 0}, {24 * mm, 24 * mm}, {0, 24 * mm}}, hole};
    const TravelMap map(region, {}, perimeters_of(region));
    const Travel way = map.travel({5 * mm, 15 * mm}, {19 * mm, 15 * mm}, 10 * mm);
    CHECK_FALSE(way.leaves_island);
    CHECK(way.length < 15 * mm);
}

TEST_CASE("random travels in random slices: inside, no shorter than straight, or said to leave") {
    std::mt19937_64 random(9);
    std::uniform_real_distribution<double> radius(4, 10);
    int around = 0, left = 0;
    for (int round = 0; round < 20; ++round) {
        Region region{{}};
        for (int i = 0; i < 30; ++i) {
            const double r = radius(random) * mm, a = i * 0.20944;
            region[0].push_back({round_to_lattice(r * std::cos(a)), round_to_lattice(r * std::sin(a))});
        }
        const TravelMap map(region, {}, perimeters_of(region));
        std::uniform_int_distribution<Unit> place(-8 * mm, 8 * mm);
        for (int k = 0; k < 60; ++k) {
            const Point from{place(random), place(random)}, to{place(random), place(random)};
            if (winding_number(region, from) == 0 || winding_number(region, to) == 0) continue;
            const Travel way = map.travel(from, to, 30 * mm);
            const bool straight_inside = distance(std::vector<Segment>{{from, to}}, segments(region)) > 0;
            CHECK(straight_inside == (way.via.size() == 1 && !way.leaves_island));
            CHECK(way.length >= length(to - from) - 1);
            CHECK(way.via.back() == to);
            left += way.leaves_island;
            if (way.leaves_island || way.via.size() == 1) continue;
            ++around;
            Point at = from;
            for (Point p : way.via) {
                CHECK(distance(std::vector<Segment>{{at, p}}, segments(region)) > 0);
                at = p;
            }
        }
    }
    CHECK(around > 40);
    CHECK(left < around / 4);
}

TEST_CASE("open air is what lies over the cavity") {
    const Region square{{{0, 0}, {20 * mm, 0}, {20 * mm, 20 * mm}, {0, 20 * mm}}};
    const Region cavity{{{5 * mm, 5 * mm}, {15 * mm, 5 * mm}, {15 * mm, 15 * mm}, {5 * mm, 15 * mm}},
                        {{8 * mm, 8 * mm}, {8 * mm, 12 * mm}, {12 * mm, 12 * mm}, {12 * mm, 8 * mm}}};
    const TravelMap map(square, cavity, perimeters_of(square));
    const auto air = [&](Point a, Point b) { return map.travel(a, b, 0).open_air / mm; };
    CHECK(air({mm, 2 * mm}, {19 * mm, 2 * mm}) == 0);
    CHECK(air({mm, 6 * mm}, {19 * mm, 6 * mm}) == Approx(10));
    CHECK(air({mm, 10 * mm}, {19 * mm, 10 * mm}) == Approx(6));
    CHECK(air({5 * mm, 6 * mm}, {7 * mm, 6 * mm}) == Approx(2));
    CHECK(air({9 * mm, 9 * mm}, {11 * mm, 11 * mm}) == 0);
    CHECK(TravelMap().travel({0, 0}, {3 * mm, 4 * mm}, 0).open_air == 5 * mm);
}
