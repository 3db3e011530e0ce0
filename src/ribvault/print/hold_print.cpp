#include "ribvault/print/hold_print.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "ribvault/exact/nearest_segment.hpp"
#include "ribvault/print/drop_tiny_steps.hpp"
#include "ribvault/print/gap_strips.hpp"
#include "ribvault/print/print_patches.hpp"
#include "ribvault/print/printed_tracks.hpp"
#include "ribvault/print/support_paths.hpp"
#include "ribvault/verify/outside_outline.hpp"

namespace ribvault {
namespace {

constexpr int rounds = 6;  ///< of laying supports otherwise, and of patches; another look follows each

/// Without its isolated roots, which hold up the last stub of a wall above: they are printed where something hangs
/// without them, as patches.
SupportForest without_dots(const SupportForest& forest) {
    SupportForest walls;
    std::vector<std::size_t> index(num_vertices(forest));
    for (auto [v, end] = vertices(forest); v != end; ++v)
        if (out_degree(*v, forest) > 0 || forest[*v].free) index[*v] = add_vertex(forest[*v], walls);
    for (auto [e, end] = edges(forest); e != end; ++e)
        add_edge(index[source(*e, forest)], index[target(*e, forest)], forest[*e], walls);
    return walls;
}

class Holder {
public:
    Holder(LayerPlan shell, const SupportForest& forest, const PrintedLayer* above, const Cavity* beside,
           const PrintOverGap* over_gap, const Region* walls_below_gap, const Settings& settings)
        : shell_(std::move(shell)),
          forest_(settings.gaps == Gaps::proved ? without_dots(forest) : forest),
          above_(above),
          over_gap_(over_gap),
          settings_(settings),
          beside_(beside),
          walls_below_gap_(walls_below_gap) {
        if (settings.gaps != Gaps::none) return;
        for (auto [e, end] = edges(forest_); e != end; ++e) forest_[*e].to_junction = true;
    }

    HeldLayer run() {
        if (above_ && !shell_.spare.empty()) print_strips_under(seem_to_hang(), settings_.nozzle, shell_);
        reach_over_strips(shell_, settings_.nozzle, forest_);
        lay_supports();
        if (!above_) return std::move(held_);
        judge();
        std::vector<HangingTrack> hanging = open();
        if (print_strips(hanging)) {
            lay_supports();
            look_again();
            hanging = open();
        }
        for (int laid = 1; settings_.gaps == Gaps::proved && !hanging.empty() && laid < rounds; ++laid) {
            if (!close_gaps(NearHanging(*this, hanging))) break;
            lay_supports();
            look_again();
            hanging = open();
        }
        for (int round = 0; settings_.gaps != Gaps::paper && !hanging.empty() && round < rounds; ++round) {
            patch(hanging, round);
            look_again();
            hanging = open();
        }
        if (settings_.outside() && settings_.support_gap_layers > 0 && settings_.gaps != Gaps::paper)
            patch_object_under_overhangs();
        if (patches_)
            for (const Patch& patch : patches_->patches()) held_.patch_tracks.push_back(patch.segment);
        return std::move(held_);
    }

private:
    void judge() {
        const bool through_gap = settings_.outside() && settings_.support_gap_layers > 0;
        std::vector<PrintedTrack> supports;
        if (through_gap || settings_.bed_only)
            std::copy_if(above_->tracks.begin(), above_->tracks.end(), std::back_inserter(supports),
                         is_external_support);
        held_.parts.push_back({nullptr, PrintJudgement(*above_, *held_.printed, settings_)});
        held_.parts.back().inside = settings_.outside_apart();
        const auto widened = [&settings = settings_](const PrintedLayer& below) {
            return counted_below(below.tracks, settings);
        };
        if (settings_.outside_apart() && !through_gap)
            if (std::vector<PrintedTrack> outside = extruded_outside(*above_, *held_.printed); !outside.empty())
                add_part(std::move(outside), widened, false);
        if (!supports.empty() && !settings_.bed_only) add_part(std::move(supports), widened, false);
        if (!supports.empty() && settings_.bed_only)
            add_part(
                std::move(supports),
                [](const PrintedLayer& below) {
                    std::vector<PrintedTrack> holding;
                    std::copy_if(below.tracks.begin(), below.tracks.end(), std::back_inserter(holding),
                                 is_external_support);
                    return holding;
                },
                false, true);
        if (over_gap_ && !over_gap_->hanging->tracks.empty())
            add_part(
                over_gap_->hanging->tracks,
                [&settings = settings_, object = over_gap_->object](const PrintedLayer& below) {
                    std::vector<PrintedTrack> holding = counted_below(below.tracks, settings);
                    holding.insert(holding.end(), object.begin(), object.end());
                    return holding;
                },
                true);
    }
    void add_part(std::vector<PrintedTrack> tracks, PrintJudgement::Holding holding, bool over_gap,
                  bool on_supports = false) {
        auto layer = std::make_shared<PrintedLayer>();
        layer->tracks = std::move(tracks);
        PrintJudgement judgement(*layer, *held_.printed, settings_, std::move(holding));
        held_.parts.push_back({std::move(layer), std::move(judgement), over_gap, false, on_supports});
    }

    void lay_supports() {
        held_.plan = shell_;
        append_support_paths(forest_, settings_, held_.plan);
        drop_tiny_steps(held_.plan);
        held_.printed = std::make_shared<const PrintedLayer>(printed_layer(held_.plan));
    }

    void look_again() {
        for (PrintPart& part : held_.parts) part.judgement.change_below(*held_.printed);
    }

    std::vector<StripReach> seem_to_hang() const {
        std::vector<Segment> walls;
        for (auto [e, end] = edges(forest_); e != end; ++e)
            walls.push_back({forest_[source(*e, forest_)].at, forest_[target(*e, forest_)].at});
        std::vector<Lane> above;
        for (const PrintedTrack& track : above_->tracks) above.push_back(lane_of(track));
        return ribvault::seem_to_hang(above, walls, shell_, settings_);
    }

    /// Prints spare strips of the shell where they may be what something needs.
    bool print_strips(const std::vector<HangingTrack>& open) {
        std::vector<StripReach> places;
        for (const HangingTrack& hanging : open) places.push_back({hanging.place(), reach_under(hanging)});
        return print_strips_under(places, settings_.nozzle, shell_);
    }
    /// How far from the stretch there can be something that holds up what hangs there.
    double reach_under(const HangingTrack& hanging) const {
        return hanging.track->width.get_d() / 2 * units_per_mm + static_cast<double>(settings_.support_radius + 4);
    }

    /// What of the layer above inside the outline is not held up.
    std::vector<HangingTrack> open() const {
        std::vector<HangingTrack> all;
        for (const PrintPart& part : held_.parts)
            append_open(part.judgement, {nullptr, {}, part.over_gap, part.inside, part.on_supports}, all);
        // Supports that must not stand on the object are mended where nothing but supports counts.
        if (settings_.bed_only)
            std::erase_if(all, [](const HangingTrack& h) { return !h.on_supports && is_external_support(*h.track); });
        return all;
    }
    static void append_open(const PrintJudgement& judgement, const HangingTrack& like, std::vector<HangingTrack>& all) {
        const std::vector<PrintedTrack>& tracks = judgement.above().tracks;
        std::vector<OpenStretch> stretches = judgement.open();
        // A track that is found wanting without a stretch that shows where is mended as a whole.
        std::vector<char> shown(tracks.size(), 0);
        for (const OpenStretch& stretch : stretches) shown[stretch.track] = 1;
        for (std::size_t k = 0; k < shown.size(); ++k) {
            if (judgement.supported(k) || shown[k]) continue;
            const PrintedTrack& track = tracks[k];
            stretches.push_back(
                {k, 0, std::hypot(track.b[0].get_d() - track.a[0].get_d(), track.b[1].get_d() - track.a[1].get_d())});
        }
        std::stable_sort(stretches.begin(), stretches.end(),
                         [](const OpenStretch& a, const OpenStretch& b) { return a.track < b.track; });
        for (const OpenStretch& stretch : stretches)
            all.push_back({&tracks[stretch.track], stretch, like.over_gap, like.inside, like.on_supports});
    }

    /// What hangs lies within half a width of a stretch. Walls whose centre line is farther than ρ from that could hold
    /// its rim only; changing them too costs more than the patches that it saves.
    class NearHanging {
    public:
        NearHanging(const Holder& holder, const std::vector<HangingTrack>& open) {
            std::vector<Segment> stretches;
            for (const HangingTrack& hanging : open)
                stretches.push_back(hanging.place()), reach_.push_back(holder.reach_under(hanging));
            farthest_ = static_cast<Unit>(std::ceil(*std::max_element(reach_.begin(), reach_.end())));
            places_ = NearestSegment(std::move(stretches));
        }
        bool has(const Segment& s) const {
            bool near = false;
            places_.visit(bounding_box(s, farthest_),
                          [&](std::uint32_t k) { near = near || distance(s, places_.segments()[k]) <= reach_[k]; });
            return near;
        }

    private:
        NearestSegment places_;
        std::vector<double> reach_;
        Unit farthest_ = 0;
    };

    /// Branches whose gap may be what lets something hang reach their junction from now on. Are there new ones?
    bool close_gaps(const NearHanging& hanging) {
        const int before = held_.closed_gaps;
        for (auto [e, end] = edges(forest_); e != end; ++e) {
            if (forest_[*e].to_junction) continue;
            for (const auto& [from, to] : {std::pair(source(*e, forest_), target(*e, forest_)),
                                           std::pair(target(*e, forest_), source(*e, forest_))}) {
                if (out_degree(from, forest_) < 2 && !forest_[from].root) continue;
                // A gap takes the first width of the wall at most.
                const Point a = forest_[from].at, b = forest_[to].at;
                const double l = length(b - a), width = static_cast<double>(settings_.support_width);
                if (!hanging.has({a, part_way(a, b, l > width ? width / l : 1)})) continue;
                forest_[*e].to_junction = true;
                ++held_.closed_gaps;
                break;
            }
        }
        return held_.closed_gaps > before;
    }
    /// Puts patches under what hangs and lays them with the tracks that are there. From now on those stay as they are.
    void patch(const std::vector<HangingTrack>& open, int round) {
        patches().add(open, round >= rounds / 2);
        lay_patches();
    }
    PrintPatches& patches() {
        if (!patches_)
            patches_.emplace(
                std::move(held_.plan), beside_, walls_below_gap_,
                over_gap_ ? std::span<const PrintedTrack>(over_gap_->object) : std::span<const PrintedTrack>(),
                settings_);
        return *patches_;
    }
    void lay_patches() {
        held_.plan = patches_->plan();
        held_.patches = static_cast<int>(patches_->patches().size());
        held_.patch_length = patches_->lay(held_.plan);
        held_.printed = std::make_shared<const PrintedLayer>(printed_layer(held_.plan));
    }

    /// With a gap of layers: what hangs outside the outline within reach of the object's slice is the slice's to hold
    /// up, all else is held up farther down.
    void patch_object_under_overhangs() {
        PrintedLayer object;
        std::remove_copy_if(above_->tracks.begin(), above_->tracks.end(), std::back_inserter(object.tracks),
                            is_external_support);
        const PrintJudgement judgement(object, *held_.printed, settings_, [&](const PrintedLayer& below) {
            return counted_below(below.tracks, settings_);
        });
        std::vector<HangingTrack> hanging;
        append_open(judgement, {}, hanging);
        if (hanging.empty()) return;
        patches().add_to_object(hanging);
        lay_patches();
        look_again();
    }

    LayerPlan shell_;
    SupportForest forest_;
    const PrintedLayer* above_;
    const PrintOverGap* over_gap_;
    const Settings& settings_;
    HeldLayer held_;
    const Cavity* beside_;
    const Region* walls_below_gap_;
    std::optional<PrintPatches> patches_;  ///< once something hangs that the tracks cannot be made to hold up
};

}  // namespace

HeldLayer hold_print(LayerPlan shell, const SupportForest& forest, const PrintedLayer* above, const Settings& settings,
                     const Cavity* outside, const PrintOverGap* over_gap, const Region* walls_below_gap) {
    return Holder(std::move(shell), forest, above, outside, over_gap, walls_below_gap, settings).run();
}

}  // namespace ribvault
