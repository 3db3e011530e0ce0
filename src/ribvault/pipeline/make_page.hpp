// The run page from files: one run, or two side by side.
#pragma once

#include <filesystem>
#include <vector>

#include "ribvault/pipeline/verify_print.hpp"

namespace ribvault {

struct PageJob {
    /// One or two: layers files of `ribvault generate`, or G-code of any slicer.
    std::vector<std::filesystem::path> runs;
    std::filesystem::path page;               ///< what to write
    std::string rule_given;  ///< an option of `rules` that the user gave; empty: none
    VerifyJob rules;  ///< how G-code is judged, threads, progress, warn, stop; its files are not looked at
};

/// Writes the page, complete or not at all. Layers files carry their verdicts; memory does not depend on the number of
/// their layers. Throws Error: unreadable (a file; LayersFile and read_gcode say what is wrong with it), usage (not one
/// or two runs, rules that cannot be, or that are given though no run is G-code), cannot_write, interrupted.
void make_page(const PageJob& job);

}  // namespace ribvault
