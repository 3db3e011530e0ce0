// One layer of a print, judged over the material directly below it.
#pragma once

#include <optional>
#include <vector>

#include "ribvault/print/gcode_print.hpp"
#include "ribvault/report/print_report.hpp"

namespace ribvault {

struct LayerRules {
    Rational support_radius;                 ///< ρ, mm
    std::optional<Rational> longest_bridge;  ///< mm
    double min_area = 0;                     ///< mm²
    std::vector<char> judged;                ///< per feature
    bool inside = false;                     ///< only what lies inside the outline below (verify/outside_outline.hpp)
};

/// What a feature has in one layer.
struct FeatureShare {
    std::uint64_t tracks = 0;
    double length_mm = 0;
    Enclosure unsupported_mm, bridged_mm;
};

struct JudgedLayer {
    HangingLayer layer;
    std::vector<FeatureShare> features;  ///< one a feature of the print
};

/// Where bridges are allowed, equation (1) is decided first; what of its violations are bridges (verify/bridges.hpp) is taken
/// out of the layer with one track width at both ends, and both equations are decided for the rest.
JudgedLayer judge_layer(const GcodePrint& print, std::size_t entry, const LayerRules& rules);

}  // namespace ribvault
