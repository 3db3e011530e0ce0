// Two hollowing methods that grow cavities downwards. Both are our reading of published descriptions, not the authors'
// programs.
#pragma once

#include "judge.hpp"

namespace ribvault::baselines {

/// Iterative carving (Hornus and Lefebvre, Eurographics short papers 2018). From top to bottom: where a slice has room
/// and no cavity reaches it from above, it is torn open along its skeleton, no wider than a track, so that nothing
/// above hangs; every tear grows by r per layer as far as there is room. Then the same in the pockets that are left,
/// behind walls one track thick, until a round gains less than 0.5 %. Islands of material that end over a cavity get
/// one straight bridge each, in the direction in which it is shortest. Like the published method (its errata) it does
/// not see overhanging edges.
///
/// Support-free hollowing in the spirit of Wang et al. (TVCG 2018): the same growth from the deepest place of each
/// pocket, greedy and as large as it goes, but with walls two tracks thick and no bridges: wherever material above
/// would hang (a roof flatter than 45°, an edge, an island) a column two tracks thick is left down to the floor. A
/// bound in their spirit; their method cuts the inside into parts and optimises, and leaves more material.
struct CarvingRules {
    Unit wall = 0;         ///< thickness kept between two cavities
    bool columns = false;  ///< columns under what would hang, instead of bridges under islands
    int rounds = 12;       ///< at most
};

struct Carving {
    Hollowed hollowed;
    int rounds = 0, tears = 0, bridges = 0;
    double bridge_mm = 0;  ///< length of all bridges
    double longest_bridge_mm = 0;
};

Carving carve(const Stack& stack, const CarvingRules& rules, const Settings& settings);

}  // namespace ribvault::baselines
