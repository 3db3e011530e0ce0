#include "ribvault/exact/millimetres.hpp"

#include <bit>
#include <cmath>
#include <optional>

#include "ribvault/exact/int128.hpp"

namespace ribvault {
namespace {

/// value / 1e9 towards zero, to 53 binary digits.
double cut_off(std::int64_t value) {
    if (value == 0) return 0;
    const std::uint64_t size = value < 0 ? -static_cast<std::uint64_t>(value) : static_cast<std::uint64_t>(value);
    // 1e9 has 30 digits: 83 make a quotient of 53 or 54.
    int shift = 83 - static_cast<int>(std::bit_width(size));
    auto quotient = static_cast<std::uint64_t>((static_cast<UInt128>(size) << shift) / Millimetres::picometres_per_mm);
    if (quotient >> 53 != 0) quotient >>= 1, --shift;
    const double result = std::ldexp(static_cast<double>(quotient), -shift);
    return value < 0 ? -result : result;
}

std::optional<std::int64_t> in_picometres(const Rational& value) {
    const mpz_class& below = value.get_den();
    if (!below.fits_slong_p() || Millimetres::picometres_per_mm % below.get_si() != 0 ||
        !value.get_num().fits_slong_p())
        return std::nullopt;
    std::int64_t result = 0;
    if (__builtin_mul_overflow(static_cast<std::int64_t>(value.get_num().get_si()),
                               Millimetres::picometres_per_mm / below.get_si(), &result))
        return std::nullopt;
    return result;
}

}  // namespace

Millimetres::Millimetres(const Rational& value) : approximate_(value.get_d()) {
    if (const std::optional<std::int64_t> whole = in_picometres(value))
        picometres_ = *whole;
    else
        other_ = std::make_shared<const Rational>(value);
}

Millimetres Millimetres::of_picometres(std::int64_t value) {
    Millimetres result;
    result.picometres_ = value;
    result.approximate_ = cut_off(value);
    return result;
}

Millimetres::operator Rational() const {
    if (other_) return *other_;
    Rational result(static_cast<long>(picometres_), static_cast<unsigned long>(picometres_per_mm));
    result.canonicalize();
    return result;
}

std::strong_ordering Millimetres::compare(const Millimetres& a, const Millimetres& b) {
    return cmp(Rational(a), Rational(b)) <=> 0;
}

Millimetres half_plus(const Millimetres& a, const Millimetres& b) {
    std::int64_t sum = 0;
    if (a.whole() && b.whole() && a.picometres() % 2 == 0 &&
        !__builtin_add_overflow(a.picometres() / 2, b.picometres(), &sum))
        return Millimetres::of_picometres(sum);
    return Rational(Rational(a) / 2 + Rational(b));
}

}  // namespace ribvault
