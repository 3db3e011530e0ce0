// How long a verdict takes; printed, not asserted.
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <iostream>
#include <numbers>

#include "layers.hpp"
#include "printed_layers.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

// A wavy ring of n vertices, all coordinates off the round numbers.
Contour ring(double radius_mm, int n) {
    Contour c;
    for (int i = 0; i < n; ++i) {
        const double t = 2 * std::numbers::pi * i / n, r = radius_mm * (1 + 0.05 * std::sin(7 * t));
        c.push_back({round_to_lattice(r * std::cos(t) * 1e5), round_to_lattice(r * std::sin(t) * 1e5)});
    }
    return c;
}

// Zigzag tracks over a square, `columns` of them 0.7 mm apart, segments of about 0.8 mm.
std::vector<Segment> comb(int columns, int rows, double shift_mm) {
    std::vector<Segment> tracks;
    for (int i = 0; i < columns; ++i) {
        Point last;
        for (int k = 0; k <= rows; ++k) {
            const double x = (i - columns / 2.0) * 0.7 + (k % 2 ? 0.05 : -0.05) + shift_mm, y = (k - rows / 2.0) * 0.8;
            const Point p{round_to_lattice(x * 1e5), round_to_lattice(y * 1e5)};
            if (k > 0) tracks.push_back({last, p});
            last = p;
        }
    }
    return tracks;
}

void time(const char* what, const Layer& upper, const Layer& lower, bool supported) {
    const Settings how = settings(20000, 20000);
    LayerVerdict verdict = verify(upper, lower, how);
    CHECK(verdict.malformed == "");
    CHECK(verdict.supported == supported);
    const int n = 200;
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < n; ++i) verdict = verify(upper, lower, how);
    const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count() / n;
    std::cout << what << ": " << ms << " ms (intervals " << verdict.stages.interval << ", rationals "
              << verdict.stages.rational << ", algebraic numbers " << verdict.stages.algebraic << ")\n";
}

}  // namespace

TEST_CASE("time per pair of layers", "[timing]") {
    const Layer plain = layer({ring(20, 500)}, {ring(19.5, 500)});
    time("500 edges, vertical wall", plain, plain, true);
    time("500 edges, wall leaning in by 0.15 mm", layer({ring(19.85, 500)}, {ring(19.35, 500)}), plain, true);
    time("500 edges, wall leaning out by 0.15 mm", layer({ring(20.15, 500)}, {ring(19.65, 500)}), plain, true);
    time("500 edges, external overhang of 0.3 mm", layer({ring(20.3, 500)}, {ring(19.65, 500)}), plain, true);
    time("500 edges, internal ledge of 0.3 mm", layer({ring(19.7, 500)}, {ring(19.2, 500)}), plain, false);
    const Contour frame = square(1100000);
    const Layer over_comb = layer({frame}, {square(1000000)}, comb(20, 25, 0));
    const Layer near_comb = layer({frame}, {square(1000000)}, comb(20, 25, 0.12));
    time("500 tracks over the same tracks", over_comb, over_comb, true);
    time("500 tracks over tracks moved by 0.12 mm", near_comb, over_comb, true);
    const Layer roof = layer({square(690000)}, {});
    time("a roof on 500 tracks", roof, layer({frame}, {square(1000000)}, comb(21, 25, 0)), true);
    time("a roof with gaps on 250 tracks", roof, layer({frame}, {square(1000000)}, comb(10, 25, 0)), false);
}

namespace {

// 100 lines of 40 mm, `step` mm apart, along x or y, longer by `beyond` at both ends.
PrintedLayer raster(const char* step, const char* width, bool along_x, int beyond = 0) {
    PrintedLayer layer = printed({});
    for (int i = 0; i < 100; ++i) {
        const Rational at = q(step) * i;
        layer.tracks.push_back(along_x ? track(-beyond, at, 40 + beyond, at, q(width))
                                       : track(at, -beyond, at, 40 + beyond, q(width)));
    }
    return layer;
}

}  // namespace

TEST_CASE("time per pair of printed layers", "[timing]") {
    const auto time = [](const char* what, const PrintedLayer& upper, const PrintedLayer& lower, bool supported) {
        const Rational rho = q("0.2");
        PrintedVerdict v = verify_printed(upper, lower, rho);
        CHECK(v.supported == supported);
        const int n = 10;
        const auto start = std::chrono::steady_clock::now();
        for (int i = 0; i < n; ++i) v = verify_printed(upper, lower, rho);
        const double ms =
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count() / n;
        std::cout << what << ": " << ms << " ms (intervals " << v.stages.interval << ", rationals " << v.stages.rational
                  << ", algebraic numbers " << v.stages.algebraic << ")\n";
    };
    const PrintedLayer lines = raster("0.407", "0.449999", true), across = raster("0.407", "0.449999", false);
    time("4 m of lines over the same lines", lines, lines, true);
    time("4 m of lines across lines", across, raster("0.407", "0.449999", true, 1), true);
    time("4 m of lines across lines 1.2 mm apart", across, raster("1.2", "0.449999", true), false);
}
