#include <stdexcept>

#include "commands.hpp"
#include "growth.hpp"
#include "ribvault/error.hpp"
#include "ribvault/vault/copy_supports.hpp"
#include "ribvault/vault/erode_supports.hpp"
#include "ribvault/vault/next_layer.hpp"
#include "ribvault/vault/straighten_supports.hpp"

namespace ribvault::steps {
namespace {

Segment segment_of(const SupportForest& forest, SupportForest::edge_descriptor e) {
    return {forest[source(e, forest)].at, forest[target(e, forest)].at};
}

struct CopyAmounts {
    double clipped = 0, prolonged = 0;  ///< lattice units
};

CopiedSupports copy_down(const SweptLayer& above, const CavityBoundary& boundary, const Settings& s) {
    return copy_supports(above.forest, boundary, s.support_radius >= s.nozzle / 2);
}

CopyAmounts amounts(const SweptLayer& above, const SweptLayer& here, const Settings& s) {
    CopyAmounts sum;
    if (here.material.cavity->region.empty() || num_edges(above.forest) == 0) return sum;
    const CopiedSupports copied = copy_down(above, prepare_boundary(here.material.cavity->region), s);
    for (auto [e, end] = edges(above.forest); e != end; ++e) sum.clipped += length(segment_of(above.forest, *e));
    std::size_t k = 0;
    for (auto [e, end] = edges(copied.forest); e != end; ++e, ++k)
        (copied.origin[k] < 0 ? sum.prolonged : sum.clipped) +=
            (copied.origin[k] < 0 ? 1 : -1) * length(segment_of(copied.forest, *e));
    return sum;
}

int most_copied(const Run& run) {
    int best = -1;
    double most = 0;
    for (std::size_t k = 0; k + 1 < run.layers.size(); ++k) {
        const CopyAmounts a = amounts(run.layers[k + 1], run.layers[k], run.settings);
        if (std::min(a.clipped, a.prolonged) > most)
            most = std::min(a.clipped, a.prolonged), best = run.layers[k].material.layer;
    }
    if (best < 0)
        throw Error(ErrorKind::usage, "no layer of this model both clips and prolongs supports; name one with --layer");
    return best;
}

std::vector<int> prolonged_edges(const CopiedSupports& copied) {
    std::vector<int> marks;
    for (const std::int32_t origin : copied.origin) marks.push_back(origin < 0 ? 1 : 0);
    return marks;
}

}  // namespace

Json stages(const Options& options, int layer) {
    const Run run = sweep(options);
    const Settings& s = run.settings;
    if (layer < 0) layer = most_copied(run);
    const SweptLayer& here = layer_of(run, layer);
    const SweptLayer& above = layer_of(run, layer + 1);
    const Cavity& cavity = *here.material.cavity;
    if (cavity.region.empty()) throw Error(ErrorKind::usage, "--layer " + std::to_string(layer) + ": has no cavity");
    const CavityBoundary boundary = prepare_boundary(cavity.region);

    const CopiedSupports copied = copy_down(above, boundary, s);
    const ErodedSupports eroded = erode_supports(copied.forest, s.erosion_step);
    SupportForest propagated = eroded.forest;
    if (s.straighten)
        propagated = straighten_supports(eroded.forest, eroded.pinned, boundary, s.straighten_step).forest;

    Json result = result_head("stages", options, s);
    result["layer"] = layer;
    result["slice_above"] = json_of(above.material.slice->rounded);
    result["cavity_above"] = json_of(above.material.cavity->region);
    result["slice"] = json_of(here.material.slice->rounded);
    result["cavity"] = json_of(cavity.region);
    result["above"] = json_of(above.forest);
    result["copied"] = json_of(copied.forest);
    result["copied"]["prolonged"] = prolonged_edges(copied);
    result["inherited"] = json_of(copied.inherited);
    result["eroded"] = json_of(eroded.forest);
    result["straightened"] = json_of(propagated);
    result["overhang"] = json_of(overhang_over_cavity(cavity, *above.material.slice, *above.material.cavity, s));
    result["unsupported"] = json_of(here.unsupported);
    result["growth"] = growth_json(propagated, here.forest, boundary, s);
    result["grown"] = json_of(here.forest);
    return result;
}

}  // namespace ribvault::steps
