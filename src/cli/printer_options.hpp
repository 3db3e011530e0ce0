// Options of `generate` about tracks and the printer.
#pragma once

#include "cli/commands.hpp"
#include "ribvault/pipeline/generate.hpp"

namespace ribvault::cli {

/// Profiles and imports change settings that other options name too, so they must be added before all other options and
/// groups: options act in the order in which they were added, and what is written out wins. `imported`: what an import
/// took from the file `from`, in words for people.
void add_profiles(CLI::App* command, Job& job, std::optional<Unit>& first_layer_height, std::string& from,
                  std::string& imported);

void add_tracks(CLI::App* command, TrackSettings& tracks);
void add_printer(CLI::App* command, PrinterSettings& printer);

}  // namespace ribvault::cli
