// A model as the baselines see it: all slices at once, and where each may be hollow.
#pragma once

#include <filesystem>
#include <vector>

#include "ribvault/mesh/examine_mesh.hpp"
#include "ribvault/mesh/place_mesh.hpp"
#include "ribvault/settings.hpp"
#include "ribvault/slice/slice.hpp"

namespace ribvault::baselines {

struct Stack {
    std::vector<Slice> slices;   ///< O_i
    std::vector<Region> room;    ///< O_i without shell and covers: C_i of the same settings
    double volume_mm3 = 0;       ///< of the slices
};

/// Reads and places a model; `facts` gets its size and volume. Throws as the library's parts do.
Placement read_placed(const std::filesystem::path& file, const PlacementOptions& options, Mesh& mesh, MeshFacts& facts);

/// Slices on all processors. `shell` is what is kept inside the boundary, in whole tracks.
Stack slice_all(const Mesh& mesh, const Placement& placement, const Settings& settings, int shell_tracks);

}  // namespace ribvault::baselines
