// Pictures of printed layers: the tracks, the material below, and what hangs.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "ribvault/exact/lattice.hpp"
#include "ribvault/print/gcode_print.hpp"
#include "ribvault/report/print_report.hpp"

namespace ribvault {

/// Consecutive tracks of one feature and width, as one line. Lattice coordinates (rounded to 10 nm, for pictures only).
struct PrintedLine {
    std::uint16_t feature = 0;
    double width_mm = 0;
    std::vector<Point> points;  ///< one: a dot
};
std::vector<PrintedLine> printed_lines(const GcodeLayer& layer);

/// One entry of the report as an SVG file, one unit a mm, y upwards on the bed: the material directly below in grey,
/// tracks in blue with their true widths, bridges in green, what violates equation (1) in vermilion and equation (2) in
/// a lighter one, and a ring at the largest region's witness. Colours are told apart without red and green (Okabe and
/// Ito).
std::string printed_layer_svg(const GcodePrint& print, const PrintReport& report, std::size_t entry);

}  // namespace ribvault
