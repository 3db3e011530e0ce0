// What slicers say in comments: who they are, feature types, widths, heights, settings.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

#include "ribvault/print/gcode_print.hpp"

namespace ribvault {

/// Reads comments one after the other and keeps what they said last.
///
/// Feature types: ";TYPE:x" (PrusaSlicer, OrcaSlicer, CuraEngine, ribvault), "; FEATURE: x" (Bambu Studio, OrcaSlicer),
/// "; feature x" or "; x" alone (Simplify3D), "; x" after the move (Slic3r). Widths: ";WIDTH:", "; LINE_WIDTH:",
/// "; tool H W". Heights: ";HEIGHT:", "; LAYER_HEIGHT:", "; tool H W". Settings: filament and nozzle diameters, layer
/// heights, use_volumetric_e.
class GcodeComments {
public:
    GcodeComments();

    /// A comment without its semicolon that has its line to itself.
    void read(std::string_view comment);
    /// A comment behind an extrusion: Slic3r names the feature there.
    void read_behind_move(std::string_view comment);

    std::vector<GcodeFeature> features{{"untyped", FeatureKind::other}};
    std::uint16_t feature = 0;
    bool marked = false;                      ///< a feature type or a layer has been named: start G-code is over
    std::optional<int> layer;                 ///< as ";LAYER:n" numbers it
    bool raft = false;                        ///< there were layers below 0, which CuraEngine numbers a raft's so
    std::optional<std::int64_t> width;        ///< 1e-9 mm
    std::optional<std::int64_t> height;       ///< 1e-9 mm, whole µm
    GcodeFlavour flavour = GcodeFlavour::unknown;
    std::string program;
    std::vector<Decimal> nozzles;
    std::vector<double> filaments;
    std::optional<std::int64_t> layer_height, first_layer_height;  ///< 1e-9 mm
    bool volumetric = false;

    /// Why the file is not complete as its slicer would have it, or empty. Precondition: all of it was read.
    std::string missing_end() const;

private:
    void read_setting(std::string_view key, std::string_view value);
    void set_feature(std::string_view name);
    void note_program(std::string_view comment);

    std::unordered_map<std::string, std::uint16_t> known_;
    bool ended_ = false, block_started_ = false;
    std::int64_t layers_announced_ = -1, layers_named_ = 0;
};

}  // namespace ribvault
