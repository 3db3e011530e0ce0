// The whole sweep as a bounded pipeline over the layers, from top to bottom.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "ribvault/exact/nearest_segment.hpp"
#include "ribvault/pipeline/clock.hpp"
#include "ribvault/pipeline/outside_room.hpp"
#include "ribvault/print/hold_print.hpp"
#include "ribvault/print/track_settings.hpp"
#include "ribvault/settings.hpp"
#include "ribvault/slice/cavity.hpp"
#include "ribvault/slice/slice_mesh.hpp"
#include "ribvault/vault/next_layer.hpp"

namespace ribvault {

/// What one layer is made of.
struct LayerMaterial {
    int layer = 0;
    std::shared_ptr<const Slice> slice;               ///< O_i
    std::shared_ptr<const Cavity> cavity;             ///< C_i
    std::shared_ptr<const Cavity> outside;            ///< where external supports may stand; nullptr: nowhere
    std::shared_ptr<const std::vector<Segment>> tracks;  ///< S_i as segments; dots as segments of no length
    std::shared_ptr<const std::vector<Segment>> internal, external;  ///< of these, those in cavities and those outside
    /// Of the next settings.support_gap_layers layers, as far as there are any.
    std::vector<std::shared_ptr<const Slice>> slices_above;
    std::vector<GapClosing> closings;
    std::shared_ptr<LayerPlan> shell;  ///< perimeters and covers; taken by hold_print
};

/// A layer whose overhangs external supports hold up through a gap, from settings.support_gap_layers + 1 layers below.
/// Where there are not so many the bed does.
struct OverGap {
    LayerMaterial upper;                                  ///< layer j
    bool over_bed = false;                                ///< no more layers than the gap has lie below it
    std::vector<LayerMaterial> gap;                       ///< layers j - 1, j - 2, ... above the supports
    PrintOverGap print;
};

/// A layer with everything known about it that its neighbours decide.
struct SweptLayer {
    LayerMaterial material;
    SupportForest forest;  ///< S_i, SupportEdge::first_layer set
    Region unsupported;    ///< what of layer i + 1 the walls copied from above and the shell did not hold up
    /// No supports rooted on the shell could be shorter, lattice units; 0 unless settings.length_bound.
    double length_bound = 0;
    int blocked = 0;       ///< chains that could not be straightened without crossing a wall
    int braces = 0;        ///< walls that give a long tree its second root
    HeldLayer held;        ///< what is printed
    std::shared_ptr<const PrintedLayer> printed_above;  ///< what `held` is judged against, which refers to it;
                                                        ///< nullptr: this is the top
    /// Where supports stand off: the object's tracks of kind support on this layer and on the next
    /// settings.support_gap_layers.
    std::vector<std::shared_ptr<const NearestSegment>> patches;
    std::vector<OverGap> over_gap;  ///< what the external supports of this layer hold up through the gap above them
                                    ///< (settings.support_gap_layers)
};

/// Slices, hollows and sweeps all layers, and plans what is printed. `finish(layer, below)` is called for every layer,
/// concurrently, with the material of the layer below (nullptr under layer 0); what it returns is handed to `collect`
/// in the order of the layers from top to bottom, one at a time. At most a window of layers is alive at any time,
/// whatever their number. The result does not depend on `threads` (0: all).
///
/// `room`: where external supports stand; needed when settings.outside(). `made`: supports that a sweep with the same
/// settings made, layer by layer from the top; without it they are swept here.
///
/// Throws what its parts throw, and Error (interrupted) soon after `stop()` returned true.
StageTimes sweep_layers(
    const Slicer& slicer, const Settings& settings, const TrackSettings& track_settings, int threads,
    const std::function<std::shared_ptr<void>(const SweptLayer&, const LayerMaterial* below)>& finish,
    const std::function<void(const SweptLayer&, std::shared_ptr<void>)>& collect, const std::function<bool()>& stop,
    const OutsideRoom* room = nullptr, const std::function<LayerSupports(std::size_t depth)>& made = nullptr);

}  // namespace ribvault
