// Where external supports may stand on each layer (Section 6): off the object, and with settings.bed_only where they
// get down to the bed.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "ribvault/pipeline/layer_spool.hpp"
#include "ribvault/slice/outside.hpp"
#include "ribvault/slice/slice_mesh.hpp"

namespace ribvault {

/// With settings.bed_only a wall may run on layer i where W_i is: W_0 is all that keeps off the object, W_{i+1} what of
/// that lies within ρ of W_i (less the slack, so that roundings do not matter). A wall in W_{i+1} can stand on one in
/// W_i: who follows that down gets to the bed. These regions are made from the bed up, before the sweep, and wait on
/// disk.
class OutsideRoom {
public:
    /// `frame`: a box that the object does not reach. Throws what slicing throws, Error (cannot_write) when the
    /// temporary folder is full, and Error (interrupted). All references must outlive the room.
    OutsideRoom(const Slicer& slicer, const Box& frame, const Settings& settings, int threads,
                const std::function<bool()>& stop);

    /// What lies outside a slice. `above`: the slices of the settings.support_gap_layers next layers, as far as there
    /// are any: no wall stands under them, for it would touch them. May be called from several threads at once.
    Cavity of(const std::shared_ptr<const Slice>& slice, const std::vector<std::shared_ptr<const Slice>>& above) const;

private:
    Region off(const std::shared_ptr<const Slice>& slice, const std::vector<std::shared_ptr<const Slice>>& above) const;
    Region way_at(int layer) const;
    void find_ways_to_bed(const Slicer& slicer, int threads, const std::function<bool()>& stop);

    Box frame_;
    const Settings& settings_;
    std::optional<LayerSpool> ways_;  ///< W_i, with settings.bed_only
};

}  // namespace ribvault
