// A swept layer proved, ordered and described, ready for the outputs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ribvault/output_file.hpp"
#include "ribvault/pipeline/clock.hpp"
#include "ribvault/pipeline/generate.hpp"
#include "ribvault/pipeline/picture_folder.hpp"
#include "ribvault/pipeline/sweep_layers.hpp"
#include "ribvault/print/travel_map.hpp"
#include "ribvault/print/write_gcode.hpp"

namespace ribvault {

/// What one layer adds to the outputs.
struct LayerOutput {
    LayerReport report;  ///< without what its way from the layer below adds
    LayerText text;
    TravelMap map;
    Box box;                   ///< of the tracks' centre lines
    PrintVerdict print_above;  ///< of the layer above over this one
    struct OverGap {
        int layer;
        LayerVerdict verdict;
        PrintVerdict print;
    };
    std::vector<OverGap> over_gap;      ///< of the layers that external supports of this one hold up through a gap
    std::string walls;                  ///< binary STL facets; empty unless the job writes a mesh
    std::optional<AtomicFile> picture;  ///< not yet under its name
    std::string shapes, packed;         ///< for the layers file; for the run page
};

/// Makes what the layers add, several at once. The job and the slicer must outlive it.
class LayerFinisher {
public:
    /// `pictures`: where the job's pictures go; nullptr: there are none.
    LayerFinisher(const Slicer& slicer, const Job& job, const PictureFolder* pictures)
        : slicer_(slicer), job_(job), pictures_(pictures) {}

    /// `below`: the layer below, nullptr under layer 0. Throws what its parts throw.
    LayerOutput finish(const SweptLayer& swept, const LayerMaterial* below);

    StageTimes seconds() const {
        return {{"proof", proof_.seconds()}, {"paths", paths_.seconds()}, {"pictures", drawing_.seconds()}};
    }

private:
    void prove(const SweptLayer& swept, const LayerMaterial* below, LayerOutput& output) const;
    void check_gap(const SweptLayer& swept, LayerReport& report) const;
    LayerPaths lay_paths(const SweptLayer& swept, LayerOutput& output) const;
    void describe(const SweptLayer& swept, const LayerPaths& paths, LayerOutput& output) const;
    void draw(const SweptLayer& swept, const LayerMaterial* below, LayerOutput& output) const;

    const Slicer& slicer_;
    const Job& job_;
    const PictureFolder* pictures_;
    Clock proof_, paths_, drawing_;
};

}  // namespace ribvault
