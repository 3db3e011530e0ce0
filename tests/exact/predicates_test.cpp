// Predicates against plain rationals, on random inputs, on inputs next to a tie, and on ties by name.
#include "ribvault/exact/predicates.hpp"

#include <catch2/catch.hpp>

#include "rationals.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

constexpr Unit far = lattice_bound;

Rational rational(const SquaredDistance& d) {
    mpz_class numerator = whole(static_cast<Unit>(d.numerator >> 62));
    numerator <<= 62;
    numerator += whole(static_cast<Unit>(d.numerator & ((Int128{1} << 62) - 1)));
    Rational q(numerator, whole(d.denominator));
    q.canonicalize();
    return q;
}

Segment random_segment(Random& g) {
    const Point a = random_point(g);
    switch (pick(g, 0, 5)) {
        case 0:
            return {a, a};
        case 1:
            return {a, {a.x, random_point(g).y}};
        case 2:
            return {a, {random_point(g).x, a.y}};
        default:
            return {a, random_point(g)};
    }
}

Point query(Random& g, const Segment& s) { return pick(g, 0, 1) ? random_point(g) : near_segment(g, s); }

Unit floor_of_root(const Rational& q) { return mpz_class(sqrt(mpz_class(q))).get_si(); }

/// The distance from p to the segment is exactly the radius: closer, on and beyond must be told apart.
void check_tie(Point p, const Segment& s, Unit radius) {
    INFO("(" << p.x << ", " << p.y << ") at " << radius);
    CHECK(rational_squared_distance(p, s) == Rational(whole(radius) * whole(radius)));
    CHECK(compare_distance(p, s, radius) == 0);
    if (radius > 0) CHECK(compare_distance(p, s, radius - 1) == 1);
    CHECK(compare_distance(p, s, radius + 1) == -1);
    CHECK(compare_distance(p, {s.b, s.a}, radius) == 0);
}

}  // namespace

TEST_CASE("orientation agrees with rationals, also between coordinates at the bound of the lattice") {
    Random g(1);
    int zero = 0;
    for (int k = 0; k < 30000; ++k) {
        const Segment s = random_segment(g);
        const Point c = query(g, s);
        const RationalPoint a = rational(s.a);
        const Rational twice = wedge(rational(s.b) - a, rational(c) - a);
        REQUIRE(cross(s.a, s.b, c) == twice.get_num().get_si());
        REQUIRE(orientation(s.a, s.b, c) == sgn(twice));
        zero += twice == 0;
    }
    CHECK(zero > 1000);
    CHECK(cross({-far, -far}, {far, -far}, {far, far}) == 4 * far * far);
    CHECK(orientation({-far, -far}, {far, far}, {far, far - 1}) == -1);
    CHECK(orientation({-far, -far}, {far - 1, far - 1}, {far, far}) == 0);
    CHECK(cross({-far, far}, {far, -far}, {far, far}) == 4 * far * far);
}

TEST_CASE("the distance of a point to a segment is the rational one") {
    Random g(2);
    for (int k = 0; k < 20000; ++k) {
        const Segment s = random_segment(g);
        const Point p = query(g, s);
        const SquaredDistance d = squared_distance(p, s);
        const Rational truth = rational_squared_distance(p, s);
        REQUIRE(d.denominator > 0);
        REQUIRE(rational(d) == truth);
        const Unit root = floor_of_root(truth);
        for (const Unit radius : {root - 1, root, root + 1, root / 2}) {
            if (radius < 0 || radius > far) continue;
            REQUIRE(compare_distance(p, s, radius) == sgn(Rational(truth - whole(radius) * whole(radius))));
        }
    }
}

TEST_CASE("ties of a distance with a radius: 3-4-5 and its like") {
    check_tie({3, 4}, {{0, 0}, {0, 0}}, 5);
    check_tie({3, 4}, {{0, 0}, {-7, -7}}, 5);
    check_tie({12000, 16000}, {{0, 0}, {-16000, 12000}}, 20000);           // square to the segment, at its end
    check_tie({12000, 16000}, {{-16000, 12000}, {16000, -12000}}, 20000);  // over its inner part
    check_tie({5000 * 20, 12000 * 20}, {{-12000, 5000}, {24000, -10000}}, 260000);
    check_tie({7, 20000}, {{-100, 0}, {100, 0}}, 20000);
    check_tie({-20000, 7}, {{0, -100}, {0, 100}}, 20000);
    check_tie({600000000, 800000000}, {{-800000000, 600000000}, {800000000, -600000000}}, 1000000000);
    check_tie({1, 1}, {{0, 0}, {2, 2}}, 0);
    CHECK(compare_distance(Point{0, 0}, {{far, far}, {far, far}}, far) == 1);
    CHECK(compare_distance(Point{0, 1}, {{0, 0}, {0, 0}}, -2) == 1);
}

TEST_CASE("the distance of two segments: the nearest of their ends, or nothing where they cross") {
    const Segment way{{0, 0}, {60000, 80000}};
    const auto check = [&](const Segment& s, Unit radius) {
        for (const auto& [a, b] : {std::pair(way, s), std::pair(s, way), std::pair(Segment{way.b, way.a}, s)}) {
            CHECK(compare_distance(a, b, radius) == 0);
            CHECK(compare_distance(a, b, radius - 1) == 1);
            CHECK(compare_distance(a, b, radius + 1) == -1);
        }
    };
    check({{24000, -18000}, {124000, -18000}}, 30000);  // 30000 beside the way's beginning
    check({{54000, 22000}, {104000, 72000}},
          30000);  // an end beside the inner part: 30000 (0.8, -0.6) from (30000, 40000)
    check({{84000, 62000}, {24000, -18000}}, 30000);    // parallel
    check({{60000, 90000}, {0, 95000}}, 10000);         // beside the end
    CHECK(compare_distance(Segment{{0, 80000}, {60000, 0}}, way, 1) == -1);
    CHECK(compare_distance(Segment{{0, 80000}, {60000, 0}}, way, 0) == 0);
    CHECK(compare_distance(Segment{{30000, 40000}, {90000, 0}}, way, 1) == -1);
}

TEST_CASE("comparing two distances agrees with rationals") {
    Random g(3);
    int equal = 0;
    for (int k = 0; k < 20000; ++k) {
        const Segment s = random_segment(g);
        const Point p = query(g, s);
        Segment t = random_segment(g);
        if (pick(g, 0, 2) != 0) {
            // A part of the same line, or the line moved by a unit: distances that differ little or not at all.
            const Point u = s.b - s.a, by{pick(g, -1, 1), pick(g, -1, 1)};
            t = {s.a + by, {s.a.x + u.x / 3 + by.x, s.a.y + u.y / 3 + by.y}};
            for (Point* q : {&t.a, &t.b}) q->x = std::clamp(q->x, -far, far), q->y = std::clamp(q->y, -far, far);
        }
        const int truth = sgn(Rational(rational_squared_distance(p, s) - rational_squared_distance(p, t)));
        REQUIRE(compare(squared_distance(p, s), squared_distance(p, t)) == truth);
        REQUIRE(compare(squared_distance(p, t), squared_distance(p, s)) == -truth);
        equal += truth == 0;
    }
    CHECK(equal > 500);
}

TEST_CASE("equal distances with different denominators are equal") {
    Random g(4);
    for (int k = 0; k < 2000; ++k) {
        const Point u{pick(g, 1, 10000), pick(g, 1, 10000)}, p{pick(g, -40000, 40000), pick(g, -40000, 40000)};
        const Unit m = pick(g, 10, 90000), n = pick(g, 10, 90000);
        const Segment s{{-m * u.x, -m * u.y}, {m * u.x, m * u.y}}, t{{-n * u.x, -n * u.y}, {n * u.x, n * u.y}};
        REQUIRE(compare(squared_distance(p, s), squared_distance(p, t)) == 0);
        const SquaredDistance d = squared_distance(p, s);
        if (d.numerator == 0) continue;
        REQUIRE(compare({d.numerator - 1, d.denominator}, squared_distance(p, t)) == -1);
        REQUIRE(compare({d.numerator + 1, d.denominator}, squared_distance(p, t)) == 1);
    }
}

TEST_CASE("comparing distances under the bonus of equation (4) agrees with 1024-bit roots") {
    Random g(5);
    int equal = 0;
    for (int k = 0; k < 8000; ++k) {
        const Segment s = random_segment(g), t = random_segment(g);
        const Point p = query(g, s);
        const SquaredDistance a = squared_distance(p, s), b = squared_distance(p, t);
        const Rational qa = rational(a), qb = rational(b);
        // Biases next to the difference of the two distances.
        const Unit bias_b = pick(g, 0, 1) ? 0 : pick(g, 0, 80000);
        const Unit bias_a =
            pick(g, 0, 3) == 0 ? pick(g, 0, 80000) : bias_b + floor_of_root(qa) - floor_of_root(qb) + pick(g, -1, 1);
        const int truth = sign_of_difference(qa, qb, Rational(whole(bias_a - bias_b)));
        REQUIRE(compare_biased(a, bias_a, b, bias_b) == truth);
        REQUIRE(compare_biased(b, bias_b, a, bias_a) == -truth);
        equal += truth == 0;
    }
    CHECK(equal > 50);
}

TEST_CASE("roots a fraction of a rounding below whole numbers: only exact arithmetic tells") {
    Random g(8);
    // Distance c m / sqrt(m^2 + 1), that is c - c / (2 m^2): less than c by about a last binary place of long double.
    const auto next_to = [&](Unit c) {
        const Unit m = pick(g, 300000000, far);
        return squared_distance({0, -c}, {{0, 0}, {m, -1}});
    };
    int signs[3] = {0, 0, 0};
    for (int k = 0; k < 3000; ++k) {
        const Unit c = pick(g, 10000, far), d = pick(g, 10000, far);
        const SquaredDistance a = next_to(c), b = next_to(d);
        const int truth = sign_of_difference(rational(a), rational(b), Rational(whole(c - d)));
        REQUIRE(compare_biased(a, c, b, d) == truth);
        ++signs[truth + 1];
    }
    CHECK(signs[0] > 1000);
    CHECK(signs[2] > 1000);
}

TEST_CASE("ties of equation (4): a junction 4r farther than the wall") {
    const Unit bonus = 80000;
    const Point p{0, 0};
    for (const Unit at : {0, 1, 20000, 123456}) {
        const SquaredDistance plain = squared_distance(p, {{-5, at}, {5, at}});
        const auto junction = [&](Unit distance) { return squared_distance(p, {{distance, 0}, {distance, 0}}); };
        CHECK(compare_biased(junction(at + bonus), bonus, plain, 0) == 0);
        CHECK(compare_biased(plain, 0, junction(at + bonus), bonus) == 0);
        CHECK(compare_biased(junction(at + bonus - 1), bonus, plain, 0) == -1);
        CHECK(compare_biased(junction(at + bonus + 1), bonus, plain, 0) == 1);
    }
    const SquaredDistance slanted = squared_distance({12000, 16000}, {{-16000, 12000}, {16000, -12000}});  // 20000
    const SquaredDistance far_vertex = squared_distance({0, 0}, {{60000, 80000}, {60000, 80000}});         // 100000
    CHECK(compare_biased(far_vertex, bonus, slanted, 0) == 0);
    CHECK(compare_biased({far_vertex.numerator + 1, 1}, bonus, slanted, 0) == 1);
    CHECK(compare_biased({far_vertex.numerator - 1, 1}, bonus, slanted, 0) == -1);
    // Nearer than the bonus: the shortened distance is negative, and less than nothing.
    CHECK(compare_biased(squared_distance({0, 0}, {{0, 1}, {0, 1}}), bonus, {0, 1}, 0) == -1);
    CHECK(compare_biased({0, 1}, 0, {0, 1}, bonus) == 1);
    // sqrt(10^18 + 1) - 10^9 is about 5e-10, not zero.
    CHECK(compare_biased({static_cast<Int128>(far) * far + 1, 1}, far, {0, 1}, 0) == 1);
    CHECK(compare_biased({static_cast<Int128>(far) * far - 1, 1}, far, {0, 1}, 0) == -1);
}

TEST_CASE("whether segments touch or cross agrees with rationals") {
    Random g(6);
    int touching = 0, crossing = 0;
    for (int k = 0; k < 20000; ++k) {
        const Segment s = random_segment(g);
        Segment t = random_segment(g);
        if (pick(g, 0, 1)) t.a = near_segment(g, s);
        if (pick(g, 0, 3) == 0) t.b = near_segment(g, s);
        const bool touch = rational_touch(s, t);
        // Inner points of both: touching, no end of either on the other.
        const auto apart = [](Point p, const Segment& e) { return rational_squared_distance(p, e) > 0; };
        const bool cross = touch && apart(s.a, t) && apart(s.b, t) && apart(t.a, s) && apart(t.b, s);
        REQUIRE(segments_touch(s, t) == touch);
        REQUIRE(segments_touch(t, s) == touch);
        REQUIRE(segments_cross(s, t) == cross);
        REQUIRE(segments_cross(t, {s.b, s.a}) == cross);
        touching += touch, crossing += cross;
    }
    CHECK(touching > 2000);
    CHECK(crossing > 500);
    CHECK(touching - crossing > 500);
}

TEST_CASE("segments that meet in one end, overlap, or pass each other by a unit") {
    const Segment s{{0, 0}, {300, 100}};
    CHECK(segments_touch(s, {{300, 100}, {500, -70}}));
    CHECK_FALSE(segments_cross(s, {{300, 100}, {500, -70}}));
    CHECK(segments_touch(s, {{150, 50}, {900, 300}}));  // overlap
    CHECK_FALSE(segments_cross(s, {{150, 50}, {900, 300}}));
    CHECK_FALSE(segments_touch(s, {{303, 101}, {900, 300}}));  // behind it on the same line
    CHECK(segments_touch(s, {{150, 50}, {150, 50}}));
    CHECK_FALSE(segments_touch(s, {{150, 51}, {150, 51}}));
    CHECK(segments_cross(s, {{150, 49}, {150, 51}}));
    CHECK_FALSE(segments_cross(s, {{150, 50}, {150, 51}}));  // a T
    CHECK(segments_cross({{-far, -far}, {far, far}}, {{-far, far}, {far, -far}}));
}

TEST_CASE("the nearest point of a segment is rounded once") {
    Random g(7);
    for (int k = 0; k < 10000; ++k) {
        const Segment s = random_segment(g);
        const Point p = query(g, s), q = nearest_point(p, s);
        const RationalPoint foot = rational_foot(rational(p), s), off = rational(q) - foot;
        const Rational bound(501, 1000);
        REQUIRE(abs(off.x) <= bound);
        REQUIRE(abs(off.y) <= bound);
        if (foot.x == rational(s.a).x && foot.y == rational(s.a).y) REQUIRE(q == s.a);
        if (foot.x == rational(s.b).x && foot.y == rational(s.b).y) REQUIRE(q == s.b);
    }
}
