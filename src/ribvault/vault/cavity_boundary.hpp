// The boundary of C_i, or of what lies outside O_i, prepared for the sweep: nearest edge, point location, and where a
// track may be rooted.
#pragma once

#include "ribvault/exact/nearest_segment.hpp"
#include "ribvault/exact/point_location.hpp"
#include "ribvault/slice/cavity.hpp"

namespace ribvault {

struct CavityBoundary {
    NearestSegment edges;    ///< which walls must not cross; the frame of an outside is not among them
    PointLocation location;
    bool free_trees = false; ///< trees may stand free (vault/free_trees.hpp)
    bool rooted = true;      ///< the edges are the shell's: walls may be rooted there
    int layers_below = 0;    ///< down to the bed, on which a tree may stand
    /// Is there a shell on which a wall can be rooted?
    bool has_shell() const { return rooted && !edges.empty(); }
};
CavityBoundary prepare_boundary(const Region& cavity);
CavityBoundary prepare_boundary(const Cavity& cavity);

/// The edges of a region outside a slice but for those of its frame, the box around it.
std::vector<Segment> edges_off_frame(const Region& region);

/// How far (lattice units) a root may lie from the boundary of C_i.
inline constexpr Unit root_tolerance = 3;

/// A lattice point at or next to p (which lies on the boundary up to rounding) that is not strictly inside the cavity:
/// a track that ends there touches the shell.
Point place_root(Point p, const CavityBoundary& boundary);

}  // namespace ribvault
