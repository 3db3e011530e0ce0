#include "ribvault/exact/millimetres.hpp"

#include <catch2/catch.hpp>
#include <random>

using namespace ribvault;

TEST_CASE("millimetres are the rational that they were made of") {
    for (const char* text : {"0", "1", "-1", "1/5", "-123456789/1000000000", "1/1000000000", "1/1000000001", "1/3",
                             "-22/7", "9000000000", "10000000000", "1/2305843009213693952"}) {
        const Rational value(text);
        const Millimetres mm(value);
        CHECK(Rational(mm) == value);
        CHECK(mm.get_d() == value.get_d());
        CHECK(mm.whole() == (abs(value) <= 9000000000L && Rational(value * 1000000000L).get_den() == 1));
        CHECK(mm == Millimetres(value));
    }
    CHECK(Millimetres() == Millimetres(0));
    CHECK(Millimetres(3) == Millimetres(Rational(3)));
}

TEST_CASE("picometres are cut off to doubles like rationals") {
    std::mt19937_64 random(5);
    for (int round = 0; round < 100000; ++round) {
        const auto value = static_cast<std::int64_t>(random()) >> (random() % 63);
        Rational exact(static_cast<long>(value), 1000000000L);
        exact.canonicalize();
        const Millimetres mm = Millimetres::of_picometres(value);
        REQUIRE(mm.get_d() == exact.get_d());
        REQUIRE(Rational(mm) == exact);
        REQUIRE(mm == Millimetres(exact));
    }
    CHECK(Rational(Millimetres::of_picometres(INT64_MIN)).get_d() == Millimetres::of_picometres(INT64_MIN).get_d());
}

TEST_CASE("millimetres are ordered as their values, whichever way they are held") {
    const char* texts[] = {
        "-7/3", "-1", "0", "1/3000000000", "1/1000000000", "333333333/1000000000", "1/3", "333333334/1000000000", "2"};
    for (const char* a : texts)
        for (const char* b : texts) {
            CHECK((Millimetres(Rational(a)) < Millimetres(Rational(b))) == (Rational(a) < Rational(b)));
            CHECK((Millimetres(Rational(a)) == Millimetres(Rational(b))) == (Rational(a) == Rational(b)));
        }
}

TEST_CASE("half of one and another") {
    CHECK(Rational(half_plus(Rational(2, 5), Rational(1, 5))) == Rational(2, 5));
    CHECK(Rational(half_plus(Rational(1, 1000000000), Rational(0))) == Rational(1, 2000000000));
    CHECK(Rational(half_plus(Rational(1, 3), Rational(1, 5))) == Rational(11, 30));
    CHECK(Rational(half_plus(Millimetres::of_picometres(INT64_MAX - 1), Millimetres::of_picometres(INT64_MAX))) >
          Rational(9000000000L));
}
