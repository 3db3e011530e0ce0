#include "ribvault/mesh/input_file.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>

namespace ribvault {

void InputFile::fail(ErrorKind kind, const std::string& place, const std::string& what,
                     const std::string& remedy) const {
    throw Error(kind, name + (place.empty() ? "" : ", " + place) + ": " + what + "; " + remedy);
}

InputFile load_file(const std::filesystem::path& file) {
    InputFile input{file.string(), {}};
    const auto refuse = [&](const std::string& what, const std::string& remedy) {
        input.fail(ErrorKind::unreadable, "", what, remedy);
    };
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(file, error);
    if (!std::filesystem::exists(status)) refuse("there is no such file", "check the path");
    if (std::filesystem::is_directory(status)) refuse("is a folder, not a mesh file", "name the file in it");
    std::ifstream stream(file, std::ios::binary);
    if (!stream) refuse(std::string("cannot be opened (") + std::strerror(errno) + ")", "check its permissions");
    if (std::filesystem::is_regular_file(status)) {
        input.data.resize(std::filesystem::file_size(file));
        stream.read(input.data.data(), static_cast<std::streamsize>(input.data.size()));
        input.data.resize(static_cast<std::size_t>(stream.gcount()));
    } else {
        input.data.assign(std::istreambuf_iterator<char>(stream), {});
    }
    if (stream.bad()) refuse("reading failed", "copy the file to a local disk and try again");
    if (input.data.empty()) refuse("the file is empty", "export the mesh again");
    return input;
}

}  // namespace ribvault
