// Every baseline before the same judge: equation (2), decided by src/ribvault/verify.
#pragma once

#include "ribvault/verify/verify_layer.hpp"
#include "stack.hpp"

namespace ribvault::baselines {

/// What a baseline leaves: the empty space of each layer, and tracks in it.
struct Hollowed {
    std::vector<Region> cavities;
    std::vector<std::vector<Segment>> tracks;  ///< centre lines, one track wide
    double track_volume_mm3 = 0;               ///< what the tracks add to the material
};

struct Judgement {
    int layers = 0, refuted = 0, malformed = 0, external = 0;
    double area_lo_mm2 = 0, area_hi_mm2 = 0;  ///< of what internal supports should have held up, over all layers
    double worst_distance_mm = 0;             ///< of the witnesses, to the nearest material below
    StageCounts stages;
};

/// On all processors.
Judgement judge(const Stack& stack, const Hollowed& hollowed, const Settings& settings);

/// Slices without their cavities, and the tracks.
double material_mm3(const Stack& stack, const Hollowed& hollowed, const Settings& settings);

}  // namespace ribvault::baselines
