#include "stack.hpp"

#include <oneapi/tbb/parallel_for.h>

#include "ribvault/mesh/orient_mesh.hpp"
#include "ribvault/mesh/read_mesh.hpp"
#include "ribvault/slice/cavity.hpp"
#include "ribvault/slice/slice_mesh.hpp"

namespace ribvault::baselines {

Placement read_placed(const std::filesystem::path& file, const PlacementOptions& options, Mesh& mesh,
                      MeshFacts& facts) {
    mesh = read_mesh(file);
    const Placement placement = place(mesh, options);
    facts = examine(mesh, placement);
    if (facts.unbalanced_edges > 0 && orient_consistently(mesh) > 0) facts = examine(mesh, placement);
    return placement;
}

Stack slice_all(const Mesh& mesh, const Placement& placement, const Settings& settings, int shell_tracks) {
    const Slicer slicer(mesh, placement, settings);
    require_closed_contours(slicer, settings);
    const int layers = slicer.layer_count();
    Stack stack;
    stack.slices.resize(static_cast<std::size_t>(layers));
    stack.room.resize(stack.slices.size());
    std::vector<Region> eroded(stack.slices.size());
    Settings shell = settings;
    shell.perimeters = shell_tracks;
    oneapi::tbb::parallel_for(0, layers, [&](int i) {
        const auto k = static_cast<std::size_t>(i);
        stack.slices[k] = slicer.slice(i);
        eroded[k] = erode_slice(stack.slices[k], shell);
    });
    oneapi::tbb::parallel_for(0, layers, [&](int i) {
        const int lo = i - settings.bottom_layers, hi = i + settings.top_layers;
        if (lo < 0 || hi >= layers) return;  // missing layers count as empty
        Region room = eroded[static_cast<std::size_t>(i)];
        for (int j = lo; j <= hi; ++j)
            if (j != i) room = intersect(room, eroded[static_cast<std::size_t>(j)]);
        stack.room[static_cast<std::size_t>(i)] = std::move(room);
    });
    for (int i = 0; i < layers; ++i) {
        const double height = to_mm(settings.height_of(i));
        stack.volume_mm3 += height * area_to_mm2(signed_area(stack.slices[static_cast<std::size_t>(i)].rounded));
    }
    return stack;
}

}  // namespace ribvault::baselines
