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
#include "ribvault/vault/cavity_boundary.hpp"

namespace ribvault {
namespace {

constexpr int rounds = 6;  ///< of mending, each of which is followed by another look
constexpr Unit within_edge = 5;  ///< by so much more than needed for rounding a patch may stand out of the slice whose edge it follows

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
    Holder(LayerPlan shell, const SupportForest& forest, const PrintedLayer* above, const Cavity* beside, const PrintOverGap* over_gap, const Region* walls_below_gap,
           const Settings& settings)
        : shell_(std::move(shell)), forest_(settings.gaps == Gaps::proved ? without_dots(forest) : forest), above_(above), over_gap_(over_gap), settings_(settings), beside_(beside), walls_below_gap_(walls_below_gap) {
        // What stands on nothing but supports is printed as it is proved.
        for (auto [e, end] = edges(forest_); e != end; ++e)
            if (settings.gaps == Gaps::none || (settings.bed_only && forest_[source(*e, forest_)].outside)) forest_[*e].to_junction = true;
    }

    HeldLayer run() {
        lay_supports();
        if (!above_) return std::move(held_);
        judge();
        std::vector<Hanging> hanging = open();
        for (int round = 0; settings_.gaps != Gaps::paper && !hanging.empty() && round < rounds; ++round) {
            if (!tracks_ && close_gaps(hanging) > 0)
                lay_supports();
            else
                patch(hanging, round);
            held_.mended = true;
            for (PrintPart& part : held_.parts) part.judgement.change_below(*held_.printed);
            hanging = open();
        }
        if (settings_.outside() && settings_.support_gap_layers > 0 && settings_.gaps != Gaps::paper) patch_object_under_overhangs();
        for (const Patch& patch : patches_) held_.patch_tracks.push_back(patch.segment);
        return std::move(held_);
    }

private:
    struct Hanging {
        const PrintedTrack* track;
        OpenStretch stretch;
        Segment place() const { return place_of(*track, stretch); }
    };

    void judge() {
        const bool apart = settings_.outside() && settings_.support_gap_layers > 0;
        std::vector<PrintedTrack> supports, object;
        if (apart || settings_.bed_only)
            for (const PrintedTrack& track : above_->tracks) (is_external_support(track) ? supports : object).push_back(track);
        if (apart)
            add_part(std::move(object), {}, false);
        else
            held_.parts.push_back({nullptr, PrintJudgement(*above_, *held_.printed, settings_)});
        if (!supports.empty())
            add_part(std::move(supports), [&settings = settings_](const PrintedLayer& below) {
                if (!settings.bed_only) return counted_below(below.tracks, settings);
                std::vector<PrintedTrack> holding;
                std::copy_if(below.tracks.begin(), below.tracks.end(), std::back_inserter(holding), is_external_support);
                return holding;
            }, false);
        if (over_gap_ && !over_gap_->hanging->tracks.empty())
            add_part(over_gap_->hanging->tracks, [&settings = settings_, object = over_gap_->object](const PrintedLayer& below) {
                std::vector<PrintedTrack> holding = counted_below(below.tracks, settings);
                holding.insert(holding.end(), object.begin(), object.end());
                return holding;
            }, true);
    }
    void add_part(std::vector<PrintedTrack> tracks, PrintJudgement::Holding holding, bool over_gap) {
        auto layer = std::make_shared<PrintedLayer>();
        layer->tracks = std::move(tracks);
        PrintJudgement judgement = holding ? PrintJudgement(*layer, *held_.printed, settings_, std::move(holding)) : PrintJudgement(*layer, *held_.printed, settings_);
        held_.parts.push_back({std::move(layer), std::move(judgement), over_gap});
    }

    void lay_supports() {
        held_.plan = shell_;
        append_support_paths(forest_, settings_, held_.plan);
        drop_tiny_steps(held_.plan);
        held_.printed = std::make_shared<const PrintedLayer>(printed_layer(held_.plan));
    }

    /// What of the layer above inside the outline is not held up.
    std::vector<Hanging> open() const {
        std::vector<Hanging> all;
        for (const PrintPart& part : held_.parts) append_open(part.judgement, all);
        return all;
    }
    static void append_open(const PrintJudgement& judgement, std::vector<Hanging>& all) {
        const std::vector<PrintedTrack>& tracks = judgement.above().tracks;
        std::vector<OpenStretch> stretches = judgement.open();
        // A track that is found wanting without a stretch that shows where is mended as a whole.
        std::vector<char> shown(tracks.size(), 0);
        for (const OpenStretch& stretch : stretches) shown[stretch.track] = 1;
        for (std::size_t k = 0; k < shown.size(); ++k) {
            if (judgement.supported(k) || shown[k]) continue;
            const PrintedTrack& track = tracks[k];
            stretches.push_back({k, 0, std::hypot(track.b[0].get_d() - track.a[0].get_d(), track.b[1].get_d() - track.a[1].get_d())});
        }
        std::stable_sort(stretches.begin(), stretches.end(), [](const OpenStretch& a, const OpenStretch& b) { return a.track < b.track; });
        for (const OpenStretch& stretch : stretches) all.push_back({&tracks[stretch.track], stretch});
    }

    /// Branches whose gap may be what lets something hang reach their junction from now on. How many walls are new.
    int close_gaps(const std::vector<Hanging>& open) {
        // What hangs lies within half a width of its stretch. Walls whose centre line is farther than ρ from that could hold its rim only;
        // closing their gaps too costs more than the patches that it saves.
        struct Place {
            Segment segment;
            double reach;
        };
        std::vector<Place> places;
        for (const Hanging& hanging : open) {
            places.push_back({hanging.place(), hanging.track->width.get_d() / 2 * units_per_mm + static_cast<double>(settings_.support_radius + 4)});
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
    void patch(const std::vector<Hanging>& open, int round) {
        begin_patches();
        add_patches(open, round);
        lay_all_patches();
    }
    void begin_patches() {
        if (tracks_) return;
        without_patches_ = std::move(held_.plan);
        tracks_.emplace(without_patches_);
    }
    void lay_all_patches() {
        held_.plan = without_patches_;
        held_.patch_length = lay_patches(patches_, *tracks_, held_.plan, settings_.nozzle, [&](const Segment& way) { return may_stand_outside(way); });
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
    std::optional<PlacedDot> place(const Hanging& hanging) const {
        if (beside_ && beside_->walls) return std::nullopt;
        const PrintedTrack& track = *hanging.track;
        const OpenStretch& stretch = hanging.stretch;
        const Lane whole{place_of(track, {0, 0, HUGE_VAL}), round_to_lattice(track.width.get_d() * units_per_mm)};
        return place_dot({whole, stretch.from_mm * units_per_mm, stretch.to_mm * units_per_mm}, material_near(hanging.place()), settings_.nozzle,
                         settings_.support_radius);
    }

    /// In the first half of the rounds dots as near to the tracks as can be; what these do not reach, and what sampling missed, in another way.
    void add_patches(const std::vector<Hanging>& open, int round) {
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
        for (const Hanging& stretch : open) {
            const Segment hanging = stretch.place();
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
            } else if (beside_ && patch_at_gap(hanging, round >= rounds / 2)) {
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

    /// With a removal gap only where walls may, and off the object's patches.
    bool may_stand_outside(const Segment& s) {
        if (!beside_ || !beside_->walls) return beside_ != nullptr;
        if (std::any_of(patches_.begin(), patches_.end(), [&](const Patch& patch) { return patch.kind == TrackKind::support && distance(patch.segment, s) < static_cast<double>(apart()); }))
            return false;
        const Place& walls = gap_places().walls;
        Box box;
        box.add(s.a), box.add(s.b);
        bool crosses = false;
        walls.edges.visit(box, [&](std::uint32_t k) { crosses = crosses || segments_touch(walls.edges.segments()[k], s); });
        return !crosses && walls.location.locate(s.a) == Side::inside;
    }

    /// How far apart the centre lines of the object's tracks and of supports are to be.
    Unit apart() const { return settings_.support_gap + settings_.nozzle; }

    /// How far a patch of the object is from what is printed outside, as far as apart() and a hair.
    double room_around(const Segment& patch) const {
        Box box;
        box.add(patch.a), box.add(patch.b);
        box.grow(apart() + 1);
        double room = static_cast<double>(apart() + 1);
        tracks_->segments().visit(box, [&](std::uint32_t k) {
            const PlanTracks::Place place = tracks_->place(k);
            if (without_patches_.tracks[place.track].paths[place.path].kind == TrackKind::external_support)
                room = std::min(room, distance(tracks_->segments().segments()[k], patch));
        });
        for (const Patch& other : patches_)
            if (other.kind == TrackKind::external_support) room = std::min(room, distance(other.segment, patch));
        return room;
    }
    bool keeps_off_supports(const Segment& patch) const { return room_around(patch) >= static_cast<double>(apart()); }

    /// Where a track must run that keeps within the slice at its edge next to p, however far inside p is: `depth` from the edge.
    Point moved_inwards(Point p, Unit depth) {
        const Place& air = gap_places().air;
        const Segment& edge = air.edges.segments()[air.edges.nearest(p).index];
        const Point foot = nearest_point(p, edge);
        // From air to object: across the edge, whose left is air, or past a corner.
        Point way{edge.b.y - edge.a.y, edge.a.x - edge.b.x};
        if ((foot == edge.a || foot == edge.b) && length(p - foot) > 100) way = air.location.locate(p) == Side::inside ? foot - p : p - foot;
        const double l = length(way), t = l > 0 ? static_cast<double>(depth) / l : 0;
        return foot + Point{round_to_lattice(t * static_cast<double>(way.x)), round_to_lattice(t * static_cast<double>(way.y))};
    }
    bool is_within(Point p, Unit depth) {
        const Place& air = gap_places().air;
        return air.location.locate(p) != Side::inside && compare_distance(p, air.edges.segments()[air.edges.nearest(p).index], depth) >= 0;
    }

    /// The point of the slice that is nearest to p.
    Point nearest_of_slice(Point p) {
        const Place& air = gap_places().air;
        return air.location.locate(p) == Side::inside ? nearest_point(p, air.edges.segments()[air.edges.nearest(p).index]) : p;
    }

    /// The place for a patch of the object that holds up what is over p: as near to it as a track can be that does not stand out of the slice. Where the slice has no room for one,
    /// the point of the slice nearest to p, moved inwards as far as needed to keep off external supports; where they are too near on both sides, the place farthest from them.
    Point place_in_object(Point p) {
        const Unit flush = settings_.nozzle / 2 - within_edge;
        Point within = p;
        for (int step = 0; step < 4; ++step) {
            if (is_within(within, flush - within_edge)) return within;
            within = moved_inwards(within, flush);
        }
        const Point nearest = nearest_of_slice(p);
        Point best = nearest;
        double most = -1;
        for (const Point place : {nearest, moved_inwards(p, flush / 4), moved_inwards(p, flush / 2), moved_inwards(p, 3 * flush / 4), moved_inwards(p, flush)}) {
            const double room = room_around({place, place});
            if (room > most) best = place, most = room;
            if (room >= static_cast<double>(apart())) break;
        }
        return best;
    }

    /// Within a removal gap patches are the object's: where its slice is too thin to be printed, they are printed, in pieces short
    /// enough to follow its outline. Says no when the stretch is not over such a place.
    bool patch_object(const Segment& hanging, Unit reach, bool at_edge = false) {
        if (gap_places().air.edges.empty()) return false;
        const NearestSegment& near = gap_places().air.edges;
        const PointLocation& air = gap_places().air.location;
        const auto pieces = static_cast<std::size_t>(length(hanging) / static_cast<double>(settings_.nozzle)) + 1;
        const std::size_t before = patches_.size();
        std::vector<Point> at;
        for (std::size_t k = 0; k <= pieces; ++k) {
            const double t = static_cast<double>(k) / static_cast<double>(pieces);
            const Point d = hanging.b - hanging.a, p = hanging.a + Point{round_to_lattice(t * static_cast<double>(d.x)), round_to_lattice(t * static_cast<double>(d.y))};
            if (air.locate(p) == Side::inside && compare_distance(p, near.segments()[near.nearest(p).index], reach) > 0) return patches_.resize(before), false;
            at.push_back(at_edge ? nearest_of_slice(p) : place_in_object(p));
            if (k == 0) continue;
            // Feet on two sides of a notch: the way between them would lie in the air.
            const Point middle{(at[k - 1].x + at[k].x) / 2, (at[k - 1].y + at[k].y) / 2};
            const bool apart = air.locate(middle) == Side::inside &&
                               compare_distance(middle, near.segments()[near.nearest(middle).index], settings_.nozzle / 4) > 0;
            if (apart || !keeps_off_supports({at[k - 1], at[k]})) {
                patches_.push_back({{at[k - 1], at[k - 1]}, TrackKind::support});
                patches_.push_back({{at[k], at[k]}, TrackKind::support});
            } else {
                patches_.push_back({{at[k - 1], at[k]}, TrackKind::support});
            }
        }
        held_.patches += static_cast<int>(pieces);
        return true;
    }

    /// The object's edge, where it is not printed (but for its corners) and so fails to hold up what it should; else a support where one may stand. `again`: that has not
    /// helped, and the object is printed at its very edge, though that stands into the gap.
    bool patch_at_gap(const Segment& hanging, bool again) {
        if (!beside_->walls) return false;
        const bool object_first = again || !edge_is_printed(hanging.a, settings_.nozzle / 4) || !edge_is_printed(hanging.b, settings_.nozzle / 4);
        return (object_first && patch_object(hanging, settings_.reach_of_object(), again)) || patch_beside_gap(hanging) ||
               (!object_first && patch_object(hanging, settings_.reach_of_object()));
    }

    /// The allowed place nearest to p, if it can hold up all that a track there would: within ρ.
    std::optional<Point> place_for_wall(Point p) {
        const Place& walls = gap_places().walls;
        if (walls.edges.empty() || walls.location.locate(p) == Side::inside) return walls.edges.empty() ? std::nullopt : std::optional(p);
        const Point near = nearest_point(p, walls.edges.segments()[walls.edges.nearest(p).index]);
        for (Unit ring = 1; ring <= 3; ++ring)
            for (Unit dy = -ring; dy <= ring; ++dy)
                for (Unit dx = -ring; dx <= ring; ++dx)
                    if (const Point q{near.x + dx, near.y + dy}; walls.location.locate(q) == Side::inside)
                        return squared_length(q - p) <= settings_.support_radius * settings_.support_radius ? std::optional(q) : std::nullopt;
        return std::nullopt;
    }

    /// Where walls must keep off what is right under a stretch: patches at the nearest places where they need not, as far as these are near enough. Says no when none is.
    bool patch_beside_gap(const Segment& hanging) {
        const auto pieces = static_cast<std::size_t>(4 * length(hanging) / static_cast<double>(settings_.nozzle)) + 1;
        std::vector<Point> at;
        for (std::size_t k = 0; k <= pieces; ++k) {
            const double t = static_cast<double>(k) / static_cast<double>(pieces);
            const Point d = hanging.b - hanging.a;
            const std::optional<Point> place = place_for_wall(hanging.a + Point{round_to_lattice(t * static_cast<double>(d.x)), round_to_lattice(t * static_cast<double>(d.y))});
            if (!place) continue;
            if (at.empty() || at.back() != *place) at.push_back(*place);
        }
        if (at.empty()) return false;
        const std::size_t before = patches_.size();
        for (std::size_t k = 1; k < at.size(); ++k)
            if (may_stand_outside({at[k - 1], at[k]})) patches_.push_back({{at[k - 1], at[k]}, TrackKind::external_support});
        if (patches_.size() - before + 1 < at.size()) {  // some way between them is barred
            patches_.resize(before);
            for (const Point p : at) patches_.push_back({{p, p}, TrackKind::external_support});
        }
        if (patches_.size() == before) patches_.push_back({{at[0], at[0]}, TrackKind::external_support});
        held_.patches += static_cast<int>(patches_.size() - before);
        return true;
    }

    /// With a gap of layers: what hangs outside the outline within reach of the object's slice is the slice's to hold up, all else is held up farther down.
    void patch_object_under_overhangs() {
        PrintedLayer object;
        std::remove_copy_if(above_->tracks.begin(), above_->tracks.end(), std::back_inserter(object.tracks), is_external_support);
        const PrintJudgement judgement(object, *held_.printed, settings_, [&](const PrintedLayer& below) { return counted_below(below.tracks, settings_); });
        std::vector<Hanging> hanging;
        append_open(judgement, hanging);
        if (hanging.empty()) return;
        begin_patches();
        const int before = held_.patches;
        for (const Hanging& stretch : hanging) {
            // In pieces: part of a stretch may hang beyond the object's reach.
            const Segment whole = stretch.place();
            const auto pieces = static_cast<std::size_t>(length(whole) / static_cast<double>(settings_.nozzle)) + 1;
            const auto at = [&](std::size_t k) {
                const double t = static_cast<double>(k) / static_cast<double>(pieces);
                const Point d = whole.b - whole.a;
                return whole.a + Point{round_to_lattice(t * static_cast<double>(d.x)), round_to_lattice(t * static_cast<double>(d.y))};
            };
            // Where the slice is not printed at its edge; the rim of what hangs may be within its reach though the centre line is not. What only a rounded corner leaves
            // is the supports' where they can stand.
            for (std::size_t k = 0; k < pieces; ++k) {
                const auto everywhere = [&](const auto& is) {
                    return is(at(k)) && is({(at(k).x + at(k + 1).x) / 2, (at(k).y + at(k + 1).y) / 2}) && is(at(k + 1));
                };
                const bool printed = everywhere([&](Point p) { return edge_is_printed(p, settings_.nozzle / 4); });
                if (printed && everywhere([&](Point p) { return supports_reach_rim(p); })) continue;
                if (!patch_object({at(k), at(k + 1)}, settings_.reach_of_object(), printed))
                    patch_object({at(k), at(k + 1)}, settings_.reach_of_object() + settings_.nozzle / 2);
            }
        }
        if (held_.patches == before) {
            held_.plan = without_patches_;
            if (!patches_.empty()) lay_all_patches();
            return;
        }
        lay_all_patches();
        held_.mended = true;
        for (PrintPart& part : held_.parts) part.judgement.change_below(*held_.printed);
    }

    /// May a support under the gap come so near to the outer rim of a track over p that it holds it up?
    bool supports_reach_rim(Point p) {
        if (!walls_below_gap_) return false;
        if (!below_gap_) below_gap_.emplace(*walls_below_gap_);
        if (below_gap_->edges.empty()) return false;
        const Place& air = gap_places().air;
        const Segment& edge = air.edges.segments()[air.edges.nearest(p).index];
        const Point foot = nearest_point(p, edge);
        const bool outside = air.location.locate(p) == Side::inside;
        Point way{edge.a.y - edge.b.y, edge.b.x - edge.a.x};  // to the left of the edge, where air is
        if ((foot == edge.a || foot == edge.b) && length(p - foot) > 100) way = outside ? p - foot : foot - p;
        const double l = length(way), t = l > 0 ? static_cast<double>(settings_.nozzle / 2) / l : 0;
        const Point rim = p + Point{round_to_lattice(t * static_cast<double>(way.x)), round_to_lattice(t * static_cast<double>(way.y))};
        return below_gap_->location.locate(rim) == Side::inside ||
               compare_distance(rim, below_gap_->edges.segments()[below_gap_->edges.nearest(rim).index], settings_.support_radius - 4 * settings_.slack) <= 0;
    }

    /// Is the place of the slice that is nearest to p within half a width and `beyond` of a track's centre line? (A corner of 90° is 0.41 r beyond.)
    bool edge_is_printed(Point p, Unit beyond) {
        const Place& air = gap_places().air;
        if (air.edges.empty()) return false;
        const Point foot = nearest_of_slice(p);
        Box box;
        box.add(foot);
        box.grow(2 * settings_.nozzle);
        bool printed = false;
        tracks_->segments().visit(box, [&](std::uint32_t k) {
            const PlanTracks::Place place = tracks_->place(k);
            const Unit width = without_patches_.tracks[place.track].paths[place.path].width;
            printed = printed || compare_distance(foot, tracks_->segments().segments()[k], width / 2 + beyond) <= 0;
        });
        return printed;
    }

    /// A region with what it takes to look things up in it.
    struct Place {
        explicit Place(const Region& region) : Place(region, edges_of(region)) {}
        Place(const Region& region, std::vector<Segment> edges) : edges(std::move(edges)), location(edges_of(region), units_per_mm) {}
        NearestSegment edges;
        PointLocation location;
    };
    /// With a removal gap: where walls may stand, and what lies outside the slice, whose edges are the slice's. Made when first asked for.
    struct GapPlaces {
        Place walls, air;
    };
    const GapPlaces& gap_places() {
        if (!gap_places_) gap_places_.emplace(GapPlaces{Place(*beside_->walls), Place(beside_->region, edges_off_frame(beside_->region))});
        return *gap_places_;
    }

    LayerPlan shell_;
    SupportForest forest_;
    const PrintedLayer* above_;
    const PrintOverGap* over_gap_;
    const Settings& settings_;
    HeldLayer held_;
    const Cavity* beside_;
    const Region* walls_below_gap_;
    std::optional<GapPlaces> gap_places_;
    std::optional<Place> below_gap_;  ///< of walls_below_gap_
    LayerPlan without_patches_;         ///< once there are patches
    std::optional<PlanTracks> tracks_;  ///< of it
    std::vector<Patch> patches_;
    std::vector<Point> tried_;
};

}  // namespace

HeldLayer hold_print(LayerPlan shell, const SupportForest& forest, const PrintedLayer* above, const Settings& settings, const Cavity* outside,
                     const PrintOverGap* over_gap, const Region* walls_below_gap) {
    return Holder(std::move(shell), forest, above, outside, over_gap, walls_below_gap, settings).run();
}

}  // namespace ribvault
