// What the user has is not lost: no output takes the place of an input.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ribvault {

/// An output with the option that names it.
struct NamedOutput {
    std::string option;
    std::optional<std::filesystem::path> file;
};

/// Throws Error (usage) when an output is the file of an input or of another output, through symbolic links as well.
/// (A second hard link is another file: outputs take a name's place, they do not write into what is there.) What exists
/// and is no regular file (a device, a pipe) may be several outputs. Nor may an output have the name of a picture in
/// the folder for `pictures`: those of earlier runs are removed there.
void check_outputs(const std::vector<std::filesystem::path>& inputs, const std::vector<NamedOutput>& outputs,
                   const std::optional<std::filesystem::path>& pictures = {});

}  // namespace ribvault
