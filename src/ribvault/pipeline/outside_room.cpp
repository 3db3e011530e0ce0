#include "ribvault/pipeline/outside_room.hpp"

#include <oneapi/tbb/parallel_pipeline.h>

#include <algorithm>
#include <deque>

#include "ribvault/error.hpp"
#include "ribvault/pipeline/packed_values.hpp"
#include "ribvault/pipeline/thread_limit.hpp"
#include "ribvault/slice/lattice_clip.hpp"

namespace ribvault {
namespace {

/// With vertices left out that lie within `distance` of the line between their neighbours.
Region simplified(const Region& region, double distance) {
    ClipperLib::Paths paths = to_clipper(region);
    ClipperLib::CleanPolygons(paths, distance);
    return from_clipper(paths);
}

}  // namespace

OutsideRoom::OutsideRoom(const Slicer& slicer, const Box& frame, const Settings& settings, int threads,
                         const std::function<bool()>& stop)
    : frame_(frame), settings_(settings) {
    if (settings.bed_only) find_ways_to_bed(slicer, threads, stop);
}

Region OutsideRoom::off(const std::shared_ptr<const Slice>& slice,
                        const std::vector<std::shared_ptr<const Slice>>& above) const {
    std::vector<std::shared_ptr<const Slice>> slices{slice};
    slices.insert(slices.end(), above.begin(), above.end());
    return off_the_object(slices, frame_, settings_);
}

Cavity OutsideRoom::of(const std::shared_ptr<const Slice>& slice,
                       const std::vector<std::shared_ptr<const Slice>>& above) const {
    Cavity outside = make_outside(*slice, frame_, settings_);
    if (ways_)
        outside.walls = way_at(slice->layer), outside.on_bed = true;
    else if (settings_.stands_off())
        outside.walls = off(slice, above);
    return outside;
}

Region OutsideRoom::way_at(int layer) const {
    const std::string bytes = ways_->at(static_cast<std::size_t>(layer));
    std::string_view rest = bytes;
    Region way;
    unpack(rest, way);
    return way;
}

void OutsideRoom::find_ways_to_bed(const Slicer& slicer, int threads, const std::function<bool()>& stop) {
    namespace tbb = oneapi::tbb;
    using tbb::filter_mode;
    ways_.emplace();
    const std::size_t limit = thread_limit(threads);
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, limit);
    const int layers = slicer.layer_count(), apart = settings_.support_gap_layers;
    using SlicePtr = std::shared_ptr<const Slice>;
    struct Layer {
        SlicePtr slice;
        std::vector<SlicePtr> above;
        Region off;
    };
    using LayerPtr = std::shared_ptr<Layer>;
    int next = 0;
    const auto produce = [&](tbb::flow_control& flow) {
        if (next == layers || stop()) flow.stop();
        return next == layers ? layers : next++;
    };
    const auto slice = [&](int layer) { return std::make_shared<const Slice>(slicer.slice(layer)); };
    // A layer goes on once the slices of its gap are there; the last ones go on together.
    std::deque<SlicePtr> waiting;
    const auto gather = [&](SlicePtr slice) {
        waiting.push_back(std::move(slice));
        std::vector<LayerPtr> complete;
        const bool last = waiting.back()->layer == layers - 1;
        while (!waiting.empty() && (last || static_cast<int>(waiting.size()) > apart)) {
            complete.push_back(
                std::make_shared<Layer>(Layer{waiting.front(), {waiting.begin() + 1, waiting.end()}, {}}));
            waiting.pop_front();
        }
        return complete;
    };
    const auto keep_off = [&](std::vector<LayerPtr> complete) {
        for (const LayerPtr& layer : complete) layer->off = off(layer->slice, layer->above);
        return complete;
    };
    Region way;
    // What a wall in W_{i+1} needs below it must lie within r + ρ less three times the slack of W_i to be grown
    // (vault/next_layer.cpp); and the contours, of which each layer would add arcs, are kept simple.
    const double simple = 2 * static_cast<double>(settings_.slack),
                 reach = static_cast<double>(settings_.support_radius - 4 * settings_.slack) - simple;
    const auto follow = [&](const std::vector<LayerPtr>& complete) {
        for (const LayerPtr& layer : complete) {
            way = layer->slice->layer == 0 ? std::move(layer->off)
                                           : uncross(intersect(layer->off, offset(simplified(way, simple), reach,
                                                                                  ClipperLib::jtRound, simple)));
            std::string bytes;
            pack(bytes, way);
            ways_->add(bytes);
        }
    };
    tbb::parallel_pipeline(
        4 * limit, tbb::make_filter<void, int>(filter_mode::serial_in_order, produce) &
                       tbb::make_filter<int, SlicePtr>(filter_mode::parallel, slice) &
                       tbb::make_filter<SlicePtr, std::vector<LayerPtr>>(filter_mode::serial_in_order, gather) &
                       tbb::make_filter<std::vector<LayerPtr>, std::vector<LayerPtr>>(filter_mode::parallel, keep_off) &
                       tbb::make_filter<std::vector<LayerPtr>, void>(filter_mode::serial_in_order, follow));
    end_if(stop);
    ways_->finish();
}

}  // namespace ribvault
