#include "ribvault/mesh/read_mesh.hpp"

#include <algorithm>

#include "ribvault/lower_case.hpp"
#include "ribvault/mesh/read_formats.hpp"

namespace ribvault {
namespace {

using Reader = void (*)(const InputFile&, MeshBuilder&);

/// The first word of a text, past comments.
std::string_view first_word(std::string_view text) {
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    for (;;) {
        text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
        if (!text.starts_with('#')) return text.substr(0, text.find_first_of(" \t\r\n"));
        text.remove_prefix(std::min(text.find_first_of("\r\n"), text.size()));
    }
}

Reader reader_for(const InputFile& file, std::string extension) {
    if (file.starts_with("PK\x03\x04") || file.starts_with("PK\x05\x06")) return read_3mf;
    if (is_binary_stl(file)) return read_stl;
    if (file.starts_with("ply\n") || file.starts_with("ply\r")) return read_ply;
    const std::string_view word = first_word(file.data);
    if (word.size() <= 7 && word.ends_with("OFF")) return read_off;
    static constexpr std::string_view obj_words[] = {"v", "vn", "vt", "f", "o", "g", "s", "mtllib", "usemtl"};
    if (std::find(std::begin(obj_words), std::end(obj_words), word) != std::end(obj_words)) return read_obj;
    if (word == "solid" || word == "SOLID") return read_stl;
    extension = lower_case(extension);
    if (extension == ".stl") return read_stl;
    if (extension == ".obj") return read_obj;
    if (extension == ".off") return read_off;
    if (extension == ".ply") return read_ply;
    if (extension == ".3mf") return read_3mf;
    file.fail(ErrorKind::unreadable, "", "neither content nor name is that of an STL, OBJ, OFF, PLY or 3MF file",
              "export the mesh as one of these");
}

void check_solid(const InputFile& file, const Mesh& mesh) {
    const auto refuse = [&](const std::string& what) {
        file.fail(ErrorKind::bad_geometry, "", what, "export the solid's surface as triangles");
    };
    if (mesh.triangles.cols() == 0)
        refuse(mesh.degenerate_triangles == 0 ? "the file holds no triangles"
                                              : "all " + std::to_string(mesh.degenerate_triangles) +
                                                    " triangles have two corners at the same point");
    for (int axis = 0; axis < 3; ++axis)
        if (mesh.vertices.row(axis).minCoeff() == mesh.vertices.row(axis).maxCoeff())
            refuse(std::string("the mesh has no volume, all its points have the same ") + "xyz"[axis]);
}

}  // namespace

Mesh read_mesh(const std::filesystem::path& path) {
    const InputFile file = load_file(path);
    MeshBuilder builder;
    reader_for(file, path.extension().string())(file, builder);
    Mesh mesh = builder.finish();
    check_solid(file, mesh);
    return mesh;
}

}  // namespace ribvault
