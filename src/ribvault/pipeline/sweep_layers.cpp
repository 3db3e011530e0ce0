#include "ribvault/pipeline/sweep_layers.hpp"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_pipeline.h>

#include <atomic>
#include <boost/graph/copy.hpp>
#include <chrono>
#include <deque>
#include <mutex>

#include "ribvault/error.hpp"
#include "ribvault/print/shell_paths.hpp"
#include "ribvault/print/wide_walls.hpp"
#include "ribvault/slice/outside.hpp"
#include "ribvault/vault/next_layer.hpp"

namespace ribvault {
namespace {

/// Seconds spent in one stage, by all threads.
class Clock {
public:
    template <class Work>
    auto measure(Work&& work) {
        const auto start = std::chrono::steady_clock::now();
        struct Stop {
            std::chrono::steady_clock::time_point start;
            std::atomic<std::int64_t>& total;
            ~Stop() { total += std::chrono::nanoseconds(std::chrono::steady_clock::now() - start).count(); }
        } stop{start, nanoseconds_};
        return work();
    }
    double seconds() const { return 1e-9 * static_cast<double>(nanoseconds_); }

private:
    std::atomic<std::int64_t> nanoseconds_{0};
};

/// A slice and its erosion, alive while a cavity near it needs them.
struct Eroded {
    std::shared_ptr<const Slice> slice;
    std::shared_ptr<const Region> region;
    std::vector<GapClosing> closings;
};

/// What travels through the pipeline. Token `slice_index` brings in one slice and, with the covers' delay, sends one layer
/// on.
struct Token {
    int slice_index = 0;
    Eroded own;
    int layer = -1;  ///< the layer whose cavity this token computes; -1: none yet, or none any more
    std::vector<std::shared_ptr<const Region>> eroded;  ///< slices layer - k .. layer + k; empty where one is missing
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

std::shared_ptr<const std::vector<Segment>> tracks_of(const SupportForest& forest) {
    auto tracks = std::make_shared<std::vector<Segment>>();
    tracks->reserve(num_edges(forest));
    for (auto [e, end] = edges(forest); e != end; ++e)
        tracks->push_back({forest[source(*e, forest)].at, forest[target(*e, forest)].at});
    for (auto [v, end] = vertices(forest); v != end; ++v)
        if (out_degree(*v, forest) == 0) tracks->push_back({forest[*v].at, forest[*v].at});
    return tracks;
}

/// Adds the supports outside to those in the cavity. Both grow from all of `above`: what stood in a cavity may stand outside below.
void add_outside(LayerSupports& supports, SupportForest& above, const Cavity& outside, const Region& overhang, const Settings& settings) {
    std::vector<char> ends;
    for (auto [e, end] = edges(above); e != end; ++e) ends.push_back(above[*e].first_layer);
    const LayerSupports more = next_layer(above, outside, overhang, settings);
    std::size_t k = 0;
    for (auto [e, end] = edges(above); e != end; ++e, ++k) above[*e].first_layer = above[*e].first_layer && ends[k];
    boost::copy_graph(more.forest, supports.forest);
    supports.unsupported.insert(supports.unsupported.end(), more.unsupported.begin(), more.unsupported.end());
    supports.blocked += more.blocked;
}

}  // namespace

StageTimes sweep_layers(const Slicer& slicer, const Settings& settings, const TrackSettings& track_settings, int threads,
                        const std::function<std::shared_ptr<void>(const SweptLayer&, const LayerMaterial* below)>& finish,
                        const std::function<void(const SweptLayer&, std::shared_ptr<void>)>& collect,
                        const std::function<bool()>& stop, const Box& frame) {
    namespace tbb = oneapi::tbb;
    using tbb::filter_mode;
    const auto limit = threads > 0 ? static_cast<std::size_t>(threads)
                                   : tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, limit);

    const int layers = slicer.layer_count(), up = settings.top_layers, down = settings.bottom_layers;
    Clock slicing, eroding, cavities, overhangs, planning, sweeping, holding, finishing;

    Tokens tokens;
    int next = layers - 1;  // after the last slice come empty tokens that push the last layers through
    const int last = -down - 1;
    const auto produce = [&](tbb::flow_control& flow) -> TokenPtr {
        if (next < last || stop()) {
            flow.stop();
            return nullptr;
        }
        const TokenPtr token = tokens.add();
        token->slice_index = next--;
        return token;
    };
    const auto slice = [&](TokenPtr token) {
        if (token->slice_index < 0) return token;
        slicing.measure([&] {
            token->own.slice = std::make_shared<const Slice>(slicer.slice(token->slice_index, &token->own.closings));
        });
        eroding.measure([&] { token->own.region = std::make_shared<const Region>(erode_slice(*token->own.slice, settings)); });
        return token;
    };

    std::deque<Eroded> window;  // slices window_top, window_top - 1, ...
    int window_top = layers - 1;
    const auto gather = [&](TokenPtr token) {
        window.push_back(std::move(token->own));
        const int layer = token->slice_index + down;
        if (layer >= layers || layer < 0) return token;
        token->layer = layer;
        while (window_top > layer + up) window.pop_front(), --window_top;
        bool complete = layer + up < layers && layer - down >= 0;  // missing layers count as empty
        for (int j = layer + up; complete && j >= layer - down; --j)
            token->eroded.push_back(window[static_cast<std::size_t>(window_top - j)].region);
        Eroded& own = window[static_cast<std::size_t>(window_top - layer)];
        token->material = {layer, own.slice, nullptr, nullptr, nullptr, std::move(own.closings), nullptr};
        return token;
    };
    const auto hollow = [&](TokenPtr token) {
        if (token->layer < 0) return token;
        cavities.measure([&] {
            Region region;
            if (!token->eroded.empty() && settings.inside()) {
                region = *token->eroded.front();
                for (std::size_t k = 1; k < token->eroded.size(); ++k) region = intersect(region, *token->eroded[k]);
            }
            token->material.cavity = std::make_shared<const Cavity>(make_cavity(token->layer, std::move(region), settings));
            if (settings.outside()) token->material.outside = std::make_shared<const Cavity>(make_outside(*token->material.slice, frame, settings));
        });
        return token;
    };
    LayerMaterial above;
    const auto pair = [&](TokenPtr token) {
        if (token->layer < 0) return token;
        token->above = above;
        above = token->material;
        above.closings.clear();
        return token;
    };
    const auto hang = [&](TokenPtr token) {
        if (token->layer < 0) return token;
        planning.measure([&] {
            token->material.shell = std::make_shared<LayerPlan>();
            token->material.shell->layer = token->layer;
            append_shell_paths(*token->material.slice, token->material.cavity->region, settings, track_settings, *token->material.shell);
        });
        if (token->above.slice)
            overhangs.measure([&] {
                token->overhang = overhang_over_cavity(*token->material.cavity, *token->above.slice,
                                                       *token->above.cavity, settings);
                if (settings.outside())
                    token->overhang_outside = overhang_outside(*token->material.outside, *token->above.outside, *token->above.cavity, settings);
            });
        return token;
    };
    std::shared_ptr<SweptLayer> previous;
    const auto sweep = [&](TokenPtr token) {
        sweeping.measure([&] {
            if (token->layer >= 0) {
                SupportForest none;
                SupportForest& forest = previous ? previous->forest : none;
                LayerSupports supports = next_layer(forest, *token->material.cavity, token->overhang, settings);
                if (settings.outside()) add_outside(supports, forest, *token->material.outside, token->overhang_outside, settings);
                token->material.tracks = tracks_of(supports.forest);
                token->swept = std::move(previous);
                token->below_swept = std::make_shared<const LayerMaterial>(token->material);
                previous = std::make_shared<SweptLayer>(SweptLayer{
                    std::move(token->material), std::move(supports.forest), std::move(supports.unsupported), supports.blocked, {}, nullptr});
            } else if (token->slice_index == last && previous) {
                for (auto [e, end] = edges(previous->forest); e != end; ++e) previous->forest[*e].first_layer = true;
                token->swept = std::move(previous);
            }
        });
        return token;
    };
    std::shared_ptr<const PrintedLayer> printed_above;
    const auto hold = [&](TokenPtr token) {
        if (!token->swept) return token;
        holding.measure([&] {
            const LayerMaterial& material = token->swept->material;
            append_wide_walls(token->swept->forest, material.cavity->region, settings, *material.shell);
            token->swept->held = hold_print(std::move(*material.shell), token->swept->forest, printed_above.get(), settings, material.outside.get());
            token->swept->printed_above = std::move(printed_above);
            printed_above = token->swept->held.printed;
        });
        return token;
    };
    const auto complete = [&](TokenPtr token) {
        if (token->swept) finishing.measure([&] { token->finished = finish(*token->swept, token->below_swept.get()); });
        return token;
    };
    const auto deliver = [&](TokenPtr token) {
        if (token->swept) collect(*token->swept, std::move(token->finished));
        tokens.remove_first();
    };

    const std::size_t window_size = 4 * limit + static_cast<std::size_t>(up + down);
    tbb::parallel_pipeline(
        window_size, tbb::make_filter<void, TokenPtr>(filter_mode::serial_in_order, produce) &
                    tbb::make_filter<TokenPtr, TokenPtr>(filter_mode::parallel, slice) &
                    tbb::make_filter<TokenPtr, TokenPtr>(filter_mode::serial_in_order, gather) &
                    tbb::make_filter<TokenPtr, TokenPtr>(filter_mode::parallel, hollow) &
                    tbb::make_filter<TokenPtr, TokenPtr>(filter_mode::serial_in_order, pair) &
                    tbb::make_filter<TokenPtr, TokenPtr>(filter_mode::parallel, hang) &
                    tbb::make_filter<TokenPtr, TokenPtr>(filter_mode::serial_in_order, sweep) &
                    tbb::make_filter<TokenPtr, TokenPtr>(filter_mode::serial_in_order, hold) &
                    tbb::make_filter<TokenPtr, TokenPtr>(filter_mode::parallel, complete) &
                    tbb::make_filter<TokenPtr, void>(filter_mode::serial_in_order, deliver));
    if (stop()) throw Error(ErrorKind::interrupted, "interrupted; nothing was written");
    return {{"slice", slicing.seconds()},    {"erode", eroding.seconds()},  {"cavity", cavities.seconds()},
            {"overhang", overhangs.seconds()}, {"sweep", sweeping.seconds()}, {"shell", planning.seconds()}, {"hold", holding.seconds()}, {"finish", finishing.seconds()}};
}

}  // namespace ribvault
