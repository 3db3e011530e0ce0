// The predicates once more, in plain rationals: slow, and independent of everything in src/ribvault/exact.
#pragma once

#include <gmpxx.h>

#include <algorithm>
#include <random>

#include "ribvault/exact/lattice.hpp"

namespace ribvault::test {

using Rational = mpq_class;
using Random = std::mt19937_64;

inline Unit pick(Random& g, Unit lo, Unit hi) { return std::uniform_int_distribution<Unit>(lo, hi)(g); }

inline mpz_class whole(Unit u) { return mpz_class(static_cast<long>(u)); }

struct RationalPoint {
    Rational x, y;
};
inline RationalPoint rational(Point p) { return {Rational(whole(p.x)), Rational(whole(p.y))}; }
inline RationalPoint operator-(const RationalPoint& a, const RationalPoint& b) { return {a.x - b.x, a.y - b.y}; }
inline Rational dot(const RationalPoint& a, const RationalPoint& b) { return a.x * b.x + a.y * b.y; }
inline Rational wedge(const RationalPoint& a, const RationalPoint& b) { return a.x * b.y - a.y * b.x; }

/// The point of a closed segment nearest to p.
inline RationalPoint rational_foot(const RationalPoint& p, const Segment& s) {
    const RationalPoint a = rational(s.a), u = rational(s.b) - a;
    if (s.a == s.b) return a;
    const Rational t = dot(p - a, u) / dot(u, u), share = t < 0 ? Rational(0) : t > 1 ? Rational(1) : t;
    return {a.x + share * u.x, a.y + share * u.y};
}
inline Rational rational_squared_distance(const RationalPoint& p, const Segment& s) {
    const RationalPoint d = p - rational_foot(p, s);
    return dot(d, d);
}
inline Rational rational_squared_distance(Point p, const Segment& s) {
    return rational_squared_distance(rational(p), s);
}

/// Sign of sqrt(a) - sqrt(b) - c by 1024-bit numbers. A difference that is not zero is the root of a polynomial of
/// degree four whose coefficients' sizes keep it above 2^-500 for all that lattice coordinates can give.
inline int sign_of_difference(const Rational& a, const Rational& b, const Rational& c) {
    const auto root = [](const Rational& q) {
        mpf_class value(q, 1024), result(0, 1024);
        mpf_sqrt(result.get_mpf_t(), value.get_mpf_t());
        return result;
    };
    mpf_class difference(0, 1024), zero(1, 1024);
    difference = root(a) - root(b) - mpf_class(c, 1024);
    mpf_div_2exp(zero.get_mpf_t(), zero.get_mpf_t(), 600);
    return abs(difference) < zero ? 0 : sgn(difference);
}

/// Do two closed segments share a point? By the parameters of the common point, or overlap along a line.
inline bool rational_touch(const Segment& s, const Segment& t) {
    const RationalPoint a = rational(s.a), u = rational(s.b) - a, b = rational(t.a), v = rational(t.b) - b, w = b - a;
    const Rational d = wedge(u, v);
    if (d != 0) {
        const Rational along_s = wedge(w, v) / d, along_t = wedge(w, u) / d;
        return along_s >= 0 && along_s <= 1 && along_t >= 0 && along_t <= 1;
    }
    const auto on = [](const Segment& e, Point p) { return rational_squared_distance(p, e) == 0; };
    return on(s, t.a) || on(s, t.b) || on(t, s.a) || on(t, s.b);
}

/// A point whose coordinates are of one of several sizes, up to the bound of the lattice.
inline Point random_point(Random& g) {
    static constexpr Unit sizes[] = {3, 50, 20000, 10000000, lattice_bound};
    const Unit size = sizes[pick(g, 0, 4)];
    return {pick(g, -size, size), pick(g, -size, size)};
}

/// Within a unit of a point of the segment, often on it: where signs are hardest to tell.
inline Point near_segment(Random& g, const Segment& s) {
    const Point u = s.b - s.a;
    const double t = std::uniform_real_distribution<double>(-0.2, 1.2)(g);
    const Point p{s.a.x + round_to_lattice(t * static_cast<double>(u.x)) + pick(g, -1, 1),
                  s.a.y + round_to_lattice(t * static_cast<double>(u.y)) + pick(g, -1, 1)};
    return {std::clamp(p.x, -lattice_bound, lattice_bound), std::clamp(p.y, -lattice_bound, lattice_bound)};
}

}  // namespace ribvault::test
