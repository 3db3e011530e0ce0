#include "swept_model.hpp"

#include <algorithm>
#include <mutex>

#include "ribvault/mesh/read_mesh.hpp"
#include "ribvault/print/shell_paths.hpp"

using namespace ribvault;

Covering covering_of(const SweptModel& model, std::size_t k) {
    if (k == 0 || k + 1 == model.layers.size()) return {};
    return {model.layers[k + 1].swept.material.slice, model.layers[k - 1].swept.material.slice};
}

SweptModel sweep_model(const std::filesystem::path& file, const PlacementOptions& placement) {
    SweptModel model;
    model.file = file;
    model.mesh = read_mesh(file);
    model.placement = place(model.mesh, placement);
    model.triangles = static_cast<std::size_t>(model.mesh.triangles.cols());
    model.slicer = std::make_unique<Slicer>(model.mesh, model.placement, model.settings);
    model.layers.resize(static_cast<std::size_t>(model.slicer->layer_count()));
    const auto keep = [&](const SweptLayer& swept, const LayerMaterial*) -> std::shared_ptr<void> {
        Layer& layer = model.layers[static_cast<std::size_t>(swept.material.layer)];
        layer.swept = swept;
        layer.eroded = erode_slice(*swept.material.slice, model.settings);
        layer.shell.layer = swept.material.layer;
        for (const Contour& contour : swept.material.slice->rounded) layer.vertices += contour.size();
        return nullptr;
    };
    sweep_layers(
        *model.slicer, model.settings, model.tracks, 0, keep, [](const SweptLayer&, std::shared_ptr<void>) {},
        [] { return false; });
    for (std::size_t k = 0; k < model.layers.size(); ++k) {
        model.vertices += model.layers[k].vertices;
        const LayerMaterial& material = model.layers[k].swept.material;
        append_shell_paths(*material.slice, material.cavity->region, model.settings, model.tracks,
                           model.layers[k].shell, covering_of(model, k));
        if (k + 1 == model.layers.size()) continue;
        const LayerMaterial &own = model.layers[k].swept.material, &above = model.layers[k + 1].swept.material;
        model.layers[k].overhang = overhang_over_cavity(*own.cavity, *above.slice, *above.cavity, model.settings);
    }
    return model;
}
