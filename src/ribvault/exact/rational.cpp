#include "ribvault/exact/rational.hpp"

#include <cctype>
#include <charconv>

#include "ribvault/error.hpp"

namespace ribvault {
namespace {

[[noreturn]] void not_a_number(std::string_view text, std::string_view what) {
    throw Error(ErrorKind::usage, std::string(what) + ": '" + std::string(text) +
                                      "' is not a number; write a decimal such as 0.2 or a fraction such as 1/2.4");
}

Rational parse_decimal(std::string_view text, std::string_view whole, std::string_view what) {
    std::string digits;
    long exponent = 0;
    std::size_t i = 0;
    bool negative = false, any = false;
    if (i < text.size() && (text[i] == '+' || text[i] == '-')) negative = text[i++] == '-';
    for (bool point = false; i < text.size(); ++i) {
        if (text[i] == '.' && !point) {
            point = true;
        } else if (std::isdigit(static_cast<unsigned char>(text[i]))) {
            digits += text[i];
            any = true;
            if (point) --exponent;
        } else {
            break;
        }
    }
    if (!any) not_a_number(whole, what);
    if (i < text.size() && (text[i] == 'e' || text[i] == 'E')) {
        ++i;
        if (i + 1 < text.size() && text[i] == '+' && text[i + 1] != '-') ++i;
        long power = 0;
        const auto [end, error] = std::from_chars(text.data() + i, text.data() + text.size(), power);
        if (error != std::errc() || power > 1000 || power < -1000) not_a_number(whole, what);
        exponent += power, i = static_cast<std::size_t>(end - text.data());
    }
    if (i != text.size() || exponent > 100 || exponent < -400) not_a_number(whole, what);
    mpz_class number(digits, 10), power;
    mpz_ui_pow_ui(power.get_mpz_t(), 10, static_cast<unsigned long>(exponent < 0 ? -exponent : exponent));
    Rational value = exponent < 0 ? Rational(number, power) : Rational(number * power);
    value.canonicalize();
    return negative ? Rational(-value) : value;
}

}  // namespace

Rational power_of_two(int exponent) {
    Rational r(1);
    if (exponent >= 0)
        mpq_mul_2exp(r.get_mpq_t(), r.get_mpq_t(), static_cast<mp_bitcnt_t>(exponent));
    else
        mpq_div_2exp(r.get_mpq_t(), r.get_mpq_t(), static_cast<mp_bitcnt_t>(-exponent));
    return r;
}

Rational rounded_down(const Rational& a, unsigned bits) {
    mpz_class n = a.get_num(), q;
    n <<= bits;
    mpz_fdiv_q(q.get_mpz_t(), n.get_mpz_t(), a.get_den_mpz_t());
    Rational r(q);
    mpq_div_2exp(r.get_mpq_t(), r.get_mpq_t(), bits);
    return r;
}

Rational parse_rational(std::string_view text, std::string_view what) {
    const std::size_t slash = text.find('/');
    if (slash == std::string_view::npos) return parse_decimal(text, text, what);
    const Rational denominator = parse_decimal(text.substr(slash + 1), text, what);
    if (denominator == 0) not_a_number(text, what);
    return parse_decimal(text.substr(0, slash), text, what) / denominator;
}

std::string millimetres(Unit length) {
    std::string text = std::to_string(to_mm(length));  // six decimals
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text;
}

Unit parse_length(std::string_view text, std::string_view what) {
    const Rational units = parse_rational(text, what) * units_per_mm;
    const auto refuse = [&](const char* why) {
        throw Error(ErrorKind::usage, std::string(what) + ": '" + std::string(text) + "' mm " + why);
    };
    if (abs(units) > lattice_bound) refuse("is more than 10 m");
    if (units.get_den() != 1) refuse("does not lie on the 10 nm lattice; give at most five decimals");
    return units.get_num().get_si();
}

}  // namespace ribvault
