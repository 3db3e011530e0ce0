// One function a subcommand: adds it to the program's parser; the returned function runs it and returns the exit code.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace ribvault::cli {

std::function<int()> add_generate(CLI::App& app);
std::function<int()> add_verify(CLI::App& app);
std::function<int()> add_page(CLI::App& app);

/// Refuses an empty name, which a script writes whose variable is not set.
inline CLI::Validator output_name() {
    return CLI::Validator(
        [](const std::string& name) { return std::string(name.empty() ? "the name of the output is empty" : ""); }, "");
}

}  // namespace ribvault::cli
