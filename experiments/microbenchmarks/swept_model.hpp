// A model with everything that its sweep makes, kept whole so that each stage can be timed alone.
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "ribvault/mesh/place_mesh.hpp"
#include "ribvault/pipeline/sweep_layers.hpp"
#include "ribvault/print/gap_strips.hpp"

/// One layer: what the stages read and make. Everything is there but on the lowest layer (no `below`).
struct Layer {
    ribvault::SweptLayer swept;
    ribvault::Region eroded;    ///< the slice's erosion alone
    ribvault::Region overhang;  ///< of the layer above over this cavity
    ribvault::LayerPlan shell;  ///< before the supports
    std::size_t vertices = 0;   ///< of the slice
};

struct SweptModel {
    std::filesystem::path file;
    ribvault::Mesh mesh;
    ribvault::Placement placement;
    ribvault::Settings settings;
    ribvault::TrackSettings tracks;
    std::unique_ptr<ribvault::Slicer> slicer;
    std::vector<Layer> layers;  ///< from the bottom
    std::size_t vertices = 0, triangles = 0;
};

/// The slices that cover layer k of a model with one cover on either side.
ribvault::Covering covering_of(const SweptModel& model, std::size_t k);

/// Reads, places and sweeps a model with the default settings. Throws what these throw.
SweptModel sweep_model(const std::filesystem::path& file, const ribvault::PlacementOptions& placement);
