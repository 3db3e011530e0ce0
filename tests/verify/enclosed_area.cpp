// Areas of what hangs out, against points counted on a grid: independent of cells, lines and corners.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "layers.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

using Random = std::mt19937_64;

/// A star about the middle, with corners that turn both ways.
Contour star(Random& g, int corners, double least, double most) {
    std::uniform_real_distribution<double> radius(least, most), turn(0.0, 0.8);
    Contour contour;
    for (int k = 0; k < corners; ++k) {
        const double r = radius(g), angle = 2 * std::numbers::pi * (k + turn(g)) / corners;
        contour.push_back({round_to_lattice(r * std::cos(angle)), round_to_lattice(r * std::sin(angle))});
    }
    return contour;
}

template <class Visit>
void for_each_edge(const Contour& contour, const Visit& visit) {
    for (std::size_t k = 0; k < contour.size(); ++k) visit(contour[k], contour[(k + 1) % contour.size()]);
}

bool inside(const Contour& contour, double x, double y) {
    bool in = false;
    for_each_edge(contour, [&](Point a, Point b) {
        const auto ay = static_cast<double>(a.y), by = static_cast<double>(b.y), ax = static_cast<double>(a.x);
        if ((ay > y) != (by > y) && x < ax + (y - ay) / (by - ay) * static_cast<double>(b.x - a.x)) in = !in;
    });
    return in;
}

double distance(const Contour& contour, double x, double y) {
    double nearest = HUGE_VAL;
    for_each_edge(contour, [&](Point a, Point b) {
        const auto dx = static_cast<double>(b.x - a.x), dy = static_cast<double>(b.y - a.y);
        const double tx = x - static_cast<double>(a.x), ty = y - static_cast<double>(a.y);
        const double t = std::clamp((tx * dx + ty * dy) / (dx * dx + dy * dy), 0.0, 1.0);
        nearest = std::min(nearest, std::hypot(tx - t * dx, ty - t * dy));
    });
    return nearest;
}

}  // namespace

TEST_CASE("the area of an overhang is that of the points in it") {
    Random g(20);
    int known = 0;
    for (int turn = 0; turn < 60; ++turn) {
        const int corners = 3 + turn % 9;
        const Contour above = star(g, corners, 60000, 300000), below = star(g, 3 + turn % 7, 30000, 250000);
        const double rho = 5000 + 5000 * (turn % 4);
        const LayerVerdict v = verify(layer({above}, {}), layer({below}, {}),
                                      settings(20000, round_to_lattice(rho)));
        constexpr int n = 600;
        const double from = -300000, step = 600000.0 / n;
        int out = 0;
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                const double x = from + (i + 0.5) * step, y = from + (j + 0.5) * step;
                if (inside(above, x, y) && !inside(below, x, y) && distance(below, x, y) > rho) ++out;
            }
        const double area = out * step * step * 1e-10;
        // A border of length l gets about sqrt(l / step) cells wrong, of some 5 m in all here at most.
        const double error = 4 * std::sqrt(5e6 / step) * step * step * 1e-10;
        INFO("turn " << turn << ", counted " << area);
        if (!v.external) {
            CHECK(area < error);
            continue;
        }
        INFO("enclosed by " << v.external->area_lo << " and " << v.external->area_hi);
        CHECK(v.external->area_lo <= area + error);
        CHECK(v.external->area_hi >= area - error);
        if (v.external->area_hi - v.external->area_lo <= 0.011 * v.external->area_hi) ++known;
    }
    CHECK(known > 50);
}
