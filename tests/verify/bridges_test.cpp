#include "ribvault/verify/bridges.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace ribvault;

namespace {

const Rational radius(1, 5), width(2, 5);

PrintedTrack track(double x0, double y0, double x1, double y1) {
    return {{Rational(x0), Rational(y0)}, {Rational(x1), Rational(y1)}, width, 0, 0};
}

/// Piers from x = 0 to 2 and from x = 8 to 10.
PrintedLayer piers() { return {{track(0, 0, 2, 0), track(8, 0, 10, 0)}}; }

std::vector<Bridge> bridges(const PrintedLayer& upper, const std::vector<char>& continues, const Rational& longest,
                            const std::vector<char>& judged = {}) {
    PrintedOptions lines;
    lines.areas = lines.regions = false;
    lines.judged = judged;
    return find_bridges(upper, continues, judged, verify_printed(upper, piers(), radius, lines), longest);
}

}  // namespace

TEST_CASE("a straight span between two piers is a bridge up to its length", "[bridges]") {
    const PrintedLayer upper{{track(0, 0, 10, 0)}};
    CHECK(bridges(upper, {0}, 6)[0].length_mm == Approx(5.2));
    CHECK(bridges(upper, {0}, Rational(26, 5)).size() == 1);
    CHECK(bridges(upper, {0}, Rational(Rational(26, 5) - power_of_two(-150))).empty());
}

TEST_CASE("a span exactly as long as the limit is a bridge, wherever it lies", "[bridges]") {
    for (const double x : {0.0, 0.1, 37.3, 123.456})
        for (const double limit : {0.1, 1.7, 5.0}) {
            const Rational from = Rational(x), to = from + 2 + Rational(limit) + 2 * (radius + width / 2) + 2;
            const PrintedLayer upper{{{{from, 0}, {to, 0}, width, 0, 0}}},
                lower{{{{from, 0}, {from + 2, 0}, width, 0, 0}, {{to - 2, 0}, {to, 0}, width, 0, 0}}};
            PrintedOptions lines;
            lines.areas = lines.regions = false;
            const PrintedVerdict verdict = verify_printed(upper, lower, radius, lines);
            CAPTURE(x, limit);
            CHECK(find_bridges(upper, {0}, {}, verdict, Rational(limit)).size() == 1);
            CHECK(find_bridges(upper, {0}, {}, verdict, Rational(Rational(limit) - power_of_two(-150))).empty());
        }
}

TEST_CASE("a slanted span is measured to many digits", "[bridges]") {
    // Along (1, 1): the span is 6 sqrt(2) less both reaches of 0.4, an irrational length.
    const PrintedLayer upper{{track(0, 0, 10, 10)}}, lower{{track(0, 0, 2, 2), track(8, 8, 10, 10)}};
    PrintedOptions lines;
    lines.areas = lines.regions = false;
    const PrintedVerdict verdict = verify_printed(upper, lower, radius, lines);
    const mpf_class exact = 6 * sqrt(mpf_class(2, 400)) - mpf_class("0.8", 400);
    const Rational close(exact), hair = power_of_two(-150);
    CHECK(find_bridges(upper, {0}, {}, verdict, Rational(close + hair)).size() == 1);
    CHECK(find_bridges(upper, {0}, {}, verdict, Rational(close - hair)).empty());
}

TEST_CASE("a bridge may have joints, if it is straight", "[bridges]") {
    const PrintedLayer straight{{track(0, 0, 4, 0), track(4, 0, 6, 0.005), track(6, 0.005, 10, 0)}};
    REQUIRE(bridges(straight, {0, 1, 1}, 6).size() == 1);
    CHECK(bridges(straight, {0, 1, 1}, 6)[0].pieces.size() == 3);
    CHECK(bridges(straight, {0, 0, 1}, 6).empty());  // a travel between: two free ends
    const PrintedLayer bent{{track(0, 0, 5, 0.1), track(5, 0.1, 10, 0)}};
    CHECK(bridges(bent, {0, 1}, 6).empty());
    const PrintedLayer back{{track(0, 0, 5, 0), track(5, 0, 4, 0), track(4, 0, 10, 0)}};
    CHECK(bridges(back, {0, 1, 1}, 20).empty());
}

TEST_CASE("a cantilever is no bridge", "[bridges]") {
    CHECK(bridges({{track(0, 0, 6, 0)}}, {0}, 100).empty());
    CHECK(bridges({{track(6, 0, 0, 0)}}, {0}, 100).empty());
    CHECK(bridges({{track(3, 0, 6, 0)}}, {0}, 100).empty());
    CHECK(bridges({{track(0, 5, 10, 5)}}, {0}, 100).empty());
    CHECK(bridges({{track(5, 0, 5, 0)}}, {0}, 100).empty());  // a dot in the air
}

TEST_CASE("a track that is not judged holds no bridge", "[bridges]") {
    const PrintedLayer upper{{track(0, 0, 2.4, 0), track(2.4, 0, 10, 0)}};
    CHECK(bridges(upper, {0, 1}, 6).size() == 1);
    CHECK(bridges(upper, {0, 1}, 6, {0, 1}).size() == 1);  // 2.4 as a double is below 12/5: a hair of it is held up
    const Rational edge(12, 5);
    const PrintedLayer exactly{{{{0, 0}, {edge, 0}, width, 0, 0}, {{edge, 0}, {10, 0}, width, 0, 0}}};
    CHECK(bridges(exactly, {0, 1}, 6).size() == 1);
    CHECK(bridges(exactly, {0, 1}, 6, {0, 1}).empty());
    const PrintedLayer late{{track(0, 0, 3, 0), track(3, 0, 10, 0)}};
    CHECK(bridges(late, {0, 1}, 6).size() == 1);
    CHECK(bridges(late, {0, 1}, 6, {0, 1}).empty());
    const PrintedLayer early{{track(0, 0, 7, 0), track(7, 0, 10, 0)}};
    CHECK(bridges(early, {0, 1}, 6).size() == 1);
    CHECK(bridges(early, {0, 1}, 6, {1, 0}).empty());
}

TEST_CASE("what is left without a bridge is held up and lies on the track", "[bridges]") {
    // Of one track, with joints over the air, and with joints less than a width before the air.
    for (const double joint : {0.0, 2.5, 2.2}) {
        const bool joined = joint > 0;
        const PrintedLayer upper =
            joined ? PrintedLayer{{track(0, 0, joint, 0), track(joint, 0, 10 - joint, 0), track(10 - joint, 0, 10, 0)}}
                   : PrintedLayer{{track(0, 0, 10, 0)}};
        const std::vector<char> continues = joined ? std::vector<char>{0, 1, 1} : std::vector<char>{0};
        PrintedOptions lines;
        lines.areas = lines.regions = false;
        const PrintedVerdict verdict = verify_printed(upper, piers(), radius, lines);
        const auto found = find_bridges(upper, continues, {}, verdict, 6);
        REQUIRE(found.size() == 1);
        const PrintedLayer left = take_out_bridges(upper, continues, verdict, found);
        REQUIRE(left.tracks.size() == 2);
        CHECK(verify_printed(left, piers(), radius).supported);
        CHECK(left.tracks[0].a == upper.tracks[0].a);
        CHECK(left.tracks[0].b[0].get_d() == Approx(2.4 - 0.4));  // one width less than what is held up
        CHECK(left.tracks[1].a[0].get_d() == Approx(7.6 + 0.4));
        CHECK(left.tracks[1].b == upper.tracks.back().b);
    }
}
