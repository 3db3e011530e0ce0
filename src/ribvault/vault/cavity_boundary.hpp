// The boundary of C_i prepared for the sweep: nearest edge, point location, and where a track may be rooted.
#pragma once

#include "ribvault/exact/nearest_segment.hpp"
#include "ribvault/exact/point_location.hpp"
#include "ribvault/slice/cavity.hpp"

namespace ribvault {

struct CavityBoundary {
    NearestSegment edges;
    PointLocation location;
};
CavityBoundary prepare_boundary(const Region& cavity);

/// How far (lattice units) a root may lie from the boundary of C_i.
inline constexpr Unit root_tolerance = 3;

/// A lattice point at or next to p (which lies on the boundary up to rounding) that is not strictly inside the cavity:
/// a track that ends there touches the shell.
Point place_root(Point p, const CavityBoundary& boundary);

}  // namespace ribvault
