// The predicates' stages: which one must decide, and that all that answer agree.
#include <catch2/catch.hpp>
#include <iostream>
#include <numeric>
#include <random>

#include "ribvault/verify/local_cover.hpp"

using namespace ribvault;
using namespace ribvault::verify;

namespace {

constexpr double reach = 40000;

/// M is a square with half side 10 mm about the origin.
struct Scene {
    std::vector<Vertex> vertices;
    CoverProblem problem;
    std::vector<int> sites, edges;

    explicit Scene(const std::vector<Segment>& tracks) {
        for (const Segment& t : tracks) {
            vertices.push_back(lattice_vertex(t.a));
            vertices.push_back(lattice_vertex(t.b));
            const int n = static_cast<int>(vertices.size());
            problem.sites.push_back({n - 2, t.a == t.b ? n - 2 : n - 1, reach});
        }
        const int n = static_cast<int>(vertices.size());
        for (const Point p : {Point{-1000000, -1000000}, {1000000, -1000000}, {1000000, 1000000}, {-1000000, 1000000}})
            vertices.push_back(lattice_vertex(p));
        for (int i = 0; i < 4; ++i) problem.material.push_back({n + i, n + (i + 1) % 4});
        problem.vertices = vertices;
        sites.resize(problem.sites.size());
        std::iota(sites.begin(), sites.end(), 0);
        edges = {0, 1, 2, 3};
    }
    Surroundings near() const { return {sites, edges, {}, 17, 5, 1}; }
    Curve line(int site, int side) const {
        return {true, problem.sites[site].a, problem.sites[site].b, side, reach, false};
    }
    Curve circle(int site) const { return {false, problem.sites[site].a, problem.sites[site].a, 0, reach, false}; }
    Located at(const Curve& c1, const Curve& c2, int root) const {
        return located(problem, {Candidate::Kind::meeting, -1, 0, c1, c2, root});
    }
};

}  // namespace

TEST_CASE("which stage decides at the meeting point of two tracks' boundaries") {
    const CGAL::Protect_FPU_rounding<true> upward;
    Vec<double> hint{1, 0};
    const Segment up{{-300000, -300000}, {200000, 200000}}, down{{-300000, 300000}, {200000, -200000}};

    SECTION("two tracks alone: intervals, for the incidences are known") {
        const Scene s({up, down});
        Located v = s.at(s.line(0, -1), s.line(1, 1), 0);
        CHECK(decide_locally(v, s.near(), hint) == Local::uncovered);
        CHECK(v.stage == verify::Stage::interval);
    }
    SECTION("a third track overlapping the first: its boundary passes through the same irrational point") {
        const Scene s({up, down, {{-200000, -200000}, {300000, 300000}}});
        Located v = s.at(s.line(0, -1), s.line(1, 1), 0);
        CHECK(decide_locally(v, s.near(), hint) == Local::uncovered);
        CHECK(v.stage == verify::Stage::algebraic);
    }
    SECTION("with a track over the corner: intervals again, no tie is looked at") {
        const Scene s({up, down, {{-200000, -200000}, {300000, 300000}}, {{56568, 0}, {100000, 0}}});
        Located v = s.at(s.line(0, -1), s.line(1, 1), 0);
        CHECK(decide_locally(v, s.near(), hint) == Local::covered);
        CHECK(v.stage == verify::Stage::interval);
    }
    SECTION("lines through one rational point that is no double: rationals") {
        // Directions (3, 4) and (-5, 12): rational normals, and a meeting point with a denominator of 56. The third
        // track overlaps the first.
        const Segment first{{0, 0}, {300000, 400000}}, second{{1, 0}, {-499999, 1200000}};
        const Scene s({first, second, {{30000, 40000}, {330000, 440000}}});
        Located v = s.at(s.line(0, 1), s.line(1, -1), 0);
        CHECK(decide_locally(v, s.near(), hint) != Local::unknown);
        CHECK(v.stage == verify::Stage::rational);
    }
    SECTION("outside M: nothing to decide") {
        const Scene s({{{990000, -1100000}, {990000, 1100000}}, {{-2000000, 1050000}, {2000000, 1050000}}});
        Located v = s.at(s.line(0, -1), s.line(1, 1), 0);
        CHECK(decide_locally(v, s.near(), hint) == Local::not_in_m);
    }
}

TEST_CASE("tangent curves meet once, separate ones never, and concentric or parallel ones have no meeting point") {
    const CGAL::Protect_FPU_rounding<true> upward;
    const Scene s({{{0, 0}, {0, 0}},
                   {{80000, 0}, {80000, 0}},
                   {{80001, 0}, {80001, 0}},
                   {{79999, 0}, {79999, 0}},
                   {{-500000, 80000}, {500000, 80000}},
                   {{-500000, -80000}, {500000, -80000}},
                   {{100000, 100000}, {200000, 200000}},
                   {{300000, 300000}, {400000, 400000}}});
    verify::Stage stage = verify::Stage::interval;
    const auto meet = [&](const Curve& a, const Curve& b) { return meeting_points(s.problem, a, b, stage); };
    CHECK(meet(s.circle(0), s.circle(1)) == 1);
    CHECK(meet(s.circle(0), s.circle(2)) == 0);
    CHECK(meet(s.circle(0), s.circle(3)) == 2);
    CHECK(meet(s.circle(0), s.circle(0)) == 0);
    CHECK(meet(s.circle(0), s.line(4, -1)) == 1);
    CHECK(meet(s.circle(0), s.line(4, 1)) == 0);
    CHECK(meet(s.line(4, -1), s.line(5, 1)) == 0);
    CHECK(meet(s.line(4, -1), s.line(6, 1)) == 1);
    CHECK(stage == verify::Stage::interval);
    // The second slanted track's circle touches the first one's line: algebraic, as the line's offset is irrational,
    // but the difference of the two radii is 0 and settles it.
    CHECK(meet(s.circle(7), s.line(6, 1)) == 1);
    CHECK(stage == verify::Stage::interval);
}

TEST_CASE("all stages that answer agree on thousands of near-degenerate points", "[agreement]") {
    const CGAL::Protect_FPU_rounding<true> upward;
    std::mt19937_64 g(7);
    const auto pick = [&](Unit lo, Unit hi) { return std::uniform_int_distribution<Unit>(lo, hi)(g); };
    const auto point = [&] { return Point{pick(-3, 3) * 20000, pick(-3, 3) * 20000}; };
    int certain = 0, zero = 0, rational = 0, total = 0;
    for (int draw = 0; draw < 3000; ++draw) {
        std::vector<Segment> tracks;
        for (int i = 0; i < 3; ++i) tracks.push_back({point(), point()});
        // Half of them: the third track on the line of the first, so that its boundary shares the point.
        if (const Point d = tracks[0].b - tracks[0].a; pick(0, 1)) tracks[2] = {tracks[0].a - d, tracks[0].b + d};
        const Scene s(tracks);
        const auto curve = [&](int site) {
            return s.problem.sites[site].a == s.problem.sites[site].b || pick(0, 1) ? s.circle(site)
                                                                                    : s.line(site, pick(0, 1) ? 1 : -1);
        };
        const Curve c1 = curve(0), c2 = curve(1);
        verify::Stage stage = verify::Stage::interval;
        const int n = meeting_points(s.problem, c1, c2, stage);
        if (n == 0) continue;
        Located v = s.at(c1, c2, n == 1 ? 0 : 1);
        const Stadium& third = s.problem.sites[2];
        const auto f = [&]<class NT>(const Vec<NT>& p) -> NT {
            const Vec<NT> a = exact_point<NT>(s.vertices[third.a]), b = exact_point<NT>(s.vertices[third.b]);
            const Vec<NT> d = third.a == third.b ? Vec<NT>{NT(1), NT(0)} : Vec<NT>(b - a);
            const NT c = cross(d, Vec<NT>(p - a));
            return NT(c * c - number<NT>(reach * reach) * dot(d, d));
        };
        const int by_intervals = sign_of(f.operator()<Interval>({v.x, v.y}));
        const Vec<Rational>* q = nullptr;
        int by_rationals = unknown, by_algebra = unknown;
        {
            const CGAL::Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST);
            q = rational_value(v);
            if (q) by_rationals = sign_of(f.operator()<Rational>(*q));
            by_algebra = sign_of(f.operator()<Algebraic>(locate<Algebraic>(s.problem, v.candidate)));
        }
        ++total, certain += by_intervals != unknown, zero += by_algebra == 0, rational += q != nullptr;
        REQUIRE((by_intervals == unknown || by_intervals == by_algebra));
        REQUIRE((by_rationals == unknown || by_rationals == by_algebra));
    }
    std::cout << "stages agree at " << total << " points: intervals answered " << certain << ", rationals " << rational
              << ", zeros " << zero << "\n";
    CHECK(zero > 50);
}
