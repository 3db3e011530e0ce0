// The main job: a mesh in, a hollow print with proved supports out.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ribvault/mesh/place_mesh.hpp"
#include "ribvault/report/run_report.hpp"
#include "ribvault/settings.hpp"

namespace ribvault {

struct Job {
    std::filesystem::path model;
    std::vector<std::filesystem::path> settings_files;  ///< what settings were read from: no output takes its place
    std::optional<std::filesystem::path> gcode, report, svg, mesh, layers, html;  ///< what to write; svg is a folder
    PlacementOptions placement;
    Settings settings;
    TrackSettings tracks;
    PrinterSettings printer;
    int threads = 0;  ///< 0: all processors
    std::function<void(int done, int total)> progress = [](int, int) {};
    std::function<void(int done, int total)> choosing = [](int, int) {
    };  ///< the same for the sweeps before the run (Settings::choose_bonus, tries)
    std::function<void(const std::string&)> warn = [](const std::string&) {};
    std::function<bool()> stop = [] { return false; };
};

/// Reads, slices, hollows, sweeps, proves, and writes what the job names. Files appear under their names only when all
/// of the run succeeded; a print that could not be proved is written all the same (RunReport::verdict says so). Throws
/// Error as its parts do; then no file was written, unless it was a finished file that could not get its name.
RunReport generate(const Job& job);

/// The report in a few lines for people.
std::string summary(const RunReport& report, const Job& job);

/// Of these lines, those about what is proved and what is not.
std::string verdict_text(const RunReport& report, const Job& job);

}  // namespace ribvault
