// One self-contained HTML page on which one can walk through the layers and see what hangs.
#pragma once

#include <string>

#include "ribvault/print/gcode_print.hpp"
#include "ribvault/report/print_report.hpp"

namespace ribvault {

/// The page: no network, no other files; every layer with its tracks (rounded to 0.01 mm, packed to about 5 bytes a track), the
/// material below, violations of equations (1) and (2), figures by feature type. The template is print_page.html.
std::string print_page(const GcodePrint& print, const PrintReport& report);

}  // namespace ribvault
