// Signs and digits of numbers with two square roots, against CGAL's CORE numbers.
#include "ribvault/verify/algebraic_number.hpp"

#include <CGAL/CORE_Expr.h>

#include <catch2/catch.hpp>
#include <random>
#include <vector>

using namespace ribvault;
using verify::AlgebraicNumber;

namespace {

/// The same number in both types.
struct Both {
    AlgebraicNumber ours;
    CORE::Expr core;
    friend Both operator+(const Both& x, const Both& y) { return {x.ours + y.ours, x.core + y.core}; }
    friend Both operator-(const Both& x, const Both& y) { return {x.ours - y.ours, x.core - y.core}; }
    friend Both operator*(const Both& x, const Both& y) { return {x.ours * y.ours, x.core * y.core}; }
    friend Both operator/(const Both& x, const Both& y) { return {x.ours / y.ours, x.core / y.core}; }
};
Both exactly(const Rational& a) { return {AlgebraicNumber(a), CORE::Expr(CORE::BigRat(a.get_mpq_t()))}; }
Both root_of(const Both& a) { return {root(a.ours), CGAL::sqrt(a.core)}; }

/// Both give one sign, and our digits are right.
int agreed_sign(const Both& a) {
    const int sign = sign_of(a.ours);
    REQUIRE(sign == a.core.sign());
    for (const unsigned bits : {20u, 150u}) {
        const CORE::Expr close = exactly(approximation(a.ours, bits)).core,
                         off = exactly(power_of_two(-static_cast<int>(bits))).core;
        REQUIRE(a.core <= close + off);
        REQUIRE(a.core >= close - off);
    }
    return sign;
}

}  // namespace

TEST_CASE("numbers with two square roots have the signs of CORE's", "[algebraic]") {
    std::mt19937_64 g(11);
    const auto small = [&](int lo, int hi) { return std::uniform_int_distribution<int>(lo, hi)(g); };
    const auto rational = [&] { return exactly(Rational(small(-6, 6), small(1, 4))); };
    int zeros = 0, negative = 0, positive = 0;
    const auto ask = [&](const Both& a) {
        const int sign = agreed_sign(a);
        ++(sign == 0 ? zeros : sign < 0 ? negative : positive);
    };
    for (int draw = 0; draw < 1000; ++draw) {
        // Two lines' lengths: independent roots, or multiples of one another, or none.
        const Both n = exactly(small(0, 12)), m = small(0, 1) == 0 ? n * exactly(small(0, 4)) : exactly(small(0, 12));
        const Both one = rational() + rational() * root_of(n), other = rational() + rational() * root_of(m);
        const Both x = (one * rational() - other * rational()) / exactly(small(1, 5));
        const Both y = (other * rational() + one * rational()) / exactly(small(1, 5));
        ask(x), ask(y), ask(x * x + y * y - exactly(small(0, 9))), ask(x * rational() + y * rational() + rational());
        ask((one - one) + other - other), ask(x * y - y * x), ask((x + y) * (x - y) - x * x + y * y);
        // A line's length under the root of where it meets a circle.
        const Both under = one * one + exactly(small(0, 2)), s = root_of(under);
        const Both u = rational() * one + s * rational(), v = one - s * rational();
        ask(u), ask(v), ask(u * u + v * v - rational()), ask(s * s - under), ask(u * v - v * u + rational() * one);
    }
    CHECK(zeros > 3000);
    CHECK(negative > 1000);
    CHECK(positive > 1000);
}

TEST_CASE("numbers with two square roots tell apart what differs by 1e-60", "[algebraic]") {
    // (sqrt(2) + sqrt(3))^2 = 5 + 2 sqrt(6)
    const AlgebraicNumber a = root(AlgebraicNumber(2)) + root(AlgebraicNumber(3)), square = a * a;
    CHECK(sign_of(square - (AlgebraicNumber(5) +
                            AlgebraicNumber(2) * root(AlgebraicNumber(2)) * root(AlgebraicNumber(3)))) == 0);
    const Rational tiny(mpz_class(1), mpz_class("1" + std::string(60, '0')));
    const Rational close = approximation(a, 400);
    CHECK(sign_of(a - AlgebraicNumber(Rational(close - tiny))) == 1);
    CHECK(sign_of(a - AlgebraicNumber(Rational(close + tiny))) == -1);
}

TEST_CASE("two tangents of a circle that are all but parallel meet outside it", "[algebraic]") {
    // The circle's centre is (9, 1/5). One side lies on y = 1/5 + r, the other is turned by `tiny` / 8, so that they
    // meet r tiny / 16 away from where they touch. CORE of CGAL 5.5.1 calls that point one of the circle for 1e-20.
    const AlgebraicNumber r(Rational(449999, 2000000)), x0(9), y0(Rational(1, 5));
    for (const int digits : {3, 20, 60}) {
        const AlgebraicNumber tiny(Rational(mpz_class(1), mpz_class("1" + std::string(digits, '0'))));
        const AlgebraicNumber dx(-8), length = root(dx * dx + tiny * tiny), level(-10);
        const AlgebraicNumber k = -(r * root(level * level)), l = -(r * length), det = level * tiny;
        const AlgebraicNumber x = x0 + (k * dx - l * level) / det, y = y0 + k * tiny / det;
        const AlgebraicNumber from_centre = (x - x0) * (x - x0) + (y - y0) * (y - y0) - r * r;
        CHECK(sign_of(from_centre) == 1);
        // Its power is the square of that distance, to some 1e-7 of it at most.
        const AlgebraicNumber ratio = from_centre / (r * r * tiny * tiny / AlgebraicNumber(256));
        CHECK(approximation(ratio, 60).get_d() == Approx(1).epsilon(1e-6));
    }
}

TEST_CASE("a third square root, or a division by one, is an error", "[algebraic]") {
    const AlgebraicNumber two = root(AlgebraicNumber(2)) + root(AlgebraicNumber(3));
    CHECK_THROWS_AS(two + root(AlgebraicNumber(5)), std::logic_error);
    CHECK_THROWS_AS(root(two), std::logic_error);
    CHECK_THROWS_AS(AlgebraicNumber(1) / root(AlgebraicNumber(2)), std::logic_error);
    CHECK(sign_of(AlgebraicNumber(1) / root(AlgebraicNumber(4)) - AlgebraicNumber(0.5)) == 0);
}
