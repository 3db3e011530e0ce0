// Windows outside which two boundaries have the same winding numbers.
#include "ribvault/verify/boundary_match.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

using namespace ribvault;
using namespace ribvault::verify;

namespace {

constexpr double rho = 20000, pi = 3.14159265358979323846;

/// Closed chains over common vertices.
struct Boundaries {
    std::vector<Vertex> vertices;
    std::vector<Edge> moved, fixed;

    void add(std::vector<Edge>& edges, const Contour& loop) {
        const int first = static_cast<int>(vertices.size()), n = static_cast<int>(loop.size());
        for (const Point p : loop) vertices.push_back(lattice_vertex(p));
        for (int i = 0; i < n; ++i) edges.push_back({first + i, first + (i + 1) % n});
    }
    int winding(const std::vector<Edge>& edges, double x, double y) const {
        int sum = 0;
        for (const Edge& e : edges) {
            const Vertex &a = vertices[static_cast<std::size_t>(e.a)], &b = vertices[static_cast<std::size_t>(e.b)];
            if ((a.cy > y) == (b.cy > y)) continue;
            const double side = (b.cx - a.cx) * (y - a.cy) - (b.cy - a.cy) * (x - a.cx);
            if ((side > 0) == (b.cy > y)) sum += b.cy > y ? 1 : -1;
        }
        return sum;
    }
    double distance_to_fixed(double x, double y) const {
        double least = HUGE_VAL;
        for (const Edge& e : fixed) {
            const Vertex &a = vertices[static_cast<std::size_t>(e.a)], &b = vertices[static_cast<std::size_t>(e.b)];
            const double dx = b.cx - a.cx, dy = b.cy - a.cy, norm = dx * dx + dy * dy;
            const double t = norm > 0 ? std::clamp(((x - a.cx) * dx + (y - a.cy) * dy) / norm, 0.0, 1.0) : 0;
            least = std::min(least, std::hypot(x - a.cx - t * dx, y - a.cy - t * dy));
        }
        return least;
    }
    std::vector<Window> windows() const { return windows_of_change(vertices, moved, fixed, rho).value(); }
};

bool inside(const std::vector<Window>& windows, double x, double y) {
    return std::any_of(windows.begin(), windows.end(),
                       [&](const Window& w) { return w.lo_x <= x && x <= w.hi_x && w.lo_y <= y && y <= w.hi_y; });
}

double area(const std::vector<Window>& windows) {
    double sum = 0;
    for (const Window& w : windows) sum += (w.hi_x - w.lo_x) * (w.hi_y - w.lo_y);
    return sum;
}

/// A wavy ring of n vertices about the centre, from a vertex of its own, whose radius `bump` changes.
template <class Bump>
Contour ring(Point centre, double radius, int n, int start, bool clockwise, const Bump& bump) {
    Contour loop;
    for (int k = 0; k < n; ++k) {
        const double angle = 2 * pi * (k + start) / n * (clockwise ? -1 : 1),
                     r = radius * (1 + 0.2 * std::sin(5 * angle)) + bump(angle);
        loop.push_back(
            {centre.x + round_to_lattice(r * std::cos(angle)), centre.y + round_to_lattice(r * std::sin(angle))});
    }
    return loop;
}

}  // namespace

TEST_CASE("boundaries that are nowhere farther apart than the distance need no window") {
    Boundaries b;
    b.add(b.moved, ring({0, 0}, 1e6, 300, 17, false, [](double) { return 15000.0; }));
    b.add(b.fixed, ring({0, 0}, 1e6, 211, 100, false, [](double) { return 0.0; }));
    CHECK(b.windows().empty());
}

TEST_CASE("a bump has a window of its own, and a ring without partner one around it") {
    Boundaries b;
    const auto bump = [](double angle) {
        return std::fabs(std::remainder(angle - 1, 2 * pi)) < 0.1 ? 60000.0 : 5000.0;
    };
    b.add(b.moved, ring({0, 0}, 1e6, 300, 17, false, bump));
    b.add(b.fixed, ring({0, 0}, 1e6, 211, 100, false, [](double) { return 0.0; }));
    CHECK(area(b.windows()) < 0.05 * 4e12);
    CHECK(inside(b.windows(), 1.05e6 * (1 + 0.2 * std::sin(5.0)) * std::cos(1.0),
                 1.05e6 * (1 + 0.2 * std::sin(5.0)) * std::sin(1.0)));
    const std::size_t before = b.windows().size();
    b.add(b.moved, ring({3000000, 0}, 2e5, 20, 0, false, [](double) { return 0.0; }));
    REQUIRE(b.windows().size() == before + 1);
    CHECK(inside(b.windows(), 3e6, 0));
}

TEST_CASE("edges that are no closed chains have no windows") {
    Boundaries b;
    b.add(b.moved, ring({0, 0}, 1e6, 30, 0, false, [](double) { return 0.0; }));
    b.add(b.fixed, ring({0, 0}, 1e6, 30, 0, false, [](double) { return 0.0; }));
    b.fixed.pop_back();
    CHECK_FALSE(windows_of_change(b.vertices, b.moved, b.fixed, rho).has_value());
}

TEST_CASE("every point with another winding number, farther than the distance from the boundary, is in a window",
          "[agreement]") {
    std::mt19937 random(7);
    const auto uniform = [&](double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random); };
    std::size_t differing = 0, outside = 0;
    for (int round = 0; round < 300; ++round) {
        Boundaries b;
        const int rings = 1 + round % 4;
        for (int k = 0; k < rings; ++k) {
            // Concentric ones turn in turn, as outlines and holes do; their spacing is of the order of the distance.
            const double radius = 3e5 - k * uniform(2e4, 8e4);
            const double from = uniform(0, 6), width = uniform(0, 2), high = uniform(-9e4, 9e4),
                         drift = uniform(-1.5e4, 1.5e4);
            const auto bump = [&](double angle) {
                return drift + (std::fabs(std::remainder(angle - from, 2 * pi)) < width ? high : 0);
            };
            const int n = 3 + static_cast<int>(uniform(0, 80));
            if (round % 7 != 1)
                b.add(b.moved, ring({round_to_lattice(uniform(-2e4, 2e4)), 0}, radius, n,
                                    static_cast<int>(uniform(0, 9)), k % 2 != 0, bump));
            if (round % 5 != 1)
                b.add(b.fixed, ring({0, 0}, radius, 3 + static_cast<int>(uniform(0, 80)), 0, k % 2 != 0,
                                    [](double) { return 0.0; }));
        }
        const std::vector<Window> windows = b.windows();
        for (int i = 0; i < 400; ++i) {
            const double x = uniform(-5e5, 5e5), y = uniform(-5e5, 5e5);
            if (b.winding(b.moved, x, y) == b.winding(b.fixed, x, y) || b.distance_to_fixed(x, y) <= rho) continue;
            ++differing;
            if (!inside(windows, x, y)) ++outside;
        }
    }
    CHECK(differing > 1000);
    CHECK(outside == 0);
}
