// The readers behind read_mesh(), one a format. Each throws Error as read_mesh() says, except for "no triangles".
#pragma once

#include "ribvault/mesh/input_file.hpp"
#include "ribvault/mesh/mesh_builder.hpp"

namespace ribvault {

/// True when the length is that of a binary STL file with the number of triangles it declares.
bool is_binary_stl(const InputFile& file);

void read_stl(const InputFile& file, MeshBuilder& mesh);
void read_obj(const InputFile& file, MeshBuilder& mesh);
void read_off(const InputFile& file, MeshBuilder& mesh);
void read_ply(const InputFile& file, MeshBuilder& mesh);
void read_3mf(const InputFile& file, MeshBuilder& mesh);

}  // namespace ribvault
