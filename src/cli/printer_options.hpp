// Options of `generate` about tracks and the printer.
#pragma once

#include "cli/commands.hpp"
#include "ribvault/pipeline/generate.hpp"
#include "ribvault/print/import_prusaslicer.hpp"

namespace ribvault::cli {

/// What an import took.
struct Imported {
    std::string file;                 ///< empty: nothing was imported
    std::string summary;              ///< for people
    std::vector<ImportDoubt> doubts;  ///< values that cannot be
    std::optional<Unit> first_layer_height, support_width;  ///< where it names them: defaults of the options
};

/// Profiles and imports change settings that other options name too, so they must be added before all other options and
/// groups: options act in the order in which they were added, and what is written out wins.
void add_profiles(CLI::App* command, Job& job, Imported& imported);

void add_tracks(CLI::App* command, TrackSettings& tracks);
void add_printer(CLI::App* command, PrinterSettings& printer);

}  // namespace ribvault::cli
