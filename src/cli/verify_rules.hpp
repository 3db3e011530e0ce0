// The options by which G-code is read and judged.
#pragma once

#include <CLI/CLI.hpp>

#include "ribvault/pipeline/verify_print.hpp"

namespace ribvault::cli {

/// Adds the groups "Rule" and "Reading" to a subcommand; what the user writes goes to `job`, which must outlive the
/// parsing.
void add_rules(CLI::App* command, VerifyJob& job);

}  // namespace ribvault::cli
