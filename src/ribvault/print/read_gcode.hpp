// G-code of any slicer, read back as layers of tracks.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "ribvault/print/gcode_print.hpp"

namespace ribvault {

struct GcodeOptions {
    std::optional<double> filament_diameter;    ///< mm; instead of what the file says (1.75 where neither does)
    std::optional<double> nozzle;               ///< mm; instead of what the file says (0.4 where neither does)
    std::optional<double> layer_height;         ///< mm; where the file does not say
    int infill_layers = 1;                      ///< how thick infill is whose height the file does not say, in layers
};

/// Reads PrusaSlicer, SuperSlicer, OrcaSlicer, Bambu Studio, CuraEngine, Slic3r, Simplify3D, ribvault and plain G-code.
///
/// Coordinates are the file's decimals, exactly; arcs become chords within arc_bound_mm. Layers come from the heights
/// of extrusions (gcode_layers.hpp), features and widths from comments (gcode_comments.hpp). Custom G-code, and all
/// before the first named layer or feature where there is one, is set aside. A file that stops early is read to there
/// and `cut` says so; a motion in a last line without line end is not believed.
///
/// Throws Error (unreadable): no such file; empty; binary; "FILE, line N: WHAT; expected ..." for a malformed line; no
/// extrusion. Reads in blocks; memory is about 60 bytes an extrusion.
GcodePrint read_gcode(const std::filesystem::path& file, const GcodeOptions& options = {});

/// The same from memory; `name` is for messages.
GcodePrint read_gcode(std::string_view text, const std::string& name, const GcodeOptions& options = {});

}  // namespace ribvault
