// A file in memory, and the one form in which its readers complain.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "ribvault/error.hpp"

namespace ribvault {

struct InputFile {
    std::string name;  ///< as the user wrote it
    std::string data;

    /// Throws Error: "NAME, PLACE: WHAT; REMEDY".
    [[noreturn]] void fail(ErrorKind kind, const std::string& place, const std::string& what,
                           const std::string& remedy) const;

    bool starts_with(std::string_view text) const { return std::string_view(data).starts_with(text); }
};

/// Throws Error (unreadable) when the file is missing, a folder, not readable or empty.
InputFile load_file(const std::filesystem::path& file);

}  // namespace ribvault
