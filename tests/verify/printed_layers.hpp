// Small printed layers for the verifier's tests.
#pragma once

#include <string>

#include "ribvault/verify/verify_printed.hpp"

namespace ribvault::test {

/// A fraction or a decimal, exactly: "3/25", "0.2", "1e-30".
inline Rational q(const std::string& text) { return parse_rational(text, "a test's number"); }
/// 10^-n.
inline Rational tiny(unsigned n) {
    mpz_class power;
    mpz_ui_pow_ui(power.get_mpz_t(), 10, n);
    return Rational(mpz_class(1), power);
}

inline PrintedTrack track(const Rational& ax, const Rational& ay, const Rational& bx, const Rational& by,
                          const Rational& width) {
    return {{ax, ay}, {bx, by}, width, 0, 0};
}
inline PrintedTrack dot(const Rational& x, const Rational& y, const Rational& width) {
    return track(x, y, x, y, width);
}
inline PrintedLayer printed(std::vector<PrintedTrack> tracks) { return {std::move(tracks)}; }

/// Squared distance of a point to the centre line of a track, in this file so that tests check witnesses by themselves.
inline Rational squared_distance_to(const std::array<Rational, 2>& p, const PrintedTrack& t) {
    const Rational dx = t.b[0] - t.a[0], dy = t.b[1] - t.a[1], n = dx * dx + dy * dy;
    Rational s = n == 0 ? Rational(0) : Rational(((p[0] - t.a[0]) * dx + (p[1] - t.a[1]) * dy) / n);
    if (s < 0) s = 0;
    if (s > 1) s = 1;
    const Rational x = Rational(t.a[0]) + s * dx - p[0], y = Rational(t.a[1]) + s * dy - p[1];
    return x * x + y * y;
}
/// What anyone can check by hand: in a stadium above, in none below dilated by ρ.
inline bool is_witness(const std::array<Rational, 2>& p, const PrintedLayer& upper, const PrintedLayer& lower,
                       const Rational& rho) {
    bool above = false;
    for (const PrintedTrack& t : upper.tracks) above = above || squared_distance_to(p, t) <= t.width * t.width / 4;
    for (const PrintedTrack& t : lower.tracks) {
        const Rational r = t.width / 2 + rho;
        if (squared_distance_to(p, t) <= r * r) return false;
    }
    return above;
}

}  // namespace ribvault::test
