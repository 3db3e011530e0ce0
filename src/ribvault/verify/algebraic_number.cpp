#include "ribvault/verify/algebraic_number.hpp"

#include <stdexcept>
#include <utility>

namespace ribvault::verify {

namespace {

bool same(const QuadraticNumber& x, const QuadraticNumber& y) {
    return x.p == y.p && x.q == y.q && (x.rational() || x.d == y.d);
}

QuadraticNumber over(const QuadraticNumber& x, const Rational& y) {
    return {Rational(x.p / y), Rational(x.q / y), x.d};
}

Rational least(const Rational& a, const Rational& b) { return a < b ? a : b; }
Rational greatest(const Rational& a, const Rational& b) { return a < b ? b : a; }

}  // namespace

/// The n of a_, b_ and d_; null when all of them are rational.
const Rational* AlgebraicNumber::inner() const {
    if (!a_.rational()) return &a_.d;
    if (one_root()) return nullptr;
    if (!b_.rational()) return &b_.d;
    return d_.rational() ? nullptr : &d_.d;
}

/// p + q sqrt(n) as a = p, b = q, d = n. Precondition: one_root().
void AlgebraicNumber::move_root_out() {
    b_ = {a_.q, 0, 0}, d_ = {a_.d, 0, 0};
    a_ = {a_.p, 0, 0};
}

/// p + q sqrt(n) + (s + t sqrt(n)) sqrt(d) as p + s sqrt(d) + (q + t sqrt(d)) sqrt(n). Precondition: d_ is rational.
void AlgebraicNumber::swap_roots() {
    const Rational n = inner() ? *inner() : Rational(0), d = d_.p;
    const QuadraticNumber a = a_, b = b_;
    a_ = {a.p, b.p, d}, b_ = {a.q, b.q, d}, d_ = {n, 0, 0};
}

/// Gives both one n and one d, with y's roots placed as x's are where that does it.
bool AlgebraicNumber::hold_together(AlgebraicNumber& x, AlgebraicNumber& y) {
    const Rational *n = x.inner(), *m = y.inner();
    const bool one_inner = !n || !m || *n == *m;
    if (!x.one_root() && !y.one_root()) {
        if (one_inner && same(x.d_, y.d_)) return true;
        if (!x.d_.rational() || !y.d_.rational() || (n && *n != y.d_.p) || (m && *m != x.d_.p)) return false;
        y.swap_roots();
        return true;
    }
    if (x.one_root() && !y.one_root()) return false;
    if (!x.one_root() && m && x.d_.rational() && x.d_.p == *m) {
        y.move_root_out();
        return true;
    }
    if (one_inner) return true;
    if (!x.one_root()) return false;
    y.move_root_out();
    return true;
}

void AlgebraicNumber::bring_together(AlgebraicNumber& x, AlgebraicNumber& y) {
    if (!hold_together(x, y) && !hold_together(y, x)) throw std::logic_error("exact arithmetic: too many square roots");
    if (x.one_root()) x.d_ = y.d_;
}

AlgebraicNumber operator+(AlgebraicNumber x, AlgebraicNumber y) {
    AlgebraicNumber::bring_together(x, y);
    return {x.a_ + y.a_, x.b_ + y.b_, std::move(x.d_)};
}
AlgebraicNumber operator-(AlgebraicNumber x, AlgebraicNumber y) {
    AlgebraicNumber::bring_together(x, y);
    return {x.a_ - y.a_, x.b_ - y.b_, std::move(x.d_)};
}
AlgebraicNumber operator*(AlgebraicNumber x, AlgebraicNumber y) {
    AlgebraicNumber::bring_together(x, y);
    return {x.a_ * y.a_ + x.b_ * y.b_ * x.d_, x.a_ * y.b_ + x.b_ * y.a_, x.d_};
}
AlgebraicNumber operator/(AlgebraicNumber x, const AlgebraicNumber& y) {
    if (!y.one_root() || !y.a_.rational()) throw std::logic_error("exact arithmetic: division by a square root");
    return {over(x.a_, y.a_.p), over(x.b_, y.a_.p), std::move(x.d_)};
}

AlgebraicNumber root(const AlgebraicNumber& x) {
    if (!x.one_root()) throw std::logic_error("exact arithmetic: the root of two square roots");
    if (x.a_.rational()) return {quadratic(0, 1, x.a_.p), {}, {}};
    return {{}, {1, 0, 0}, x.a_};
}

int sign_of(const AlgebraicNumber& x) {
    if (x.one_root()) return sign(x.a_);
    return sign_of_sum(sign(x.a_), sign(x.b_) * sign(x.d_), [&] { return sign(x.a_ * x.a_ - x.b_ * x.b_ * x.d_); });
}

Rational approximation(const AlgebraicNumber& x, unsigned bits) {
    Rational enough(1);
    mpq_div_2exp(enough.get_mpq_t(), enough.get_mpq_t(), bits);
    for (unsigned digits = bits + 64;; digits *= 2) {
        auto [lo, hi] = enclose(x.a_, digits);
        if (!x.one_root()) {
            const auto [from, to] = enclose(x.d_, digits);
            const Rational low = enclose({0, 1, greatest(from, 0)}, digits)[0], high = enclose({0, 1, to}, digits)[1];
            const auto [b, c] = enclose(x.b_, digits);
            lo += least(b * low, b * high), hi += greatest(c * low, c * high);
        }
        if (hi - lo <= enough) return Rational((lo + hi) / 2);
    }
}

}  // namespace ribvault::verify
