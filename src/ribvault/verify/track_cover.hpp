// Tracks that follow a track below: the rule that settles nearly all of them.
#pragma once

#include <vector>

#include "ribvault/verify/cover_problem.hpp"
#include "ribvault/verify/verdict.hpp"

namespace ribvault::verify {

/// The tracks of `above` that the following rule does not settle. When both ends of a track lie within ρ of one and the
/// same segment below, all of it does, the stadium of radius ρ being convex; so the track's material, within r of it,
/// lies within r + ρ of that segment. Exact, ties included. Under upward rounding.
std::vector<Edge> uncovered_tracks(std::span<const Vertex> vertices, std::span<const Edge> above,
                                   std::span<const Edge> below, double rho, StageCounts& stages);

}  // namespace ribvault::verify
