// Slices whose vertices come as lazy exact numbers with wide enclosures: exact values count, whatever the enclosure.
#include <catch2/catch.hpp>
#include <random>

#include "layers.hpp"
#include "ribvault/exact/rational.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

using Exact = ExactKernel::FT;

/// `mm` exactly, with an enclosure about as wide as the last place of `detour`.
Exact wide(double mm, double detour) { return (Exact(mm) + Exact(detour)) - Exact(detour); }

ExactPolygon wide_rectangle(double x0, double y0, double x1, double y1, double detour) {
    const auto at = [&](double x, double y) { return ExactKernel::Point_2(wide(x, detour), wide(y, detour)); };
    ExactPolygon polygon;
    polygon.push_back(at(x0, y0)), polygon.push_back(at(x1, y0)), polygon.push_back(at(x1, y1)),
        polygon.push_back(at(x0, y1));
    return polygon;
}

}  // namespace

TEST_CASE("a verdict depends on the exact slice, not on how wide the enclosures of its lazy numbers are") {
    const Settings how = settings(20000, 20000);
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> far(1, 9);
    for (const double detour : {1.0, 1e6, 1e9, 1e12, 1e14, 1e16, 3e16, 1e17, 1e18})
        for (int k = 0; k < 20; ++k) {
            // Above: [-10, 10]^2. Below: the same up to x, which holds up what is above it to x + 0.2.
            const double x = far(random);
            INFO("right end " << x << " detour " << detour);
            Layer above, tie, gone;
            above.exact.polygons.emplace_back(wide_rectangle(-10, -10, x + 0.125, 10, detour));
            tie.exact.polygons.emplace_back(wide_rectangle(-10, -10, x, 10, detour));
            gone.exact.polygons.emplace_back(wide_rectangle(-10, -10, x - 0.25, 10, detour));
            CHECK(!verify(above, tie, how).external);
            CHECK(verify(above, gone, how).external);
        }
}

TEST_CASE("an island a hair too far from the track below is found whatever the enclosures of its corners") {
    const Settings how = settings(16384, 16384);
    Layer below = layer({square(2000000)}, {square(1500000)}, {});
    for (const double detour : {1.0, 1e3, 1e6, 1e8, 1e10, 1e12, 1e15, 1e17}) {
        INFO("detour " << detour);
        // The cavity's left side is at x = -15 mm; the island may reach to -15 + 0.16384.
        for (const double over : {-1e-9, -1e-12, 1e-12, 1e-9}) {
            Layer above;
            above.exact.polygons.emplace_back(wide_rectangle(-15.5, -1, -15 + 0.16384 + over, 1, detour));
            const bool held = Rational(-15 + 0.16384 + over) <= Rational(-15) + Rational(16384, 100000);
            CHECK(verify(above, below, how).supported == held);
        }
    }
}
