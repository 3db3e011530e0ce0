// A print judged by its G-code: equations (1) and (2), layer by layer.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "ribvault/exact/rational.hpp"
#include "ribvault/print/gcode_print.hpp"
#include "ribvault/report/print_report.hpp"

namespace ribvault {

struct VerifyJob {
    std::filesystem::path gcode;
    std::optional<Rational> support_radius;  ///< ρ, mm; default: (1 - overlap) nozzle
    std::optional<Rational> overlap;         ///< share of the nozzle's width, 0 to 1; default 1/2
    std::optional<Rational> nozzle;          ///< mm; default: the smallest that the file names, else 0.4
    std::optional<Rational> filament_diameter;  ///< mm; default: as the file says, else 1.75
    std::optional<Rational> layer_height;    ///< mm; where the file does not tell
    int infill_layers = 1;                   ///< how thick infill is, in layers, where the file does not tell
    std::vector<std::string> features;       ///< judge only these: names or kinds, any case; empty: all
    std::vector<std::string> ignored_features;
    std::optional<Rational> longest_bridge;  ///< mm; default: bridges are not told apart
    bool inside = false;                    ///< judge only what lies inside the outline of the layer below
    Rational min_area = 0;                   ///< mm²; regions up to this do not count
    /// Mm; what lies within this and half a nozzle of the object's tracks counts as held up by them.
    std::optional<Rational> support_gap;
    int support_gap_layers = 0;              ///< the object may lie on material that is so many layers farther down
    bool bed_only = false;                   ///< supports must lie on supports, down to the bed
    std::optional<std::filesystem::path> report, svg, html;  ///< what to write; svg is a folder
    bool boundaries = false;                 ///< the report has the exact boundary of every region
    bool distances = true;  ///< tight bounds of the greatest distances of regions are wanted (a quarter of the work)
    int pictures = 12;                       ///< how many layers svg gets at most
    int threads = 0;                         ///< 0: all processors
    std::function<void(int done, int total)> progress = [](int, int) {};
    std::function<void(const std::string&)> warn = [](const std::string&) {};
    std::function<bool()> stop = [] { return false; };
};

/// Reads the G-code, judges every layer over the material directly below it, writes what the job names (complete or not
/// at all). The first layer lies on the bed, which holds up everything. Features that are not judged are material all
/// the same. The result does not depend on the number of threads. Throws Error: unreadable (the file), usage (a setting
/// or feature that cannot be), cannot_write, interrupted.
PrintReport verify_print(const VerifyJob& job);

struct JudgedPrint {
    GcodePrint print;
    PrintReport report;
};
/// The same, with the print itself.
JudgedPrint judged_print(const VerifyJob& job);

/// The report in a few lines for people: one a feature type, then the verdict.
std::string summary(const PrintReport& report, const VerifyJob& job);

}  // namespace ribvault
