// Steps too short for the printer's numbers are not printed.
#pragma once

#include "ribvault/exact/predicates.hpp"
#include "ribvault/print/layer_plan.hpp"

namespace ribvault {

/// Shorter steps along a path (lattice units, 5 µm) are finer than printers move, and push next to no filament.
inline constexpr Unit shortest_step = 500;
inline bool is_tiny_step(Point a, Point b) { return squared_length(b - a) < shortest_step * shortest_step; }

/// Leaves out points of a path so that all steps are at least shortest_step long; the first and the last point of an
/// open path stay. A path that is shorter than that as a whole becomes a dot at its first point. No point of a centre
/// line moves farther than shortest_step: a choice, made before anything is proved about the print. External supports
/// that are longer as a whole keep their steps: by a shorter way they could come nearer to the object than the gap.
void drop_tiny_steps(ToolPath& path);
/// Of all paths of the plan; then supports that are a dot are left out where the centre line of another track of their
/// kind, no narrower, runs no farther than shortest_step from it: a second dot there would be twice the filament.
void drop_tiny_steps(LayerPlan& plan);

}  // namespace ribvault
