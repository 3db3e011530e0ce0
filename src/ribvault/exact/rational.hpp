// Exact rational numbers and the decimals users write.
#pragma once

#include <gmpxx.h>

#include <string>
#include <string_view>

#include "ribvault/exact/lattice.hpp"

namespace ribvault {

using Rational = mpq_class;

/// 2^exponent.
Rational power_of_two(int exponent);

/// The greatest multiple of 2^-bits that is no greater.
Rational rounded_down(const Rational& a, unsigned bits);

/// "0.2", "-3", "1e-3" or a fraction "1/2.4" as the exact rational it denotes.
/// Throws Error (usage) naming `what` when the text is not a number.
Rational parse_rational(std::string_view text, std::string_view what);

/// A length in mm as written by the user, in lattice units, exactly.
/// Throws Error (usage) when it is not a number or finer than the lattice (10 nm).
Unit parse_length(std::string_view text, std::string_view what);

/// A length as decimals of a mm without closing zeros: "0.4".
std::string millimetres(Unit length);

}  // namespace ribvault
