// How high layers are that are known by their tops.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "ribvault/print/gcode_print.hpp"

namespace ribvault {

/// What is not in the file's moves.
struct LayerHints {
    std::optional<std::int64_t> layer_height, first_layer_height;  ///< 1e-9 mm
    std::optional<double> nozzle;                                  ///< diameter of the widest, mm
    std::int64_t widest_track = 0;                                 ///< 1e-9 mm; no nozzle lays a wider one
    std::vector<double> filaments;                                 ///< diameters, mm, at least one; one a tool
    bool volumetric = false;                                       ///< E is mm³ in all of the file
    int infill_layers = 1;                                         ///< how thick infill of unsaid height is, in layers
};

struct LayerKey {
    Int128 z;             ///< top
    std::int64_t height;  ///< 1e-9 mm; 0: the file does not say
    friend auto operator<=>(const LayerKey&, const LayerKey&) = default;
};
using LayerGroups = std::map<LayerKey, GcodeLayer>;

inline constexpr std::int64_t pm_per_mm = 1000000000;  ///< 1e-9 mm
inline constexpr Int128 decimal_per_pm = decimal_one / pm_per_mm;
inline constexpr Int128 z_rounding = decimal_one / 200;  ///< 0.005 mm, as slicers round
inline std::int64_t in_pm(Int128 z) { return static_cast<std::int64_t>(z / decimal_per_pm); }

/// At the end of the layer a track like `track` between these points, a dot where they are equal. It continues the
/// track before it if `track` does and that one ends at `from`.
void append_track(GcodeLayer& layer, const GcodePoint& from, const GcodePoint& to, GcodeTrack track);

/// All of `from` behind the tracks of `to`.
void append_tracks(GcodeLayer& to, GcodeLayer& from);

/// The height of a layer, 1e-9 mm: as the hints say, else the median distance between the tops, else 0.2 mm.
std::int64_t usual_height(const LayerGroups& groups, const LayerHints& hints);

/// Gives every group the height it was printed with, and fills in what of `print` tells of heights.
///
/// As the file says, except for bridges, which it describes as round threads, and ironing, which it describes by what
/// it adds: theirs is their layer's. Where it does not say: the distance to the next lower layer; for the lowest one
/// the first layer's height that the file names, else the distance to z = 0 unless that is more than 0.5 mm and two
/// layer heights; for infill, so many of these as the hints say. A distance, or a height in the file that is one, of
/// more than 1.25 times two layers or the nozzle is no height: slicers do not say that there is air. Such a layer has
/// the usual height, and air below it.
///
/// When a file says no heights at all, tops up to 0.005 mm over another are one layer with it, and what is printed
/// before all else, higher than the lowest layer but no higher than one on the bed may be, lies on the bed with it.
void resolve_heights(LayerGroups& groups, GcodePrint& print, const LayerHints& hints);

}  // namespace ribvault
