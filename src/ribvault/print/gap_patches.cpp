#include "ribvault/print/gap_patches.hpp"

#include <algorithm>
#include <cmath>

#include "ribvault/exact/predicates.hpp"
#include "ribvault/vault/cavity_boundary.hpp"

namespace ribvault {
namespace {

/// By so much more than needed for rounding a patch may stand out of the slice whose edge it follows.
constexpr Unit within_edge = 5;

/// So far (1 um) the centre line of a patch at the edge may run beside it.
constexpr Unit beside_edge = 100;

/// The k-th of the points that divide a segment into so many pieces.
Point division(const Segment& s, std::size_t k, std::size_t pieces) {
    return part_way(s.a, s.b, static_cast<double>(k) / static_cast<double>(pieces));
}

struct Disc {
    Point centre;
    double radius = 0;
    bool holds(Point p) const { return length(p - centre) < radius; }
};

Disc disc_around(const HangingStretch& stretch) {
    const Segment& s = stretch.track.centre;
    const double l = length(s.b - s.a), half = static_cast<double>(stretch.track.width) / 2;
    const double middle = std::clamp((stretch.from + stretch.to) / 2, 0.0, l);
    return {l > 0 ? part_way(s.a, s.b, middle / l) : s.a,
            std::max(middle - stretch.from, stretch.to - middle) + half + 1};
}

/// Pieces of about this length.
std::vector<HangingStretch> pieces_of(const HangingStretch& stretch, Unit size) {
    const double l = length(stretch.track.centre.b - stretch.track.centre.a),
                 half = static_cast<double>(stretch.track.width) / 2;
    const double from = std::max(stretch.from, -half), to = std::min(stretch.to, l + half);
    const int count = static_cast<int>((to - from) / static_cast<double>(size)) + 1;
    std::vector<HangingStretch> pieces;
    for (int k = 0; k < count; ++k)
        pieces.push_back({stretch.track, from + (to - from) * k / count, from + (to - from) * (k + 1) / count});
    return pieces;
}

}  // namespace

GapPatches::GapPatches(const Cavity& beside, const Region* walls_below_gap, const LayerPlan& plan,
                       const PlanTracks& tracks, std::vector<Patch>& patches, const Settings& settings)
    : plan_(plan),
      tracks_(tracks),
      patches_(patches),
      settings_(settings),
      walls_(*beside.walls),
      air_(beside.region, edges_off_frame(beside.region)),
      walls_below_gap_(walls_below_gap) {}

bool GapPatches::may_stand(const Segment& s) const {
    const auto too_near = [&](const Patch& patch) {
        return patch.kind == TrackKind::support && distance(patch.segment, s) < static_cast<double>(apart());
    };
    if (std::any_of(patches_.begin(), patches_.end(), too_near)) return false;
    bool crosses = false;
    walls_.edges.visit(bounding_box(s),
                       [&](std::uint32_t k) { crosses = crosses || segments_touch(walls_.edges.segments()[k], s); });
    return !crosses && walls_.holds(s.a);
}

/// How far a patch of the object is from what is printed outside, as far as apart() and a hair.
double GapPatches::room_around(const Segment& patch) const {
    double room = static_cast<double>(apart() + 1);
    tracks_.segments().visit(bounding_box(patch, apart() + 1), [&](std::uint32_t k) {
        const PlanTracks::Place place = tracks_.place(k);
        if (plan_.tracks[place.track].paths[place.path].kind == TrackKind::external_support)
            room = std::min(room, distance(tracks_.segments().segments()[k], patch));
    });
    for (const Patch& other : patches_)
        if (other.kind == TrackKind::external_support) room = std::min(room, distance(other.segment, patch));
    return room;
}

Point GapPatches::Edge::shifted(Unit by) const {
    const double l = length(inwards), t = l > 0 ? static_cast<double>(by) / l : 0;
    return part_way(foot, foot + inwards, t);
}

GapPatches::Edge GapPatches::edge_beside(Point p) const {
    const Segment& edge = air_.nearest_edge(p);
    const Point foot = nearest_point(p, edge);
    // Past a corner, else across the edge, whose left is air.
    if ((foot == edge.a || foot == edge.b) && length(p - foot) > 100) return {foot, in_air(p) ? foot - p : p - foot};
    return {foot, {edge.b.y - edge.a.y, edge.a.x - edge.b.x}};
}

bool GapPatches::is_within(Point p, Unit depth) const {
    return !in_air(p) && compare_distance(p, air_.nearest_edge(p), depth) >= 0;
}

Point GapPatches::nearest_of_slice(Point p) const { return in_air(p) ? nearest_point(p, air_.nearest_edge(p)) : p; }

/// The place for a patch of the object that holds up what is over p: as near to it as a track can be that does not
/// stand out of the slice. Where the slice has no room for one, the point of the slice nearest to p, moved inwards as
/// far as needed to keep off external supports; where they are too near on both sides, the place farthest from them.
Point GapPatches::place_in_object(Point p) const {
    const Unit flush = settings_.half_width() - within_edge;
    Point within = p;
    for (int step = 0; step < 4; ++step) {
        if (is_within(within, flush - within_edge)) return within;
        within = edge_beside(within).shifted(flush);
    }
    const Edge edge = edge_beside(p);
    Point best = nearest_of_slice(p);
    double most = -1;
    for (const Point place :
         {best, edge.shifted(flush / 4), edge.shifted(flush / 2), edge.shifted(3 * flush / 4), edge.shifted(flush)}) {
        if (place != best && in_air(place)) continue;  // through a thin slice to its other side
        const double room = room_around({place, place});
        if (room > most) best = place, most = room;
        if (room >= static_cast<double>(apart())) break;
    }
    return best;
}

/// The object's: where its slice is too thin to be printed, it is printed, in pieces short enough to follow its
/// outline. Says no when the stretch is not over such a place.
bool GapPatches::add_object(const Segment& hanging, Unit reach, bool at_edge) {
    if (air_.edges.empty()) return false;
    const auto pieces = static_cast<std::size_t>(length(hanging) / static_cast<double>(settings_.support_width)) + 1;
    const std::size_t before = patches_.size();
    std::vector<Point> at;
    for (std::size_t k = 0; k <= pieces; ++k) {
        const Point p = division(hanging, k, pieces);
        if (in_air(p) && compare_distance(p, air_.nearest_edge(p), reach) > 0) return patches_.resize(before), false;
        at.push_back(at_edge ? nearest_of_slice(p) : place_in_object(p));
        if (k > 0) add_along_slice({at[k - 1], at[k]}, 0);
    }
    return true;
}

/// A patch of the object, which follows its edge where the straight way would lead through the air; where it cannot, as
/// between feet on two sides of a notch, its ends.
void GapPatches::add_along_slice(const Segment& s, int depth) {
    if (runs_in_object(s) && keeps_off_supports(s)) {
        patches_.push_back({s, TrackKind::support});
        return;
    }
    const Point middle = nearest_of_slice({(s.a.x + s.b.x) / 2, (s.a.y + s.b.y) / 2});
    const double shorter = 0.8 * length(s.b - s.a);
    if (depth < 4 && length(middle - s.a) < shorter && length(s.b - middle) < shorter && keeps_off_supports(s)) {
        add_along_slice({s.a, middle}, depth + 1);
        add_along_slice({middle, s.b}, depth + 1);
        return;
    }
    for (const Point end : {s.a, s.b}) patches_.push_back({{end, end}, TrackKind::support});
}

bool GapPatches::runs_in_object(const Segment& s) const {
    const auto pieces =
        static_cast<std::size_t>(8 * length(s.b - s.a) / static_cast<double>(settings_.support_width)) + 2;
    for (std::size_t k = 0; k <= pieces; ++k)
        if (const Point p = division(s, k, pieces);
            in_air(p) && compare_distance(p, air_.nearest_edge(p), beside_edge) > 0)
            return false;
    return true;
}

bool GapPatches::add(const Segment& hanging, bool again) {
    const bool object_first =
        again || !is_printed(hanging.a, settings_.nozzle / 4) || !is_printed(hanging.b, settings_.nozzle / 4);
    return (object_first && add_object(hanging, settings_.reach_of_object(), again)) || add_support(hanging) ||
           (!object_first && add_object(hanging, settings_.reach_of_object()));
}

std::optional<Point> GapPatches::place_for_wall(Point p, Unit reach, double* beyond) const {
    if (beyond) *beyond = HUGE_VAL;
    if (walls_.edges.empty()) return std::nullopt;
    if (walls_.holds(p)) return p;
    const Point near = nearest_point(p, walls_.nearest_edge(p));
    if (beyond) *beyond = std::max(0.0, length(near - p) - static_cast<double>(reach) - 2);
    for (Unit ring = 1; ring <= 3; ++ring)
        for (Unit dy = -ring; dy <= ring; ++dy)
            for (Unit dx = -ring; dx <= ring; ++dx)
                if (const Point q{near.x + dx, near.y + dy}; walls_.holds(q))
                    return squared_length(q - p) <= reach * reach ? std::optional(q) : std::nullopt;
    return std::nullopt;
}

bool GapPatches::add_support(const Segment& hanging) {
    const auto pieces =
        static_cast<std::size_t>(4 * length(hanging) / static_cast<double>(settings_.support_width)) + 1;
    std::vector<Point> at;
    for (std::size_t k = 0; k <= pieces; ++k) {
        const std::optional<Point> place = place_for_wall(division(hanging, k, pieces), settings_.support_radius);
        if (place && (at.empty() || at.back() != *place)) at.push_back(*place);
    }
    if (at.empty()) return false;
    const std::size_t before = patches_.size();
    for (std::size_t k = 1; k < at.size(); ++k)
        if (may_stand({at[k - 1], at[k]})) patches_.push_back({{at[k - 1], at[k]}, TrackKind::external_support});
    if (patches_.size() - before + 1 < at.size()) {  // some way between them is barred
        patches_.resize(before);
        for (const Point p : at) patches_.push_back({{p, p}, TrackKind::external_support});
    }
    if (patches_.size() == before) patches_.push_back({{at[0], at[0]}, TrackKind::external_support});
    return true;
}

bool GapPatches::add_under_rim(const HangingStretch& hanging, const std::vector<Lane>& material) {
    const Unit reach = settings_.reach_of_support() - sampling_room;
    std::vector<Point> open;
    bool all_in_reach = true;
    // Piece by piece: where nothing may stand within reach of any of it, its points need not be looked at.
    for (const HangingStretch& piece : pieces_of(hanging, settings_.support_width)) {
        const Disc disc = disc_around(piece);
        double beyond = 0;
        if (!place_for_wall(disc.centre, reach, &beyond) && beyond > disc.radius) {
            all_in_reach = false;
            continue;
        }
        const std::vector<Point> points = hanging_points(piece, material, settings_.support_radius);
        open.insert(open.end(), points.begin(), points.end());
    }
    if (open.empty() && all_in_reach) open = {nearest_to_hanging(hanging, material, settings_.support_radius)};
    // One place after the other, each for all that it reaches.
    const std::size_t before = patches_.size();
    std::vector<Point> places;
    Disc out_of_reach;
    for (const Point p : open) {
        const auto is_near = [&](Point place) { return squared_length(p - place) <= reach * reach; };
        if (out_of_reach.holds(p) || std::any_of(places.begin(), places.end(), is_near)) continue;
        double beyond = 0;
        if (const std::optional<Point> place = place_for_wall(p, reach, &beyond)) {
            places.push_back(*place);
            if (may_stand({*place, *place})) patches_.push_back({{*place, *place}, TrackKind::external_support});
        } else {
            out_of_reach = {p, beyond};
        }
    }
    return patches_.size() > before;
}

void GapPatches::add_to_object(const Segment& hanging) {
    if (walls_below_gap_ && !below_gap_) below_gap_.emplace(*walls_below_gap_);
    // In pieces: part of a stretch may hang beyond the object's reach.
    const auto pieces = static_cast<std::size_t>(length(hanging) / static_cast<double>(settings_.support_width)) + 1;
    for (std::size_t k = 0; k < pieces; ++k) {
        const Segment piece{division(hanging, k, pieces), division(hanging, k + 1, pieces)};
        const Point middle{(piece.a.x + piece.b.x) / 2, (piece.a.y + piece.b.y) / 2};
        const auto everywhere = [&](const auto& is) { return is(piece.a) && is(middle) && is(piece.b); };
        const bool printed = everywhere([&](Point p) { return is_printed(p, settings_.nozzle / 4); });
        if (printed && everywhere([&](Point p) { return supports_reach_rim(p); })) continue;
        // The rim of what hangs may be within the slice's reach though the centre line is not.
        if (!add_object(piece, settings_.reach_of_object(), printed))
            add_object(piece, settings_.reach_of_object() + settings_.nozzle / 2);
    }
}

/// May a support under the gap come so near to the outer rim of a track over p that it holds it up?
bool GapPatches::supports_reach_rim(Point p) const {
    if (!below_gap_ || below_gap_->edges.empty()) return false;
    const Edge edge = edge_beside(p);
    const Point rim = p + (edge.shifted(-settings_.nozzle / 2) - edge.foot);
    return below_gap_->holds(rim) ||
           compare_distance(rim, below_gap_->nearest_edge(rim), settings_.support_radius - 4 * settings_.slack) <= 0;
}

/// Is the place of the slice that is nearest to p within half a width and `beyond` of a track's centre line? (A corner
/// of 90° is 0.41 r beyond.)
bool GapPatches::is_printed(Point p, Unit beyond) const {
    if (air_.edges.empty()) return false;
    const Point foot = nearest_of_slice(p);
    bool printed = false;
    tracks_.segments().visit(bounding_box({foot, foot}, 2 * settings_.nozzle), [&](std::uint32_t k) {
        const PlanTracks::Place place = tracks_.place(k);
        const Unit width = plan_.tracks[place.track].paths[place.path].width;
        printed = printed || compare_distance(foot, tracks_.segments().segments()[k], width / 2 + beyond) <= 0;
    });
    return printed;
}

}  // namespace ribvault
