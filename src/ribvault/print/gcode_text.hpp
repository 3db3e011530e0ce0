// Numbers as G-code has them.
#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

#include "ribvault/settings.hpp"

namespace ribvault {

inline void append_integer(std::string& text, std::int64_t value) {
    char digits[24];
    text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

/// A number of hundred-thousandths with as many decimals as it needs.
inline void append_decimal(std::string& text, std::int64_t value) {
    if (value < 0) text += '-', value = -value;
    append_integer(text, value / units_per_mm);
    std::int64_t fraction = value % units_per_mm;
    if (fraction == 0) return;
    char digits[6] = {'.', '0', '0', '0', '0', '0'};
    for (int i = 5; i > 0; --i, fraction /= 10) digits[i] = static_cast<char>('0' + fraction % 10);
    int count = 6;
    while (digits[count - 1] == '0') --count;
    text.append(digits, static_cast<std::size_t>(count));
}

inline std::int64_t hundred_thousandths(double value) {
    return std::llround(value * static_cast<double>(units_per_mm));
}

inline std::string decimal_text(double value) {
    std::string text;
    append_decimal(text, hundred_thousandths(value));
    return text;
}

/// Filament's cross-section in mm².
inline double filament_area(const PrinterSettings& printer) {
    return std::numbers::pi / 4 * printer.filament_diameter * printer.filament_diameter;
}

}  // namespace ribvault
