#include "ribvault/print/decimal.hpp"

#include <array>
#include <cmath>

namespace ribvault {
namespace {

constexpr auto powers_of_ten = [] {
    std::array<std::int64_t, decimal_places + 1> powers{};
    powers[0] = 1;
    for (std::size_t k = 1; k < powers.size(); ++k) powers[k] = powers[k - 1] * 10;
    return powers;
}();

bool is_digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

ScannedDecimal scan_decimal(std::string_view text) {
    using Fault = ScannedDecimal::Fault;
    const char* at = text.data();
    const char* const end = at + text.size();
    bool negative = false, any = false;
    if (at != end && (*at == '-' || *at == '+')) negative = *at++ == '-';
    std::int64_t whole = 0, fraction = 0;
    for (; at != end && is_digit(*at); ++at, any = true) {
        whole = whole * 10 + (*at - '0');
        if (whole >= decimal_limit) return {Fault::too_large, {}, 0};
    }
    int places = 0;
    if (at != end && *at == '.') {
        for (++at; at != end && is_digit(*at); ++at, any = true) {
            if (places == decimal_places) {
                if (*at != '0') return {Fault::too_many_decimals, {}, 0};
                continue;
            }
            fraction = fraction * 10 + (*at - '0');
            ++places;
        }
    }
    if (!any) return {Fault::no_number, {}, 0};
    const Int128 value =
        static_cast<Int128>(whole) * decimal_one +
        static_cast<Int128>(fraction) * powers_of_ten[static_cast<std::size_t>(decimal_places - places)];
    return {Fault::none, {negative ? -value : value}, static_cast<std::size_t>(at - text.data())};
}

std::optional<Decimal> parse_decimal(std::string_view text) {
    const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
    while (!text.empty() && blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && blank(text.back())) text.remove_suffix(1);
    const ScannedDecimal scanned = scan_decimal(text);
    if (scanned.fault != ScannedDecimal::Fault::none || scanned.length != text.size()) return std::nullopt;
    return scanned.number;
}

Decimal rounded_decimal(double value) {
    return {static_cast<Int128>(std::llround(value * 1e9)) * (decimal_one / 1000000000)};
}

std::optional<Decimal> inches(Decimal d) {
    const Int128 product = d.value * 254;  // below 1e7 * 1e18 * 254: it fits
    if (product % 10 != 0) return std::nullopt;
    return Decimal{product / 10};
}

Rational to_rational(Decimal d) {
    Int128 value = d.value;
    int places = decimal_places;
    for (; places >= 9 && value % 1000000000 == 0; places -= 9) value /= 1000000000;
    for (; places > 0 && value % 10 == 0; --places) value /= 10;
    const bool negative = value < 0;
    if (negative) value = -value;
    mpz_class number(static_cast<unsigned long>(value / decimal_one));
    number = number * decimal_one + static_cast<unsigned long>(value % decimal_one);
    Rational result(negative ? mpz_class(-number) : number, mpz_class(powers_of_ten[static_cast<std::size_t>(places)]));
    result.canonicalize();
    return result;
}

}  // namespace ribvault
