// External overhangs: which stretches of centre lines lie outside the outline below.
#include "ribvault/verify/outside_outline.hpp"

#include <catch2/catch.hpp>
#include <random>

using namespace ribvault;

namespace {

PrintedTrack piece(PrintedPoint a, PrintedPoint b, bool outline = false) {
    return {a, b, Rational(2, 5), 0, 0, outline};
}

PrintedLayer loop(const std::vector<PrintedPoint>& points) {
    PrintedLayer layer;
    for (std::size_t k = 0; k < points.size(); ++k)
        layer.tracks.push_back(piece(points[k], points[(k + 1) % points.size()], true));
    return layer;
}

PrintedLayer above(std::vector<PrintedTrack> tracks) {
    PrintedLayer layer;
    layer.tracks = std::move(tracks);
    return layer;
}

}  // namespace

TEST_CASE("a track is cut exactly where it crosses the outline") {
    const PrintedLayer lower = loop({{0, 0}, {3, 0}, {3, 3}, {0, 3}});
    const auto outside = stretches_outside(above({piece({1, 1}, {4, 2})}), lower);
    REQUIRE(outside.size() == 1);
    CHECK(outside[0].a == PrintedPoint{3, Rational(5, 3)});
    CHECK(outside[0].b == PrintedPoint{4, 2});
    PrintedLayer wide = above({piece({1, 1}, {4, 2})});
    wide.tracks[0].width = 7 * lower.tracks[0].width;
    CHECK(stretches_outside(wide, lower)[0].width == lower.tracks[0].width);
    PrintedLayer uneven = lower;
    uneven.tracks[1].width = Rational(3, 10), uneven.tracks[2].width = Rational(1, 2);
    CHECK(stretches_outside(wide, uneven)[0].width == Rational(3, 10));
    const auto extruded = extruded_outside(wide, lower);
    REQUIRE(extruded.size() == 1);
    CHECK(extruded[0].a == outside[0].a);
    CHECK(extruded[0].width == wide.tracks[0].width);
    CHECK(stretches_outside(above({piece({1, 1}, {2, 2})}), lower).empty());
    CHECK(stretches_outside(above({piece({5, 5}, {6, 6})}), lower).size() == 1);
    CHECK(stretches_outside(above({piece({-1, 1}, {4, 1})}), lower).size() == 2);
}

TEST_CASE("an offset of 10^-30 from the outline decides") {
    const PrintedLayer lower = loop({{0, 0}, {3, 0}, {3, 3}, {0, 3}});
    const Rational tiny(mpz_class(1), mpz_class("1000000000000000000000000000000"));
    CHECK(stretches_outside(above({piece({3 + tiny, 1}, {3 + tiny, 2})}), lower).size() == 1);
    CHECK(stretches_outside(above({piece({3 - tiny, 1}, {3 - tiny, 2})}), lower).empty());
    CHECK(stretches_outside(above({piece({3 + tiny, 1}, {3 + tiny, 1})}), lower).size() == 1);  // a dot
}

TEST_CASE("holes are outside, and an outline that does not close is none") {
    PrintedLayer lower = loop({{0, 0}, {9, 0}, {9, 9}, {0, 9}});
    const PrintedLayer hole = loop({{3, 3}, {3, 6}, {6, 6}, {6, 3}});
    lower.tracks.insert(lower.tracks.end(), hole.tracks.begin(), hole.tracks.end());
    const auto outside = stretches_outside(above({piece({1, 4}, {8, 4})}), lower);
    REQUIRE(outside.size() == 1);
    CHECK(outside[0].a == PrintedPoint{3, 4});
    CHECK(outside[0].b == PrintedPoint{6, 4});
    lower.tracks.pop_back();
    const auto whole = stretches_outside(above({piece({1, 4}, {8, 4})}), lower);
    REQUIRE(whole.size() == 1);
    CHECK(whole[0].a == PrintedPoint{1, 4});
    CHECK(whole[0].b == PrintedPoint{8, 4});
}

TEST_CASE(
    "pieces agree with even-odd counting in rationals on coarse lattices, where tracks run over corners and sides") {
    std::mt19937_64 random(7);
    const auto coordinate = [&] { return Rational(static_cast<long>(random() % 7)); };
    for (int round = 0; round < 3000; ++round) {
        std::vector<PrintedPoint> points;
        for (std::size_t k = 0; k < 3 + random() % 4; ++k) points.push_back({coordinate(), coordinate()});
        const PrintedLayer lower = loop(points);
        const PrintedTrack track = piece({coordinate(), coordinate()}, {coordinate(), coordinate()});
        if (track.a == track.b) continue;
        const auto outside = stretches_outside(above({track}), lower);
        for (int part = 1; part < 40; ++part) {
            const Rational t(2 * part + 1, 82);
            const PrintedPoint p{track.a[0] + t * (track.b[0] - track.a[0]),
                                 track.a[1] + t * (track.b[1] - track.a[1])};
            bool odd = false, on = false;
            for (const PrintedTrack& e : lower.tracks) {
                const Rational c = (e.b[0] - e.a[0]) * (p[1] - e.a[1]) - (e.b[1] - e.a[1]) * (p[0] - e.a[0]);
                on = on || (c == 0 && (p[0] - e.a[0]) * (p[0] - e.b[0]) <= 0 && (p[1] - e.a[1]) * (p[1] - e.b[1]) <= 0);
                if ((e.a[1] > p[1]) == (e.b[1] > p[1])) continue;
                if (p[0] < e.a[0] + (p[1] - e.a[1]) * (e.b[0] - e.a[0]) / (e.b[1] - e.a[1])) odd = !odd;
            }
            if (on) continue;
            const bool found = std::any_of(outside.begin(), outside.end(), [&](const PrintedTrack& s) {
                return (p[0] - s.a[0]) * (p[0] - s.b[0]) <= 0 && (p[1] - s.a[1]) * (p[1] - s.b[1]) <= 0;
            });
            CHECK(found == !odd);
        }
    }
}
