// One run of the pipeline, with the layers that a drawing needs kept.
#pragma once

#include <string>
#include <vector>

#include "ribvault/mesh/place_mesh.hpp"
#include "ribvault/pipeline/sweep_layers.hpp"

namespace ribvault::steps {

/// What the command line says; lengths as written.
struct Options {
    std::string model, output, scale, height, up = "z", bed = "250,250,250", gaps = "proved", layer_height = "0.2";
    int top_layers = 1, bottom_layers = 1;
    bool no_straighten = false, no_branch_bonus = false;
    std::uint64_t seed = 1;

    /// Throws Error (usage).
    Settings settings() const;
    PlacementOptions placement() const;
};

/// The layers of a model, bottom layer first, as sweep_layers computed them.
struct Run {
    Settings settings;
    std::vector<SweptLayer> layers;
    std::vector<double> plane_heights_mm;  ///< z_i
};

/// Everything from `first` up; the layers below are swept too, but not kept. Throws as the library's parts do, and
/// Error (usage) when the model has no layer `first`.
Run sweep(const Options& options, int first = 0);

/// The layer with this number. Throws Error (usage) naming the option `--layer` when there is none.
const SweptLayer& layer_of(const Run& run, int layer);

}  // namespace ribvault::steps
