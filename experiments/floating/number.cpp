#include "ribvault/verify/number.hpp"

namespace ribvault::verify {

Vertex lattice_vertex(Point p) {
    Vertex v;
    v.cx = static_cast<double>(p.x), v.cy = static_cast<double>(p.y);
    v.x = v.cx, v.y = v.cy, v.lattice = p;
    return v;
}
Vertex slice_vertex(const ExactKernel::Point_2& p) {
    Vertex v;
    v.cx = CGAL::to_double(p.x()) * static_cast<double>(units_per_mm),
    v.cy = CGAL::to_double(p.y()) * static_cast<double>(units_per_mm);
    v.x = v.cx, v.y = v.cy, v.slice = &p;
    return v;
}
Interval enclosure(const Rational& a) { return a.get_d(); }
Interval enclosure(const Algebraic& a) { return approximation(a, 128).get_d(); }
template <>
Vec<Rational> exact_point<Rational>(const Vertex& v) {
    if (!v.slice) return {Rational(static_cast<long>(v.lattice.x)), Rational(static_cast<long>(v.lattice.y))};
    const Rational scale(static_cast<long>(units_per_mm));
    return {Rational(CGAL::exact(v.slice->x()) * scale), Rational(CGAL::exact(v.slice->y()) * scale)};
}
template <>
Vec<Algebraic> exact_point<Algebraic>(const Vertex& v) {
    const Vec<Rational> q = exact_point<Rational>(v);
    return {Algebraic(q.x), Algebraic(q.y)};
}
Interval root(const Interval& a) { return std::sqrt(std::max(a.inf(), 0.0)); }
Rational root(const Rational& a) {
    if (mpz_perfect_square_p(a.get_num_mpz_t()) == 0 || mpz_perfect_square_p(a.get_den_mpz_t()) == 0)
        throw NotRational{};
    return Rational(sqrt(a.get_num()), sqrt(a.get_den()));
}

}  // namespace ribvault::verify
