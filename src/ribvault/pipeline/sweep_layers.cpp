#include "ribvault/pipeline/sweep_layers.hpp"

#include <algorithm>
#include <deque>
#include <iterator>
#include <optional>
#include <utility>

#include "ribvault/error.hpp"
#include "ribvault/pipeline/layer_front.hpp"
#include "ribvault/pipeline/thread_limit.hpp"
#include "ribvault/print/wide_walls.hpp"
#include "ribvault/vault/length_bound.hpp"
#include "ribvault/vault/wall_stability.hpp"
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

/// S_i under S_{i+1}, one layer after the other from the top: a layer is complete when the next one is known.
class Sweep {
public:
    Sweep(const Settings& settings, const std::function<LayerSupports(std::size_t)>& made)
        : settings_(settings), made_(made), overhung_(settings.support_gap_layers) {}

    void advance(Token& token) {
        if (token.layer < 0) {
            if (!previous_) return;
            for (auto [e, end] = edges(previous_->forest); e != end; ++e) previous_->forest[*e].first_layer = true;
            complete_previous(token);
            return;
        }
        SupportForest none;
        SupportForest& forest = previous_ ? previous_->forest : none;
        LayerSupports supports = made_ ? made_(depth_++) : next_supports(forest, token, settings_);
        double bound = 0;
        if (settings_.length_bound)
            bound = length_bound_.next(*token.material.cavity, token.overhang, token.above.cavity.get(), settings_);
        enter_tracks(supports.forest, token.material);
        complete_previous(token);
        token.below_swept = std::make_shared<const LayerMaterial>(token.material);
        previous_ = std::make_shared<SweptLayer>();
        previous_->material = std::move(token.material);
        previous_->forest = std::move(supports.forest), previous_->unsupported = std::move(supports.unsupported);
        previous_->length_bound = bound;
        previous_->blocked = supports.blocked, previous_->braces = supports.braces;
    }

private:
    void complete_previous(Token& token) {
        token.swept = std::move(previous_);
        if (token.swept) token.swept->over_gap = overhung_.over(token.swept->material);
    }

    const Settings& settings_;
    const std::function<LayerSupports(std::size_t)>& made_;
    std::size_t depth_ = 0;  ///< of the next layer, from the top
    std::shared_ptr<SweptLayer> previous_;
    LengthBound length_bound_;
    Overhung overhung_;
};

/// What is printed, held up, one layer after the other from the top. Layers wait until it is known where supports may
/// stand under the gap below them.
class Hold {
public:
    Hold(const Settings& settings, std::size_t delay) : settings_(settings), delay_(delay) {}

    /// Takes the layer that the token brings and sends on the one whose turn it is, if any.
    void advance(Token& token) {
        const std::shared_ptr<const LayerMaterial> newest = token.layer >= 0 ? token.below_swept : nullptr;
        if (token.swept) waiting_.push_back({std::move(token.swept), std::move(token.below_swept)});
        if (waiting_.empty() || (newest && waiting_.size() <= delay_)) return;
        token.swept = std::move(waiting_.front().layer), token.below_swept = std::move(waiting_.front().below);
        waiting_.pop_front();
        hold(*token.swept, newest.get());
    }

private:
    struct Waiting {
        std::shared_ptr<SweptLayer> layer;
        std::shared_ptr<const LayerMaterial> below;
    };

    void hold(SweptLayer& layer, const LayerMaterial* newest) {
        const LayerMaterial& material = layer.material;
        const bool over_gap = settings_.support_gap_layers > 0;
        const bool below_known = over_gap && newest && newest->outside->walls;
        const PrintOverGap* print_over_gap = over_gap ? find_print_over_gap(layer) : nullptr;
        std::optional<SupportForest> tapered;
        if (settings_.wall_lines > 1) {
            tapered = tapered_trees(layer.forest, settings_, wide_ends_above_);
            wide_ends_above_ = ends_of_wide_trees(*tapered);
        }
        const SupportForest& walls = tapered ? *tapered : layer.forest;
        append_wide_walls(walls, material.cavity->region, settings_, *material.shell);
        layer.held =
            hold_print(std::move(*material.shell), walls, printed_above_.get(), settings_, material.outside.get(),
                       print_over_gap, below_known ? &*newest->outside->walls : nullptr);
        layer.printed_above = std::exchange(printed_above_, layer.held.printed);
        const std::size_t kept = static_cast<std::size_t>(settings_.support_gap_layers) + 1;
        if (settings_.stands_off()) {
            patches_.push_front(
                std::make_shared<const NearestSegment>(segments_of(layer.held.plan, TrackKind::support)));
            if (patches_.size() > kept) patches_.pop_back();
            layer.patches.assign(patches_.begin(), patches_.end());
        }
        if (over_gap) {
            printed_.push_back(printed_above_);
            if (printed_.size() > kept) printed_.pop_front();
        }
    }

    /// Enters what is printed of the layers over the gap; the last of them, nullptr where there is none.
    const PrintOverGap* find_print_over_gap(SweptLayer& layer) const {
        const PrintOverGap* found = nullptr;
        const int top = layer.material.layer + static_cast<int>(printed_.size());
        const auto at = [&](int j) -> const PrintedLayer& { return *printed_[static_cast<std::size_t>(top - j)]; };
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
                const std::vector<PrintedTrack> tracks = counted_below(at(gap.layer).tracks, settings_);
                std::remove_copy_if(tracks.begin(), tracks.end(), std::back_inserter(over.print.object),
                                    is_external_support);
            }
            found = &over.print;
        }
        return found;
    }

    const Settings& settings_;
    const std::size_t delay_;
    std::deque<Waiting> waiting_;
    std::shared_ptr<const PrintedLayer> printed_above_;
    std::vector<Point> wide_ends_above_;                         ///< of wide trees, as they are printed
    std::deque<std::shared_ptr<const PrintedLayer>> printed_;    ///< of the layers over a gap, from the top
    std::deque<std::shared_ptr<const NearestSegment>> patches_;  ///< of this layer and of those a gap above it
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
    Sweep sweep(settings, made);
    Hold hold(settings, front.delay());
    const auto swept = [&](TokenPtr token) {
        sweeping.measure([&] { sweep.advance(*token); });
        return token;
    };
    const auto held = [&](TokenPtr token) {
        holding.measure([&] { hold.advance(*token); });
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
                           front.filter() & tbb::make_filter<TokenPtr, TokenPtr>(filter_mode::serial_in_order, swept) &
                               tbb::make_filter<TokenPtr, TokenPtr>(filter_mode::serial_in_order, held) &
                               tbb::make_filter<TokenPtr, TokenPtr>(filter_mode::parallel, complete) &
                               tbb::make_filter<TokenPtr, void>(filter_mode::serial_in_order, deliver));
    end_if(stop);
    StageTimes times = front.seconds();
    times["sweep"] = sweeping.seconds(), times["hold"] = holding.seconds(), times["finish"] = finishing.seconds();
    return times;
}

}  // namespace ribvault
