#include "ribvault/print/hold_print.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "ribvault/exact/nearest_segment.hpp"
#include "ribvault/exact/point_location.hpp"
#include "ribvault/print/drop_tiny_steps.hpp"
#include "ribvault/print/printed_tracks.hpp"
#include "ribvault/print/support_paths.hpp"
#include "ribvault/verify/outside_outline.hpp"
#include "ribvault/verify/verify_printed.hpp"

namespace ribvault {
namespace {

constexpr int rounds = 6;  ///< of mending, each of which is followed by another look

Point lattice(const PrintedPoint& p) {
    return {round_to_lattice(p[0].get_d() * units_per_mm), round_to_lattice(p[1].get_d() * units_per_mm)};
}

std::vector<Segment> segments_of(const LayerPlan& plan) {
    std::vector<Segment> segments;
    for (const PlannedTrack& track : plan.tracks)
        for (const ToolPath& path : track.paths) append_segments(path, segments);
    return segments;
}

/// The stretch of the track above as a segment of the lattice.
Segment place_of(const PrintedTrack& track, const OpenStretch& stretch) {
    const Segment whole{lattice(track.a), lattice(track.b)};
    const double l = length(whole);
    const auto at = [&](double mm) {
        const double t = l > 0 ? std::clamp(mm * units_per_mm / l, 0.0, 1.0) : 0;
        return Point{whole.a.x + round_to_lattice(t * static_cast<double>(whole.b.x - whole.a.x)),
                     whole.a.y + round_to_lattice(t * static_cast<double>(whole.b.y - whole.a.y))};
    };
    return {at(stretch.from_mm), at(stretch.to_mm)};
}

double distance(const Segment& s, const Segment& t) {
    if (segments_touch(s, t)) return 0;
    double least = HUGE_VAL;
    for (const Point p : {s.a, s.b}) least = std::min(least, squared_distance(p, t).value());
    for (const Point p : {t.a, t.b}) least = std::min(least, squared_distance(p, s).value());
    return std::sqrt(least);
}

/// With a removal gap the object's tracks hold up what is within it: they count as so much wider (Settings::reach_of_object).
PrintedLayer held_outside(PrintedLayer below, const Settings& settings) {
    const Rational wider = 2 * Rational(printed_length(settings.reach_of_object() - settings.support_radius));
    if (!settings.outside() || wider == 0) return below;
    for (PrintedTrack& t : below.tracks)
        if (t.feature != static_cast<int>(TrackKind::external_support)) t.width = Rational(Rational(t.width) + wider);
    return below;
}

class Holder {
public:
    Holder(LayerPlan shell, const SupportForest& forest, const PrintedLayer* above, const Cavity* beside, const Settings& settings)
        : shell_(std::move(shell)), forest_(forest), above_(above), settings_(settings), rho_(printed_length(settings.support_radius)), beside_(beside) {
        if (settings.gaps == Gaps::none)
            for (auto [e, end] = edges(forest_); e != end; ++e) forest_[*e].to_junction = true;
    }

    HeldLayer run() {
        lay_tracks();
        if (!above_) return std::move(held_);
        if (!settings_.outside()) outside_ = stretches_outside(*above_, *held_.printed);  // the outline stays the same
        std::vector<std::size_t> all(above_->tracks.size());
        std::iota(all.begin(), all.end(), std::size_t{0});
        std::vector<OpenStretch> open = look(all);
        bool close = true;
        for (int round = 0; settings_.gaps != Gaps::paper && !open.empty() && round < rounds; ++round) {
            close = close && close_gaps(open) > 0;
            if (!close) patch(open);
            held_.mended = true;
            const std::vector<Segment> before = segments_of(held_.plan);
            lay_tracks();
            open = look(affected(open, before));
        }
        for (const Patch& patch : patches_) held_.patch_tracks.push_back(patch.segment);
        return std::move(held_);
    }

private:
    void lay_tracks() {
        held_.plan = shell_;
        append_support_paths(forest_, settings_, held_.plan);
        for (const auto& [s, kind] : patches_) {
            ToolPath path{kind, settings_.nozzle, false, {s.a}};
            if (s.b != s.a) path.points.push_back(s.b);
            held_.plan.tracks.push_back({{std::move(path)}, Entry::either_end, no_stop});
        }
        drop_tiny_steps(held_.plan);
        held_.printed = std::make_shared<const PrintedLayer>(printed_layer(held_.plan));
    }

    /// What of these tracks above (indices, increasing) inside the outline is not held up.
    std::vector<OpenStretch> look(const std::vector<std::size_t>& which) {
        PrintedOptions options;
        options.regions = false, options.stretches = true;
        PrintedLayer upper, below = held_outside(*held_.printed, settings_);
        for (const std::size_t k : which) upper.tracks.push_back(above_->tracks[k]);
        below.tracks.insert(below.tracks.end(), outside_.begin(), outside_.end());
        PrintedVerdict inside = verify_printed(upper, below, rho_, options);
        // A track that is found wanting without a stretch that shows where is mended as a whole.
        std::vector<char> shown(which.size(), 0);
        for (const OpenStretch& stretch : inside.stretches) shown[stretch.track] = 1;
        for (std::size_t k = 0; k < which.size(); ++k) {
            if (inside.track_supported[k] || shown[k]) continue;
            const Segment whole{lattice(upper.tracks[k].a), lattice(upper.tracks[k].b)};
            inside.stretches.push_back({k, 0, to_mm(round_to_lattice(length(whole)))});
        }
        std::stable_sort(inside.stretches.begin(), inside.stretches.end(), [](const OpenStretch& a, const OpenStretch& b) { return a.track < b.track; });
        for (OpenStretch& stretch : inside.stretches) stretch.track = which[stretch.track];
        return std::move(inside.stretches);
    }

    /// The tracks above that must be looked at again: those that were open, and those near a track that is not there any more
    /// as it was. (A branch that reaches its junction takes the place of others there.)
    std::vector<std::size_t> affected(const std::vector<OpenStretch>& open, std::vector<Segment> before) const {
        const auto less = [](const Segment& s, const Segment& t) { return s.a != t.a ? s.a < t.a : s.b < t.b; };
        std::vector<Segment> now = segments_of(held_.plan), gone;
        std::sort(before.begin(), before.end(), less);
        std::sort(now.begin(), now.end(), less);
        std::set_difference(before.begin(), before.end(), now.begin(), now.end(), std::back_inserter(gone), less);
        std::vector<char> again(above_->tracks.size(), 0);
        for (const OpenStretch& stretch : open) again[stretch.track] = 1;
        if (!gone.empty()) {
            const NearestSegment near(std::move(gone));
            for (std::size_t k = 0; k < again.size(); ++k) {
                const PrintedTrack& track = above_->tracks[k];
                Box box;
                box.add(lattice(track.a)), box.add(lattice(track.b));
                // Widths of the layer below are at most 3/2 d (thin walls); one d covers r + ρ and the rounding.
                box.grow(round_to_lattice(track.width.get_d() / 2 * units_per_mm) + settings_.nozzle + settings_.support_radius);
                near.visit(box, [&](std::uint32_t) { again[k] = 1; });
            }
        }
        std::vector<std::size_t> which;
        for (std::size_t k = 0; k < again.size(); ++k)
            if (again[k]) which.push_back(k);
        return which;
    }
    /// Branches whose gap may be what lets something hang reach their junction from now on. How many walls are new.
    int close_gaps(const std::vector<OpenStretch>& open) {
        // What hangs lies within half a width of its stretch, and what would hold it within r + ρ of that.
        struct Place {
            Segment segment;
            double reach;
        };
        std::vector<Place> places;
        for (const OpenStretch& stretch : open) {
            const PrintedTrack& track = above_->tracks[stretch.track];
            places.push_back({place_of(track, stretch), track.width.get_d() / 2 * units_per_mm + static_cast<double>(settings_.nozzle / 2 + settings_.support_radius + 4)});
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

    void patch(const std::vector<OpenStretch>& open) {
        const NearestSegment material(segments_of(held_.plan));
        std::vector<Segment> loops;
        for (const PlannedTrack& track : shell_.tracks)
            for (const ToolPath& path : track.paths)
                if (path.closed && path.kind == TrackKind::outer_perimeter) append_segments(path, loops);
        const PointLocation outline(loops, units_per_mm / 2);
        const Unit step = settings_.support_radius - 2;
        const auto move = [&](Point p) {
            if (material.empty()) return p;
            const Point near = nearest_point(p, material.segments()[material.nearest(p).index]);
            const double d = length(near - p);
            if (d <= static_cast<double>(step)) return near;
            const double t = static_cast<double>(step) / d;
            return Point{p.x + round_to_lattice(t * static_cast<double>(near.x - p.x)), p.y + round_to_lattice(t * static_cast<double>(near.y - p.y))};
        };
        const std::size_t before = patches_.size();
        for (const OpenStretch& stretch : open) {
            const Segment hanging = place_of(above_->tracks[stretch.track], stretch);
            const bool held = std::any_of(patches_.begin() + static_cast<std::ptrdiff_t>(before), patches_.end(), [&](const Patch& patch) {
                const Segment& p = patch.segment;
                return compare_distance(hanging.a, p, step) <= 0 && compare_distance(hanging.b, p, step) <= 0;
            });
            if (held) continue;
            Segment s = place_of(above_->tracks[stretch.track], stretch);
            // Tried before without success: now just below it.
            const bool again = std::find(tried_.begin(), tried_.end(), s.a) != tried_.end();
            tried_.push_back(s.a);
            if (!again) {
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
                const Segment whole = place_of(above_->tracks[stretch.track], stretch);
                const Point middle{(whole.a.x + whole.b.x) / 2, (whole.a.y + whole.b.y) / 2};
                const Point inside = outline.locate(whole.a) != Side::outside ? whole.a : outline.locate(whole.b) != Side::outside ? whole.b : middle;
                if (outline.locate(inside) == Side::outside) continue;
                s = {inside, inside};
            }
            patches_.push_back({s, kind});
            ++held_.patches;
            held_.patch_length += round_to_lattice(length(s));
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
        for (std::size_t k = before; k < patches_.size(); ++k) held_.patch_length += round_to_lattice(length(patches_[k].segment));
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
    Rational rho_;
    HeldLayer held_;
    struct Patch {
        Segment segment;
        TrackKind kind;
    };
    const Cavity* beside_;
    std::optional<GapPlaces> gap_places_;
    std::vector<Patch> patches_;
    std::vector<Point> tried_;
    std::vector<PrintedTrack> outside_;
};

std::array<double, 2> sum(const PrintedVerdict& verdict) {
    std::array<double, 2> total{0, 0};
    for (const std::array<double, 2>& l : verdict.unsupported_length) total[0] += l[0], total[1] += l[1];
    return total;
}

}  // namespace

HeldLayer hold_print(LayerPlan shell, const SupportForest& forest, const PrintedLayer* above, const Settings& settings, const Cavity* outside) {
    return Holder(std::move(shell), forest, above, outside, settings).run();
}

PrintVerdict judge_print(const PrintedLayer& above, const PrintedLayer& below, const Settings& settings) {
    const Rational rho = printed_length(settings.support_radius);
    PrintedOptions options;
    options.regions = false, options.stretches = true;
    const std::vector<PrintedTrack> outside = settings.outside() ? std::vector<PrintedTrack>() : stretches_outside(above, below);
    PrintedLayer held = held_outside(below, settings);
    held.tracks.insert(held.tracks.end(), outside.begin(), outside.end());
    const PrintedVerdict inside = verify_printed(above, held, rho, options);
    PrintVerdict verdict;
    verdict.supported = inside.supported;
    verdict.unsupported_mm = sum(inside);
    verdict.stages = inside.stages;
    if (!inside.stretches.empty()) {
        const OpenStretch& first = inside.stretches.front();
        const Segment place = place_of(above.tracks[first.track], first);
        verdict.place = {to_mm((place.a.x + place.b.x) / 2), to_mm((place.a.y + place.b.y) / 2)};
    }
    if (settings.reach_of_object() > settings.support_radius) {
        options.areas = options.stretches = false;
        const PrintedVerdict strictly = verify_printed(above, below, rho, options);
        verdict.external_mm = sum(strictly);
        verdict.stages += strictly.stages;
    }
    if (outside.empty()) return verdict;
    PrintedLayer upper;
    upper.tracks = outside;
    options.areas = options.stretches = false;
    const PrintedVerdict hanging = verify_printed(upper, below, rho, options);
    verdict.external_mm = sum(hanging);
    verdict.stages += hanging.stages;
    return verdict;
}

}  // namespace ribvault
