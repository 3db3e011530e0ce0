// Stands before ribvault/verify/number.hpp when the verifier is compiled a second time: the same checks in plain doubles. What was an
// interval with a certified enclosure is one rounded number here, and its sign is believed.
#pragma once

#include <CGAL/Interval_nt.h>
#include <CGAL/number_utils.h>

#include <cmath>

#include "ribvault/exact/rational.hpp"
#include "ribvault/slice/exact_polygons.hpp"
#include "ribvault/verify/core_number.hpp"

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
using Algebraic = CORE::Expr;

struct NotRational {};

inline constexpr int unknown = 2;

struct Vertex {
    Interval x, y;
    double cx = 0, cy = 0;
    Point lattice;
    const ExactKernel::Point_2* slice = nullptr;
};

template <class NT>
struct Vec {
    NT x, y;
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
Vertex slice_vertex(const ExactKernel::Point_2& p);

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

Interval root(const Interval& a);
Rational root(const Rational& a);
Algebraic root(const Algebraic& a);

/// Always an answer, but for NaN (0 / 0), which falls back to exact numbers as a program with doubles could not.
inline int sign_of(const Interval& a) { return a.inf() > 0 ? 1 : a.inf() < 0 ? -1 : a.inf() == 0 ? 0 : unknown; }
inline int sign_of(const Rational& a) { return sgn(a); }
inline int sign_of(const Algebraic& a) { return a.sign(); }

Algebraic to_algebraic(const Rational& a);

template <class NT>
NT number(double a) {
    return NT(a);
}

}  // namespace ribvault::verify

namespace CGAL {
inline ribvault::verify::Interval abs(const ribvault::verify::Interval& a) { return std::abs(a.inf()); }
}  // namespace CGAL
