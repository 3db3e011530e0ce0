// Layers of things that have layers of their own: not over the next lower ones, but over others.
#pragma once

#include <vector>

#include "ribvault/print/gcode_print.hpp"

namespace ribvault {

/// What is printed at one height.
struct LevelTracks {
    Int128 z = 0;                ///< top, 1e-18 mm
    bool by_distance = false;    ///< its height is the distance to the next lower level
    std::vector<const GcodeLayer*> entries;
};

/// How many levels lie beside the next lower one: those of which half or more, by length, lies outside that one's
/// outline and inside that of a level farther down, but no more than `reach`. Such a level is higher than its distance
/// to the next lower one, which belongs to something else. One alone may lie over a gap, as between supports and what
/// they hold up, so it counts when there is another at most four levels below it.
///
/// `levels` by z. A level's outline is taken in cells of 1 mm: within it is what has material to the left and to the
/// right, in front and behind, or beside.
int interleaved_layers(const std::vector<LevelTracks>& levels, Int128 reach);

}  // namespace ribvault
