// Decimals as they stand in a file, without rounding and without the cost of a rational each.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "ribvault/exact/int128.hpp"
#include "ribvault/exact/rational.hpp"

namespace ribvault {

/// A number with at most 18 decimals, as a multiple of 1e-18. Sums, differences and multiples by integers are exact.
struct Decimal {
    Int128 value = 0;
    friend bool operator==(Decimal, Decimal) = default;
    friend auto operator<=>(Decimal, Decimal) = default;
};
inline Decimal operator+(Decimal a, Decimal b) { return {a.value + b.value}; }
inline Decimal operator-(Decimal a, Decimal b) { return {a.value - b.value}; }

inline constexpr int decimal_places = 18;
inline constexpr std::int64_t decimal_one = 1000000000000000000;  ///< 1 as a multiple of 1e-18
inline constexpr std::int64_t decimal_limit = 10000000;  ///< numbers in a file stay below this: 10 km, or of filament

/// The number at the start of `text`: sign, digits, at most one point. No exponent: in G-code, E is the extruder.
struct ScannedDecimal {
    enum class Fault { none, no_number, too_many_decimals, too_large } fault = Fault::none;
    Decimal number;
    std::size_t length = 0;  ///< characters used
};
ScannedDecimal scan_decimal(std::string_view text);

/// The whole text, blanks around it allowed, as a number; nothing when it is none.
std::optional<Decimal> parse_decimal(std::string_view text);

inline double to_double(Decimal d) { return static_cast<double>(d.value) / static_cast<double>(decimal_one); }
/// The nearest multiple of 1e-9; a choice, for what is computed and not read. Precondition: |value| < 1e9.
Decimal rounded_decimal(double value);
/// times 25.4, exactly (one more decimal), or nothing when there is no room for it.
std::optional<Decimal> inches(Decimal d);
Rational to_rational(Decimal d);

}  // namespace ribvault
