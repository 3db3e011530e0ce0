// One step of the sweep from top to bottom (Algorithm 1): S_i from S_{i+1}.
#pragma once

#include "ribvault/settings.hpp"
#include "ribvault/slice/cavity.hpp"
#include "ribvault/vault/support_forest.hpp"

namespace ribvault {

struct LayerSupports {
    SupportForest forest;
    Region unsupported;  ///< U_{i+1} (a superset, see detection), for pictures
    int blocked = 0;     ///< chains that could not be straightened without crossing another wall
    int braces = 0;      ///< walls to a second root added here (settings.brace)
    bool full_bonus = false, quarter_bonus = false;  ///< used by a wall that was added here (GrownSupports)
};

/// S_i under `above` = S_{i+1}. `overhang` is overhang_over_cavity(C_i, ...). Marks in `above` the branches that do not
/// continue on layer i (SupportEdge::first_layer). Depends on its arguments only, not on threads or addresses.
LayerSupports next_layer(SupportForest& above, const Cavity& cavity, const Region& overhang, const Settings& settings);

}  // namespace ribvault
