// What stands before the first layer and after the last.
#pragma once

#include <string>

#include "ribvault/print/track_settings.hpp"
#include "ribvault/settings.hpp"

namespace ribvault {

/// What is known of a print when all its layers are written. Zeros before that.
struct PrintFacts {
    int layers = 0;
    double seconds = 0;       ///< estimated
    double filament_mm = 0;   ///< pushed along tracks
    Box box;                  ///< of the tracks' centre lines, lattice units
    double height_mm = 0;     ///< top of the last layer
    bool support_tool = false;  ///< external supports are printed, so that their tool is used if they have their own
};

/// Throws Error (usage) naming the first printer setting with which no G-code can be written: a number out of range,
/// text with a placeholder that nothing is known for.
void check_printer(const PrinterSettings& printer);

/// `text` with every {name} replaced by its value; `{{` and `}}` stand for braces. docs/printing.md lists the names.
/// Throws Error (usage), naming `key` and the placeholder, when a name is unknown or a brace is left open.
std::string fill_placeholders(const std::string& text, const std::string& key, const Settings& settings,
                              const PrinterSettings& printer, const PrintFacts& facts);

/// The profile's own first lines, then settings and facts as comments, thumbnails, heating (left to the start G-code
/// when that heats itself), the start G-code, limits of motion when asked for, units. Ends with the filament retracted.
std::string gcode_header(const Settings& settings, const TrackSettings& tracks, const PrinterSettings& printer,
                         const PrintFacts& facts, const std::string& thumbnails = {});

/// What comes after the last layer: heaters and fan off, the end G-code, motors off.
std::string gcode_footer(const Settings& settings, const PrinterSettings& printer, const PrintFacts& facts);

}  // namespace ribvault
