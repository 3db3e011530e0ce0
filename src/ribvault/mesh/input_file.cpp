#include "ribvault/mesh/input_file.hpp"

#include "ribvault/input_stream.hpp"

namespace ribvault {

void InputFile::fail(ErrorKind kind, const std::string& place, const std::string& what,
                     const std::string& remedy) const {
    throw Error(kind, name + (place.empty() ? "" : ", " + place) + ": " + what + "; " + remedy);
}

InputFile load_file(const std::filesystem::path& file) {
    InputFile input{file.string(), read_input(file, "mesh")};
    if (input.data.empty()) input.fail(ErrorKind::unreadable, "", "the file is empty", "export the mesh again");
    return input;
}

}  // namespace ribvault
