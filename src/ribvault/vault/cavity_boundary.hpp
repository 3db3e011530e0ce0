// The boundary of C_i, or of what lies outside O_i, prepared for the sweep: nearest edge, point location, and where a
// track may be rooted.
#pragma once

#include <algorithm>
#include <optional>

#include "ribvault/exact/nearest_segment.hpp"
#include "ribvault/exact/point_location.hpp"
#include "ribvault/slice/cavity.hpp"

namespace ribvault {

/// What a tree that stands free keeps of its track while it leans towards what is nearest to it (vault/lean_trees.hpp).
struct Leaning {
    Unit length;               ///< at least
    double length_of_a_layer;  ///< more the higher it stands: so much for each layer of it, lattice units
    /// With so many layers of it on the place where it stands tallest.
    double track(double standing) const {
        return std::max(static_cast<double>(length), length_of_a_layer * (standing + 1));
    }
};

struct CavityBoundary {
    NearestSegment edges;    ///< which walls must not cross; the frame of an outside is not among them
    PointLocation location;
    bool free_trees = false; ///< trees may stand free (vault/free_trees.hpp)
    bool rooted = true;      ///< the edges are the shell's: walls may be rooted there
    int layers_below = 0;    ///< down to the bed, on which a tree may stand
    std::optional<Leaning> leaning{};  ///< trees that stand free lean; there is a shell then
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
