#include "ribvault/pipeline/sweep_layers.hpp"

#include <algorithm>
#include <deque>
#include <iterator>

#include "ribvault/error.hpp"
#include "ribvault/pipeline/layer_front.hpp"
#include "ribvault/pipeline/thread_limit.hpp"
#include "ribvault/print/wide_walls.hpp"
#include "ribvault/vault/length_bound.hpp"
#include "ribvault/verify/outside_outline.hpp"

namespace ribvault {
namespace {

/// Remembers the layers over a gap. Used from the top layer down.
class Overhung {
public:
    explicit Overhung(int gap) : gap_(static_cast<std::size_t>(gap)) {}

    /// What the external supports of this layer hold up: layer + gap + 1. With layer 0 come all that hang over the bed.
    std::vector<OverGap> over(const LayerMaterial& layer) {
        std::vector<OverGap> result;
        if (gap_ == 0) return result;
        for (std::size_t k = 0; k < above_.size(); ++k)
            if (above_[k].layer - layer.layer == static_cast<int>(gap_) + 1 || layer.layer == 0)
                result.push_back({above_[k],
                                  above_[k].layer <= static_cast<int>(gap_),
                                  {above_.begin() + static_cast<std::ptrdiff_t>(k) + 1, above_.end()},
                                  nullptr,
                                  {}});
        above_.push_back(layer);
        if (above_.size() > gap_ + 1) above_.pop_front();
        return result;
    }

private:
    std::size_t gap_;
    std::deque<LayerMaterial> above_;  ///< the last layers, at most gap + 1
};

}  // namespace

StageTimes sweep_layers(
    const Slicer& slicer, const Settings& settings, const TrackSettings& track_settings, int threads,
    const std::function<std::shared_ptr<void>(const SweptLayer&, const LayerMaterial* below)>& finish,
    const std::function<void(const SweptLayer&, std::shared_ptr<void>)>& collect, const std::function<bool()>& stop,
    const OutsideRoom* room, const std::function<LayerSupports(std::size_t)>& made) {
    namespace tbb = oneapi::tbb;
    using tbb::filter_mode;
    const std::size_t limit = thread_limit(threads);
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, limit);

    Clock sweeping, holding, finishing;
    LayerFront front(slicer, settings, &track_settings, stop, room, !made || settings.length_bound);
    std::size_t depth = 0;
    std::shared_ptr<SweptLayer> previous;
    LengthBound length_bound;
    Overhung overhung(settings.support_gap_layers);
    const auto sweep = [&](TokenPtr token) {
        sweeping.measure([&] {
            if (token->layer >= 0) {
                SupportForest none;
                SupportForest& forest = previous ? previous->forest : none;
                LayerSupports supports = made ? made(depth++) : next_supports(forest, *token, settings);
                double bound = 0;
                if (settings.length_bound)
                    bound = length_bound.next(*token->material.cavity, token->overhang, token->above.cavity.get(),
                                              settings);
                enter_tracks(supports.forest, token->material);
                token->swept = std::move(previous);
                if (token->swept) token->swept->over_gap = overhung.over(token->swept->material);
                token->below_swept = std::make_shared<const LayerMaterial>(token->material);
                previous = std::make_shared<SweptLayer>(SweptLayer{std::move(token->material),
                                                                   std::move(supports.forest),
                                                                   std::move(supports.unsupported),
                                                                   bound,
                                                                   supports.blocked,
                                                                   supports.braces,
                                                                   {},
                                                                   nullptr,
                                                                   {},
                                                                   {}});
            } else if (previous) {
                for (auto [e, end] = edges(previous->forest); e != end; ++e) previous->forest[*e].first_layer = true;
                token->swept = std::move(previous);
                token->swept->over_gap = overhung.over(token->swept->material);
            }
        });
        return token;
    };
    std::shared_ptr<const PrintedLayer> printed_above;
    std::deque<std::shared_ptr<const PrintedLayer>> printed;  // of the layers over a gap, from the top
    std::deque<std::shared_ptr<const NearestSegment>> patches;  // of this layer and of those a gap above it
    const auto find_print_over_gap = [&](SweptLayer& layer) -> const PrintOverGap* {
        const PrintOverGap* found = nullptr;
        const int top = layer.material.layer + static_cast<int>(printed.size());
        const auto at = [&](int j) -> const PrintedLayer& { return *printed[static_cast<std::size_t>(top - j)]; };
        for (OverGap& over : layer.over_gap) {
            if (over.over_bed) continue;
            PrintedLayer object;
            const PrintedLayer& upper = at(over.upper.layer);
            std::remove_copy_if(upper.tracks.begin(), upper.tracks.end(), std::back_inserter(object.tracks),
                                is_external_support);
            auto hanging = std::make_shared<PrintedLayer>();
            hanging->tracks = extruded_outside(object, at(over.upper.layer - 1));
            over.print.hanging = std::move(hanging);
            for (const LayerMaterial& gap : over.gap) {
                const std::vector<PrintedTrack> tracks = counted_below(at(gap.layer).tracks, settings);
                std::remove_copy_if(tracks.begin(), tracks.end(), std::back_inserter(over.print.object),
                                    is_external_support);
            }
            found = &over.print;
        }
        return found;
    };
    // A layer is printed once it is known where supports may stand under the gap below it.
    struct Waiting {
        std::shared_ptr<SweptLayer> layer;
        std::shared_ptr<const LayerMaterial> below;
    };
    std::deque<Waiting> waiting;
    const auto hold = [&](TokenPtr token) {
        const std::shared_ptr<const LayerMaterial> newest = token->layer >= 0 ? token->below_swept : nullptr;
        if (token->swept) waiting.push_back({std::move(token->swept), std::move(token->below_swept)});
        if (waiting.empty() || (newest && waiting.size() <= front.delay())) return token;
        token->swept = std::move(waiting.front().layer), token->below_swept = std::move(waiting.front().below);
        waiting.pop_front();
        holding.measure([&] {
            const LayerMaterial& material = token->swept->material;
            const bool below_known = settings.support_gap_layers > 0 && newest && newest->outside->walls;
            const PrintOverGap* over_gap =
                settings.support_gap_layers > 0 ? find_print_over_gap(*token->swept) : nullptr;
            append_wide_walls(token->swept->forest, material.cavity->region, settings, *material.shell);
            token->swept->held =
                hold_print(std::move(*material.shell), token->swept->forest, printed_above.get(), settings,
                           material.outside.get(), over_gap, below_known ? &*newest->outside->walls : nullptr);
            token->swept->printed_above = std::move(printed_above);
            printed_above = token->swept->held.printed;
            if (settings.stands_off()) {
                patches.push_front(
                    std::make_shared<const NearestSegment>(segments_of(token->swept->held.plan, TrackKind::support)));
                if (patches.size() > static_cast<std::size_t>(settings.support_gap_layers) + 1) patches.pop_back();
                token->swept->patches.assign(patches.begin(), patches.end());
            }
            if (settings.support_gap_layers > 0) {
                printed.push_back(printed_above);
                if (printed.size() > static_cast<std::size_t>(settings.support_gap_layers) + 1) printed.pop_front();
            }
        });
        return token;
    };
    const auto complete = [&](TokenPtr token) {
        if (token->swept) finishing.measure([&] { token->finished = finish(*token->swept, token->below_swept.get()); });
        return token;
    };
    const auto deliver = [&](TokenPtr token) {
        if (token->swept) collect(*token->swept, std::move(token->finished));
        front.remove(token);
    };

    tbb::parallel_pipeline(front.window(limit),
                           front.filter() & tbb::make_filter<TokenPtr, TokenPtr>(filter_mode::serial_in_order, sweep) &
                               tbb::make_filter<TokenPtr, TokenPtr>(filter_mode::serial_in_order, hold) &
                               tbb::make_filter<TokenPtr, TokenPtr>(filter_mode::parallel, complete) &
                               tbb::make_filter<TokenPtr, void>(filter_mode::serial_in_order, deliver));
    end_if(stop);
    StageTimes times = front.seconds();
    times["sweep"] = sweeping.seconds(), times["hold"] = holding.seconds(), times["finish"] = finishing.seconds();
    return times;
}

}  // namespace ribvault
