#include "ribvault/print/hold_print.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "ribvault/exact/nearest_segment.hpp"
#include "ribvault/exact/point_location.hpp"
#include "ribvault/print/drop_tiny_steps.hpp"
#include "ribvault/print/lay_patches.hpp"
#include "ribvault/print/place_dot.hpp"
#include "ribvault/print/printed_tracks.hpp"
#include "ribvault/print/support_paths.hpp"

namespace ribvault {
namespace {

constexpr int rounds = 6;  ///< of mending, each of which is followed by another look

double distance(const Segment& s, const Segment& t) {
    if (segments_touch(s, t)) return 0;
    double least = HUGE_VAL;
    for (const Point p : {s.a, s.b}) least = std::min(least, squared_distance(p, t).value());
    for (const Point p : {t.a, t.b}) least = std::min(least, squared_distance(p, s).value());
    return std::sqrt(least);
}

/// Without its isolated roots, which hold up the last stub of a wall above: they are printed where something hangs without them, as patches.
SupportForest without_dots(const SupportForest& forest) {
    SupportForest walls;
    std::vector<std::size_t> index(num_vertices(forest));
    for (auto [v, end] = vertices(forest); v != end; ++v)
        if (out_degree(*v, forest) > 0 || forest[*v].free) index[*v] = add_vertex(forest[*v], walls);
    for (auto [e, end] = edges(forest); e != end; ++e) add_edge(index[source(*e, forest)], index[target(*e, forest)], forest[*e], walls);
    return walls;
}

class Holder {
public:
    Holder(LayerPlan shell, const SupportForest& forest, const PrintedLayer* above, const Cavity* beside, const Settings& settings)
        : shell_(std::move(shell)), forest_(settings.gaps == Gaps::proved ? without_dots(forest) : forest), above_(above), settings_(settings), beside_(beside) {
        if (settings.gaps == Gaps::none)
            for (auto [e, end] = edges(forest_); e != end; ++e) forest_[*e].to_junction = true;
    }

    HeldLayer run() {
        lay_supports();
        if (!above_) return std::move(held_);
        held_.judgement.emplace(*above_, *held_.printed, settings_);
        std::vector<OpenStretch> hanging = open();
        for (int round = 0; settings_.gaps != Gaps::paper && !hanging.empty() && round < rounds; ++round) {
            if (!tracks_ && close_gaps(hanging) > 0)
                lay_supports();
            else
                patch(hanging, round);
            held_.mended = true;
            held_.judgement->change_below(*held_.printed);
            hanging = open();
        }
        for (const Patch& patch : patches_) held_.patch_tracks.push_back(patch.segment);
        return std::move(held_);
    }

private:
    void lay_supports() {
        held_.plan = shell_;
        append_support_paths(forest_, settings_, held_.plan);
        drop_tiny_steps(held_.plan);
        held_.printed = std::make_shared<const PrintedLayer>(printed_layer(held_.plan));
    }

    /// What of the layer above inside the outline is not held up.
    std::vector<OpenStretch> open() const {
        const PrintJudgement& judgement = *held_.judgement;
        std::vector<OpenStretch> stretches = judgement.open();
        // A track that is found wanting without a stretch that shows where is mended as a whole.
        std::vector<char> shown(above_->tracks.size(), 0);
        for (const OpenStretch& stretch : stretches) shown[stretch.track] = 1;
        for (std::size_t k = 0; k < shown.size(); ++k) {
            if (judgement.supported(k) || shown[k]) continue;
            const PrintedTrack& track = above_->tracks[k];
            stretches.push_back({k, 0, std::hypot(track.b[0].get_d() - track.a[0].get_d(), track.b[1].get_d() - track.a[1].get_d())});
        }
        std::stable_sort(stretches.begin(), stretches.end(), [](const OpenStretch& a, const OpenStretch& b) { return a.track < b.track; });
        return stretches;
    }

    /// Branches whose gap may be what lets something hang reach their junction from now on. How many walls are new.
    int close_gaps(const std::vector<OpenStretch>& open) {
        // What hangs lies within half a width of its stretch. Walls whose centre line is farther than ρ from that could hold its rim only;
        // closing their gaps too costs more than the patches that it saves.
        struct Place {
            Segment segment;
            double reach;
        };
        std::vector<Place> places;
        for (const OpenStretch& stretch : open) {
            const PrintedTrack& track = above_->tracks[stretch.track];
            places.push_back({place_of(track, stretch), track.width.get_d() / 2 * units_per_mm + static_cast<double>(settings_.support_radius + 4)});
        }
        int closed = 0;
        for (auto [e, end] = edges(forest_); e != end; ++e) {
            if (forest_[*e].to_junction) continue;
            for (const auto& [from, to] : {std::pair(source(*e, forest_), target(*e, forest_)), std::pair(target(*e, forest_), source(*e, forest_))}) {
                if (out_degree(from, forest_) < 2 && !forest_[from].root) continue;
                // A gap takes the first width of the wall at most.
                const Point a = forest_[from].at, d = forest_[to].at - a;
                const double l = length(d), share = l > static_cast<double>(settings_.nozzle) ? static_cast<double>(settings_.nozzle) / l : 1;
                const Segment gap{a, {a.x + round_to_lattice(share * static_cast<double>(d.x)), a.y + round_to_lattice(share * static_cast<double>(d.y))}};
                if (!std::any_of(places.begin(), places.end(), [&](const Place& p) { return near(gap, p.segment, p.reach) && distance(gap, p.segment) <= p.reach; }))
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
            return static_cast<double>(std::min(c, d) - std::max(a, b)) > reach || static_cast<double>(std::min(a, b) - std::max(c, d)) > reach;
        };
        return !apart(s.a.x, s.b.x, t.a.x, t.b.x) && !apart(s.a.y, s.b.y, t.a.y, t.b.y);
    }

    /// Puts patches under what hangs and lays them with the tracks that are there. From now on those stay as they are.
    void patch(const std::vector<OpenStretch>& open, int round) {
        if (!tracks_) {
            without_patches_ = std::move(held_.plan);
            tracks_.emplace(without_patches_);
        }
        add_patches(open, round);
        held_.plan = without_patches_;
        held_.patch_length = lay_patches(patches_, *tracks_, held_.plan, settings_.nozzle);
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

    /// The tracks and patches that come near a stretch.
    std::vector<Lane> material_near(const Segment& stretch) const {
        const Unit reach = 2 * settings_.nozzle + 2 * settings_.support_radius;
        Box box;
        for (const Point p : {stretch.a, stretch.b}) box.add({p.x - reach, p.y - reach}), box.add({p.x + reach, p.y + reach});
        std::vector<Lane> lanes;
        tracks_->segments().visit(box, [&](std::uint32_t k) {
            const PlanTracks::Place place = tracks_->place(k);
            lanes.push_back({tracks_->segments().segments()[k], without_patches_.tracks[place.track].paths[place.path].width});
        });
        for (const Patch& patch : patches_)
            if (near(stretch, patch.segment, static_cast<double>(reach))) lanes.push_back({patch.segment, settings_.nozzle});
        return lanes;
    }

    /// The dot under a stretch that is nearest to what is there, where that may be asked for: not with a removal gap.
    std::optional<PlacedDot> place(const OpenStretch& stretch) const {
        if (beside_ && beside_->walls) return std::nullopt;
        const PrintedTrack& track = above_->tracks[stretch.track];
        const Lane whole{place_of(track, {0, 0, HUGE_VAL}), round_to_lattice(track.width.get_d() * units_per_mm)};
        return place_dot({whole, stretch.from_mm * units_per_mm, stretch.to_mm * units_per_mm}, material_near(place_of(track, stretch)), settings_.nozzle,
                         settings_.support_radius);
    }

    /// In the first half of the rounds dots as near to the tracks as can be; what these do not reach, and what sampling missed, in another way.
    void add_patches(const std::vector<OpenStretch>& open, int round) {
        const std::size_t before = patches_.size();
        std::vector<Segment> loops;
        for (const PlannedTrack& track : shell_.tracks)
            for (const ToolPath& path : track.paths)
                if (path.closed && path.kind == TrackKind::outer_perimeter) append_segments(path, loops);
        const PointLocation outline(loops, units_per_mm / 2);
        const Unit step = settings_.support_radius - 2;
        const auto move = [&](Point p) {
            const Point near = nearest_material(p, before);
            const double d = length(near - p);
            if (d <= static_cast<double>(step)) return near;
            const double t = static_cast<double>(step) / d;
            return Point{p.x + round_to_lattice(t * static_cast<double>(near.x - p.x)), p.y + round_to_lattice(t * static_cast<double>(near.y - p.y))};
        };
        for (const OpenStretch& stretch : open) {
            const Segment hanging = place_of(above_->tracks[stretch.track], stretch);
            const std::optional<PlacedDot> placed = round < rounds / 2 ? place(stretch) : std::nullopt;
            if (placed && !placed->needed) continue;
            const bool held = !placed && std::any_of(patches_.begin() + static_cast<std::ptrdiff_t>(before), patches_.end(), [&](const Patch& patch) {
                const Segment& p = patch.segment;
                return compare_distance(hanging.a, p, step) <= 0 && compare_distance(hanging.b, p, step) <= 0;
            });
            if (held) continue;
            Segment s = hanging;
            // Tried before without success: now just below it.
            const bool again = std::find(tried_.begin(), tried_.end(), s.a) != tried_.end();
            tried_.push_back(s.a);
            if (placed) {
                s = {placed->at, placed->at};
            } else if (!again) {
                const Point middle{(s.a.x + s.b.x) / 2, (s.a.y + s.b.y) / 2};
                const Unit half = round_to_lattice(length(s) / 2) + 2;
                if (half <= step) {
                    // Short: a dot that both its ends can reach.
                    const Point near = move(middle);
                    const double way = length(near - middle), free = static_cast<double>(step) - static_cast<double>(half);
                    const double t = way > free ? free / way : 1;
                    const Point dot{middle.x + round_to_lattice(t * static_cast<double>(near.x - middle.x)), middle.y + round_to_lattice(t * static_cast<double>(near.y - middle.y))};
                    s = {dot, dot};
                } else {
                    s = {move(s.a), move(s.b)};
                }
            }
            TrackKind kind = TrackKind::support;
            if ((outline.locate(s.a) == Side::outside || outline.locate(s.b) == Side::outside) && may_stand_outside(s)) {
                kind = TrackKind::external_support;
            } else if (beside_ && patch_object(hanging)) {
                continue;
            } else if (outline.locate(s.a) == Side::outside || outline.locate(s.b) == Side::outside) {
                const Point middle{(hanging.a.x + hanging.b.x) / 2, (hanging.a.y + hanging.b.y) / 2};
                const Point inside = outline.locate(hanging.a) != Side::outside ? hanging.a : outline.locate(hanging.b) != Side::outside ? hanging.b : middle;
                if (outline.locate(inside) == Side::outside) continue;
                s = {inside, inside};
            }
            patches_.push_back({s, kind});
            ++held_.patches;
        }
    }

    /// With a removal gap only where walls may.
    bool may_stand_outside(const Segment& s) {
        if (!beside_ || !beside_->walls) return beside_ != nullptr;
        const Place& walls = gap_places().walls;
        Box box;
        box.add(s.a), box.add(s.b);
        bool crosses = false;
        walls.edges.visit(box, [&](std::uint32_t k) { crosses = crosses || segments_touch(walls.edges.segments()[k], s); });
        return !crosses && walls.location.locate(s.a) == Side::inside;
    }

    /// Within a removal gap patches are the object's: where its slice is too thin to be printed, they are printed, in pieces short
    /// enough to follow its outline. Says no when the stretch is not over such a place.
    bool patch_object(const Segment& hanging) {
        if (!beside_->walls) return false;
        const NearestSegment& near = gap_places().air.edges;
        const PointLocation& air = gap_places().air.location;
        const auto pieces = static_cast<std::size_t>(length(hanging) / static_cast<double>(settings_.nozzle)) + 1;
        const std::size_t before = patches_.size();
        std::vector<Point> at;
        for (std::size_t k = 0; k <= pieces; ++k) {
            const double t = static_cast<double>(k) / static_cast<double>(pieces);
            const Point d = hanging.b - hanging.a, p = hanging.a + Point{round_to_lattice(t * static_cast<double>(d.x)), round_to_lattice(t * static_cast<double>(d.y))};
            at.push_back(air.locate(p) == Side::inside ? nearest_point(p, near.segments()[near.nearest(p).index]) : p);
            if (length(at.back() - p) > static_cast<double>(settings_.reach_of_object())) return patches_.resize(before), false;
            if (k > 0) patches_.push_back({{at[k - 1], at[k]}, TrackKind::support});
        }
        held_.patches += static_cast<int>(pieces);
        return true;
    }

    /// A region with what it takes to look things up in it.
    struct Place {
        explicit Place(const Region& region) : edges(edges_of(region)), location(edges_of(region), units_per_mm) {}
        NearestSegment edges;
        PointLocation location;
    };
    /// With a removal gap: where walls may stand, and what lies outside the slice. Made when first asked for.
    struct GapPlaces {
        Place walls, air;
    };
    const GapPlaces& gap_places() {
        if (!gap_places_) gap_places_.emplace(GapPlaces{Place(*beside_->walls), Place(beside_->region)});
        return *gap_places_;
    }

    LayerPlan shell_;
    SupportForest forest_;
    const PrintedLayer* above_;
    const Settings& settings_;
    HeldLayer held_;
    const Cavity* beside_;
    std::optional<GapPlaces> gap_places_;
    LayerPlan without_patches_;         ///< once there are patches
    std::optional<PlanTracks> tracks_;  ///< of it
    std::vector<Patch> patches_;
    std::vector<Point> tried_;
};

}  // namespace

HeldLayer hold_print(LayerPlan shell, const SupportForest& forest, const PrintedLayer* above, const Settings& settings, const Cavity* outside) {
    return Holder(std::move(shell), forest, above, outside, settings).run();
}

}  // namespace ribvault
