// Numbers p + q sqrt(d): where a line with rational coefficients enters and leaves a stadium, and what square roots of
// them are built on (algebraic_number.hpp). Light: GMP only.
#pragma once

#include <array>

#include "ribvault/exact/rational.hpp"

namespace ribvault::verify {

/// p + q sqrt(d), d >= 0. A rational number has q = 0 (see quadratic()).
struct QuadraticNumber {
    Rational p, q, d;
    bool rational() const { return q == 0; }
};

/// p + q sqrt(d) with the root taken where it is rational. Precondition: d >= 0.
QuadraticNumber quadratic(const Rational& p, const Rational& q, const Rational& d);

/// Sums and products. Precondition: one of them is rational, or both have the same d.
QuadraticNumber operator+(const QuadraticNumber& a, const QuadraticNumber& b);
QuadraticNumber operator-(const QuadraticNumber& a, const QuadraticNumber& b);
QuadraticNumber operator*(const QuadraticNumber& a, const QuadraticNumber& b);

/// Sign of p + q sqrt(d). Exact: rational arithmetic on squares.
int sign(const QuadraticNumber& a);

/// Sign of u + v, given the signs of both; `compare_squares` gives that of u^2 - v^2 and is asked only where they
/// differ.
template <class CompareSquares>
int sign_of_sum(int u, int v, const CompareSquares& compare_squares) {
    if (u == 0 || v == 0 || u == v) return u != 0 ? u : v;
    const int c = compare_squares();
    return c > 0 ? u : c < 0 ? v : 0;
}

/// Sign of a - b. Exact: rational arithmetic on squares.
int compare(const QuadraticNumber& a, const QuadraticNumber& b);

/// Rationals lo <= a <= hi, about q sqrt(d) 2^-bits apart (equal when a is rational).
std::array<Rational, 2> enclose(const QuadraticNumber& a, unsigned bits);

}  // namespace ribvault::verify
