// Traced boundaries: closed, on their curves, with the area and the inside that other means find.
#include <catch2/catch.hpp>
#include <cmath>
#include <iostream>
#include <queue>

#include "random_printed_layers.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

PrintedVerdict traced(const PrintedLayer& upper, const PrintedLayer& lower, const Rational& rho) {
    return verify_printed(upper, lower, rho);
}

struct Point2 {
    double x, y;
};
Point2 place(const RegionBoundary& b, std::size_t vertex) {
    const BoundaryVertex& v = b.vertices[vertex];
    return {(v.x[0] + v.x[1]) / 2, (v.y[0] + v.y[1]) / 2};
}
Point2 place(const std::array<Rational, 2>& p) { return {p[0].get_d(), p[1].get_d()}; }

// Distance of a point to a whole curve.
double off_curve(const BoundaryCurve& c, const Point2& p) {
    const Point2 a = place(c.a), b = place(c.b);
    const double r = c.radius.get_d();
    if (!c.line) return std::abs(std::hypot(p.x - a.x, p.y - a.y) - r);
    const double dx = b.x - a.x, dy = b.y - a.y;
    return std::abs((dx * (p.y - a.y) - dy * (p.x - a.x)) / std::hypot(dx, dy) + r);
}

// By how much the angle about p grows along a piece, by small steps; `least` becomes the least distance seen.
double turned(const RegionBoundary& b, const BoundaryPiece& piece, const Point2& p, double& least) {
    const BoundaryCurve& c = b.curves[piece.curve];
    const auto angle = [](const Point2& u, const Point2& v) {
        return std::atan2(u.x * v.y - u.y * v.x, u.x * v.x + u.y * v.y);
    };
    const auto along = [&](const Point2& u, const Point2& v) {  // a straight step
        const double dx = v.x - u.x, dy = v.y - u.y, n = dx * dx + dy * dy;
        const double t = n > 0 ? std::clamp(((p.x - u.x) * dx + (p.y - u.y) * dy) / n, 0.0, 1.0) : 0;
        least = std::min(least, std::hypot(u.x + t * dx - p.x, u.y + t * dy - p.y));
        return angle({u.x - p.x, u.y - p.y}, {v.x - p.x, v.y - p.y});
    };
    if (piece.turn == 0) return along(place(b, piece.from), place(b, piece.to));
    const Point2 m = place(c.a);
    const double r = c.radius.get_d(), sweep = piece.angle * piece.turn;
    double from = 0;
    if (piece.from != BoundaryPiece::nowhere)
        from = std::atan2(place(b, piece.from).y - m.y, place(b, piece.from).x - m.x);
    constexpr int steps = 64;
    double total = 0;
    for (int i = 0; i < steps; ++i) {
        const auto at = [&](int k) {
            return Point2{m.x + r * std::cos(from + sweep * k / steps), m.y + r * std::sin(from + sweep * k / steps)};
        };
        total += along(at(i), at(i + 1));
    }
    return total;
}

// The winding number of all loops about p; nothing within `near` of a loop, where 64 chords an arc cannot tell.
std::optional<int> winding(const RegionBoundary& b, const Point2& p, double near) {
    double total = 0, least = HUGE_VAL;
    for (const RegionComponent& component : b.components)
        for (const BoundaryLoop& loop : component.loops)
            for (const BoundaryPiece& piece : loop) total += turned(b, piece, p, least);
    if (least < near) return std::nullopt;
    return static_cast<int>(std::lround(total / (2 * M_PI)));
}

// Every piece begins where the one before ends, exactly, and its ends are on its curve.
void check_closed(const RegionBoundary& b) {
    for (const BoundaryVertex& v : b.vertices) {
        CHECK(v.first != v.second);
        CHECK(v.x[0] <= v.x[1]);
        CHECK(v.x[1] - v.x[0] < 1e-9);
        CHECK(v.y[1] - v.y[0] < 1e-9);
    }
    for (std::size_t v = 0; v < b.vertices.size(); ++v)
        for (const std::size_t curve : {b.vertices[v].first, b.vertices[v].second})
            CHECK(off_curve(b.curves[curve], place(b, v)) < 1e-7);
    CHECK(!b.components.empty());
    for (const RegionComponent& component : b.components) {
        CHECK(component.area_lo > 0);
        CHECK(component.area_hi - component.area_lo <= 1e-6 * component.area_hi);
        CHECK(!component.loops.empty());
        for (const BoundaryLoop& loop : component.loops) {
            CHECK(!loop.empty());
            for (std::size_t i = 0; i < loop.size(); ++i) {
                const BoundaryPiece &piece = loop[i], &next = loop[(i + 1) % loop.size()];
                CHECK(piece.to == next.from);
                CHECK((piece.turn == 0) == b.curves[piece.curve].line);
                if (piece.turn != 0 && piece.from != BoundaryPiece::nowhere) {
                    // The angle is the one between its ends.
                    const Point2 m = place(b.curves[piece.curve].a), u = place(b, piece.from), v = place(b, piece.to);
                    const double angle = std::atan2(v.y - m.y, v.x - m.x) - std::atan2(u.y - m.y, u.x - m.x);
                    CHECK(std::abs(std::remainder(angle - piece.turn * piece.angle, 2 * M_PI)) < 1e-6);
                }
                if (piece.from == BoundaryPiece::nowhere) {
                    CHECK(loop.size() == 1);
                    continue;
                }
                for (const std::size_t end : {piece.from, piece.to})
                    CHECK(off_curve(b.curves[piece.curve], place(b, end)) < 1e-7);
            }
        }
    }
}

// The area by squares: those in a stadium above and in none below count, those that may meet both may.
struct Square {
    double x, y, half;
    bool operator<(const Square& o) const { return half < o.half; }
};
std::array<double, 2> area_by_squares(const PrintedLayer& upper, const PrintedLayer& lower, double rho, double half,
                                      int budget) {
    struct Capsule {
        double ax, ay, dx, dy, n, r;
        double beyond(double x, double y) const {  // distance to it; negative inside
            const double t = n > 0 ? std::clamp(((x - ax) * dx + (y - ay) * dy) / n, 0.0, 1.0) : 0;
            return std::hypot(ax + t * dx - x, ay + t * dy - y) - r;
        }
        bool holds(const Square& s) const {
            for (const double x : {s.x - s.half, s.x + s.half})
                for (const double y : {s.y - s.half, s.y + s.half})
                    if (beyond(x, y) > -1e-9) return false;
            return true;
        }
        bool misses(const Square& s) const { return beyond(s.x, s.y) > s.half * 1.4142136 + 1e-9; }
    };
    const auto capsules = [](const PrintedLayer& layer, double more) {
        std::vector<Capsule> all;
        for (const PrintedTrack& t : layer.tracks) {
            const double ax = t.a[0].get_d(), ay = t.a[1].get_d(), dx = t.b[0].get_d() - ax, dy = t.b[1].get_d() - ay;
            all.push_back({ax, ay, dx, dy, dx * dx + dy * dy, t.width.get_d() / 2 + more});
        }
        return all;
    };
    const std::vector<Capsule> above = capsules(upper, 0), below = capsules(lower, rho);
    std::priority_queue<Square> open;
    open.push({0, 0, half});
    double lo = 0;
    while (!open.empty() && budget-- > 0) {
        const Square s = open.top();
        open.pop();
        const double h = s.half / 2;
        for (const double dx : {-h, h})
            for (const double dy : {-h, h}) {
                const Square q{s.x + dx, s.y + dy, h};
                const auto misses = [&](const Capsule& c) { return c.misses(q); };
                const auto holds = [&](const Capsule& c) { return c.holds(q); };
                if (std::all_of(above.begin(), above.end(), misses) || std::any_of(below.begin(), below.end(), holds))
                    continue;
                if (std::any_of(above.begin(), above.end(), holds) && std::all_of(below.begin(), below.end(), misses))
                    lo += 4 * h * h;
                else
                    open.push(q);
            }
    }
    double hi = lo;
    for (; !open.empty(); open.pop()) hi += 4 * open.top().half * open.top().half;
    return {lo, hi};
}

struct Figures {
    double lo = 0, hi = 0;
    std::size_t components = 0, loops = 0, pieces = 0;
};
Figures figures(const PrintedVerdict& v) {
    Figures f;
    for (const UnsupportedRegion& r : v.regions)
        for (const RegionComponent& c : r.boundary.components) {
            f.lo += c.area_lo, f.hi += c.area_hi;
            ++f.components;
            f.loops += c.loops.size();
            for (const BoundaryLoop& loop : c.loops) f.pieces += loop.size();
        }
    return f;
}

}  // namespace

TEST_CASE("a dot in the air is bounded by its circle", "[boundary]") {
    const PrintedVerdict v = traced(printed({dot(0, 0, 1)}), printed({}), q("1/5"));
    REQUIRE(v.regions.size() == 1);
    const RegionBoundary& b = v.regions[0].boundary;
    check_closed(b);
    REQUIRE(b.curves.size() == 1);
    CHECK(b.curves[0].radius == q("1/2"));
    CHECK(b.components[0].loops[0][0].turn == 1);
    CHECK(figures(v).lo <= M_PI / 4);
    CHECK(figures(v).hi >= M_PI / 4);
    CHECK(figures(v).hi - figures(v).lo < 1e-9);
}

TEST_CASE("a track in the air is bounded by two sides and two arcs, joined tracks by one loop", "[boundary]") {
    const PrintedVerdict one = traced(printed({track(0, 0, 3, 4, 1)}), printed({}), q("1/5"));
    check_closed(one.regions.at(0).boundary);
    CHECK(figures(one).pieces == 4);
    CHECK(figures(one).lo == Approx(5 + M_PI / 4).epsilon(1e-9));
    const PrintedVerdict chain =
        traced(printed({track(0, 0, 3, 4, 1), track(3, 4, 6, 8, 1), track(6, 8, 3, 4, 1)}), printed({}), q("1/5"));
    CHECK(figures(chain).pieces == 4);
    CHECK(figures(chain).lo == Approx(10 + M_PI / 4).epsilon(1e-9));
}

TEST_CASE("a hole, and a component in it", "[boundary]") {
    // A disc of radius 4 over a ring of tracks that hold what is within 1/2 of a square of side 4.
    const PrintedLayer ring = printed({track(-2, -2, 2, -2, q("1/2")), track(2, -2, 2, 2, q("1/2")),
                                       track(2, 2, -2, 2, q("1/2")), track(-2, 2, -2, -2, q("1/2"))});
    const PrintedVerdict v = traced(printed({dot(0, 0, 8)}), ring, q("1/4"));
    REQUIRE(v.regions.size() == 1);
    check_closed(v.regions[0].boundary);
    CHECK(figures(v).components == 2);
    CHECK(figures(v).loops == 3);
    const double ring_area = 16 * 1 + M_PI / 4 - 1;  // straight, round corners outside, square ones inside
    CHECK(figures(v).lo == Approx(16 * M_PI - ring_area).epsilon(1e-9));
}

TEST_CASE("where stadiums touch in a point the region on both sides is two components, or one that touches itself",
          "[boundary]") {
    // Two dots below that touch each other inside a track above: it is cut in two where they reach across.
    const PrintedVerdict cut =
        traced(printed({track(-5, 0, 5, 0, 2)}), printed({dot(0, 1, 1), dot(0, -1, 1)}), q("1/2"));
    REQUIRE(cut.regions.size() == 1);
    check_closed(cut.regions[0].boundary);
    CHECK(figures(cut).components == 2);
    // Two dots that touch each other inside a wide dot: one component whose one hole is two discs, run round at once or
    // apart.
    const PrintedVerdict holes = traced(printed({dot(0, 0, 8)}), printed({dot(0, 1, 1), dot(0, -1, 1)}), q("1/2"));
    check_closed(holes.regions.at(0).boundary);
    CHECK(figures(holes).components == 1);
    CHECK(figures(holes).lo == Approx(16 * M_PI - 2 * M_PI).epsilon(1e-9));
    // A disc inside a wide dot that touches its circle: the outer loop runs round both.
    const PrintedVerdict moon = traced(printed({dot(0, 0, 8)}), printed({dot(2, 0, 3)}), q("1/2"));
    check_closed(moon.regions.at(0).boundary);
    CHECK(figures(moon).components == 1);
    CHECK(figures(moon).loops == 1);
    CHECK(figures(moon).lo == Approx(12 * M_PI).epsilon(1e-9));
    // Seven hundredths of 10^-30 further out, or less, and it is a hole, or a bite.
    const PrintedVerdict hole =
        traced(printed({dot(0, 0, 8)}), printed({track(2 - tiny(30), 0, 2 - tiny(30), 0, 3)}), q("1/2"));
    CHECK(figures(hole).loops == 2);
    const PrintedVerdict bite =
        traced(printed({dot(0, 0, 8)}), printed({track(2 + tiny(30), 0, 2 + tiny(30), 0, 3)}), q("1/2"));
    CHECK(figures(bite).loops == 1);
    CHECK(figures(bite).pieces == 2);
}

TEST_CASE("regions of 10^-20 and 10^-60 mm2 are traced", "[boundary]") {
    // Four dots below whose circles nearly meet in the middle.
    for (const unsigned n : {10u, 30u}) {
        const Rational e = tiny(n);
        const PrintedLayer lower = printed({dot(1 + e, 0, 1), dot(-1 - e, 0, 1), dot(0, 1 + e, 1), dot(0, -1 - e, 1)});
        const PrintedVerdict v = traced(printed({dot(0, 0, q("1/10"))}), lower, q("1/2"));
        INFO(n);
        double least = HUGE_VAL;
        for (const UnsupportedRegion& r : v.regions) {
            CHECK(!r.boundary.components.empty());
            for (const RegionComponent& c : r.boundary.components) {
                least = std::min(least, c.area_lo);
                CHECK(c.area_hi - c.area_lo <= 1e-6 * c.area_hi);
            }
        }
        CHECK(least > 0);
        CHECK(least < std::pow(10, -1.9 * n));
    }
}

TEST_CASE("hundreds of tracks on the same line in the air are one region", "[boundary]") {
    PrintedLayer upper;
    constexpr int n = 300;
    const auto rational = [](int p, int q) {
        Rational r(p, q);
        r.canonicalize();
        return r;
    };
    for (int k = 0; k < n; ++k)
        upper.tracks.push_back(track(rational(k, 1000), 5, rational(10000 + k, 1000), 5, q("2/5")));
    const PrintedVerdict v = traced(upper, printed({dot(0, 0, q("2/5"))}), q("1/5"));
    REQUIRE(v.regions.size() == 1);
    check_closed(v.regions[0].boundary);
    CHECK(figures(v).components == 1);
    CHECK(figures(v).loops == 1);
    CHECK(figures(v).pieces == 4);
    CHECK((v.regions[0].area_lo + v.regions[0].area_hi) / 2 ==
          Approx((10 + 0.001 * (n - 1)) * 0.4 + M_PI * 0.04).epsilon(1e-9));
}

TEST_CASE("tracks shorter than doubles tell apart are traced", "[boundary]") {
    for (const unsigned n : {14u, 15u, 17u, 18u, 40u}) {
        INFO(n);
        const Rational x = q("73/10") + 3 * tiny(n), y = q("31/10") + tiny(n);
        const PrintedLayer upper =
            printed({track(q("1/10"), q("1/10"), q("73/10"), q("31/10"), q("2/5")),
                     track(q("73/10"), q("31/10"), x, y, q("2/5")), track(x, y, q("91/10"), q("77/10"), q("2/5"))});
        const PrintedVerdict v = traced(upper, printed({dot(-9, 0, q("2/5"))}), q("1/5"));
        REQUIRE(v.regions.size() == 1);
        check_closed(v.regions[0].boundary);
        CHECK(figures(v).components == 1);
        const std::array<double, 2> area = area_by_squares(upper, printed({}), 0.2, 16, 20000);
        CHECK(figures(v).lo <= area[1]);
        CHECK(figures(v).hi >= area[0]);
    }
}

TEST_CASE("a rational point beside a line whose length is not", "[boundary]") {
    // Ten kilometres long: intervals do not tell where it ends.
    const PrintedLayer upper =
        printed({track(q("102540/1000"), q("98311/1000"), q("-9999999"), q("96955/1000"), q("1/1000")),
                 track(q("-9999999"), q("96955/1000"), q("101626/1000"), q("96955/1000"), q("1/1000"))});
    const PrintedVerdict v = traced(upper, printed({dot(100, 90, q("2/5"))}), q("1/5"));
    CHECK_FALSE(v.supported);
    REQUIRE(!v.regions.empty());
    for (const UnsupportedRegion& r : v.regions) CHECK(r.witness_certified);
}

namespace {

/// What has been compared, over all layers.
struct Compared {
    double tightness = 0;
    int layers = 0, regions = 0, points = 0, near = 0, inside = 0, holes = 0;
    void report(const char* name) const {
        std::cout << name << ": " << regions << " regions traced, " << holes << " holes; " << points << " points, "
                  << inside << " of them inside, " << near << " too near to a boundary; " << layers
                  << " areas, by squares on average to within " << tightness / layers * 100 << " %\n";
    }
};

void compare(const PrintedLayer& upper, const PrintedLayer& lower, Random& g, int squares, Compared& all) {
    const Rational rho = q("1/2");
    const PrintedVerdict v = traced(upper, lower, rho);
    CHECK(v.supported == v.regions.empty());
    for (const UnsupportedRegion& r : v.regions) {
        check_closed(r.boundary);
        for (const RegionComponent& component : r.boundary.components)
            all.holes += static_cast<int>(component.loops.size()) - 1;
        CHECK(r.area_hi - r.area_lo <= 1e-6 * r.area_hi);
        ++all.regions;
    }
    if (v.regions.empty()) return;
    const std::array<double, 2> area = area_by_squares(upper, lower, 0.5, 8, squares);
    CHECK(figures(v).lo <= area[1] + 1e-9);
    CHECK(figures(v).hi >= area[0] - 1e-9);
    all.tightness += (area[1] - area[0]) / area[1];
    ++all.layers;
    for (int i = 0; i < 8; ++i) {
        const double x = static_cast<double>(pick(g, -6000, 6000)) / 1000,
                     y = static_cast<double>(pick(g, -6000, 6000)) / 1000;
        int around = 0;
        bool told = true;
        for (const UnsupportedRegion& r : v.regions) {
            const std::optional<int> n = winding(r.boundary, {x, y}, 0.02);
            told = told && n;
            around += n.value_or(0);
        }
        if (!told) {
            ++all.near;
            continue;
        }
        const bool out = is_witness({Rational(x), Rational(y)}, upper, lower, rho);
        INFO(x << " " << y);
        CHECK(around == (out ? 1 : 0));
        ++all.points, all.inside += out;
    }
}

}  // namespace

TEST_CASE("traced boundaries agree with the area by squares and the inside by rationals on random small layers",
          "[boundary]") {
    Compared all;
    for (std::uint64_t seed = 0; seed < 20000; ++seed) {
        Random g(seed + 1000000);
        const Case c = random_case(g);
        const int grow = seed % 2 == 0 ? 0 : static_cast<int>(pick(g, -1, 1));
        INFO("seed " << seed << ", radii changed by " << grow << " 10^-30");
        compare(layer_of(c.upper, false, 0), layer_of(c.lower, true, tiny(30) * grow), g, seed % 20 == 0 ? 8000 : 400,
                all);
    }
    all.report("boundaries");
    CHECK(all.regions > 10000);
    CHECK(all.inside > 1000);
    CHECK(all.holes > 20);
}

TEST_CASE("the same where many tracks above lie over each other", "[boundary]") {
    Compared all;
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        Random g(seed + 2000000);
        const Case c = random_case(g);
        PrintedLayer upper = layer_of(c.upper, false, 0);
        for (int k = 0; k < 6; ++k) {
            const PrintedLayer more = layer_of(random_case(g).upper, false, 0);
            upper.tracks.insert(upper.tracks.end(), more.tracks.begin(), more.tracks.end());
        }
        const int grow = seed % 2 == 0 ? 0 : static_cast<int>(pick(g, -1, 1));
        INFO("seed " << seed << ", radii changed by " << grow << " 10^-30");
        compare(upper, layer_of(c.lower, true, tiny(30) * grow), g, 1000, all);
    }
    all.report("boundaries of crowds");
    CHECK(all.regions > 1000);
    CHECK(all.inside > 300);
    CHECK(all.holes > 20);
}
