// One function a subcommand: adds it to the program's parser; the returned function runs it and returns the exit code.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace ribvault::cli {

std::function<int()> add_generate(CLI::App& app);
std::function<int()> add_verify(CLI::App& app);
std::function<int()> add_page(CLI::App& app);

/// An option that names an output. An empty name, which a script writes whose variable is not set, is refused.
inline CLI::Option* add_output(CLI::App* command, const std::string& option, std::string& target,
                               const std::string& help, const std::string& type = "FILE") {
    const CLI::Validator named(
        [](const std::string& name) { return std::string(name.empty() ? "the name of the output is empty" : ""); }, "");
    return command->add_option(option, target, help)->check(named)->type_name(type);
}

}  // namespace ribvault::cli
