// A point of M \ K whose coordinates anyone can check.
#pragma once

#include <array>

#include "ribvault/verify/subdivide.hpp"

namespace ribvault::verify {

/// Area enclosure (mm²) and a certified witness (mm, exactly these binary floats) of a non-empty M \ K; `start` is what
/// find_uncovered gave. `reach` is ρ: a site of radius R is material up to R - ρ from its segment, for
/// witness_distance. When no binary floats are found in M \ K, the place of `start` with witness_certified = false.
Unsupported describe_uncovered(const CoverProblem& problem, std::span<const Window> windows, const Uncovered& start,
                               double reach);

/// Decides with rational arithmetic whether the point with these coordinates (mm) is in M and not in K.
bool in_uncovered(const CoverProblem& problem, const std::array<double, 2>& mm);

}  // namespace ribvault::verify
