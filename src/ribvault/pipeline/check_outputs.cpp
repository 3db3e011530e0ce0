#include "ribvault/pipeline/check_outputs.hpp"

#include <system_error>

#include "ribvault/error.hpp"
#include "ribvault/output_file.hpp"
#include "ribvault/pipeline/picture_folder.hpp"

namespace ribvault {
namespace {

namespace fs = std::filesystem;

bool is_one_file(const fs::path& a, const fs::path& b) {
    std::error_code error;
    const fs::file_status there = fs::status(a, error);
    if (fs::exists(there) && !fs::is_regular_file(there)) return false;
    const fs::path whole_a = fs::weakly_canonical(follow_links(fs::absolute(a, error)), error);
    const fs::path whole_b = fs::weakly_canonical(follow_links(fs::absolute(b, error)), error);
    return !whole_a.empty() && whole_a == whole_b;
}

}  // namespace

void check_outputs(const std::vector<fs::path>& inputs, const std::vector<NamedOutput>& outputs,
                   const std::optional<fs::path>& pictures) {
    for (std::size_t k = 0; k < outputs.size(); ++k) {
        const auto& [option, file] = outputs[k];
        if (!file) continue;
        for (const fs::path& input : inputs)
            if (is_one_file(*file, input))
                throw Error(ErrorKind::usage, option + " " + file->string() +
                                                  " is an input, which would be lost; give the output another name");
        std::error_code error;
        const fs::path name = follow_links(fs::absolute(*file, error)).filename();
        if (pictures && is_picture_name(name.string()) && is_one_file(*file, *pictures / name))
            throw Error(ErrorKind::usage,
                        option + " " + file->string() +
                            " has the name of a picture in the folder of --svg; give it another name");
        for (std::size_t other = 0; other < k; ++other)
            if (outputs[other].file && is_one_file(*file, *outputs[other].file))
                throw Error(ErrorKind::usage, option + " " + file->string() + " is the file of " +
                                                  outputs[other].option + " too; give one of them another name");
    }
}

}  // namespace ribvault
