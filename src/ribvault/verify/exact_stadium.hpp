// Which points a printed track covers, decided with rational arithmetic. Light: GMP only.
#pragma once

#include <array>

#include "ribvault/verify/printed_layer.hpp"

namespace ribvault::verify {

using RationalPoint = std::array<Rational, 2>;

/// Squared distance of p to the closed segment from a to b (a == b: a point), mm².
Rational squared_distance(const RationalPoint& p, const RationalPoint& a, const RationalPoint& b);

/// Sign of the distance of p to the track's centre line minus `radius`. Precondition: radius >= 0.
int compare_distance(const RationalPoint& p, const PrintedTrack& track, const Rational& radius);

}  // namespace ribvault::verify
