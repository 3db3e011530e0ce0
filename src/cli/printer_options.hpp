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
};

/// Profiles and imports change settings that other options name too, so they must be added before all other options and
/// groups: options act in the order in which they were added, and what is written out wins.
void add_profiles(CLI::App* command, Job& job, std::optional<Unit>& first_layer_height, Imported& imported);

void add_tracks(CLI::App* command, TrackSettings& tracks);
void add_printer(CLI::App* command, PrinterSettings& printer);

}  // namespace ribvault::cli
