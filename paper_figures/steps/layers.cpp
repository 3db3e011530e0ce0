#include "commands.hpp"
#include "ribvault/print/order_paths.hpp"

namespace ribvault::steps {
namespace {

Json layer_json(const SweptLayer& layer, double z_mm, const SweptLayer* above, const Settings& settings) {
    const LayerMaterial& m = layer.material;
    const Region overhang =
        above ? overhang_over_cavity(*m.cavity, *above->material.slice, *above->material.cavity, settings) : Region{};
    const LayerPaths paths = order_paths(layer.held.plan, m.slice->rounded, TrackSettings{}.alternate);
    return {{"layer", m.layer},
            {"z_mm", z_mm},
            {"slice", json_of(m.slice->rounded)},
            {"cavity", json_of(m.cavity->region)},
            {"overhang", json_of(overhang)},
            {"unsupported", json_of(layer.unsupported)},
            {"supports", json_of(layer.forest)},
            {"paths", json_of(paths.paths)}};
}

}  // namespace

Json layers(const Options& options, int from, int to) {
    const Run run = sweep(options, from);
    Json result = result_head("layers", options, run.settings);
    Json list = Json::array();
    for (std::size_t k = 0; k < run.layers.size(); ++k) {
        if (to >= 0 && run.layers[k].material.layer > to) break;
        list.push_back(layer_json(run.layers[k], run.plane_heights_mm[k],
                                  k + 1 < run.layers.size() ? &run.layers[k + 1] : nullptr, run.settings));
    }
    result["layers"] = std::move(list);
    return result;
}

}  // namespace ribvault::steps
