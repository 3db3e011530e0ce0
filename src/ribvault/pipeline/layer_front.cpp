#include "ribvault/pipeline/layer_front.hpp"

#include <algorithm>
#include <boost/graph/copy.hpp>

#include "ribvault/print/shell_paths.hpp"
#include "ribvault/slice/outside.hpp"

namespace ribvault {
namespace {

/// Adds the supports outside to those in the cavity. Both grow from all of `above`: what stood in a cavity may stand
/// outside below.
void add_outside(LayerSupports& supports, SupportForest& above, const Cavity& outside, const Region& overhang,
                 const Settings& settings) {
    std::vector<char> ends;
    for (auto [e, end] = edges(above); e != end; ++e) ends.push_back(above[*e].first_layer);
    const LayerSupports more = next_layer(above, outside, overhang, settings);
    std::size_t k = 0;
    for (auto [e, end] = edges(above); e != end; ++e, ++k) above[*e].first_layer = above[*e].first_layer && ends[k];
    boost::copy_graph(more.forest, supports.forest);
    supports.unsupported.insert(supports.unsupported.end(), more.unsupported.begin(), more.unsupported.end());
    supports.blocked += more.blocked;
    supports.full_bonus = supports.full_bonus || more.full_bonus;
    supports.quarter_bonus = supports.quarter_bonus || more.quarter_bonus;
}

}  // namespace

LayerSupports next_supports(SupportForest& above, const Token& token, const Settings& settings) {
    LayerSupports supports = next_layer(above, *token.material.cavity, token.overhang, settings);
    if (settings.outside()) add_outside(supports, above, *token.material.outside, token.overhang_outside, settings);
    return supports;
}

void enter_tracks(const SupportForest& forest, LayerMaterial& material) {
    std::vector<Segment> all, internal, external;
    const auto add = [&](std::size_t a, std::size_t b) {
        all.push_back({forest[a].at, forest[b].at});
        (forest[a].outside ? external : internal).push_back(all.back());
    };
    for (auto [e, end] = edges(forest); e != end; ++e) add(source(*e, forest), target(*e, forest));
    for (auto [v, end] = vertices(forest); v != end; ++v)
        if (out_degree(*v, forest) == 0) add(*v, *v);
    material.tracks = std::make_shared<const std::vector<Segment>>(std::move(all));
    material.internal = std::make_shared<const std::vector<Segment>>(std::move(internal));
    material.external = std::make_shared<const std::vector<Segment>>(std::move(external));
}

LayerFront::LayerFront(const Slicer& slicer, const Settings& settings, const TrackSettings* tracks,
                       const std::function<bool()>& stop, const OutsideRoom* room, bool overhangs)
    : slicer_(slicer),
      settings_(settings),
      tracks_(tracks),
      stop_(stop),
      room_(room),
      overhangs_wanted_(overhangs),
      layers_(slicer.layer_count()),
      last_(-settings.bottom_layers - 1 - static_cast<int>(delay())),
      next_(layers_ - 1),
      window_top_(layers_ - 1) {}

oneapi::tbb::filter<void, TokenPtr> LayerFront::filter() {
    namespace tbb = oneapi::tbb;
    using tbb::filter_mode;
    const auto step = [this](filter_mode mode, void (LayerFront::*work)(Token&)) {
        return tbb::make_filter<TokenPtr, TokenPtr>(
            mode, [this, work](TokenPtr token) { return (this->*work)(*token), token; });
    };
    return tbb::make_filter<void, TokenPtr>(filter_mode::serial_in_order,
                                            [this](tbb::flow_control& flow) { return produce(flow); }) &
           step(filter_mode::parallel, &LayerFront::slice) & step(filter_mode::serial_in_order, &LayerFront::gather) &
           step(filter_mode::parallel, &LayerFront::hollow) & step(filter_mode::serial_in_order, &LayerFront::pair) &
           step(filter_mode::parallel, &LayerFront::hang) & step(filter_mode::serial_in_order, &LayerFront::delay);
}

StageTimes LayerFront::seconds() const {
    return {{"slice", slicing_.seconds()}, {"erode", eroding_.seconds()}, {"cavity", cavities_.seconds()},
            {"overhang", overhangs_.seconds()}, {"shell", planning_.seconds()}};
}

TokenPtr LayerFront::produce(oneapi::tbb::flow_control& flow) {
    if (next_ < last_ || stop_()) {
        flow.stop();
        return nullptr;
    }
    const TokenPtr token = tokens_.add();
    token->slice_index = next_--;
    return token;
}

void LayerFront::slice(Token& token) {
    if (token.slice_index < 0) return;
    slicing_.measure([&] {
        token.own.slice = std::make_shared<const Slice>(slicer_.slice(token.slice_index, &token.own.closings));
    });
    eroding_.measure(
        [&] { token.own.region = std::make_shared<const Region>(erode_slice(*token.own.slice, settings_)); });
}

void LayerFront::gather(Token& token) {
    const int up = settings_.top_layers, down = settings_.bottom_layers;
    window_.push_back(std::move(token.own));
    const int layer = token.slice_index + down;
    if (layer >= layers_ || layer < 0) return;
    token.layer = layer;
    while (window_top_ > layer + std::max(up, settings_.support_gap_layers)) window_.pop_front(), --window_top_;
    const auto at = [&](int j) -> const Eroded& { return window_[static_cast<std::size_t>(window_top_ - j)]; };
    bool complete = layer + up < layers_ && layer - down >= 0;  // missing layers count as empty
    for (int j = layer + up; complete && j >= layer - down; --j) {
        token.eroded.push_back(at(j).region);
        if (j != layer && up > 0 && down > 0 && settings_.inside()) token.covering.push_back(at(j).slice);
    }
    Eroded& own = window_[static_cast<std::size_t>(window_top_ - layer)];
    token.material.layer = layer;
    token.material.slice = own.slice;
    token.material.closings = std::move(own.closings);
    for (int j = layer + 1; j <= std::min(layer + settings_.support_gap_layers, layers_ - 1); ++j)
        token.material.slices_above.push_back(at(j).slice);
}

void LayerFront::hollow(Token& token) {
    if (token.layer < 0) return;
    cavities_.measure([&] {
        Region region;
        if (!token.eroded.empty() && settings_.inside()) {
            region = *token.eroded.front();
            for (std::size_t k = 1; k < token.eroded.size(); ++k) region = intersect(region, *token.eroded[k]);
        }
        token.material.cavity = std::make_shared<const Cavity>(make_cavity(token.layer, std::move(region), settings_));
        if (settings_.outside())
            token.material.outside =
                std::make_shared<const Cavity>(room_->of(token.material.slice, token.material.slices_above));
    });
}

void LayerFront::pair(Token& token) {
    if (token.layer < 0) return;
    token.above = above_;
    above_ = token.material;
    above_.closings.clear();
}

void LayerFront::hang(Token& token) {
    if (token.layer < 0) return;
    if (tracks_)
        planning_.measure([&] {
            token.material.shell = std::make_shared<LayerPlan>();
            token.material.shell->layer = token.layer;
            append_shell_paths(*token.material.slice, token.material.cavity->region, settings_, *tracks_,
                               *token.material.shell, token.covering);
        });
    if (!token.above.slice || !overhangs_wanted_) return;
    overhangs_.measure([&] {
        token.overhang =
            overhang_over_cavity(*token.material.cavity, *token.above.slice, *token.above.cavity, settings_);
        if (settings_.outside())
            token.overhang_outside =
                overhang_outside(*token.material.outside, *token.above.outside, *token.above.cavity, settings_,
                                 token.material.slice.get(), token.above.slice.get());
    });
}

void LayerFront::delay(Token& token) {
    if (token.layer < 0 || settings_.support_gap_layers == 0) return;
    over_gap_.push_back(std::move(token.overhang_outside));
    token.overhang_outside.clear();
    // What is left at layer 0 hangs over the bed, no farther up than the gap.
    if (over_gap_.size() <= static_cast<std::size_t>(settings_.support_gap_layers)) return;
    token.overhang_outside = std::move(over_gap_.front());
    over_gap_.pop_front();
}

}  // namespace ribvault
