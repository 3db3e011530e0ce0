// Layers as G-code: absolute coordinates, relative extrusion. Header and footer: print/gcode_header.hpp.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>

#include "ribvault/print/motion_time.hpp"
#include "ribvault/print/travel_map.hpp"

namespace ribvault {

inline constexpr std::size_t track_kinds = 7;  ///< how many values TrackKind has

/// What a piece of G-code extrudes and moves. Millimetres of track, mm³, millimetres of filament.
struct PrintStatistics {
    std::array<double, track_kinds> length{};  ///< mm of track by TrackKind
    std::array<double, track_kinds> volume{};  ///< mm³ by TrackKind: length times width times layer height, and dots
    double filament = 0;                       ///< mm pushed along tracks; retractions and surplus not counted
    double prime_surplus = 0;                  ///< mm of filament pushed in addition before support paths (Section 5.1)
    double travel = 0;                         ///< mm in x and y
    double open_air = 0;                       ///< mm of the travels over the cavity
    double seconds = 0;                        ///< by motion_seconds, standing at the joints between layers
    int travels = 0;                           ///< ways between tracks, whatever the number of moves
    int retractions = 0;
    int detours = 0;                           ///< travels that go around to stay inside the shell
    PrintStatistics& operator+=(const PrintStatistics& other);
};

/// Where a layer's tracks begin or end.
struct TrackEnd {
    Point at;
    Unit width = 0;
    int tool = 0;  ///< that prints the track
};

/// A layer without the way to it from the layer below, so that layers can be written in any order.
struct LayerText {
    int layer = 0;
    std::string heading;  ///< comments: `;LAYER:n`, `;Z:`, `;HEIGHT:`
    std::string body;     ///< from the first track's start, filament primed, to the last track's end, not retracted
    std::optional<TrackEnd> first, last;  ///< nothing for a layer without tracks
    bool surplus = false;                 ///< a prime before the first track has the surplus
    PrintStatistics statistics;           ///< of the body
};

/// One layer: for every path `;TYPE:`, `;WIDTH:` (PrusaSlicer's names; internal supports are "Internal infill",
/// external ones "Support material", thin walls "Gap fill"), a travel, then the track. `beside`: skirt and brim,
/// printed first.
///
/// A travel goes as `map` says, and retracts when it leaves the island or when more of it than `retract_over` is over
/// open air; not when the tracks that it joins touch at their ends (Section 5.1). After a retraction a support path is
/// primed with (1 + prime_surplus) times the retraction, unless it starts within `surplus_clearance` of the centre line
/// of a perimeter or a thin wall.
///
/// External supports are printed by the tool `support_extruder`. A change of tool comes with a retraction of the one
/// and a prime of the other, nothing is purged.
///
/// Coordinates are the lattice's, exactly. A track of width w extrudes w times layer height mm³ per mm, a rectangular
/// cross-section as the paper counts material; a dot (path of one point) a disc of that width and height, in place; so
/// does a path shorter than w / 4 that no other continues. Both at the flow of a track, however slow that is. E
/// has five decimals; its rounding is carried on, so that its sum over the tracks of a layer is within 0.00001 mm of
/// the volume over the filament's cross-section, unless its last moves are so short that the least E, 0.00001 mm, is
/// more than theirs.
/// A layer that would take less than printer.min_layer_time is written slower, so that it takes about that, no track
/// below printer.min_print_speed, no stub or dot below its flow at that speed.
///
/// Precondition: every path has at least one point; the printer settings passed check_printer.
LayerText gcode_layer(const LayerPaths& layer, const TravelMap& map, const Settings& settings,
                      const PrinterSettings& printer, const std::vector<ToolPath>& beside = {});

/// What joins a layer to the one below (nullptr: to the header, which leaves the filament retracted): heading, the
/// nozzle raised, the way to the first track by the same rules as inside a layer, `map` being the upper layer's. After
/// a layer without tracks the filament stays retracted. Layer 1 brings the fan, and the temperatures where layer 0 has
/// its own. Adds to `statistics`.
std::string gcode_joint(const LayerText* below, const LayerText& layer, const TravelMap& map, const Settings& settings,
                        const PrinterSettings& printer, PrintStatistics& statistics);

/// The retraction after the last layer; nothing when that is retracted already. Adds to `statistics`.
std::string gcode_end_of_layers(const LayerText& top, const PrinterSettings& printer, PrintStatistics& statistics);

}  // namespace ribvault
