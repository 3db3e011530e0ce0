// Slits and slivers finer than the lattice: found, removed, and nothing else changed.
#include "ribvault/slice/slivers.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "ribvault/slice/cavity.hpp"
#include "ribvault/slice/nest_contours.hpp"

using namespace ribvault;

namespace {

ExactContour contour(std::initializer_list<std::array<double, 2>> corners) {
    ExactContour all;
    for (const auto& [x, y] : corners) all.emplace_back(x, y);
    return all;
}

/// A rectangle from (x0, y0) to (x1, y1), turned by an angle.
ExactContour rectangle(double x0, double y0, double x1, double y1, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    const auto at = [&](double x, double y) { return std::array{50 + c * x - s * y, 50 + s * x + c * y}; };
    return contour({at(x0, y0), at(x1, y0), at(x1, y1), at(x0, y1)});
}

Slice slice_of(const std::vector<ExactContour>& contours) {
    Slice slice;
    set_contours(slice, contours);
    return slice;
}

double area_mm2(const Region& region) { return signed_area(region) / (1e10); }

}  // namespace

TEST_CASE("parts that touch but for rounding are one, whatever their angle", "[slivers]") {
    int found = 0;
    for (int k = 0; k < 90; ++k) {
        INFO(k);
        const double angle = 0.07 * k;
        const Slice slice = slice_of({rectangle(0, 0, 20, 20, angle), rectangle(20, 5, 28, 13, angle)});
        const bool slivers = has_slivers(slice);
        found += slivers;
        const Slice clean = slivers ? without_slivers(slice) : slice;  // rounding has joined the parts in some
        CHECK(clean.slivers_removed == slivers);
        CHECK_FALSE(has_slivers(clean));
        CHECK(clean.rounded.size() == 1);
        CHECK(area_mm2(clean.rounded) == Approx(464).epsilon(5e-6));
        // The cavity of one solid, 0.4 mm in: the parts' own walls are not between them.
        CHECK(area_mm2(erode_slice(clean, Settings())) == Approx(464 - 0.4 * 96 + 0.16 * (8 - 2 * 2)).margin(0.2));
    }
    CHECK(found > 40);
}

TEST_CASE("a gap that the lattice does not tell is closed, one that it does stays", "[slivers]") {
    for (const double gap : {1e-12, 1e-9, 3e-6, 1e-5, 2e-4}) {
        INFO(gap);
        const Slice slice = slice_of({rectangle(0, 0, 10, 10, 0.3), rectangle(10 + gap, 0, 20, 10, 0.3)});
        CHECK(has_slivers(slice));
        CHECK(without_slivers(slice).rounded.size() == 1);
    }
    const Slice apart = slice_of({rectangle(0, 0, 10, 10, 0.3), rectangle(10.002, 0, 20, 10, 0.3)});
    CHECK_FALSE(has_slivers(apart));
    CHECK(without_slivers(apart).rounded.size() == 2);
}

TEST_CASE("sharp corners elsewhere keep their tips", "[slivers]") {
    for (const double degrees : {90.0, 20.0, 5.0, 1.0, 0.2})
        for (int k = 0; k < 20; ++k) {
            const double half = degrees * M_PI / 360, turn = 0.3 * k;
            const auto at = [&](double along, double angle) {
                return std::pair{50 + along * std::cos(turn + angle), 40 + along * std::sin(turn + angle)};
            };
            const auto [x, y] = at(10, half);
            const auto [u, v] = at(10, -half);
            const Slice slice = slice_of({rectangle(0, 0, 10, 10, 0.3), rectangle(10.0001, 0, 20, 10, 0.3),
                                          contour({{50, 40}, {u, v}, {x, y}})});
            REQUIRE(has_slivers(slice));
            double off = HUGE_VAL;
            for (const Contour& c : without_slivers(slice).rounded)
                for (const Point p : c) off = std::min(off, length(p - Point{5000000, 4000000}));
            INFO(degrees << " " << k << " " << off);
            CHECK(off < 2 / std::sin(half) + 2);  // units: its sides are at most so much off
        }
}

TEST_CASE("contours without area and spikes go, whatever their orientation", "[slivers]") {
    for (const bool below : {false, true}) {
        // The lowest contour tells Clipper what is inside.
        const double y = below ? 40 : 55;
        const Slice slice = slice_of({rectangle(0, 0, 10, 10, 0), contour({{45, y}, {48, y}, {46, y + 1e-5}}),
                                      contour({{30, 30}, {31, 30}, {30.5, 30 + 1e-9}})});
        CHECK(has_slivers(slice));
        const Slice clean = without_slivers(slice);
        CHECK(clean.rounded.size() == 1);
        CHECK(area_mm2(clean.rounded) == Approx(100).epsilon(1e-6));
        CHECK_FALSE(has_slivers(clean));
    }
    // Rounding turns over contours without area.
    for (const Unit at : {Unit{-5000}, Unit{1005000}})
        for (const bool turned : {false, true}) {
            INFO(at << " " << turned);
            Slice slice;
            slice.rounded = {{{0, 0}, {1000000, 0}, {1000000, 1000000}, {0, 1000000}},
                             {{100, at}, {600, at}, {300, at + 1}}};
            if (turned) std::reverse(slice.rounded[1].begin(), slice.rounded[1].end());
            CHECK(has_slivers(slice));
            CHECK(area_mm2(without_slivers(slice).rounded) == Approx(100).epsilon(1e-6));
        }
    const Slice spike =
        slice_of({contour({{0, 0}, {10, 0}, {10, 4}, {17, 4 + 1e-9}, {10, 4 + 1e-8}, {10, 10}, {0, 10}})});
    CHECK(has_slivers(spike));
    CHECK(area_mm2(without_slivers(spike).rounded) == Approx(100).epsilon(1e-6));
    CHECK_FALSE(has_slivers(without_slivers(spike)));
}

TEST_CASE("a slit is closed however short it is; a part that the lattice does not tell from a point goes",
          "[slivers]") {
    // 0.2 um wide, 0.5 mm deep.
    const Slice slit =
        slice_of({contour({{0, 0}, {10, 0}, {10, 10}, {5 + 2e-4, 10}, {5 + 2e-4, 9.5}, {5, 9.5}, {5, 10}, {0, 10}})});
    CHECK(has_slivers(slit));
    CHECK(area_mm2(without_slivers(slit).rounded) == Approx(100).epsilon(1e-7));
    const Slice speck = slice_of({rectangle(0, 0, 10, 10, 0.3), contour({{30, 30}, {30 + 1e-9, 30}, {30, 30 + 1e-9}})});
    CHECK(speck.exact->polygons.size() == 2);
    CHECK(has_slivers(speck));
    CHECK(without_slivers(speck).exact->polygons.size() == 1);
}

TEST_CASE("what is wider than a micrometre has no slivers, however short its edges and sharp its corners",
          "[slivers]") {
    ExactContour fine;  // a circle of edges of 0.06 um, and a tip
    for (int k = 0; k < 100; ++k)
        fine.emplace_back(40 + 1e-3 * std::cos(2 * M_PI * k / 100), 40 + 1e-3 * std::sin(2 * M_PI * k / 100));
    CHECK_FALSE(has_slivers(slice_of({fine})));
    CHECK_FALSE(has_slivers(slice_of({contour({{0, 0}, {10, 0}, {10, 0.05}})})));
    CHECK_FALSE(has_slivers(slice_of({contour({{0, 0}, {10, 0}, {10, 0.5}, {0, 2e-4}})})));
    CHECK_FALSE(has_slivers(slice_of({rectangle(0, 0, 10, 0.002, 0.4)})));
    CHECK_FALSE(has_slivers(slice_of({rectangle(0, 0, 10, 10, 0.4)})));
    CHECK_FALSE(has_slivers(Slice()));
}
