// Degenerate layers against an arrangement of circular arcs: cavities whose contours touch, overlap, share edges or
// cancel; tracks that coincide, run against each other, are points; material whose rational vertices are 1e-7 units or
// 1e-20 mm from a tie; everything turned by a 3-4-5 rotation so that ties are not between axis-parallel lines only.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <iostream>
#include <random>

#include "circle_arrangement.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

using Random = std::mt19937_64;
Unit pick(Random& g, Unit lo, Unit hi) { return std::uniform_int_distribution<Unit>(lo, hi)(g); }

/// z -> (3 + 4i) z when turned; a similarity by 5.
struct Turn {
    bool turned;
    Unit factor() const { return turned ? 5 : 1; }
    Point operator()(Point p) const { return turned ? Point{3 * p.x - 4 * p.y, 4 * p.x + 3 * p.y} : p; }
    Contour operator()(Contour c) const {
        for (Point& p : c) p = (*this)(p);
        return c;
    }
};

struct Case {
    Layer upper, lower;
    ArcSet hollow_above, hollow_below;
    Settings how;
    /// Something is 1e-12 mm or less from a tie: there may be no double to witness it, or none is found.
    bool hair = false;
};

/// A cavity of unit squares of a grid, given by contours that touch, repeat and cancel, and what is really hollow.
struct Hollow {
    Region contours;
    std::vector<Contour> squares;  // where the winding number is not 0
};
Hollow grid_cavity(Random& g, Unit cell, int n, const Turn& turn) {
    Hollow h;
    std::vector<int> winding(static_cast<std::size_t>(n) * n, 0);
    const Unit lo = -cell * n / 2;
    const auto block = [&](int x0, int y0, int x1, int y1, bool backward) {
        Contour c = turn(rectangle(lo + x0 * cell, lo + y0 * cell, lo + x1 * cell, lo + y1 * cell));
        if (backward) c = reversed(c);
        if (pick(g, 0, 3) == 0) c.insert(c.begin() + 1, c[0]);  // a vertex twice
        if (pick(g, 0, 5) == 0) c.insert(c.begin() + 1, {c[1], c[0]});  // an edge to and fro
        std::rotate(c.begin(), c.begin() + pick(g, 0, static_cast<Unit>(c.size()) - 1), c.end());
        h.contours.push_back(c);
        for (int x = x0; x < x1; ++x)
            for (int y = y0; y < y1; ++y) winding[static_cast<std::size_t>(x) * n + y] += backward ? -1 : 1;
    };
    if (pick(g, 0, 1)) block(0, 0, n, n, false);
    for (int k = static_cast<int>(pick(g, 1, 6)); k > 0; --k) {
        const int x0 = static_cast<int>(pick(g, 0, n - 1)), y0 = static_cast<int>(pick(g, 0, n - 1));
        const int x1 = static_cast<int>(pick(g, x0 + 1, std::min(n, x0 + 2))),
                  y1 = static_cast<int>(pick(g, y0 + 1, std::min(n, y0 + 2)));
        // Contours of a cavity may not cross: blocks are single cells or bars, which may still cross as bars; see
        // below.
        if (x1 - x0 == 2 && y1 - y0 == 2) continue;
        block(x0, y0, x1, y1, pick(g, 0, 2) == 0);
    }
    for (int x = 0; x < n; ++x)
        for (int y = 0; y < n; ++y)
            if (winding[static_cast<std::size_t>(x) * n + y] != 0)
                h.squares.push_back(
                    turn(rectangle(lo + x * cell, lo + y * cell, lo + (x + 1) * cell, lo + (y + 1) * cell)));
    return h;
}
ArcSet set_of(const std::vector<Contour>& squares) {
    ArcSet set;
    for (const Contour& c : squares) {
        std::vector<ExactPoint> points;
        for (const Point p : c) points.emplace_back(Exact(p.x), Exact(p.y));
        set.join(straight_polygon(points));
    }
    return set;
}

Segment random_track(Random& g, Unit half, Unit step, Unit jitter, const Turn& turn) {
    static constexpr Point directions[] = {{1, 0}, {0, 1}, {3, 4}, {4, 3}, {-3, 4}, {-4, 3}, {0, 0}};
    const Point a{pick(g, -half, half) * step, pick(g, -half, half) * step}, d = directions[pick(g, 0, 6)];
    const Unit k = pick(g, -3, 3) * (std::abs(d.x) + std::abs(d.y) > 1 ? step / 5 : step);
    const Point shift{pick(g, -jitter, jitter), pick(g, -jitter, jitter)};
    return {turn(a + shift), turn(Point{a.x + k * d.x, a.y + k * d.y} + shift)};
}

std::vector<Segment> random_tracks(Random& g, Unit most, Unit half, Unit step, Unit jitter, const Turn& turn) {
    std::vector<Segment> tracks;
    for (Unit n = pick(g, 0, most); n > 0; --n) {
        Segment t = random_track(g, half, step, jitter, turn);
        if (!tracks.empty() && pick(g, 0, 2) == 0) {
            // Follows another one: the same, the other way round, its continuation, a part of it, beside it.
            const Segment& f = tracks[static_cast<std::size_t>(pick(g, 0, static_cast<Unit>(tracks.size()) - 1))];
            const Point d = f.b - f.a;
            switch (pick(g, 0, 4)) {
                case 0: t = f; break;
                case 1: t = {f.b, f.a}; break;
                case 2: t = {f.b, f.b + d}; break;
                case 3: t = {f.a, f.a + d + d}; break;
                default: {
                    const Point by = turn(Point{pick(g, -2, 2) * step, pick(g, -2, 2) * step});
                    t = {f.a + by, f.b + by};
                }
            }
        }
        tracks.push_back(t);
    }
    return tracks;
}

/// A tiny exact displacement, in mm.
Exact sliver(Random& g, bool& hair) {
    static const Exact tiny[] = {Exact(0), Exact(0), Exact(1) / Exact(1e12), Exact(1) / Exact(1e20),
                                 Exact(1) / Exact(1e30) / Exact(3)};
    const Unit which = pick(g, 0, 4), sign = pick(g, -1, 1);
    hair = hair || (which > 1 && sign != 0);
    return tiny[which] * Exact(sign);
}
ExactPolygon nudged(Random& g, const Contour& c, bool& hair) {
    ExactPolygon polygon;
    for (const Point p : c) {
        const Exact dx = sliver(g, hair), dy = sliver(g, hair);
        polygon.push_back({Exact(p.x) / Exact(units_per_mm) + dx, Exact(p.y) / Exact(units_per_mm) + dy});
    }
    return polygon;
}

Case internal_case(Random& g) {
    const Turn turn{pick(g, 0, 2) == 0};
    const Unit step = 10 * (pick(g, 0, 1) ? 1 : 100), jitter = pick(g, 0, 3) == 0 ? 1 : 0;
    Case c;
    c.how = settings(pick(g, 1, 2) * step * turn.factor(), pick(g, 1, 2) * step * turn.factor());
    const Contour frame = turn(square(40 * step));
    const Hollow below = grid_cavity(g, pick(g, 1, 3) * 2 * step, 4, turn);
    c.hollow_below = set_of(below.squares);
    c.lower = layer({frame}, below.contours, random_tracks(g, 5, 5, step, jitter, turn));
    const std::vector<Segment> above = random_tracks(g, 2, 5, step, jitter, turn);
    switch (pick(g, 0, 2)) {
        case 0: {  // a roof with a cavity of its own
            const Hollow hollow = grid_cavity(g, pick(g, 1, 4) * 2 * step, 4, turn);
            c.hollow_above = set_of(hollow.squares);
            c.upper = layer({frame}, hollow.contours, above);
            break;
        }
        case 1:  // tracks only
            c.upper = layer({}, {}, above);
            break;
        default: {  // islands with rational corners, a hair off the lattice
            c.upper = layer({}, {}, above);
            const Point at{pick(g, -4, 4) * step, pick(g, -4, 4) * step};
            Contour triangle;
            do {
                triangle.clear();
                for (int i = 0; i < 3; ++i)
                    triangle.push_back(at + Point{pick(g, -3, 3) * step, pick(g, -3, 3) * step});
            } while (signed_area({triangle}) <= 0);
            c.upper.exact.polygons.emplace_back(nudged(g, turn(triangle), c.hair));
        }
    }
    return c;
}

/// Outlines of boxes and 3-4-5 triangles below; the same moved by ties and nudged above.
Case external_case(Random& g) {
    const Turn turn{pick(g, 0, 2) == 0};
    const Unit step = 60;
    Case c;
    c.how = settings(step * turn.factor(), pick(g, 1, 3) * step / 2 * 2 * turn.factor());
    const auto shape = [&](Unit k) -> Contour {
        switch (pick(g, 0, 2)) {
            case 0: return rectangle(-k * step, -k * step, k * step, pick(g, 1, 4) * step);
            case 1: return {{-2 * k * step, 0}, {2 * k * step, -3 * step * k}, {2 * k * step, 0}};
            default: return {{-3 * k * step, -4 * k * step}, {0, 0}, {3 * k * step, -4 * k * step}};
        }
    };
    Region below{turn(shape(pick(g, 1, 3)))};
    if (signed_area(below) < 0) below[0] = reversed(below[0]);
    if (pick(g, 0, 2) == 0) below.push_back(turn(rectangle(20 * step, -step, 23 * step, step)));
    c.lower = layer(below, {});
    const Point by = turn(Point{pick(g, -2, 2) * step, pick(g, -2, 2) * step});
    Contour above = pick(g, 0, 1) ? below[0] : turn(shape(pick(g, 1, 3)));
    if (signed_area({above}) < 0) above = reversed(above);
    for (Point& p : above) p = p + by;
    c.upper = layer({}, {}, random_tracks(g, 1, 5, step, 0, turn));
    c.upper.exact.polygons.emplace_back(nudged(g, above, c.hair));
    return c;
}

struct Tally {
    int cases = 0, malformed = 0, internal = 0, external = 0, uncertified = 0, wrong = 0;
    StageCounts stages;
};

void compare_case(const Case& c, std::uint64_t seed, Tally& tally) {
    const LayerVerdict verdict = verify(c.upper, c.lower, c.how);
    tally.stages += verdict.stages;
    if (!verdict.malformed.empty()) {
        ++tally.malformed;
        return;
    }
    ++tally.cases;
    const ArcVerdict truth = decide_by_arcs(c.upper, c.hollow_above, c.lower, c.hollow_below, c.how);
    tally.internal += truth.internal, tally.external += truth.external;
    INFO("seed " << seed);
    CHECK(verdict.internal.has_value() == truth.internal);
    CHECK(verdict.external.has_value() == truth.external);
    for (const auto& found : {verdict.internal, verdict.external})
        if (found && !found->witness_certified) {
            ++tally.uncertified;
            CHECK(c.hair);
        }
}

void run(const char* name, Case (*make)(Random&), std::uint64_t first, std::uint64_t count) {
    if (const char* more = std::getenv("RIBVAULT_HOSTILE_CASES")) count = std::strtoull(more, nullptr, 10);
    Tally tally;
    for (std::uint64_t seed = first; seed < first + count; ++seed) {
        Random g(seed);
        compare_case(make(g), seed, tally);
    }
    std::cout << name << ": " << tally.cases << " compared (internal " << tally.internal << ", external "
              << tally.external << " not supported), malformed " << tally.malformed << ", witness not certified "
              << tally.uncertified << "; decided by intervals " << tally.stages.interval << ", rationals "
              << tally.stages.rational << ", algebraic numbers " << tally.stages.algebraic << "\n";
    CHECK(tally.cases > 0);
}

}  // namespace

TEST_CASE("degenerate internal layers are decided as by an arrangement of circular arcs", "[agreement]") {
    run("arcs, internal", internal_case, 0, 1000);
}
TEST_CASE("degenerate external layers are decided as by an arrangement of circular arcs", "[agreement]") {
    run("arcs, external", external_case, 5000000, 500);
}
