#include "ribvault/verify/quadratic_number.hpp"

namespace ribvault::verify {

namespace {

int sign(const Rational& p, const Rational& q, const Rational& d) {
    return sign_of_sum(sgn(p), sgn(q) * sgn(d), [&] { return sgn(Rational(p * p - q * q * d)); });
}

const Rational& common_root(const QuadraticNumber& a, const QuadraticNumber& b) { return a.rational() ? b.d : a.d; }

}  // namespace

QuadraticNumber quadratic(const Rational& p, const Rational& q, const Rational& d) {
    if (sgn(q) == 0 || sgn(d) == 0) return {p, 0, 0};
    if (mpz_perfect_square_p(d.get_num_mpz_t()) == 0 || mpz_perfect_square_p(d.get_den_mpz_t()) == 0) return {p, q, d};
    return {Rational(p + q * Rational(sqrt(d.get_num()), sqrt(d.get_den()))), 0, 0};
}

QuadraticNumber operator+(const QuadraticNumber& a, const QuadraticNumber& b) {
    return {Rational(a.p + b.p), Rational(a.q + b.q), common_root(a, b)};
}
QuadraticNumber operator-(const QuadraticNumber& a, const QuadraticNumber& b) {
    return {Rational(a.p - b.p), Rational(a.q - b.q), common_root(a, b)};
}
QuadraticNumber operator*(const QuadraticNumber& a, const QuadraticNumber& b) {
    if (a.rational() && b.rational()) return {Rational(a.p * b.p), 0, 0};
    const Rational& d = common_root(a, b);
    return {Rational(a.p * b.p + a.q * b.q * d), Rational(a.p * b.q + a.q * b.p), d};
}

int sign(const QuadraticNumber& a) { return sign(a.p, a.q, a.d); }

// a - b = P + B - C with B = a.q sqrt(a.d), C = b.q sqrt(b.d). The sign of B - C follows from its squares, and P
// against B - C from P^2 - (B - C)^2 = P^2 - B^2 - C^2 + 2 B C, where B C = a.q b.q sqrt(a.d b.d).
int compare(const QuadraticNumber& a, const QuadraticNumber& b) {
    const Rational p = a.p - b.p, bb = a.q * a.q * a.d, cc = b.q * b.q * b.d;
    const int roots = sign_of_sum(sgn(a.q), -sgn(b.q), [&] { return cmp(bb, cc); });
    return sign_of_sum(sgn(p), roots,
                       [&] { return sign(Rational(p * p - bb - cc), Rational(2 * a.q * b.q), Rational(a.d * b.d)); });
}

std::array<Rational, 2> enclose(const QuadraticNumber& a, unsigned bits) {
    if (a.rational()) return {a.p, a.p};
    // sqrt(n / m) = sqrt(n m) / m; the shift gives the integer root at least `bits` digits.
    mpz_class under = a.d.get_num() * a.d.get_den();
    under <<= 2 * bits;
    const mpz_class floor = sqrt(under), above = floor + 1;
    mpz_class den = a.d.get_den();
    den <<= bits;
    Rational lo(floor, den), hi(above, den);
    lo.canonicalize(), hi.canonicalize();
    if (sgn(a.q) < 0) std::swap(lo, hi);
    return {Rational(a.p + a.q * lo), Rational(a.p + a.q * hi)};
}

}  // namespace ribvault::verify
