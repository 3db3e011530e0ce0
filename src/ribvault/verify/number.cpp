#include "ribvault/verify/number.hpp"

#include <CGAL/FPU.h>

#include <cmath>

namespace ribvault::verify {

Vertex lattice_vertex(Point p) {
    Vertex v;
    v.cx = static_cast<double>(p.x), v.cy = static_cast<double>(p.y);
    v.x = Interval(v.cx), v.y = Interval(v.cy);  // |p| <= lattice_bound < 2^53: exact
    v.lattice = p;
    return v;
}

Vertex slice_vertex(const ExactKernel::Point_2& p) {
    const auto scaled = [](const ExactKernel::FT& a) {
        const std::pair<double, double> mm = tight_enclosure(a);
        return Interval(mm.first, mm.second) * Interval(static_cast<double>(units_per_mm));
    };
    Vertex v;
    v.x = scaled(p.x()), v.y = scaled(p.y());
    // Each end is off by one rounding of the product, half the width 2^-52 before it: the middle is within 2^-50.
    v.cx = (v.x.inf() + v.x.sup()) / 2, v.cy = (v.y.inf() + v.y.sup()) / 2;
    v.slice = &p;
    return v;
}

Interval enclosure(const Rational& a) {
    const double d = a.get_d();  // truncated towards zero
    if (std::isfinite(d) && Rational(d) == a) return Interval(d);
    return a > 0 ? Interval(d, std::nextafter(d, HUGE_VAL)) : Interval(std::nextafter(d, -HUGE_VAL), d);
}

Interval enclosure(const Algebraic& a) {
    constexpr unsigned bits = 128;
    const Rational close = approximation(a, bits), off = power_of_two(-static_cast<int>(bits));
    return {enclosure(Rational(close - off)).inf(), enclosure(Rational(close + off)).sup()};
}

Vertex rational_vertex(const Vec<Rational>& p) {
    Vertex v;
    v.x = enclosure(p.x), v.y = enclosure(p.y);
    v.cx = v.x.inf(), v.cy = v.y.inf();
    v.rational = &p;
    return v;
}

template <>
Vec<Rational> exact_point<Rational>(const Vertex& v) {
    if (v.rational) return *v.rational;
    if (!v.slice) return {Rational(static_cast<long>(v.lattice.x)), Rational(static_cast<long>(v.lattice.y))};
    const Rational scale(static_cast<long>(units_per_mm));
    const auto& exact = CGAL::exact(*v.slice);
    return {Rational(exact.x() * scale), Rational(exact.y() * scale)};
}

template <>
Vec<Algebraic> exact_point<Algebraic>(const Vertex& v) {
    const Vec<Rational> q = exact_point<Rational>(v);
    return {Algebraic(q.x), Algebraic(q.y)};
}

Interval root(const Interval& a) { return CGAL::sqrt(a.inf() < 0 ? Interval(0, a.sup() < 0 ? 0 : a.sup()) : a); }

Rational root(const Rational& a) {
    if (mpz_perfect_square_p(a.get_num_mpz_t()) == 0 || mpz_perfect_square_p(a.get_den_mpz_t()) == 0)
        throw NotRational{};
    return Rational(sqrt(a.get_num()), sqrt(a.get_den()));
}

}  // namespace ribvault::verify
