// Exact lengths that are nearly always short decimals: without memory of their own, cheap to copy and to compare.
#pragma once

#include <compare>
#include <cstdint>
#include <memory>

#include "ribvault/exact/rational.hpp"

namespace ribvault {

/// An exact rational number of millimetres. A multiple of a picometre (1e-9 mm) below 9e9 mm is held as an integer, any
/// other rational as itself, shared between copies. Which of both it is follows from the value.
class Millimetres {
public:
    Millimetres() = default;
    Millimetres(const Rational& value);  // NOLINT(google-explicit-constructor): every rational is one
    Millimetres(int value) : Millimetres(of_picometres(value * picometres_per_mm)) {}  // NOLINT
    template <class U>
    Millimetres(const __gmp_expr<mpq_t, U>& expression)
        : Millimetres(Rational(expression)) {}  // NOLINT: what arithmetic on Rationals gives
    static Millimetres of_picometres(std::int64_t value);
    static constexpr std::int64_t picometres_per_mm = 1000000000;

    operator Rational() const;  // NOLINT
    /// The value cut off towards zero to a double, as Rational::get_d.
    double get_d() const { return approximate_; }
    /// Whether it is a whole number of picometres.
    bool whole() const { return !other_; }
    /// Precondition: whole().
    std::int64_t picometres() const { return picometres_; }

    friend bool operator==(const Millimetres& a, const Millimetres& b) {
        return a.other_ && b.other_ ? *a.other_ == *b.other_ : !a.other_ && !b.other_ && a.picometres_ == b.picometres_;
    }
    friend std::strong_ordering operator<=>(const Millimetres& a, const Millimetres& b) {
        return a.other_ || b.other_ ? compare(a, b) : a.picometres_ <=> b.picometres_;
    }

    /// Exact arithmetic is that of rationals.
    friend Rational operator+(const Millimetres& a, const Millimetres& b) { return Rational(a) + Rational(b); }
    friend Rational operator-(const Millimetres& a, const Millimetres& b) { return Rational(a) - Rational(b); }
    friend Rational operator*(const Millimetres& a, const Millimetres& b) { return Rational(a) * Rational(b); }
    friend Rational operator/(const Millimetres& a, const Millimetres& b) { return Rational(a) / Rational(b); }

private:
    static std::strong_ordering compare(const Millimetres& a, const Millimetres& b);

    std::int64_t picometres_ = 0;
    double approximate_ = 0;
    std::shared_ptr<const Rational> other_;  ///< null: picometres_
};

/// a / 2 + b.
Millimetres half_plus(const Millimetres& a, const Millimetres& b);

}  // namespace ribvault
