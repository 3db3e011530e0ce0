// The removal gap: equal is far enough, a rational hair nearer is not.
#include "ribvault/verify/gap_check.hpp"

#include <catch2/catch.hpp>

#include "ribvault/slice/exact_polygons.hpp"

using namespace ribvault;

namespace {

using FT = ExactKernel::FT;

/// A square of 10 mm whose right side is at x = 5 + more, with a square hole of 4 mm.
ExactPolygons frame(const FT& more = 0) {
    ExactPolygon outer, hole;
    for (const auto& [x, y] : {std::pair<FT, FT>{-5, -5}, {5 + more, -5}, {5 + more, 5}, {-5, 5}})
        outer.push_back({x, y});
    for (const auto& [x, y] : {std::pair<FT, FT>{-2, -2}, {-2, 2}, {2, 2}, {2, -2}}) hole.push_back({x, y});
    ExactPolygons polygons;
    polygons.polygons.emplace_back(outer);
    polygons.polygons.back().add_hole(hole);
    return polygons;
}
bool keeps_off(const Segment& track, const FT& more = 0) { return !find_too_near(frame(more), {track}, 40000); }

}  // namespace

TEST_CASE("a track as far as the gap is far enough, one nearer by less than any double tells is not") {
    CHECK(keeps_off({{540000, -900000}, {540000, 900000}}));
    CHECK_FALSE(keeps_off({{540000, -900000}, {540000, 900000}}, FT(1) / FT(1e30)));
    CHECK(keeps_off({{540000, -900000}, {540000, 900000}}, -FT(1) / FT(1e30)));
    CHECK_FALSE(keeps_off({{539999, 0}, {900000, 0}}));
    CHECK(keeps_off({{524000, 532000}, {524000, 532000}}));  // a dot at exactly 0.4 mm from a corner: 0.24 and 0.32
    CHECK_FALSE(keeps_off({{524000, 531999}, {524000, 531999}}));
}

TEST_CASE("in a hole is outside, in the solid is not, across is not") {
    CHECK(keeps_off({{-100000, 0}, {100000, 0}}));
    CHECK_FALSE(keeps_off({{350000, 0}, {350000, 0}}));
    CHECK_FALSE(keeps_off({{-900000, 0}, {900000, 0}}));
    ExactPolygons solid;
    solid.polygons.emplace_back(frame().polygons[0].outer_boundary());
    CHECK(find_too_near(solid, {{{0, 0}, {10, 0}}}, 40000));  // farther than the gap from the edges, and inside
    CHECK_FALSE(find_too_near(solid, {}, 40000));
}

TEST_CASE("tracks of the object and of supports keep their distance, ties are far enough") {
    const NearestSegment object({{{0, 0}, {60000, 80000}}, {{500000, 0}, {500000, 0}}});
    const Segment far{{48000, -36000},
                      {900000, -36000}};  // 60000 from the first, square to its end, and 36000 from the dot
    CHECK_FALSE(find_too_near(object, {far}, 36000));
    CHECK(find_too_near(object, {far}, 36001));
    CHECK_FALSE(find_too_near(object, {{far.a, far.a}, {{900000, 0}, {900000, 0}}}, 60000));
    CHECK(find_too_near(object, {{{900000, 0}, {900000, 0}}, {far.a, far.a}}, 60001)->a == far.a);
    CHECK(find_too_near(object, {{{0, 50000}, {50000, 0}}}, 1));
    CHECK_FALSE(find_too_near(NearestSegment(std::vector<Segment>()), {far}, 36001));
}
