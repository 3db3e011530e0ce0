// "Is M inside K?": the one question that the verifier answers, for external and for internal overhangs alike.
#pragma once

#include <span>
#include <vector>

#include "ribvault/verify/number.hpp"

namespace ribvault::verify {

/// All points within `radius` of the segment from vertex a to vertex b (a == b: a disc). Closed.
struct Stadium {
    int a = 0, b = 0;   ///< indices into CoverProblem::vertices
    Radius radius;      ///< lattice units
};

/// An oriented boundary edge.
struct Edge {
    int a = 0, b = 0;  ///< indices into CoverProblem::vertices
};

/// M = the region whose oriented boundary is `material` (material on the left) united with `pieces`.
/// K = `sites` united with the closed region bounded by the oriented edges `region`: where their winding number is not
/// zero, or, with `region_outside`, where it is. sites[i] for i < region.size() is the stadium around region[i], and
/// every radius is positive, so that K's boundary consists of pieces of the sites' boundaries only.
struct CoverProblem {
    std::span<const Vertex> vertices;
    std::vector<Edge> material;
    std::vector<Stadium> pieces;
    std::vector<Edge> region;
    std::vector<Stadium> sites;
    bool region_outside = false;
};

/// Whether K's region is where its winding number is `winding`.
inline bool in_region(const CoverProblem& problem, int winding) { return (winding == 0) == problem.region_outside; }

}  // namespace ribvault::verify
