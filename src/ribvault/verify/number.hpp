// The three number types of the verifier's predicates, and the exact points of the input in each of them.
#pragma once

#include <CGAL/Interval_nt.h>
#include <CGAL/number_utils.h>

#include "ribvault/exact/rational.hpp"
#include "ribvault/slice/exact_polygons.hpp"
#include "ribvault/verify/core_number.hpp"

namespace ribvault::verify {

using Interval = CGAL::Interval_nt_advanced;
using Algebraic = CORE::Expr;

/// Thrown by root() on rationals whose square root is none: the rational stage cannot answer.
struct NotRational {};

/// What sign_of() says when intervals leave the sign open.
inline constexpr int unknown = 2;

/// An exact point of the input in lattice units: a lattice point, or a slice's vertex (mm) times units_per_mm.
struct Vertex {
    Interval x, y;          ///< certified enclosure
    double cx = 0, cy = 0;  ///< within 2^-50 of its magnitude
    Point lattice;          ///< the point itself when `slice` is null
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
/// `p` must outlive the vertex. Call under upward rounding (CGAL::Protect_FPU_rounding).
Vertex slice_vertex(const ExactKernel::Point_2& p);

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
Algebraic root(const Algebraic& a);

/// -1, 0, 1, or `unknown` (intervals only).
inline int sign_of(const Interval& a) {
    if (a.inf() > 0) return 1;
    if (a.sup() < 0) return -1;
    return a.inf() == 0 && a.sup() == 0 ? 0 : unknown;
}
inline int sign_of(const Rational& a) { return sgn(a); }
inline int sign_of(const Algebraic& a) { return a.sign(); }

Algebraic to_algebraic(const Rational& a);

/// A double to the number type, exactly.
template <class NT>
NT number(double a) {
    return NT(a);
}

}  // namespace ribvault::verify
