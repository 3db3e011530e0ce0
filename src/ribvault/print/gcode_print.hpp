// A print as its G-code tells it: layers of tracks, with exact coordinates, compact.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ribvault/print/decimal.hpp"

namespace ribvault {

enum class GcodeFlavour { unknown, ribvault, prusa_slicer, orca_slicer, bambu_studio, cura, slic3r, simplify3d };
const char* flavour_name(GcodeFlavour flavour);

/// What a feature type is for, by the words in its name.
enum class FeatureKind { perimeter, infill, solid, bridge, support, skirt, tower, custom, other };
const char* kind_name(FeatureKind kind);

struct GcodeFeature {
    std::string name;  ///< as the file writes it; "untyped" where it says nothing
    FeatureKind kind = FeatureKind::other;
    bool outer_wall = false;  ///< the outermost perimeter
    bool overhang = false;    ///< what of a wall hangs, which OrcaSlicer names apart
    bool ironing = false;     ///< smooths what is there, and adds next to nothing
};

struct GcodePoint {
    Decimal x, y;  ///< mm
    friend bool operator==(const GcodePoint&, const GcodePoint&) = default;
};

/// A straight extrusion.
struct GcodeTrack {
    std::uint32_t a = 0, b = 0;   ///< ends: indices into the layer's points; equal: a dot
    std::uint32_t line = 0;       ///< of the file, from 1
    std::uint16_t feature = 0;    ///< index into GcodePrint::features
    bool chord = false;           ///< of an arc: the true centre line lies within arc_bound_mm of this one
    bool continues = false;       ///< starts where the track before it in this layer ended, without a travel between
    std::int64_t width = 0;       ///< 1e-9 mm
    std::int64_t width_below = 0;  ///< as it counts for what lies on it: less where E does not tell for sure
};

/// All tracks with the same top and the same height.
struct GcodeLayer {
    int layer = 0;                     ///< from 0 at the bed; entries with equal z have the same number
    Decimal z;                         ///< top, mm: where the nozzle was
    std::int64_t height = 0;           ///< 1e-9 mm
    std::vector<GcodePoint> points;
    std::vector<GcodeTrack> tracks;    ///< in the order of the file
    bool on_bed = false;
    std::vector<std::size_t> below;    ///< entries whose material is directly below (see find_layers_below)
    std::vector<std::size_t> under_air; ///< where nothing is: those next farther down
    int air_layers = 0;                ///< so many layers of this one's height of air are between
};

struct GcodePrint {
    GcodeFlavour flavour = GcodeFlavour::unknown;
    std::string program;                  ///< the line in which the slicer names itself, or empty
    std::vector<GcodeFeature> features;
    std::vector<GcodeLayer> layers;       ///< by z, then height
    int layer_count = 0;                  ///< different z
    std::string cut;                      ///< why the file is believed to be cut off, or empty
    std::int64_t lines = 0;
    std::uint64_t bytes = 0;
    double set_aside_mm = 0;  ///< extruded by start, end and other custom G-code: neither judged nor material
    std::vector<Decimal> nozzles;         ///< diameters in mm, exactly as the file says, one a tool; empty: it does not
    std::vector<double> filaments;        ///< the same of filaments
    double filament_diameter = 0;         ///< mm; what widths were computed with where the file gives none (tool 0)
    /// Of the layers whose height is the distance to the next lower one: those that lie beside that one, over others.
    int interleaved_layers = 0;
    int layers_over_air = 0;  ///< of those above that: nothing is so far below them that they cannot be as high
    struct SparseInfill {
        std::string feature;  ///< whose height the file does not say
        int apart = 1;        ///< so many layers are most of those apart that it is in; 1: there is none such
    };
    SparseInfill sparse_infill;                             ///< farther apart than it is thick
    std::uint64_t widths_written = 0, widths_computed = 0;  ///< tracks whose width stands in a comment; comes from E
    struct TooWide {
        std::uint64_t tracks = 0;  ///< whose E makes more than a nozzle lays
        std::uint32_t line = 0;    ///< of the first of them in the file
        std::int64_t widest = 0;   ///< 1e-9 mm: as wide they count for what lies on them
    };
    TooWide too_wide;
};

}  // namespace ribvault
