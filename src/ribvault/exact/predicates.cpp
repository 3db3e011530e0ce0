#include "ribvault/exact/predicates.hpp"

#include <gmpxx.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ribvault {
namespace {

mpz_class to_mpz(Int128 v) {
    const bool negative = v < 0;
    const UInt128 u = negative ? -static_cast<UInt128>(v) : static_cast<UInt128>(v);
    mpz_class result(static_cast<unsigned long>(u >> 64));
    result <<= 64;
    result += static_cast<unsigned long>(u & ~0ULL);
    return negative ? mpz_class(-result) : result;
}

int compare_exact(const SquaredDistance& a, const SquaredDistance& b) {
    return sgn(
        mpz_class(to_mpz(a.numerator) * mpz_class(b.denominator) - to_mpz(b.numerator) * mpz_class(a.denominator)));
}

/// Sign of sqrt(a) - sqrt(b) - c over the rationals, by squaring with the signs kept track of.
int compare_biased_exact(const mpq_class& a, const mpq_class& b, const mpq_class& c) {
    // sqrt(a) > sqrt(b) + c  <=>  a > b + c^2 + 2 c sqrt(b) when sqrt(b) + c >= 0.
    if (c < 0) return -compare_biased_exact(b, a, mpq_class(-c));
    const mpq_class left = a - b - c * c;
    if (left < 0) return -1;
    return cmp(mpq_class(left * left), mpq_class(4 * c * c * b));
}

mpq_class to_rational(const SquaredDistance& d) {
    mpq_class q(to_mpz(d.numerator), mpz_class(d.denominator));
    q.canonicalize();
    return q;
}

}  // namespace

SquaredDistance squared_distance(Point p, const Segment& s) {
    const Point u = s.b - s.a, v = p - s.a;
    const std::int64_t along = u.x * v.x + u.y * v.y, l2 = squared_length(u);
    if (along <= 0) return {squared_length(v), 1};
    if (along >= l2) return {squared_length(p - s.b), 1};
    // Axis-parallel segments give whole numbers, so that equal distances to different ones compare equal at once.
    if (u.x == 0) return {static_cast<Int128>(v.x) * v.x, 1};
    if (u.y == 0) return {static_cast<Int128>(v.y) * v.y, 1};
    const std::int64_t c = cross(s.a, s.b, p);
    return {static_cast<Int128>(c) * c, l2};
}

int compare_distance(Point p, const Segment& s, Unit radius) {
    if (radius < 0) return 1;
    // |cross| < 2^63 and radius^2 * length^2 < 2^62 * 2^63: both sides fit 128 bits.
    const SquaredDistance d = squared_distance(p, s);
    const Int128 bound = static_cast<Int128>(radius) * radius * d.denominator;
    return (d.numerator > bound) - (d.numerator < bound);
}

int compare_distance(const Segment& s, const Segment& t, Unit radius) {
    if (segments_touch(s, t)) return radius > 0 ? -1 : 0;
    return std::min({compare_distance(s.a, t, radius), compare_distance(s.b, t, radius),
                     compare_distance(t.a, s, radius), compare_distance(t.b, s, radius)});
}

double distance(const Segment& s, const Segment& t) {
    if (segments_touch(s, t)) return 0;
    double least = HUGE_VAL;
    for (const Point p : {s.a, s.b}) least = std::min(least, squared_distance(p, t).value());
    for (const Point p : {t.a, t.b}) least = std::min(least, squared_distance(p, s).value());
    return std::sqrt(least);
}

static_assert(std::numeric_limits<long double>::digits >= 64, "the filters below count on relative errors of 2^-64");

int compare(const SquaredDistance& a, const SquaredDistance& b) {
    if (a.denominator == b.denominator) return (a.numerator > b.numerator) - (a.numerator < b.numerator);
    // Each conversion and product rounds once with relative error 2^-64; the two sides together by less than 2^-61.
    const long double left = static_cast<long double>(a.numerator) * static_cast<long double>(b.denominator);
    const long double right = static_cast<long double>(b.numerator) * static_cast<long double>(a.denominator);
    const long double bound = 0x1p-60L * (left + right);
    if (left - right > bound) return 1;
    if (right - left > bound) return -1;
    return compare_exact(a, b);
}

int compare_biased(const SquaredDistance& a, Unit bias_a, const SquaredDistance& b, Unit bias_b) {
    if (bias_a == bias_b) return compare(a, b);
    const long double ra = std::sqrt(static_cast<long double>(a.numerator) / static_cast<long double>(a.denominator));
    const long double rb = std::sqrt(static_cast<long double>(b.numerator) / static_cast<long double>(b.denominator));
    const long double difference = (ra - static_cast<long double>(bias_a)) - (rb - static_cast<long double>(bias_b));
    // Every operation rounds once with relative error 2^-64 on operands below the sum of magnitudes; eight operations.
    const long double bound = 0x1p-60L * (ra + rb + std::fabs(static_cast<long double>(bias_a)) +
                                          std::fabs(static_cast<long double>(bias_b)));
    if (difference > bound) return 1;
    if (difference < -bound) return -1;
    return compare_biased_exact(to_rational(a), to_rational(b), mpq_class(static_cast<long>(bias_a - bias_b)));
}

bool segments_touch(const Segment& s, const Segment& t) {
    if (std::max(s.a.x, s.b.x) < std::min(t.a.x, t.b.x) || std::max(t.a.x, t.b.x) < std::min(s.a.x, s.b.x) ||
        std::max(s.a.y, s.b.y) < std::min(t.a.y, t.b.y) || std::max(t.a.y, t.b.y) < std::min(s.a.y, s.b.y))
        return false;
    return orientation(s.a, s.b, t.a) * orientation(s.a, s.b, t.b) <= 0 &&
           orientation(t.a, t.b, s.a) * orientation(t.a, t.b, s.b) <= 0;
}

bool segments_cross(const Segment& s, const Segment& t) {
    return orientation(s.a, s.b, t.a) * orientation(s.a, s.b, t.b) < 0 &&
           orientation(t.a, t.b, s.a) * orientation(t.a, t.b, s.b) < 0;
}

Point nearest_point(Point p, const Segment& s) {
    const Point u = s.b - s.a, v = p - s.a;
    const double along =
        static_cast<double>(u.x) * static_cast<double>(v.x) + static_cast<double>(u.y) * static_cast<double>(v.y);
    const double l2 = static_cast<double>(squared_length(u));
    if (along <= 0 || l2 == 0) return s.a;
    if (along >= l2) return s.b;
    return part_way(s.a, s.b, along / l2);
}

}  // namespace ribvault
