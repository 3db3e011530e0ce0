// Numbers p + q sqrt(d): where a line with rational coefficients enters and leaves a stadium. Light: GMP only.
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

/// Sign of p + q sqrt(d). Exact: rational arithmetic on squares.
int sign(const QuadraticNumber& a);

/// Sign of a - b. Exact: rational arithmetic on squares.
int compare(const QuadraticNumber& a, const QuadraticNumber& b);

/// Rationals lo <= a <= hi, about q sqrt(d) 2^-bits apart (equal when a is rational).
std::array<Rational, 2> enclose(const QuadraticNumber& a, unsigned bits);

}  // namespace ribvault::verify
