// Stands before ribvault/verify/number.hpp when the verifier is compiled a second time: the same checks in plain
// doubles. What was an interval with a certified enclosure is one rounded number here, and its sign is believed.
#pragma once

#include <CGAL/Interval_nt.h>
#include <CGAL/number_utils.h>

#include <cmath>

#include "ribvault/exact/rational.hpp"
#include "ribvault/slice/exact_polygons.hpp"
#include "ribvault/verify/algebraic_number.hpp"

namespace CGAL {
/// Doubles round to nearest, as everybody's do.
template <bool>
struct Rounds_to_nearest {
    explicit Rounds_to_nearest(FPU_CW_t = CGAL_FE_TONEAREST) {}
};
}  // namespace CGAL
#define Protect_FPU_rounding Rounds_to_nearest

namespace ribvault::verify {

class Interval {
public:
    Interval(double a = 0) : a_(a) {}
    Interval(double lo, double hi) : a_((lo + hi) / 2) {}
    double inf() const { return a_; }
    double sup() const { return a_; }
    friend Interval operator+(Interval p, Interval q) { return p.a_ + q.a_; }
    friend Interval operator-(Interval p, Interval q) { return p.a_ - q.a_; }
    friend Interval operator*(Interval p, Interval q) { return p.a_ * q.a_; }
    friend Interval operator/(Interval p, Interval q) { return p.a_ / q.a_; }
    friend Interval operator-(Interval p) { return -p.a_; }
    Interval& operator+=(Interval q) { return a_ += q.a_, *this; }
    Interval& operator-=(Interval q) { return a_ -= q.a_, *this; }

private:
    double a_;
};
using Algebraic = AlgebraicNumber;

/// Thrown by root() on rationals whose square root is none: the rational stage cannot answer.
struct NotRational {};

/// What sign_of() says when intervals leave the sign open.
inline constexpr int unknown = 2;

template <class NT>
struct Vec {
    NT x, y;
};

/// An exact point of the input in lattice units: a lattice point, a slice's vertex (mm) times units_per_mm, or any
/// rational point.
struct Vertex {
    Interval x, y;          ///< certified enclosure
    double cx = 0, cy = 0;  ///< within 2^-50 of its magnitude
    Point lattice;          ///< the point itself when the pointers are null
    const ExactKernel::Point_2* slice = nullptr;
    const Vec<Rational>* rational = nullptr;
};
template <class NT>
Vec<NT> operator-(const Vec<NT>& p, const Vec<NT>& q) {
    return {NT(p.x - q.x), NT(p.y - q.y)};
}
template <class NT>
NT dot(const Vec<NT>& p, const Vec<NT>& q) {
    return NT(p.x * q.x + p.y * q.y);
}
template <class NT>
NT cross(const Vec<NT>& p, const Vec<NT>& q) {
    return NT(p.x * q.y - p.y * q.x);
}

Vertex lattice_vertex(Point p);
/// `p` must outlive the vertex. Call under upward rounding (CGAL::Protect_FPU_rounding).
Vertex slice_vertex(const ExactKernel::Point_2& p);
/// `p` must outlive the vertex.
Vertex rational_vertex(const Vec<Rational>& p);

/// Doubles next to each other, or equal ones, that enclose a number.
Interval enclosure(const Rational& a);
Interval enclosure(const Algebraic& a);

/// The vertex in the number type NT.
template <class NT>
Vec<NT> exact_point(const Vertex& v);
template <>
inline Vec<Interval> exact_point<Interval>(const Vertex& v) {
    return {v.x, v.y};
}
template <>
Vec<Rational> exact_point<Rational>(const Vertex& v);
template <>
Vec<Algebraic> exact_point<Algebraic>(const Vertex& v);

/// Square root of a number known to be >= 0.
Interval root(const Interval& a);
Rational root(const Rational& a);  ///< throws NotRational

/// Always an answer, but for NaN (0 / 0), which falls back to exact numbers as a program with doubles could not.
inline int sign_of(const Interval& a) { return a.inf() > 0 ? 1 : a.inf() < 0 ? -1 : a.inf() == 0 ? 0 : unknown; }
inline int sign_of(const Rational& a) { return sgn(a); }

/// A double to the number type, exactly.
template <class NT>
NT number(double a) {
    return NT(a);
}

/// A radius that is no binary float. A problem holds one for each value, so that equal radii have equal addresses.
struct ExactRadius {
    Rational value;
    Interval enclosure;  ///< of `value`
};

/// A length >= 0 in lattice units: a binary float, or a rational that is none. Never the same value in both ways.
struct Radius {
    double approx = 0;                   ///< within 2^-52 of its magnitude
    const ExactRadius* exact = nullptr;  ///< null: `approx` itself
    Radius(double value = 0) : approx(value) {}
    /// Precondition: r.value is no binary float. `r` must outlive the radius.
    explicit Radius(const ExactRadius& r) : approx(r.enclosure.inf()), exact(&r) {}
    friend bool operator==(const Radius&, const Radius&) = default;
};

template <class NT>
NT number(const Radius& r);
template <>
inline Interval number<Interval>(const Radius& r) {
    return r.exact ? r.exact->enclosure : Interval(r.approx);
}
template <>
inline Rational number<Rational>(const Radius& r) {
    return r.exact ? r.exact->value : Rational(r.approx);
}
template <>
inline Algebraic number<Algebraic>(const Radius& r) {
    return r.exact ? Algebraic(r.exact->value) : Algebraic(r.approx);
}

/// r - sign * s; no rounding where r = s.
template <class NT>
NT difference(const Radius& r, int sign, const Radius& s) {
    if (r == s) return sign > 0 ? NT(0) : NT(NT(2) * number<NT>(r));
    return sign > 0 ? NT(number<NT>(r) - number<NT>(s)) : NT(number<NT>(r) + number<NT>(s));
}

/// Whether r <= s, exactly.
inline bool no_greater(const Radius& r, const Radius& s) {
    if (!r.exact && !s.exact) return r.approx <= s.approx;
    return r == s || number<Rational>(r) <= number<Rational>(s);
}

}  // namespace ribvault::verify

namespace CGAL {
inline ribvault::verify::Interval abs(const ribvault::verify::Interval& a) { return std::abs(a.inf()); }
}  // namespace CGAL
