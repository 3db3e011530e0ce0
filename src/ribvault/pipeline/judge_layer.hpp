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
    /// mm: for what lies outside the outline below, the object's tracks count as so much wider to every side (removal
    /// gap).
    Rational object_reach = 0;
    int gap_layers = 0;  ///< outside the outline below the object may lie on material so many layers farther down
    bool supports_alone = false;             ///< supports must lie on supports
    bool distances = true;                   ///< tight bounds of the greatest distances of regions are wanted
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

/// Supports are the features of that kind, the object is all others. They are judged apart where the rules tell them
/// apart, each over all that may hold it up.
///
/// Where bridges are allowed, equation (1) is decided first; what of its violations are bridges (verify/bridges.hpp) is
/// taken out of the layer with one track width at both ends, and both equations are decided for the rest.
JudgedLayer judge_layer(const GcodePrint& print, std::size_t entry, const LayerRules& rules);

}  // namespace ribvault
