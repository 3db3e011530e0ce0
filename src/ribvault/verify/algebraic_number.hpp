// Numbers with up to two square roots, one perhaps within the other: the coordinates of all points in which circles and
// lines meet, and all that is asked of them. Light: GMP only.
#pragma once

#include "ribvault/verify/quadratic_number.hpp"

namespace ribvault::verify {

/// a + b sqrt(d), d >= 0, where a, b and d are p + q sqrt(n) with one rational n. Its signs are those of rationals
/// (squares are compared where two terms differ in sign), whether or not the roots are independent.
///
/// Sums and products throw std::logic_error where more roots come together than such a number holds, and divisions
/// where the divisor is not rational.
class AlgebraicNumber {
public:
    AlgebraicNumber(double value = 0) : a_{Rational(value), 0, 0} {}
    AlgebraicNumber(const Rational& value) : a_{value, 0, 0} {}

    friend AlgebraicNumber operator+(AlgebraicNumber x, AlgebraicNumber y);
    friend AlgebraicNumber operator-(AlgebraicNumber x, AlgebraicNumber y);
    friend AlgebraicNumber operator-(AlgebraicNumber x) { return AlgebraicNumber() - std::move(x); }
    friend AlgebraicNumber operator*(AlgebraicNumber x, AlgebraicNumber y);
    friend AlgebraicNumber operator/(AlgebraicNumber x, const AlgebraicNumber& y);

    /// Square root of a number >= 0 with one root at most. Throws std::logic_error when it has two.
    friend AlgebraicNumber root(const AlgebraicNumber& x);

    /// -1, 0 or 1. Exact.
    friend int sign_of(const AlgebraicNumber& x);

    /// A rational within 2^-bits of x.
    friend Rational approximation(const AlgebraicNumber& x, unsigned bits);

private:
    AlgebraicNumber(QuadraticNumber a, QuadraticNumber b, QuadraticNumber d)
        : a_(std::move(a)), b_(std::move(b)), d_(std::move(d)) {}
    bool one_root() const { return b_.p == 0 && b_.q == 0; }
    const Rational* inner() const;
    void move_root_out();
    void swap_roots();
    static void bring_together(AlgebraicNumber& x, AlgebraicNumber& y);
    static bool hold_together(AlgebraicNumber& x, AlgebraicNumber& y);

    QuadraticNumber a_, b_, d_;
};

}  // namespace ribvault::verify
