#include "ribvault/input_stream.hpp"

#include <cerrno>
#include <cstring>
#include <iterator>
#include <system_error>

#include "ribvault/error.hpp"

namespace ribvault {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void refuse(const fs::path& file, const std::string& what, const std::string& remedy) {
    throw Error(ErrorKind::unreadable, file.string() + ": " + what + "; " + remedy);
}

}  // namespace

std::ifstream open_input(const fs::path& file, const std::string& kind) {
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (status.type() == fs::file_type::not_found) refuse(file, "there is no such file", "check the path");
    if (error) refuse(file, "cannot be opened (" + error.message() + ")", "check the path and its permissions");
    if (fs::is_directory(status)) refuse(file, "is a folder, not a " + kind + " file", "name the file in it");
    std::ifstream stream(file, std::ios::binary);
    if (!stream) refuse(file, std::string("cannot be opened (") + std::strerror(errno) + ")", "check its permissions");
    return stream;
}

void check_read(const std::ifstream& stream, const fs::path& file) {
    if (stream.bad()) refuse(file, "reading failed", "copy the file to a local disk and try again");
}

std::string read_input(const fs::path& file, const std::string& kind) {
    std::ifstream stream = open_input(file, kind);
    std::string data;
    std::error_code error;
    if (fs::is_regular_file(file, error)) {
        data.resize(fs::file_size(file));
        stream.read(data.data(), static_cast<std::streamsize>(data.size()));
        data.resize(static_cast<std::size_t>(stream.gcount()));
    } else {
        data.assign(std::istreambuf_iterator<char>(stream), {});
    }
    check_read(stream, file);
    return data;
}

}  // namespace ribvault
