// G-code out: Marlin flavour, absolute coordinates, relative extrusion.
#pragma once

#include <array>
#include <cstddef>
#include <string>

#include "ribvault/print/tool_path.hpp"

namespace ribvault {

inline constexpr std::size_t track_kinds = 4;  ///< how many values TrackKind has

/// What a piece of G-code extrudes and moves. Millimetres of track, mm³, millimetres of filament.
struct PrintStatistics {
    std::array<double, track_kinds> length{};  ///< mm of track by TrackKind
    std::array<double, track_kinds> volume{};  ///< mm³ by TrackKind: length times width times layer height, and dots
    double filament = 0;                       ///< mm pushed along tracks; retractions and surplus not counted
    double prime_surplus = 0;                  ///< mm of filament pushed in addition before support paths (Section 5.1)
    double travel = 0;                         ///< mm inside layers; the way to a layer's first track is not known
    int travels = 0;                           ///< the way to a layer's first track included
    int retractions = 0;
    PrintStatistics& operator+=(const PrintStatistics& other);
};

struct LayerText {
    std::string text;
    PrintStatistics statistics;
};

/// Height of the top of a layer over the bed: layer 0 is `first_layer_height` high, all others `layer_height`.
Unit top_of_layer(int layer, const Settings& settings);

/// What comes before the first layer: settings as comments, heating, homing. Ends with the filament retracted.
/// Throws Error (usage) naming the first printer setting with which no G-code can be written.
std::string gcode_header(const Settings& settings, const PrinterSettings& printer, int layer_count);

/// One layer: `;LAYER:n`, `;Z:`, `;HEIGHT:` and for every path `;TYPE:`, `;WIDTH:` (PrusaSlicer's names; supports are
/// "Internal infill"), a travel, then the track.
///
/// A layer's text depends on its own paths alone, so layers can be written in any order: it begins and ends with the
/// filament retracted, sets every speed it uses, and begins with a travel. Inside, travels longer than `retract_over`
/// retract. After a retraction a support path is primed with (1 + prime_surplus) times the retraction, unless it starts
/// within `surplus_clearance` of a perimeter's centre line (Section 5.1).
///
/// Coordinates are the lattice's, exactly. A track of width w extrudes w times layer height mm³ per mm, a rectangular
/// cross-section as the paper counts material; a dot (path of one point) a disc of that width and height, in place. E
/// has five decimals; its rounding is carried on, so that its sum over the tracks of a layer is within 0.00001 mm of
/// the volume over the filament's cross-section.
/// Precondition: every path has at least one point; a header was written for these printer settings.
LayerText gcode_layer(const LayerPaths& layer, const Settings& settings, const PrinterSettings& printer);

/// What comes after the last layer: heaters off, nozzle up, motors off.
std::string gcode_footer();

}  // namespace ribvault
