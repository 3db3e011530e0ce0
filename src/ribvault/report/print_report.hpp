// What `ribvault verify` says of a print: every feature type, every layer, everything that hangs.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ribvault/verify/verify_printed.hpp"

namespace ribvault {

/// A stretch of a centre line that violates equation (1), or a bridge.
struct HangingPiece {
    std::int64_t line = 0;                ///< of the file
    int feature = 0;                      ///< index into PrintReport::features
    double length_mm = 0;                 ///< rounded up; 0: a dot
    std::array<double, 2> from{}, to{};   ///< mm on the bed, rounded
    Enclosure distance_mm;                ///< its greatest distance to the material below; infinite: there is none
    std::array<double, 2> worst{};        ///< mm on the bed; where it is at least distance_mm.lo
};

/// A region that violates equation (2).
struct HangingRegion {
    Enclosure area_mm2, distance_mm;
    RegionBoundary boundary;               ///< exactly
    std::vector<std::int64_t> curve_lines; ///< per curve of the boundary, of the file: a track whose stadium has it
    std::array<double, 2> witness{};       ///< mm, rounded
    std::array<std::string, 2> witness_exact;  ///< the same as fractions, exactly
    double witness_distance_mm = 0;        ///< rounded down
    bool witness_certified = true;
    std::vector<std::int64_t> lines;       ///< of the tracks it belongs to, ascending
    std::vector<int> features;             ///< of these tracks, ascending
    bool ignored = false;                  ///< its area is at most --min-area
};

/// One layer, or one of the parts of a layer that have heights of their own.
struct HangingLayer {
    int layer = 0;                ///< from 0 at the bed
    std::size_t entry = 0;        ///< index into GcodePrint::layers
    double z_mm = 0, height_mm = 0;
    bool on_bed = false;
    bool supported = true;        ///< equation (2), up to bridges and small areas where they are allowed
    double length_mm = 0;         ///< judged centre lines
    Enclosure unsupported_mm;     ///< of these, what violates equation (1)
    Enclosure bridged_mm;         ///< what would, but is a bridge
    std::vector<HangingPiece> pieces, bridges;
    std::vector<HangingRegion> regions;
    StageCounts stages;
};

struct HangingFeature {
    std::string name, kind;
    bool judged = true;
    std::uint64_t tracks = 0;
    double length_mm = 0;
    Enclosure unsupported_mm, bridged_mm;
    Enclosure worst_mm;                    ///< of its pieces' distances, the greatest
    std::array<double, 2> worst_at{};      ///< mm
    int worst_layer = -1;                  ///< -1: nothing hangs
    std::int64_t worst_line = 0;
};

struct PrintReport {
    std::string version, input_path, flavour, program, cut;
    std::int64_t lines = 0;
    std::uint64_t bytes = 0;
    double set_aside_mm = 0;
    std::uint64_t widths_written = 0, widths_computed = 0;
    int layer_count = 0;

    double nozzle_mm = 0;
    std::string nozzle_source;             ///< "option", "file" or "default"
    double support_radius_mm = 0;          ///< ρ
    std::string support_radius_exact;      ///< as a fraction
    std::string support_radius_source;     ///< "--support-radius", "--overlap" or "half the nozzle"
    double filament_mm = 0;
    std::string filament_source;
    std::optional<double> layer_height_mm;  ///< of the option: for layers whose height the file does not tell
    int infill_layers = 1;                  ///< how many of them infill is thick
    std::optional<double> longest_bridge_mm;
    double min_area_mm2 = 0;
    bool boundaries = false;               ///< whether the JSON has the regions' boundaries
    bool inside = false;  ///< only what lies inside the outline of the layer below was judged
    /// What lies within this and half a nozzle of the object's tracks counted as held up by them.
    double support_gap_mm = 0;
    int support_gap_layers = 0;    ///< the object could lie on material so many layers farther down
    bool bed_only = false;         ///< supports had to lie on supports
    /// Numbers of layers, ascending, whose outline is not whole (print/printed_layers.hpp): what lies over what is
    /// missing counted as outside. Only where that matters.
    std::vector<int> layers_without_outline;

    std::vector<HangingFeature> features;
    std::vector<HangingLayer> layers;

    // Sums, filled by sum_up.
    bool supported = false;
    double length_mm = 0;
    Enclosure unsupported_mm, bridged_mm, area_mm2;
    int layers_unsupported = 0;            ///< layers (by z) that have a region which counts
    StageCounts stages;

    int threads = 0;
    double seconds = 0, read_seconds = 0, peak_memory_mb = 0;
};

/// Fills the sums and every feature's worst place from layers and features' lengths.
void sum_up(PrintReport& report);

/// Indices of the layers' entries in which most hangs, worst first: by unsupported area, then length, then layer.
std::vector<std::size_t> worst_layers(const PrintReport& report, std::size_t most);

/// Schema "ribvault-verify/1" (docs/verify-command.md), one line a layer; what differs between runs is in "machine",
/// last.
std::string to_json(const PrintReport& report);

}  // namespace ribvault
