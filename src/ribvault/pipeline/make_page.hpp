// The run page from files: one run, or two side by side.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace ribvault {

struct PageJob {
    std::vector<std::filesystem::path> runs;  ///< one or two: layers files of `ribvault generate`, or G-code of any slicer
    std::filesystem::path page;               ///< what to write
    int threads = 0;                          ///< for judging G-code; 0: all processors
    std::function<void(int done, int total)> progress = [](int, int) {};  ///< of judging G-code
    std::function<void(const std::string&)> warn = [](const std::string&) {};
    std::function<bool()> stop = [] { return false; };
};

/// Writes the page, complete or not at all. G-code is judged by the rules that verify_print has without options; layers files
/// carry their verdicts. Memory does not depend on the number of layers of a layers file.
/// Throws Error: unreadable (a file; LayersFile and read_gcode say what is wrong with it), usage (not one or two runs),
/// cannot_write, interrupted.
void make_page(const PageJob& job);

}  // namespace ribvault
