#include "run.hpp"

#include <algorithm>
#include <cstdio>

#include "ribvault/error.hpp"
#include "stack.hpp"

namespace ribvault::steps {

Settings Options::settings() const {
    Settings s;
    s.layer_height = s.first_layer_height = parse_length(layer_height, "--layer-height");
    s.top_layers = top_layers, s.bottom_layers = bottom_layers;
    s.straighten = !no_straighten, s.branch_bonus = !no_branch_bonus;
    s.gaps = gaps == "paper" ? Gaps::paper : gaps == "none" ? Gaps::none : Gaps::proved;
    s.seed = seed;
    s.check();
    return s;
}

PlacementOptions Options::placement() const {
    PlacementOptions p;
    if (!scale.empty()) p.scale = parse_rational(scale, "--scale");
    if (!height.empty()) p.height_mm = parse_rational(height, "--height");
    p.up = up[0];
    if (std::sscanf(bed.c_str(), "%lf,%lf,%lf", &p.bed_x, &p.bed_y, &p.bed_z) != 3)
        throw Error(ErrorKind::usage, "--bed: write for example --bed 250,210,200");
    return p;
}

Run sweep(const Options& options, int first) {
    Run run;
    run.settings = options.settings();
    Mesh mesh;
    MeshFacts facts;
    const Placement placement = baselines::read_placed(options.model, options.placement(), mesh, facts);
    const Slicer slicer(mesh, placement, run.settings);
    if (first < 0 || first >= slicer.layer_count())
        throw Error(ErrorKind::usage, "layer " + std::to_string(first) + ": the model has the layers 0 to " +
                                          std::to_string(slicer.layer_count() - 1));
    const auto keep = [&](const SweptLayer& layer, std::shared_ptr<void>) {
        if (layer.material.layer >= first) run.layers.push_back(layer);
    };
    const auto nothing = [](const SweptLayer&, const LayerMaterial*) { return std::shared_ptr<void>(); };
    sweep_layers(slicer, run.settings, {}, 0, nothing, keep, [] { return false; });
    std::reverse(run.layers.begin(), run.layers.end());
    for (const SweptLayer& layer : run.layers)
        run.plane_heights_mm.push_back(slicer.plane_height(layer.material.layer).get_d());
    return run;
}

const SweptLayer& layer_of(const Run& run, int layer) {
    for (const SweptLayer& l : run.layers)
        if (l.material.layer == layer) return l;
    throw Error(ErrorKind::usage, "--layer " + std::to_string(layer) + ": the model has the layers " +
                                      std::to_string(run.layers.front().material.layer) + " to " +
                                      std::to_string(run.layers.back().material.layer));
}

}  // namespace ribvault::steps
