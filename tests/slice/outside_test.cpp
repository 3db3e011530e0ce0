// Outside a slice: where external supports may stand, and what hangs over it.
#include "ribvault/slice/outside.hpp"

#include <catch2/catch.hpp>

#include "ribvault/exact/nearest_segment.hpp"
#include "ribvault/exact/point_location.hpp"
#include "vault/random_cavities.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

const Box frame{{-3000000, -3000000}, {3000000, 3000000}};

Slice slice_of(int layer, Region region) { return {layer, nullptr, std::move(region)}; }

Cavity none() { return {}; }

double area_mm2(const Region& region) { return area_to_mm2(signed_area(region)); }

}  // namespace

TEST_CASE("outside and slice fill the frame, and overlap by 30 nm") {
    const Slice slice = slice_of(
        0, {rectangle(-500000, -500000, 500000, 500000), reversed(rectangle(-200000, -200000, 200000, 200000))});
    const Cavity outside = make_outside(slice, frame, {});
    const PointLocation location(edges_of(outside.region), units_per_mm);
    CHECK(outside.outside);
    CHECK_FALSE(outside.walls);
    CHECK(location.locate({0, 0}) == Side::inside);  // a hole of the slice is outside
    CHECK(location.locate({500000 - 3, 0}) == Side::boundary);
    CHECK(location.locate({500000 - 4, 0}) == Side::outside);
    CHECK(location.locate({900000, 900000}) == Side::inside);
    CHECK(area_mm2(outside.region) + area_mm2(slice.rounded) == Approx(3600).margin(0.01));
}

TEST_CASE("with a removal gap walls keep g + r off every corner and edge of the slice, and no more than 4 um farther") {
    std::mt19937_64 random(7);
    Settings settings;
    settings.support = Support::external;
    for (const Unit gap : {5000, 20000, 33333, 120000}) {
        settings.support_gap = gap, settings.support_width = gap == 33333 ? 26000 : 40000;
        const DriftingShapes shapes(random, 4, 2, 2000000, 3000);
        const Slice slice = slice_of(3, shapes.at(3));
        const Region walls = off_the_object({std::make_shared<const Slice>(slice)}, frame, settings);
        const NearestSegment object(edges_of(slice.rounded));
        const PointLocation solid(edges_of(slice.rounded), units_per_mm);
        const Unit least = gap + settings.support_width / 2;
        std::size_t on_arcs = 0;
        for (const Segment& e : edges_of(walls)) {
            if (std::abs(e.a.x) == 3000000 || std::abs(e.a.y) == 3000000) continue;
            // The nearest place of an edge that is no arc's chord may be between its ends.
            for (const Segment& o : object.segments()) {
                CHECK(compare_distance(e.a, o, least) > 0);
                CHECK(compare_distance(o.a, e, least) > 0);
            }
            CHECK(solid.locate(e.a) == Side::outside);
            on_arcs += compare_distance(e.a, object.segments()[object.nearest(e.a).index], least + 400) <= 0;
        }
        CHECK(on_arcs > 20);
    }
}

TEST_CASE("where layers are left empty walls keep off the slices of all of them") {
    Settings settings;
    settings.support = Support::external;
    settings.support_gap = 20000;
    const auto square = [](int layer, Unit x) {
        return std::make_shared<const Slice>(slice_of(layer, {rectangle(x - 100000, -100000, x + 100000, 100000)}));
    };
    const Region walls = off_the_object({square(1, -1000000), square(2, 0), square(3, 1000000)}, frame, settings);
    const PointLocation location(edges_of(walls), units_per_mm);
    for (const Unit x : {-1000000, 0, 1000000}) {
        CHECK(location.locate({x, 0}) == Side::outside);
        CHECK(location.locate({x, 139999}) == Side::outside);  // 0.2 mm and half a track from the side
        CHECK(location.locate({x, 142000}) == Side::inside);
    }
}

TEST_CASE("over the outside hangs no part of the cavity above, where that has no floor") {
    Settings settings;
    const Slice column = slice_of(0, {rectangle(-500000, -500000, 500000, 500000)});
    const Region plate{rectangle(-500000, -500000, 1500000, 500000)};
    const Cavity room = make_cavity(1, {rectangle(600000, -400000, 1400000, 400000)}, settings);
    const auto area = [&](int bottom_layers) {
        settings.bottom_layers = bottom_layers;
        return area_mm2(overhang_outside(make_outside(column, frame, settings),
                                         make_outside(slice_of(1, plate), frame, settings), room, settings));
    };
    CHECK(area(1) == Approx(10 * 9.8).epsilon(0.001));
    CHECK(area(0) == Approx(10 * 9.8 - 8 * 8).epsilon(0.001));
}

TEST_CASE("what hangs over the outside is the slice above farther than rho from the slice") {
    const Settings settings;
    const Slice column = slice_of(0, {rectangle(-500000, -500000, 500000, 500000)});
    const auto over = [&](Region above) {
        return overhang_outside(make_outside(column, frame, settings),
                                make_outside(slice_of(1, std::move(above)), frame, settings), none(), settings);
    };
    CHECK(over(column.rounded).empty());
    CHECK(over({rectangle(-519800, -500000, 519800, 500000)}).empty());
    CHECK_FALSE(over({rectangle(-520000, -520000, 520000, 520000)}).empty());  // its corners are farther
    const Region hanging = over({rectangle(-500000, -500000, 800000, 500000)});
    REQUIRE(hanging.size() == 1);
    CHECK(area_mm2(hanging) == Approx(10 * 2.8).epsilon(0.001));
    CHECK(area_mm2(hanging) >= 10 * 2.8);
    const Region in_the_air = over({column.rounded.front(), rectangle(1000000, 1000000, 1100000, 1100000)});
    CHECK(area_mm2(in_the_air) == Approx(1).epsilon(0.001));
}
