// From a forest of supports to printed tracks: trunks before branches, gaps at the junctions (Section 4.4).
#pragma once

#include "ribvault/print/layer_plan.hpp"

namespace ribvault {

/// Appends the tracks of S_i to a plan and adds to its gaps (Section 4.4, "Printing support trees").
///
/// Every tree is walked from its root with the smallest index; its other roots are vertices like any. At a junction
/// the path goes on into the subtree that reaches farthest along its edges; ties prefer the straighter continuation,
/// then the smaller vertex index. What it leaves aside becomes a track of its own, `after` the path that runs through
/// the junction (after the nearest printed path above it, when that is too short to be printed). A track may be printed
/// from its other end, except when part of it is on its first layer: then it begins at the junction, where it sticks,
/// because below its other end there is nothing. A dot (isolated vertex) becomes a path of one point.
///
/// A root with several walls is a junction too: but with Gaps::paper its two longest ways are one path, from tip to
/// tip, unless both have parts on their first layer.
///
/// Only the first path runs through a junction. A later branch starts one track width (`settings.support_width`) short
/// of it, measured along the branch, unless its first edge has first_layer or to_junction set: then it starts at the
/// junction. A branch that is no longer than its gap is not printed and counts as gap. A junction that lies inside such
/// a gap is itself not printed; a branch from there starts where it is one width away, along the tree, from the nearest
/// printed centre line, so that tracks touch without overlapping there too.
///
/// With Gaps::proved and ρ from 0.361 support widths on, branches in cavities up to 3/2 widths long that would be
/// printed from their junction are taken along by the path through it (print/bent_path.hpp), where all branches at that
/// junction are such, there is room, and walls are of one line.
///
/// Precondition: every component of the forest is a tree with at least one root.
/// Postcondition: every point is a vertex of the forest or the end of a gap or of a bend (rounded once to the lattice);
/// consecutive points differ; without bends the lengths of the new paths and gaps add up to the forest's length but for
/// this rounding.
/// Throws Error (bad_geometry) naming layer and coordinates when a component has a cycle or no root.
void append_support_paths(const SupportForest& forest, const Settings& settings, LayerPlan& plan);

}  // namespace ribvault
