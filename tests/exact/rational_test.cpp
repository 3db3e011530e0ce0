// Numbers as users write them.
#include "ribvault/exact/rational.hpp"

#include <catch2/catch.hpp>

#include "ribvault/error.hpp"

using namespace ribvault;

namespace {

Rational parse(const std::string& text) { return parse_rational(text, "--scale"); }
Unit length(const std::string& text) { return parse_length(text, "--nozzle"); }

/// The message of the usage error that the call throws.
template <class Call>
std::string refusal(const Call& call) {
    try {
        call();
    } catch (const Error& error) {
        CHECK(error.kind() == ErrorKind::usage);
        return error.what();
    }
    return "accepted";
}

}  // namespace

TEST_CASE("a decimal is the rational it denotes") {
    CHECK(parse("0.2") == Rational(1, 5));
    CHECK(parse("0.2") != Rational(0.2));
    CHECK(parse("-3") == -3);
    CHECK(parse("+.5") == Rational(1, 2));
    CHECK(parse("7.") == 7);
    CHECK(parse("0.10") == Rational(1, 10));
    CHECK(parse("-0") == 0);
    CHECK(parse("0008") == 8);
    CHECK(parse("1e-3") == Rational(1, 1000));
    CHECK(parse("2.5E+2") == 250);
    CHECK(parse("1e2") == 100);
    CHECK(parse("123456789012345678901234567890") == Rational("123456789012345678901234567890"));
    CHECK(parse("0.333333333333333333333") == Rational("333333333333333333333/1000000000000000000000"));
}

TEST_CASE("a fraction of decimals is the exact quotient") {
    CHECK(parse("1/2.4") == Rational(5, 12));
    CHECK(parse("-1/3") == Rational(-1, 3));
    CHECK(parse("0.1/-0.3") == Rational(-1, 3));
    CHECK(parse("25.4/1") == Rational(127, 5));
}

TEST_CASE("what is no number is refused with the option's name and the text") {
    for (const std::string text : {"",
                                   " ",
                                   "a",
                                   ".",
                                   "-",
                                   "0,2",
                                   "1.2.3",
                                   "0.2mm",
                                   "1 ",
                                   " 1",
                                   "1e",
                                   "1e+",
                                   "1e1.5",
                                   "1/0",
                                   "1/",
                                   "/2",
                                   "1/2/3",
                                   "--1",
                                   "0x10",
                                   "nan",
                                   "inf",
                                   "1e101",
                                   "1e-999",
                                   "1e99999999999999999999",
                                   "0.1e-9223372036854775808",
                                   "1e 5",
                                   "1e+-5"}) {
        const std::string message = refusal([&] { parse(text); });
        INFO(message);
        CHECK(message.find("--scale") != std::string::npos);
        CHECK(message.find("'" + text + "' is not a number") != std::string::npos);
    }
}

TEST_CASE("a length is exact on the lattice: five places, no more") {
    CHECK(length("0.2") == 20000);
    CHECK(length("0.00001") == 1);
    CHECK(length("-0.00001") == -1);
    CHECK(length("0.4000000") == 40000);
    CHECK(length("1e-5") == 1);
    CHECK(length("1/8") == 12500);
    CHECK(length("10000") == lattice_bound);
    CHECK(length("-10000") == -lattice_bound);
    for (const std::string text : {"0.000001", "1/3", "0.123456"})
        CHECK(refusal([&] { length(text); }) ==
              "--nozzle: '" + text + "' mm does not lie on the 10 nm lattice; give at most five decimals");
    for (const std::string text : {"10000.00001", "-10000.00001", "1e90", "-1e50"})
        CHECK(refusal([&] { length(text); }) == "--nozzle: '" + text + "' mm is more than 10 m");
    CHECK(refusal([] { length("wide"); }).find("'wide' is not a number") != std::string::npos);
}
