#include "ribvault/print/hold_print.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <tuple>

#include "ribvault/exact/nearest_segment.hpp"
#include "ribvault/exact/point_location.hpp"
#include "ribvault/print/drop_tiny_steps.hpp"
#include "ribvault/print/gap_patches.hpp"
#include "ribvault/print/gap_strips.hpp"
#include "ribvault/print/lay_patches.hpp"
#include "ribvault/print/place_dot.hpp"
#include "ribvault/print/printed_tracks.hpp"
#include "ribvault/print/support_paths.hpp"
#include "ribvault/verify/outside_outline.hpp"

namespace ribvault {
namespace {

constexpr int rounds = 6;  ///< of mending, each of which is followed by another look

Lane lane_of(const PrintedTrack& track) {
    return {place_of(track, {0, 0, HUGE_VAL}), round_to_lattice(track.width.get_d() * units_per_mm)};
}

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
        // What stands on nothing but supports is printed as it is proved.
        for (auto [e, end] = edges(forest_); e != end; ++e)
            if (settings.gaps == Gaps::none || (settings.bed_only && forest_[source(*e, forest_)].outside))
                forest_[*e].to_junction = true;
    }

    HeldLayer run() {
        if (above_ && !shell_.spare.empty()) print_strips_under(seem_to_hang(), settings_.nozzle, shell_);
        reach_over_strips(shell_, settings_.nozzle, forest_);
        lay_supports();
        if (!above_) return std::move(held_);
        judge();
        std::vector<Hanging> hanging = open();
        if (print_strips(hanging)) {
            lay_supports();
            look_again();
            hanging = open();
        }
        for (int round = 0; settings_.gaps != Gaps::paper && !hanging.empty() && round < rounds; ++round) {
            if (!tracks_ && close_gaps(hanging) > 0)
                lay_supports();
            else
                patch(hanging, round);
            look_again();
            hanging = open();
        }
        if (settings_.outside() && settings_.support_gap_layers > 0 && settings_.gaps != Gaps::paper)
            patch_object_under_overhangs();
        for (const Patch& patch : patches_) held_.patch_tracks.push_back(patch.segment);
        return std::move(held_);
    }

private:
    struct Hanging {
        const PrintedTrack* track;
        OpenStretch stretch;
        bool over_gap, inside;
        Segment place() const { return place_of(*track, stretch); }
        HangingStretch hanging() const {
            return {lane_of(*track), stretch.from_mm * units_per_mm, stretch.to_mm * units_per_mm};
        }
    };

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
                false);
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
    void add_part(std::vector<PrintedTrack> tracks, PrintJudgement::Holding holding, bool over_gap) {
        auto layer = std::make_shared<PrintedLayer>();
        layer->tracks = std::move(tracks);
        PrintJudgement judgement(*layer, *held_.printed, settings_, std::move(holding));
        held_.parts.push_back({std::move(layer), std::move(judgement), over_gap});
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
    bool print_strips(const std::vector<Hanging>& open) {
        std::vector<StripReach> places;
        for (const Hanging& hanging : open)
            places.push_back({hanging.place(), reach_under(hanging)});
        return print_strips_under(places, settings_.nozzle, shell_);
    }
    /// How far from the stretch there can be something that holds up what hangs there.
    double reach_under(const Hanging& hanging) const {
        return hanging.track->width.get_d() / 2 * units_per_mm + static_cast<double>(settings_.support_radius + 4);
    }

    /// What of the layer above inside the outline is not held up.
    std::vector<Hanging> open() const {
        std::vector<Hanging> all;
        for (const PrintPart& part : held_.parts) append_open(part.judgement, part.over_gap, part.inside, all);
        return all;
    }
    static void append_open(const PrintJudgement& judgement, bool over_gap, bool inside, std::vector<Hanging>& all) {
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
        for (const OpenStretch& stretch : stretches) all.push_back({&tracks[stretch.track], stretch, over_gap, inside});
    }

    /// Branches whose gap may be what lets something hang reach their junction from now on. How many walls are new.
    int close_gaps(const std::vector<Hanging>& open) {
        // What hangs lies within half a width of its stretch. Walls whose centre line is farther than ρ from that could
        // hold its rim only; closing their gaps too costs more than the patches that it saves.
        struct Place {
            Segment segment;
            double reach;
        };
        std::vector<Place> places;
        for (const Hanging& hanging : open) {
            places.push_back({hanging.place(), reach_under(hanging)});
        }
        int closed = 0;
        for (auto [e, end] = edges(forest_); e != end; ++e) {
            if (forest_[*e].to_junction) continue;
            for (const auto& [from, to] : {std::pair(source(*e, forest_), target(*e, forest_)),
                                           std::pair(target(*e, forest_), source(*e, forest_))}) {
                if (out_degree(from, forest_) < 2 && !forest_[from].root) continue;
                // A gap takes the first width of the wall at most.
                const Point a = forest_[from].at, b = forest_[to].at;
                const double l = length(b - a), width = static_cast<double>(settings_.nozzle);
                const Segment gap{a, part_way(a, b, l > width ? width / l : 1)};
                if (!std::any_of(places.begin(), places.end(), [&](const Place& p) {
                        return near(gap, p.segment, p.reach) && distance(gap, p.segment) <= p.reach;
                    }))
                    continue;
                forest_[*e].to_junction = true;
                ++closed;
                break;
            }
        }
        held_.closed_gaps += closed;
        return closed;
    }
    static bool near(const Segment& s, const Segment& t, double reach) {
        const auto apart = [reach](Unit a, Unit b, Unit c, Unit d) {
            return static_cast<double>(std::min(c, d) - std::max(a, b)) > reach ||
                   static_cast<double>(std::min(a, b) - std::max(c, d)) > reach;
        };
        return !apart(s.a.x, s.b.x, t.a.x, t.b.x) && !apart(s.a.y, s.b.y, t.a.y, t.b.y);
    }

    /// Puts patches under what hangs and lays them with the tracks that are there. From now on those stay as they are.
    void patch(const std::vector<Hanging>& open, int round) {
        begin_patches();
        add_patches(open, round);
        lay_all_patches();
    }
    void begin_patches() {
        if (tracks_) return;
        without_patches_ = std::move(held_.plan);
        tracks_.emplace(without_patches_);
        if (beside_ && beside_->walls)
            gap_patches_.emplace(*beside_, walls_below_gap_, without_patches_, *tracks_, patches_, settings_);
    }
    void lay_all_patches() {
        held_.plan = without_patches_;
        held_.patches = static_cast<int>(patches_.size());
        held_.patch_length = lay_patches(patches_, *tracks_, held_.plan, settings_.nozzle,
                                         [&](const Segment& way) { return may_stand_outside(way); });
        held_.printed = std::make_shared<const PrintedLayer>(printed_layer(held_.plan));
    }

    /// The point of the tracks and of the patches so far that is nearest to p; p itself where there are none.
    Point nearest_material(Point p, std::size_t patches) const {
        Point nearest = p;
        double least = HUGE_VAL;
        if (const NearestSegment& tracks = tracks_->segments(); !tracks.empty()) {
            const NearestSegment::Hit hit = tracks.nearest(p);
            nearest = nearest_point(p, tracks.segments()[hit.index]), least = hit.distance.value();
        }
        for (std::size_t k = 0; k < patches; ++k)
            if (const double d = squared_distance(p, patches_[k].segment).value(); d < least)
                nearest = nearest_point(p, patches_[k].segment), least = d;
        return nearest;
    }

    /// The tracks and patches that come near a stretch; the object's are `wider` by what it holds up farther than ρ.
    std::vector<Lane> material_near(const Segment& stretch, Unit wider = 0) const {
        const Unit reach = 2 * settings_.nozzle + 2 * settings_.support_radius + wider;
        std::vector<Lane> lanes;
        const auto add = [&](const Segment& centre, Unit width, TrackKind kind) {
            lanes.push_back({centre, kind == TrackKind::external_support ? width : width + wider});
        };
        tracks_->segments().visit(bounding_box(stretch, reach), [&](std::uint32_t k) {
            const PlanTracks::Place place = tracks_->place(k);
            const ToolPath& path = without_patches_.tracks[place.track].paths[place.path];
            add(tracks_->segments().segments()[k], path.width, path.kind);
        });
        for (const Patch& patch : patches_)
            if (near(stretch, patch.segment, static_cast<double>(reach)))
                add(patch.segment, settings_.nozzle, patch.kind);
        return lanes;
    }

    /// The dot under a stretch that is nearest to what is there, where that may be asked for: with a removal gap inside
    /// the outline only.
    std::optional<PlacedDot> place(const Hanging& hanging) const {
        if (gap_patches_ && !hanging.inside) return std::nullopt;
        return place_dot(hanging.hanging(), material_near(hanging.place()), settings_.nozzle, settings_.support_radius);
    }

    bool patch_at_gap(const Hanging& hanging, bool again) {
        const bool added = gap_patches_->add(hanging.place(), again);
        if (added && !again) return true;
        std::vector<Lane> material =
            material_near(hanging.place(), 2 * (settings_.reach_of_object() - settings_.support_radius));
        if (hanging.over_gap)
            for (const PrintedTrack& track : over_gap_->object) material.push_back(lane_of(track));
        return gap_patches_->add_under_rim(hanging.hanging(), material) || added;
    }

    /// Of the patches from `before` on, those that were there already. Each would be a track of its own, to be held up
    /// farther down.
    void drop_repeated(std::size_t before) {
        const auto there = [&](const Patch& p) { return !laid_.insert({p.kind, p.segment.a, p.segment.b}).second; };
        patches_.erase(std::remove_if(patches_.begin() + static_cast<std::ptrdiff_t>(before), patches_.end(), there),
                       patches_.end());
    }

    void add_patches(const std::vector<Hanging>& open, int round) {
        const std::size_t before = patches_.size();
        std::vector<Segment> loops;
        for (const PlannedTrack& track : shell_.tracks)
            for (const ToolPath& path : track.paths)
                if (path.closed && path.kind == TrackKind::outer_perimeter) append_segments(path, loops);
        const PointLocation outline(loops, units_per_mm / 2);
        for (const Hanging& hanging : open) {
            const std::optional<Segment> place = place_under(hanging, round, before);
            if (!place) continue;
            const bool outside = outline.locate(place->a) == Side::outside || outline.locate(place->b) == Side::outside;
            if (hanging.inside && !outside) {
                patches_.push_back({*place, TrackKind::support});
            } else if (outside && may_stand_outside(*place)) {
                patches_.push_back({*place, TrackKind::external_support});
            } else if (gap_patches_ && patch_at_gap(hanging, round >= rounds / 2)) {
                continue;
            } else if (!outside) {
                patches_.push_back({*place, TrackKind::support});
            } else {
                const Segment s = hanging.place();
                for (const Point p : {s.a, s.b, Point{(s.a.x + s.b.x) / 2, (s.a.y + s.b.y) / 2}}) {
                    if (outline.locate(p) == Side::outside) continue;
                    patches_.push_back({{p, p}, TrackKind::support});
                    break;
                }
            }
        }
        drop_repeated(before);
    }

    /// Where a patch would hold up what hangs: in the first half of the rounds a dot as near to the tracks as can be;
    /// what that does not reach, and what sampling missed, in another way. Nothing where what is there, or a patch of
    /// this round, may hold it up.
    std::optional<Segment> place_under(const Hanging& hanging, int round, std::size_t before) {
        const Segment s = hanging.place();
        const std::optional<PlacedDot> dot = round < rounds / 2 ? place(hanging) : std::nullopt;
        if (dot ? !dot->needed : held_since(before, s)) return std::nullopt;
        // Tried before without success: now just below it.
        const bool again = std::find(tried_.begin(), tried_.end(), s.a) != tried_.end();
        tried_.push_back(s.a);
        if (dot) return Segment{dot->at, dot->at};
        return again ? s : lowered(s, before);
    }

    bool held_since(std::size_t before, const Segment& s) const {
        return std::any_of(patches_.begin() + static_cast<std::ptrdiff_t>(before), patches_.end(),
                           [&](const Patch& patch) {
                               return compare_distance(s.a, patch.segment, step()) <= 0 &&
                                      compare_distance(s.b, patch.segment, step()) <= 0;
                           });
    }

    /// What hangs, one layer lower: its ends moved by up to ρ towards material; where it is short, a dot that both its
    /// ends can reach.
    Segment lowered(const Segment& s, std::size_t before) const {
        const auto moved = [&](Point p, double most) {
            const Point near = nearest_material(p, before);
            const double d = length(near - p);
            return part_way(p, near, d > most ? most / d : 1);
        };
        const Unit half = round_to_lattice(length(s) / 2) + 2;
        if (half > step()) return {moved(s.a, static_cast<double>(step())), moved(s.b, static_cast<double>(step()))};
        const Point dot = moved({(s.a.x + s.b.x) / 2, (s.a.y + s.b.y) / 2}, static_cast<double>(step() - half));
        return {dot, dot};
    }
    Unit step() const { return settings_.support_radius - 2; }

    /// With a removal gap only where walls may, and off the object's patches.
    bool may_stand_outside(const Segment& s) const {
        return gap_patches_ ? gap_patches_->may_stand(s) : beside_ != nullptr;
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
        std::vector<Hanging> hanging;
        append_open(judgement, false, false, hanging);
        if (hanging.empty()) return;
        begin_patches();
        const std::size_t before = patches_.size();
        for (const Hanging& stretch : hanging) gap_patches_->add_to_object(stretch.place());
        drop_repeated(before);
        if (patches_.size() == before) {
            held_.plan = without_patches_;
            if (!patches_.empty()) lay_all_patches();
            return;
        }
        lay_all_patches();
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
    LayerPlan without_patches_;         ///< once there are patches
    std::optional<PlanTracks> tracks_;  ///< of it
    std::vector<Patch> patches_;
    std::set<std::tuple<TrackKind, Point, Point>> laid_;  ///< the same
    std::optional<GapPatches> gap_patches_;  ///< with a removal gap, once there are patches
    std::vector<Point> tried_;
};

}  // namespace

HeldLayer hold_print(LayerPlan shell, const SupportForest& forest, const PrintedLayer* above, const Settings& settings,
                     const Cavity* outside, const PrintOverGap* over_gap, const Region* walls_below_gap) {
    return Holder(std::move(shell), forest, above, outside, over_gap, walls_below_gap, settings).run();
}

}  // namespace ribvault
