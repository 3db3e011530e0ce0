// Opening what the user names, with one clear error when that cannot be.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace ribvault {

/// The bytes of a file as they are. `kind` is for the message: "mesh", "G-code", ... Throws Error (unreadable): "FILE:
/// WHAT; REMEDY" when it is missing, a folder, or may not be read.
std::ifstream open_input(const std::filesystem::path& file, const std::string& kind);

/// After reading to the end: throws Error (unreadable) when the system could not read on.
void check_read(const std::ifstream& stream, const std::filesystem::path& file);

/// All of a file at once; throws as these two do.
std::string read_input(const std::filesystem::path& file, const std::string& kind);

}  // namespace ribvault
