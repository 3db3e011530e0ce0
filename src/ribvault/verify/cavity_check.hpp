// What must hold for B_i = O_i \ int C_i before equation (2) can be asked: C_i is a region, inside O_i.
#pragma once

#include <string>
#include <vector>

#include "ribvault/verify/cover_problem.hpp"

namespace ribvault::verify {

/// The boundary of the interior of a cavity: edges with the cavity on the left. Edges with cavity on both sides
/// (contours that share an edge) are gone, contours that touch at a point are cut there, so edges meet at end points
/// only.
struct CavityBoundary {
    std::vector<Segment> edges;
    std::string malformed;  ///< why the contours bound no region; else empty
};

/// Exact (integers). Malformed when two edges cross at inner points of both.
CavityBoundary cavity_boundary(const Region& cavity);

/// Exact: empty when the closed cavity lies in the interior of the slice, else why not. Both boundaries as oriented
/// edges over `vertices`, the region on the left. No edge of one meets an edge of the other, each of the cavity's
/// chains starts inside the slice, each of the slice's outside the cavity: so the cavity holds no hole of the slice
/// either.
std::string check_inside(std::span<const Vertex> vertices, std::span<const Edge> cavity, std::span<const Edge> slice);

}  // namespace ribvault::verify
