// S_i: the supports of one layer, a planar forest of straight segments (track centre lines), rooted on the shell.
#pragma once

#include <boost/graph/adjacency_list.hpp>
#include <cstdint>
#include <vector>

#include "ribvault/exact/lattice.hpp"

namespace ribvault {

struct SupportVertex {
    Point at;
    bool root = false;  ///< lies on the shell B_i (within root_tolerance of the boundary of C_i, on the shell's
                        ///< side), or is free
    bool free = false;  ///< a root away from the shell: its tree stands on the layer below alone (vault/free_trees.hpp)
    bool outside = false;  ///< its tree stands outside the slice: an external support
    /// Its tree is printed with settings.wall_lines tracks side by side, on this layer and all below on which it is
    /// long enough for that (vault/wall_stability.hpp).
    bool wide = false;
    std::int32_t standing = 0;  ///< so many layers of the wall stand on this place, this one not counted
};

/// A vertex that is no root in the wall between a and b, at a place on it.
SupportVertex vertex_between(const SupportVertex& a, const SupportVertex& b, Point at);

struct SupportEdge {
    /// The branch that starts with this edge does not continue on the layer below: this is the first layer on which it
    /// is printed, so its path reaches the junction (Section 4.4, Figure 20). Known once the layer below is propagated.
    bool first_layer = false;
    /// The branch that starts with this edge is printed up to its junction although it continues below
    /// (print/hold_print.hpp).
    bool to_junction = false;
};

/// A forest: every connected component is a tree and has at least one root. Vertex degree is the valence of equation
/// (4). A tree that erosion has used up leaves its root for one more layer as a dot, an isolated vertex: a track of no
/// length, whose disc holds up the last stub above it. Without it nothing would: the stub reaches r + ρ beyond the
/// shell at most, the shell holds up ρ. The disc itself is within r of the shell below, so the dot vanishes.
using SupportForest =
    boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS, SupportVertex, SupportEdge>;

/// Of all walls together, lattice units.
double length(const SupportForest& forest);

/// S_i as segments, edges in their order, then dots as segments of no length.
std::vector<Segment> centre_lines(const SupportForest& forest);

/// Of all vertices; the origin where there are none.
Box bounding_box(const SupportForest& forest);

}  // namespace ribvault
