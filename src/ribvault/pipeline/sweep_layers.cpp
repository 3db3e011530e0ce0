#include "ribvault/pipeline/sweep_layers.hpp"

#include "ribvault/error.hpp"
#include "ribvault/pipeline/layer_front.hpp"
#include "ribvault/pipeline/thread_limit.hpp"
#include "ribvault/print/wide_walls.hpp"
#include "ribvault/vault/length_bound.hpp"

namespace ribvault {

StageTimes sweep_layers(const Slicer& slicer, const Settings& settings, const TrackSettings& track_settings, int threads,
                        const std::function<std::shared_ptr<void>(const SweptLayer&, const LayerMaterial* below)>& finish,
                        const std::function<void(const SweptLayer&, std::shared_ptr<void>)>& collect,
                        const std::function<bool()>& stop, const Box& frame) {
    namespace tbb = oneapi::tbb;
    using tbb::filter_mode;
    const std::size_t limit = thread_limit(threads);
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, limit);

    Clock sweeping, holding, finishing;
    LayerFront front(slicer, settings, &track_settings, stop, frame);
    std::shared_ptr<SweptLayer> previous;
    LengthBound length_bound;
    const auto sweep = [&](TokenPtr token) {
        sweeping.measure([&] {
            if (token->layer >= 0) {
                SupportForest none;
                SupportForest& forest = previous ? previous->forest : none;
                LayerSupports supports = next_supports(forest, *token, settings);
                double bound = 0;
                if (settings.length_bound) bound = length_bound.next(*token->material.cavity, token->overhang, token->above.cavity.get(), settings);
                token->material.tracks = tracks_of(supports.forest);
                token->swept = std::move(previous);
                token->below_swept = std::make_shared<const LayerMaterial>(token->material);
                previous = std::make_shared<SweptLayer>(SweptLayer{
                    std::move(token->material), std::move(supports.forest), std::move(supports.unsupported), bound, supports.blocked, {}, nullptr});
            } else if (front.is_last(token) && previous) {
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
        front.remove(token);
    };

    tbb::parallel_pipeline(front.window(limit), front.filter() & tbb::make_filter<TokenPtr, TokenPtr>(filter_mode::serial_in_order, sweep) &
                                                    tbb::make_filter<TokenPtr, TokenPtr>(filter_mode::serial_in_order, hold) &
                                                    tbb::make_filter<TokenPtr, TokenPtr>(filter_mode::parallel, complete) &
                                                    tbb::make_filter<TokenPtr, void>(filter_mode::serial_in_order, deliver));
    if (stop()) throw Error(ErrorKind::interrupted, "interrupted; nothing was written");
    StageTimes times = front.seconds();
    times["sweep"] = sweeping.seconds(), times["hold"] = holding.seconds(), times["finish"] = finishing.seconds();
    return times;
}

}  // namespace ribvault
