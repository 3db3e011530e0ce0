// One function a subcommand: adds it to the program's parser; the returned function runs it and returns the exit code.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace ribvault::cli {

std::function<int()> add_generate(CLI::App& app);
std::function<int()> add_verify(CLI::App& app);
std::function<int()> add_page(CLI::App& app);

}  // namespace ribvault::cli
