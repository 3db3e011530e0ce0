// A judged print on the run page: its tracks, and what of them hangs.
#pragma once

#include "ribvault/print/gcode_print.hpp"
#include "ribvault/report/print_report.hpp"
#include "ribvault/report/run_page.hpp"

namespace ribvault {

/// Adds the print as a run: every layer with its tracks (rounded to 0.01 mm), violations of equations (1) and (2),
/// figures by feature type.
void append_print(RunPage& page, const GcodePrint& print, const PrintReport& report);

}  // namespace ribvault
