// Walls printed with several tracks side by side (--wall-lines; beyond the paper).
#pragma once

#include "ribvault/print/layer_plan.hpp"

namespace ribvault {

/// Adds the tracks beside the centre lines of the wide trees of `forest` (SupportVertex::wide): the outlines of the
/// trees at distances d/2, 3d/2, ... for an even number of lines, d, 2d, ... for an odd one, inside the cavity. So each
/// wall is walked around its tips without a stop. The centre lines themselves, which an odd number has, are for
/// append_support_paths. Corners are rounded by chords at most 10 µm inside the arc. Whether the print is held up is
/// decided afterwards, by what is in the plan then. Precondition: settings.wall_lines >= 1; nothing happens with 1.
void append_wide_walls(const SupportForest& forest, const Region& cavity, const Settings& settings, LayerPlan& plan);

/// Are the centre lines of the tree of this vertex printed?
inline bool prints_centre_line(const SupportVertex& v, const Settings& settings) {
    return !v.wide || settings.wall_lines % 2 == 1;
}

}  // namespace ribvault
