#include "ribvault/print/print_patches.hpp"

#include <algorithm>
#include <cmath>

#include "ribvault/print/printed_tracks.hpp"

namespace ribvault {
namespace {

std::vector<Segment> outline_of(const LayerPlan& plan) {
    std::vector<Segment> loops;
    for (const PlannedTrack& track : plan.tracks)
        for (const ToolPath& path : track.paths)
            if (path.closed && path.kind == TrackKind::outer_perimeter) append_segments(path, loops);
    return loops;
}

}  // namespace

Lane lane_of(const PrintedTrack& track) {
    return {place_of(track, {0, 0, HUGE_VAL}), round_to_lattice(track.width.get_d() * units_per_mm)};
}

HangingStretch HangingTrack::stretch_of_lane() const {
    return {lane_of(*track), stretch.from_mm * units_per_mm, stretch.to_mm * units_per_mm};
}

PrintPatches::PrintPatches(LayerPlan plan, const Cavity* beside, const Region* walls_below_gap,
                           std::span<const PrintedTrack> object_over_gap, const Settings& settings)
    : plan_(std::move(plan)),
      tracks_(plan_),
      outline_(outline_of(plan_), units_per_mm / 2),
      beside_(beside),
      object_over_gap_(object_over_gap),
      settings_(settings) {
    if (!beside || !beside->walls) return;
    gap_patches_.emplace(*beside, walls_below_gap, plan_, tracks_, patches_, settings);
    supports_ = NearestSegment(segments_of(plan_, TrackKind::external_support));
}

Unit PrintPatches::lay(LayerPlan& plan) const {
    return lay_patches(patches_, tracks_, plan, settings_.support_width, [&](TrackKind kind, const Segment& way) {
        if (kind == TrackKind::external_support) return may_stand_outside(way);
        return !gap_patches_ || gap_patches_->runs_in_object(way);
    });
}

void PrintPatches::add_to_object(const std::vector<HangingTrack>& open) {
    const std::size_t before = patches_.size();
    for (const HangingTrack& hanging : open) gap_patches_->add_to_object(hanging.place());
    drop_repeated(before);
}

// The point of the tracks and of the patches so far that is nearest to p; p itself where there are none.
Point PrintPatches::nearest_material(Point p, std::size_t patches) const {
    Point nearest = p;
    double least = HUGE_VAL;
    if (const NearestSegment& tracks = tracks_.segments(); !tracks.empty()) {
        const NearestSegment::Hit hit = tracks.nearest(p);
        nearest = nearest_point(p, tracks.segments()[hit.index]), least = hit.distance.value();
    }
    for (std::size_t k = 0; k < patches; ++k)
        if (const double d = squared_distance(p, patches_[k].segment).value(); d < least)
            nearest = nearest_point(p, patches_[k].segment), least = d;
    return nearest;
}

// The tracks and patches that come near a stretch; the object's are `wider` by what it holds up farther than ρ.
std::vector<Lane> PrintPatches::material_near(const Segment& stretch, Unit wider, bool of_supports) const {
    const Unit reach = 2 * settings_.nozzle + 2 * settings_.support_radius + wider;
    std::vector<Lane> lanes;
    const auto add = [&](const Segment& centre, Unit width, TrackKind kind) {
        if (of_supports && kind != TrackKind::external_support) return;
        lanes.push_back({centre, kind == TrackKind::external_support ? width : width + wider});
    };
    tracks_.segments().visit(bounding_box(stretch, reach), [&](std::uint32_t k) {
        const PlanTracks::Place place = tracks_.place(k);
        const ToolPath& path = plan_.tracks[place.track].paths[place.path];
        add(tracks_.segments().segments()[k], path.width, path.kind);
    });
    for (const Patch& patch : patches_)
        if (boxes_near(stretch, patch.segment, static_cast<double>(reach)))
            add(patch.segment, settings_.support_width, patch.kind);
    return lanes;
}

// Where the object holds up as much outside as inside, what hangs is judged as a whole (Holder::judge): inside is then
// what lies over the slice.
bool PrintPatches::hangs_inside(const HangingTrack& hanging) const {
    if (hanging.inside || settings_.outside_apart() || hanging.on_supports) return hanging.inside;
    const Segment s = hanging.place();
    return outline_.locate(s.a) != Side::outside && outline_.locate(s.b) != Side::outside;
}

// The dot under a stretch that is nearest to what is there, where that may be asked for: with a removal gap inside
// the outline only.
std::optional<PlacedDot> PrintPatches::place(const HangingTrack& hanging) const {
    if (gap_patches_ && !hangs_inside(hanging)) return std::nullopt;
    return place_dot(hanging.stretch_of_lane(), material_near(hanging.place()), settings_.support_width,
                     settings_.support_radius);
}

bool PrintPatches::patch_at_gap(const HangingTrack& hanging, bool again) {
    const bool added = gap_patches_->add(hanging.place(), again);
    if (added && !again) return true;
    return gap_patches_->add_under_rim(hanging.stretch_of_lane(), material_under(hanging)) || added;
}

// What is there and may hold up a stretch outside, with a removal gap.
std::vector<Lane> PrintPatches::material_under(const HangingTrack& hanging) const {
    if (hanging.on_supports) return material_near(hanging.place(), 0, true);
    std::vector<Lane> material =
        material_near(hanging.place(), 2 * (settings_.reach_of_object() - settings_.support_radius));
    if (hanging.over_gap)
        for (const PrintedTrack& track : object_over_gap_) material.push_back(lane_of(track));
    return material;
}

// With a removal gap, of an external support: beside the object nothing but supports reaches all of it.
bool PrintPatches::needs_support(const HangingTrack& hanging) const {
    return gap_patches_ && !hanging.inside && is_external_support(*hanging.track);
}

// From p, where a support's patch may stand above, to where one may on this layer, no farther than `by`, and towards
// the nearest support, if it can be reached before the bed. Otherwise dots would stand upon dots down to there.
Point PrintPatches::towards_support(Point p, Unit by) const {
    Point near = p;
    double least = static_cast<double>(plan_.layer) * static_cast<double>(by);
    const auto look = [&](const Segment& s) {
        const Point q = nearest_point(p, s);
        if (const double d = length(q - p); d < least) near = q, least = d;
    };
    if (!supports_.empty()) look(supports_.segments()[supports_.nearest(p).index]);
    for (const Patch& patch : patches_)
        if (patch.kind == TrackKind::external_support) look(patch.segment);
    const double share = near == p ? 0 : std::min(1.0, static_cast<double>(by) / least);
    for (const double part : {1.0, 0.75, 0.5, 0.25})
        if (const auto place = gap_patches_->place_for_wall(part_way(p, near, part * share), by);
            place && squared_length(*place - p) <= by * by)
            return *place;
    return gap_patches_->place_for_wall(p, by).value_or(p);
}

// Under an external support beside a removal gap: a dot as near to other supports as can be; else its ends, each moved
// towards these.
void PrintPatches::add_support(const HangingTrack& hanging, bool late) {
    const std::vector<Lane> material = material_under(hanging);
    if (!late) {
        const std::optional<PlacedDot> dot =
            place_dot(hanging.stretch_of_lane(), material, settings_.support_width, settings_.support_radius);
        if (dot && !dot->needed) return;
        if (const Segment s{dot ? dot->at : Point{}, dot ? dot->at : Point{}}; dot && may_stand_outside(s)) {
            patches_.push_back({s, TrackKind::external_support});
            return;
        }
    }
    const Segment s = hanging.place();
    const Unit half = round_to_lattice(length(s) / 2) + 2;
    Segment place{towards_support(s.a, step()), towards_support(s.b, step())};
    if (half < step()) {
        const Point middle = towards_support({(s.a.x + s.b.x) / 2, (s.a.y + s.b.y) / 2}, step() - half);
        place = {middle, middle};
    }
    const bool again = std::find(tried_.begin(), tried_.end(), s.a) != tried_.end();
    tried_.push_back(s.a);
    if (!again && may_stand_outside(place))
        patches_.push_back({place, TrackKind::external_support});
    else if (!gap_patches_->add_support(s) || again)
        gap_patches_->add_under_rim(hanging.stretch_of_lane(), material);
}

// Of the patches from `before` on, those that were there already. Each would be a track of its own, to be held up
// farther down.
void PrintPatches::drop_repeated(std::size_t before) {
    const auto there = [&](const Patch& p) { return !laid_.insert({p.kind, p.segment.a, p.segment.b}).second; };
    patches_.erase(std::remove_if(patches_.begin() + static_cast<std::ptrdiff_t>(before), patches_.end(), there),
                   patches_.end());
}

// The farthest from the tracks first: what holds that up often holds up what is nearer too. The other way round a spur
// of many steps above would get a dot for each of them, on every layer below.
std::vector<HangingTrack> PrintPatches::farthest_first(const std::vector<HangingTrack>& open) const {
    if (tracks_.segments().empty()) return open;
    std::vector<std::pair<double, std::size_t>> order;
    for (const HangingTrack& hanging : open) {
        const Segment s = hanging.place();
        const auto way = [&](Point p) { return tracks_.segments().nearest(p).distance.value(); };
        order.emplace_back(-std::max(way(s.a), way(s.b)), order.size());
    }
    std::sort(order.begin(), order.end());
    std::vector<HangingTrack> sorted;
    for (const auto& [way, k] : order) sorted.push_back(open[k]);
    return sorted;
}

void PrintPatches::add(const std::vector<HangingTrack>& open, bool late) {
    const std::size_t before = patches_.size();
    for (const HangingTrack& hanging : farthest_first(open)) {
        // Where the object may hold up supports, it is asked for when dots have been tried in vain.
        if (needs_support(hanging) && (hanging.on_supports || !late)) {
            add_support(hanging, late);
            continue;
        }
        const std::optional<Segment> place = place_under(hanging, late, before);
        if (!place) continue;
        const bool outside = outline_.locate(place->a) == Side::outside || outline_.locate(place->b) == Side::outside;
        if (hangs_inside(hanging) && !outside) {
            patches_.push_back({*place, TrackKind::support});
        } else if (outside && may_stand_outside(*place)) {
            patches_.push_back({*place, TrackKind::external_support});
        } else if (gap_patches_ && patch_at_gap(hanging, late)) {
            continue;
        } else if (!outside) {
            patches_.push_back({*place, TrackKind::support});
        } else {
            const Segment s = hanging.place();
            for (const Point p : {s.a, s.b, Point{(s.a.x + s.b.x) / 2, (s.a.y + s.b.y) / 2}}) {
                if (outline_.locate(p) == Side::outside) continue;
                patches_.push_back({{p, p}, TrackKind::support});
                break;
            }
        }
    }
    drop_repeated(before);
}

// Where a patch would hold up what hangs: at first a dot as near to the tracks as can be; what that does not reach, and
// what sampling missed, in another way. Nothing where what is there, or a patch of this round, may hold it up.
std::optional<Segment> PrintPatches::place_under(const HangingTrack& hanging, bool late, std::size_t before) {
    const Segment s = hanging.place();
    const std::optional<PlacedDot> dot = late ? std::nullopt : place(hanging);
    if (dot ? !dot->needed : held_since(before, s)) return std::nullopt;
    if (dot) return Segment{dot->at, dot->at};
    // Tried before without success: now just below it.
    const bool again = std::find(tried_.begin(), tried_.end(), s.a) != tried_.end();
    tried_.push_back(s.a);
    return again ? s : lowered(s, before);
}

bool PrintPatches::held_since(std::size_t before, const Segment& s) const {
    return std::any_of(patches_.begin() + static_cast<std::ptrdiff_t>(before), patches_.end(), [&](const Patch& patch) {
        return compare_distance(s.a, patch.segment, step()) <= 0 && compare_distance(s.b, patch.segment, step()) <= 0;
    });
}

// What hangs, one layer lower: its ends moved by up to ρ towards material; where it is short, a dot that both its
// ends can reach.
Segment PrintPatches::lowered(const Segment& s, std::size_t before) const {
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

// With a removal gap only where walls may, and off the object's patches.
bool PrintPatches::may_stand_outside(const Segment& s) const {
    return gap_patches_ ? gap_patches_->may_stand(s) : beside_ != nullptr;
}

}  // namespace ribvault
