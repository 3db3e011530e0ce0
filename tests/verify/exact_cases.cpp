// Ties and near ties of equation (2), one by one. r = ρ = 0.2 mm, so a track reaches 0.4 mm below; one unit is 10 nm.
#include <algorithm>
#include <catch2/catch.hpp>
#include <numbers>
#include <thread>

#include "brute_force.hpp"
#include "ribvault/error.hpp"
#include "ribvault/exact/rational.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

constexpr Unit rho = 20000, reach = 40000, wide = 1000000;
const Settings how = settings(rho, rho);
const Contour frame = square(1500000);

Layer below(std::vector<Segment> tracks) { return layer({frame}, {square(wide)}, std::move(tracks)); }
Layer only_tracks(std::vector<Segment> tracks) { return layer({frame}, {square(wide)}, std::move(tracks)); }
/// Material on [-half, half]^2 about the origin, in the middle of the cavity.
Layer island(Unit half) { return layer({frame}, {square(wide), reversed(square(half))}); }
Segment disc(Unit x, Unit y) { return {{x, y}, {x, y}}; }

void supported(const LayerVerdict& v) {
    CHECK(v.malformed == "");
    CHECK(v.supported);
    CHECK(!v.internal);
}
void unsupported(const LayerVerdict& v, Unit radius = rho) {
    CHECK(v.malformed == "");
    CHECK(!v.supported);
    REQUIRE(v.internal);
    CHECK(v.internal->witness_certified);
    CHECK(v.internal->witness_distance >= to_mm(radius) * (1 - 1e-12));
    CHECK(v.internal->area_hi > 0);
}
void area_is(const Unsupported& u, double mm2) {
    CHECK(u.area_lo <= mm2);
    CHECK(u.area_hi >= mm2);
}
/// The highest stage that a verdict needed.
enum Stage { intervals, rationals, algebraic_numbers };
Stage stage(const LayerVerdict& v) {
    return v.stages.algebraic > 0 ? algebraic_numbers : v.stages.rational > 0 ? rationals : intervals;
}

}  // namespace

TEST_CASE("a track end at exactly ρ from the track below is supported, one unit farther is not") {
    const Layer lower = below({{{0, 0}, {200000, 0}}});
    const LayerVerdict tie = verify(only_tracks({{{-12000, 16000}, {100000, 20000}}}), lower, how);
    supported(tie);
    CHECK(stage(tie) == intervals);  // 12000^2 + 16000^2 - 20000^2 has no rounding
    unsupported(verify(only_tracks({{{-12000, 16001}, {100000, 20000}}}), lower, how));
    unsupported(verify(only_tracks({{{-12000, 16000}, {100000, 20001}}}), lower, how));
}

TEST_CASE("a track along a chain of tracks at distance exactly ρ is supported though no single one holds it") {
    const Layer upper = only_tracks({{{0, rho}, {200000, rho}}});
    supported(verify(upper, below({{{0, 0}, {90000, 0}}, {{90000, 0}, {200000, 0}}}), how));
    unsupported(verify(upper, below({{{0, 0}, {90000, 0}}, {{90000, -1}, {200000, -1}}}), how));
    unsupported(verify(upper, below({{{0, 0}, {90000, 0}}, {{90001, 0}, {200000, 0}}}), how));
}

TEST_CASE("slanted tracks that overlap on a line of irrational direction hold up what one long track would") {
    const Layer lower = below({{{-300000, -300000}, {20000, 20000}}, {{-20000, -20000}, {300000, 300000}}});
    const Layer upper = only_tracks({{{-280000, -280000}, {280000, 280000}}});
    const LayerVerdict v = verify(upper, lower, how);
    supported(v);
    unsupported(verify(island(50000), lower, how));
    // 28284.27 = 20000 times the square root of 2: the island's corners are in the strip, then outside.
    const LayerVerdict in = verify(island(28284), lower, how), out = verify(island(28285), lower, how);
    supported(in);
    unsupported(out);
}

TEST_CASE("an edge of material exactly on a slanted offset line is supported") {
    // Direction (3, 4), offset 40000 = 5 * 8000: the offset line passes through lattice points.
    const Segment track{{-300000, -400000}, {300000, 400000}};
    const Contour strip{{-24000 + 32000, -32000 - 24000},
                        {24000 + 32000, 32000 - 24000},
                        {24000 - 32000, 32000 + 24000},
                        {-24000 - 32000, -32000 + 24000}};
    Contour wider = strip;
    for (int i : {0, 1}) wider[static_cast<std::size_t>(i)].x += 1;
    const LayerVerdict v = verify(layer({frame}, {square(wide), reversed(strip)}), below({track}), how);
    supported(v);
    CHECK(stage(v) == intervals);  // the root of 3^2 + 4^2 has no rounding either
    unsupported(verify(layer({frame}, {square(wide), reversed(wider)}), below({track}), how));
}

TEST_CASE("discs through one point: covered exactly when every direction is") {
    const Layer upper = island(3000);
    supported(verify(upper, below({disc(40000, 0), disc(-24000, 32000), disc(-24000, -32000)}), how));
    unsupported(verify(upper, below({disc(40000, 0), disc(24000, 32000), disc(24000, -32000)}), how));
    unsupported(verify(upper, below({disc(40000, 0), disc(-40000, 0), disc(0, 40000)}), how));
    supported(verify(upper, below({disc(40000, 0), disc(-40000, 0), disc(0, 40000), disc(0, -40000)}), how));
    unsupported(verify(upper, below({disc(40000, 0), disc(-24001, 32000), disc(-24000, -32000)}), how));
}

TEST_CASE("tangent discs leave a cusp, however small the material between them") {
    const LayerVerdict cusp = verify(island(100), below({disc(-40000, 0), disc(40000, 0)}), how);
    unsupported(cusp);
    CHECK(cusp.internal->area_hi < 1e-6);
    supported(verify(island(100), below({disc(-39999, 0), disc(39999, 0)}), how));
    unsupported(verify(island(300), below({disc(-39999, 0), disc(39999, 0)}), how));
}

TEST_CASE("parallel tracks whose strips touch on a line cover it, and leave a cusp at their ends") {
    const std::vector<Segment> two{{{-200000, 40000}, {200000, 40000}}, {{200000, -40000}, {-200000, -40000}}};
    supported(verify(island(30000), below(two), how));
    const auto at_end = [](Unit to) {
        return layer({frame}, {square(wide), reversed(rectangle(150000, -50, to, 50))});
    };
    supported(verify(at_end(200000), below(two), how));
    unsupported(verify(at_end(200001), below(two), how));
    const std::vector<Segment> apart{{{-200000, 40001}, {200000, 40001}}, {{200000, -40000}, {-200000, -40000}}};
    unsupported(verify(island(30000), below(apart), how));
}

TEST_CASE("coincident, reversed and overlapping tracks count once") {
    const std::vector<Segment> tracks{{{0, 0}, {100000, 30000}}, {{100000, 30000}, {0, 0}}, {{0, 0}, {100000, 30000}}};
    supported(verify(only_tracks(tracks), below(tracks), how));
    supported(verify(only_tracks(tracks), below({tracks[1]}), how));
    unsupported(
        verify(only_tracks(tracks), below({{{0, 0}, {99998, 30000}}, {{0, 0}, {50000, 15000}}}), settings(rho, 1)), 1);
}

TEST_CASE("a track of length zero is a disc") {
    const Layer lower = below({disc(0, 0)});
    supported(verify(only_tracks({disc(0, 0)}), lower, how));
    supported(verify(only_tracks({disc(12000, 16000)}), lower, how));
    unsupported(verify(only_tracks({disc(12000, 16001)}), lower, how));
    unsupported(verify(only_tracks({{{0, 0}, {rho + 1, 0}}}), lower, how));
    unsupported(verify(only_tracks({disc(0, 0)}), below({}), how));
}

TEST_CASE("a cavity that recedes by exactly ρ is supported everywhere, by one unit more it is not") {
    const Contour el{{0, 0}, {wide, 0}, {wide, 400000}, {400000, 400000}, {400000, wide}, {0, wide}};
    const auto inset = [](Unit by, bool cut) {
        Contour c{{by, by}, {wide - by, by}, {wide - by, 400000 - by}};
        if (cut) {
            c.push_back({400000, 400000 - by});
            c.push_back({400000 - by, 400000});
        } else {
            c.push_back({400000 - by, 400000 - by});
        }
        c.push_back({400000 - by, wide - by});
        c.push_back({by, wide - by});
        return c;
    };
    const Layer lower = layer({frame}, {el});
    const LayerVerdict tie = verify(layer({frame}, {inset(rho, true)}), lower, how);
    supported(tie);
    CHECK(stage(tie) == intervals);
    unsupported(verify(layer({frame}, {inset(rho + 1, true)}), lower, how));
    supported(verify(layer({frame}, {inset(rho - 1, true)}), lower, how));
    // A mitred reflex corner lies outside the disc about it: what is missing is ρ^2 (1 - π/4).
    const LayerVerdict mitre = verify(layer({frame}, {inset(rho, false)}), lower, how);
    unsupported(mitre);
    area_is(*mitre.internal, 0.04 * (1 - std::numbers::pi / 4));
}

TEST_CASE("a flat roof over an empty cavity is unsupported, with its area") {
    const LayerVerdict v = verify(layer({frame}, {}), below({}), how);
    unsupported(v);
    area_is(*v.internal, 19.6 * 19.6);
    CHECK(v.internal->area_hi - v.internal->area_lo < 0.02 * 384.16);
    CHECK(v.internal->witness_distance > 1);
    CHECK(!v.external);
    CHECK(stage(v) == intervals);
}

TEST_CASE("a slot of width 2ρ needs no support, one of a unit more does") {
    const Layer roof = layer({frame}, {});
    supported(verify(roof, layer({frame}, {rectangle(0, 0, 2 * rho, wide)}), how));
    const LayerVerdict v = verify(roof, layer({frame}, {rectangle(0, 0, 2 * rho + 1, wide)}), how);
    unsupported(v);
    area_is(*v.internal, 960000e-10);
    // Turned by the angle of (3, 4), width 40000 = 5 * 8000.
    const Contour turned{{0, 0}, {300000, 400000}, {300000 - 32000, 400000 + 24000}, {-32000, 24000}};
    supported(verify(roof, layer({frame}, {turned}), how));
    supported(verify(roof, layer({frame}, {turned}), settings(rho, rho + 1)));
    unsupported(verify(roof, layer({frame}, {turned}), settings(rho, rho - 1)), rho - 1);
}

TEST_CASE("without covers the slice above may leave the cavity open") {
    const Layer lower = layer({frame}, {square(wide)});
    supported(verify(layer({rectangle(wide - rho, -wide, wide + 300000, wide)}, {}), lower, how));
    const LayerVerdict v = verify(layer({rectangle(wide - 50000, -wide, wide + 300000, wide)}, {}), lower, how);
    unsupported(v);
    area_is(*v.internal, 0.3 * 19.6);
}

TEST_CASE("an external overhang is named with its area and does not refute the layer") {
    const Layer lower = layer({square(500000)}, {square(400000)});
    const LayerVerdict v = verify(layer({rectangle(-450000, -500000, 600000, 500000)}, {square(400000)}), lower, how);
    supported(v);
    REQUIRE(v.external);
    area_is(*v.external, 8.0);
    CHECK(v.external->area_hi - v.external->area_lo < 1);
    CHECK(v.external->witness_certified);
    CHECK(v.external->witness_distance >= 0.2 - 1e-12);
    CHECK(v.external->witness[0] > 5.2);
    CHECK(
        !verify(layer({square(520000)}, {square(400000)}), layer({square(500000)}, {}), settings(rho, 28285)).external);
    CHECK(
        verify(layer({square(520000)}, {square(400000)}), layer({square(500000)}, {}), settings(rho, 28284)).external);
}

TEST_CASE("what the cavity above leaves empty is no overhang") {
    // Without covers the cavity above may reach beyond the slice below; only its shell hangs out.
    const LayerVerdict v = verify(layer({square(600000)}, {square(560000)}), layer({square(500000)}, {}), how);
    REQUIRE(v.external);
    area_is(*v.external, 12.0 * 12.0 - 11.2 * 11.2);
}

TEST_CASE("a track may cross an island of shell between two tracks below") {
    const Region cavity{square(wide), reversed(square(100000))};
    const Layer upper = layer({frame}, {square(wide)}, {{{-500000, 0}, {500000, 0}}});
    const Segment left{{-500000, 0}, {-100000, 0}}, right{{100000, 0}, {500000, 0}};
    supported(verify(upper, layer({frame}, cavity, {left, right}), how));
    const LayerVerdict v = verify(upper, layer({frame}, cavity, {left}), how);
    unsupported(v);
    CHECK(v.internal->witness[0] > 1.2);
}

TEST_CASE("cavity contours may touch, and an edge between two of them is no wall") {
    const Layer roof = layer({frame}, {});
    const Contour slot = rectangle(0, 0, 2 * rho, wide), next = rectangle(2 * rho, 0, 4 * rho, wide / 2);
    supported(verify(roof, layer({frame}, {slot}), how));
    unsupported(verify(roof, layer({frame}, {slot, next}), how));
    const Contour corner = rectangle(2 * rho, wide, 4 * rho, wide + 5 * rho);
    supported(verify(roof, layer({frame}, {slot, corner}), how));
    // A contour inside another one of the same orientation is no wall either.
    unsupported(verify(roof, layer({frame}, {square(100000), square(90000)}), how));
}

TEST_CASE("a cavity that is no cavity of its slice is refused with the place") {
    const Layer good = layer({frame}, {square(wide)});
    const Layer ring{layer({frame, reversed(square(200000))}, {square(wide)})};
    for (const Layer& bad :
         {layer({frame}, {square(1600000)}), layer({frame}, {square(1500000)}),
          layer({frame}, {rectangle(0, 0, 1500001, 100)}), layer({frame}, {rectangle(2000000, 0, 2100000, 100000)}),
          ring, layer({frame}, {{{0, 0}, {100000, 100001}, {100000, 0}, {0, 100000}}})}) {
        for (const LayerVerdict& v : {verify(bad, good, how), verify(good, bad, how)}) {
            CHECK(!v.supported);
            CHECK(v.malformed.find("layer ") == 0);
            CHECK(v.malformed.find("mm") != std::string::npos);
        }
        CHECK(verify(bad, good, how).malformed.substr(0, 7) == "layer 1");
        CHECK(verify(good, bad, how).malformed.substr(0, 7) == "layer 0");
    }
}

TEST_CASE("where a cavity lies is right though corners of outlines lie at the height of its first corner") {
    const auto diamond = [](Unit x, Unit y, Unit half) {
        return Contour{{x + half, y}, {x, y + half}, {x - half, y}, {x, y - half}};
    };
    const auto malformed = [&](Region outline, Region cavity) {
        const Layer l{layer(std::move(outline), std::move(cavity))}, none = layer({frame}, {square(wide)});
        return verify(none, l, how).malformed;
    };
    // Corners of the outline itself, the lowest and the highest corner of islands beside it, and one on its level.
    const Contour own = diamond(0, 0, 900000), above = diamond(3000000, 900000, 900000),
                  under = diamond(5000000, -900000, 900000), level = diamond(8000000, 0, 900000);
    for (const Region& outline : {Region{own}, Region{own, above}, Region{own, under}, Region{own, level},
                                  Region{own, above, under, level}, Region{own, reversed(diamond(600000, 0, 100000))}})
        CHECK(malformed(outline, {diamond(0, 0, 300000)}) == "");
    for (const Contour& outside :
         {diamond(-2000000, 0, 300000), diamond(1300000, 0, 300000), diamond(4000000, 0, 90000)})
        CHECK(malformed({own, above, under, level}, {outside}).find("leaves the outline") != std::string::npos);
    // The outline's hole at the height of corners of the cavity.
    CHECK(malformed({own, reversed(diamond(0, 0, 100000))}, {diamond(0, 0, 300000)}).find("hole") != std::string::npos);
    CHECK(malformed({own, reversed(diamond(-500000, 0, 100000))}, {diamond(0, 0, 300000)}) == "");
}

TEST_CASE("settings without a radius and missing geometry are usage errors") {
    const Layer l = layer({frame}, {});
    CHECK_THROWS_AS(verify(l, l, settings(rho, 0)), Error);
    Settings odd = how;
    odd.support_width = 40001;
    CHECK_THROWS_AS(verify(l, l, odd), Error);
    CHECK_THROWS_AS(verify_layer(1, LayerGeometry{}, view(l), how), Error);
    CHECK_THROWS_AS(verify(only_tracks({{{0, 0}, {lattice_bound + 1, 0}}}), l, how), Error);
}

TEST_CASE("nothing over nothing is supported") {
    const Layer none = layer({}, {}), some = layer({frame}, {square(wide)});
    CHECK(verify(none, some, how).supported);
    CHECK(verify(none, none, how).supported);
    const LayerVerdict v = verify(some, none, how);
    CHECK(v.supported);
    REQUIRE(v.external);
    area_is(*v.external, 30.0 * 30.0 - 20.0 * 20.0);
}

TEST_CASE("sums of bounds are bounds of the sum") {
    Enclosure sum;
    Rational exact;
    for (int k = 1; k <= 1000; ++k) {
        const Rational third(k, 3);
        const double below = third.get_d();  // truncated
        sum += {below, std::nextafter(below, 1e9)};
        exact += third;
        REQUIRE(Rational(sum.lo) <= exact);
        REQUIRE(Rational(sum.hi) >= exact);
    }
    CHECK(sum.hi - sum.lo < 1e-6);
    const Enclosure one{1.1, 1.3}, none;
    CHECK(Enclosure(one) == (Enclosure(none) += one));
}

TEST_CASE("several threads get the same verdicts") {
    const Layer lower = below({{{-300000, -300000}, {20000, 20000}}, {{-20000, -20000}, {300000, 300000}}});
    const Layer upper = only_tracks({{{-280000, -280000}, {280000, 280000}}}), roof = island(50000);
    std::vector<int> agree(4, 0);
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < agree.size(); ++t)
        threads.emplace_back([&, t] {
            for (int i = 0; i < 20; ++i)
                agree[t] += verify(upper, lower, how).supported && !verify(roof, lower, how).supported;
        });
    for (std::thread& t : threads) t.join();
    CHECK(std::count(agree.begin(), agree.end(), 20) == 4);
}
