// The removal gap between external supports and the object, decided exactly.
#pragma once

#include <optional>
#include <vector>

#include "ribvault/exact/nearest_segment.hpp"

namespace ribvault {

struct ExactPolygons;  // slice/exact_polygons.hpp

/// The first of `tracks` (centre lines, lattice) that is not outside O_i, or nearer to it than `distance` (lattice
/// units, > 0; equal is far enough); nothing when all keep off. Exact. A box filter, then rational distances: linear in
/// the tracks times the edges.
std::optional<Segment> find_too_near(const ExactPolygons& outline, const std::vector<Segment>& tracks, Unit distance);

/// The first of `tracks` that is nearer than `distance` to one of `object`, centre lines both; nothing when all keep
/// off. Exact; a tree of boxes over the object's.
std::optional<Segment> find_too_near(const NearestSegment& object, const std::vector<Segment>& tracks, Unit distance);

}  // namespace ribvault
