// Printer profiles: PrinterSettings as a text file, and the built-in ones.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ribvault/settings.hpp"

namespace ribvault {

/// The printer that a profile describes; docs/printing.md lists the keys. What it does not name keeps its default,
/// except the temperatures, which every profile must state. `start_gcode`, `end_gcode` and `file_header` may be given
/// several times: each adds a line. `name`: what to call the text in errors.
///
/// Throws Error (usage) "NAME:LINE: ..." naming the key: unknown, given twice, no number where one belongs, out of
/// range, a placeholder that does not exist, a temperature that is missing.
PrinterSettings read_profile(std::string_view text, const std::string& name);

struct BuiltinProfile {
    std::string_view name;  ///< as on the command line
    std::string_view text;  ///< an INI text for read_profile
};

/// The paper's printers (Section 5) and a generic one.
const std::vector<BuiltinProfile>& builtin_profiles();

/// A built-in profile by its name. Throws Error (usage) listing those there are.
PrinterSettings builtin_profile(std::string_view name);

}  // namespace ribvault
