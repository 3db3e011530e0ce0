// The part of the pipeline before the sweep: slices, cavities and what hangs over them, layer by layer from the top.
// What it knows of a layer does not depend on any support.
#pragma once

#include <oneapi/tbb/parallel_pipeline.h>

#include <algorithm>
#include <deque>
#include <functional>
#include <mutex>

#include "ribvault/pipeline/clock.hpp"
#include "ribvault/pipeline/sweep_layers.hpp"
#include "ribvault/print/gap_strips.hpp"
#include "ribvault/vault/next_layer.hpp"

namespace ribvault {

/// A slice and its erosion, alive while a cavity near it needs them.
struct Eroded {
    std::shared_ptr<const Slice> slice;
    std::shared_ptr<const Region> region;
    std::vector<GapClosing> closings;
};

/// What travels through the pipeline. Token `slice_index` brings in one slice and, with the covers' delay, sends one
/// layer on.
struct Token {
    int slice_index = 0;
    Eroded own;
    int layer = -1;  ///< the layer whose cavity this token computes; -1: none yet, or none any more
    std::vector<std::shared_ptr<const Region>> eroded;  ///< slices layer - k .. layer + k; empty where one is missing
    Covering covering;  ///< the slices of `eroded` but the layer's own; none unless they hollow it from both sides
    LayerMaterial material, above;
    Region overhang, overhang_outside;
    std::shared_ptr<SweptLayer> swept;                   ///< the layer above `layer`, complete now
    std::shared_ptr<const LayerMaterial> below_swept;
    std::shared_ptr<void> finished;
};
using TokenPtr = Token*;

/// The tokens on their way. When a stage throws, TBB forgets those that are under way: they are freed here.
class Tokens {
public:
    TokenPtr add() {
        const std::lock_guard lock(mutex_);
        return &tokens_.emplace_back();
    }
    /// Tokens arrive in the order in which they left.
    void remove_first() {
        const std::lock_guard lock(mutex_);
        tokens_.pop_front();
    }

private:
    std::mutex mutex_;
    std::deque<Token> tokens_;
};

/// S_i under `above` = S_{i+1}, in the cavity and outside: next_layer for the layer of this token.
LayerSupports next_supports(SupportForest& above, const Token& token, const Settings& settings);

/// Enters S_i in the layer's material: as segments, dots as segments of no length.
void enter_tracks(const SupportForest& forest, LayerMaterial& material);

/// Makes tokens of layers, from the top. One use: filter() is the head of one pipeline.
class LayerFront {
public:
    /// Without `tracks` no shell is planned, without `overhangs` it is not looked what hangs. All arguments must
    /// outlive the pipeline.
    LayerFront(const Slicer& slicer, const Settings& settings, const TrackSettings* tracks,
               const std::function<bool()>& stop, const OutsideRoom* room, bool overhangs = true);

    oneapi::tbb::filter<void, TokenPtr> filter();
    /// A token that has been through the whole pipeline, in the order in which they left.
    void remove(TokenPtr) { tokens_.remove_first(); }
    /// So many more tokens come after the last layer than push that through: layers may wait in the pipeline for the
    /// gap of layers below them.
    std::size_t delay() const { return static_cast<std::size_t>(std::max(0, settings_.support_gap_layers - 1)); }
    /// How many tokens a pipeline of so many threads needs.
    std::size_t window(std::size_t threads) const {
        return 4 * threads + static_cast<std::size_t>(settings_.top_layers + settings_.bottom_layers);
    }
    StageTimes seconds() const;

private:
    TokenPtr produce(oneapi::tbb::flow_control& flow);
    void slice(Token& token);
    void gather(Token& token);
    void hollow(Token& token);
    void pair(Token& token);
    void hang(Token& token);
    void delay(Token& token);

    const Slicer& slicer_;
    const Settings& settings_;
    const TrackSettings* tracks_;
    const std::function<bool()>& stop_;
    const OutsideRoom* room_;
    const bool overhangs_wanted_;
    const int layers_, last_;
    int next_;  ///< after the last slice come empty tokens that push the last layers through
    Tokens tokens_;
    std::deque<Eroded> window_;  ///< slices window_top_, window_top_ - 1, ...
    int window_top_;
    LayerMaterial above_;
    std::deque<Region> over_gap_;  ///< what hangs outside, for the layer that holds it up through
                                   ///< settings.support_gap_layers empty ones
    Clock slicing_, eroding_, cavities_, overhangs_, planning_;
};

}  // namespace ribvault
