#include "ribvault/print/shell_paths.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "ribvault/exact/nearest_segment.hpp"
#include "ribvault/exact/point_location.hpp"
#include "ribvault/print/cover_lines.hpp"
#include "ribvault/print/gap_strips.hpp"
#include "ribvault/print/islands.hpp"
#include "ribvault/print/medial_tracks.hpp"
#include "ribvault/print/reach_perimeters.hpp"
#include "ribvault/print/ring_centres.hpp"
#include "ribvault/print/segment_rows.hpp"
#include "ribvault/print/simplify.hpp"
#include "ribvault/slice/lattice_clip.hpp"

namespace ribvault {
namespace {

namespace cl = ClipperLib;

/// Of a point from a closed line, rounded.
double distance(Point p, const Contour& ring) {
    double least = squared_distance(p, {ring.back(), ring.front()}).value();
    for (std::size_t i = 1; i < ring.size(); ++i)
        least = std::min(least, squared_distance(p, {ring[i - 1], ring[i]}).value());
    return std::sqrt(least);
}

/// How far the contour turns at vertex i, in steps of 10 degrees, so that corners alike from layer to layer compare
/// equal.
int turn_at(const Contour& ring, std::size_t i) {
    const std::size_t n = ring.size();
    const Point in = ring[i] - ring[(i + n - 1) % n], out = ring[(i + 1) % n] - ring[i];
    const double cross =
        static_cast<double>(in.x) * static_cast<double>(out.y) - static_cast<double>(in.y) * static_cast<double>(out.x);
    const double dot =
        static_cast<double>(in.x) * static_cast<double>(out.x) + static_cast<double>(in.y) * static_cast<double>(out.y);
    return static_cast<int>(std::fabs(std::atan2(cross, dot)) * 18 / 3.14159265358979 + 0.5);
}

void put_seam_first(Contour& ring, Seam seam) {
    std::size_t best = 0;
    int sharpest = seam == Seam::corner ? turn_at(ring, 0) : 0;
    for (std::size_t i = 1; i < ring.size(); ++i) {
        const int turn = seam == Seam::corner ? turn_at(ring, i) : 0;
        if (turn > sharpest || (turn == sharpest && more_to_the_rear(ring[i], ring[best]))) best = i, sharpest = turn;
    }
    std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(best), ring.end());
}

PlannedTrack dot(Point at, Unit width) {
    return {{{TrackKind::thin_wall, width, false, {at}}}, Entry::fixed, no_stop};
}

/// A closed perimeter among the plan's tracks.
struct Ring {
    std::size_t track, island;
};

/// Has a track wait for one more. It names only one that it waits for, so all of them are put in a row.
void wait_for(std::size_t earlier, std::size_t track, LayerPlan& plan) {
    const auto waits_for = [&](std::size_t t, std::size_t other) {
        while (t != no_stop && t != other) t = plan.tracks[t].after;
        return t == other;
    };
    const std::size_t before = plan.tracks[track].after;
    if (waits_for(before, earlier)) return;
    if (!waits_for(earlier, before)) {
        std::size_t first = earlier;  // of what it waits for and `before` does not
        while (!waits_for(before, plan.tracks[first].after)) first = plan.tracks[first].after;
        plan.tracks[first].after = before;
    }
    plan.tracks[track].after = earlier;
}

/// The pairs of an inner ring and an outer one that run side by side somewhere. Where an island has several outer
/// rings, that is where the middle of a step of the inner one is hardly farther from one than a track is wide.
std::vector<std::pair<Ring, Ring>> side_by_side(const std::vector<Ring>& inner, const std::vector<Ring>& outer, Unit w,
                                                const LayerPlan& plan) {
    const auto points = [&](const Ring& ring) -> const Contour& {
        return plan.tracks[ring.track].paths.front().points;
    };
    const Unit reach = w + w / 4;
    const auto near = [reach](Point p, const SegmentRows& rows) {
        return rows.any(p.y, p.y, [&](const Segment& s) {
            return squared_distance(p, s).value() <= static_cast<double>(reach) * static_cast<double>(reach);
        });
    };
    std::map<std::size_t, std::vector<Ring>> of_island;
    for (const Ring& ring : outer) of_island[ring.island].push_back(ring);
    std::map<std::size_t, SegmentRows> rows;  // by track
    for (const auto& [island, rings] : of_island)
        for (const Ring& ring : rings)
            if (rings.size() > 1) rows.try_emplace(ring.track, edges_of(Region{points(ring)}), reach);
    std::vector<std::pair<Ring, Ring>> pairs;
    for (const Ring& ring : inner) {
        const std::vector<Segment> steps = edges_of(Region{points(ring)});
        const std::vector<Ring>& others = of_island[ring.island];
        for (const Ring& other : others)
            if (others.size() == 1 || std::any_of(steps.begin(), steps.end(), [&](const Segment& s) {
                    return near({(s.a.x + s.b.x) / 2, (s.a.y + s.b.y) / 2}, rows.at(other.track));
                }))
                pairs.emplace_back(ring, other);
    }
    return pairs;
}

/// The perimeters by ring, j = 0 outermost, each after its neighbours of the ring before in the same island, if that
/// has any. Where a ring is hardly longer than a point there is room for a dot, if nothing is printed there already.
void append_perimeters(const std::vector<Region>& centres, Unit w, const TrackSettings& tracks, const Region& outline,
                       LayerPlan& plan) {
    const double width = static_cast<double>(w);
    std::optional<Islands> islands;  // where rings have neighbours
    if (centres.size() > 1) islands.emplace(outline);
    std::vector<std::vector<Ring>> rings;
    std::vector<Point> specks;
    for (std::size_t j = 0; j < centres.size(); ++j) {
        rings.emplace_back();
        for (const Contour& line : centres[j]) {
            ToolPath path{j == 0 ? TrackKind::outer_perimeter : TrackKind::inner_perimeter, w, true, line};
            if (2 * length(path) < width) {
                specks.push_back(path.points.front());
                continue;
            }
            put_seam_first(path.points, tracks.seam);
            const Entry entry = j == 0 && tracks.seam != Seam::nearest ? Entry::fixed : Entry::anywhere;
            rings.back().push_back({plan.tracks.size(), islands ? islands->of(path.points.front()) : 0});
            plan.tracks.push_back({{std::move(path)}, entry, no_stop});
        }
    }
    for (const Point speck : specks) {
        const auto covers = [&](const PlannedTrack& track) {
            return distance(speck, track.paths.front().points) < 0.75 * width;
        };
        if (std::none_of(plan.tracks.begin(), plan.tracks.end(), covers)) plan.tracks.push_back(dot(speck, w));
    }
    for (std::size_t k = 1; k < rings.size(); ++k) {
        const std::size_t j = tracks.inner_first ? rings.size() - k : k;
        for (const auto& [inner, outer] : side_by_side(rings[j], rings[j - 1], w, plan))
            if (tracks.inner_first)
                wait_for(inner.track, outer.track, plan);
            else
                wait_for(outer.track, inner.track, plan);
    }
}

/// About the middle of an area, in it.
Point middle_of(const Region& area) {
    const Contour* largest = &area.front();
    for (const Contour& c : area)
        if (signed_area({c}) > signed_area({*largest})) largest = &c;
    const Box box = bounding_box({*largest});
    const Point middle = part_way(box.lo, box.hi, 0.5);
    if (PointLocation(edges_of(area), units_per_mm / 10).locate(middle) != Side::outside) return middle;
    return *std::min_element(largest->begin(), largest->end(),
                             [&](Point p, Point q) { return squared_length(p - middle) < squared_length(q - middle); });
}

/// The widest dot that a piece has room for, in steps of a twentieth of d; nothing when that is less than half as wide.
std::optional<PlannedTrack> widest_dot(const Region& piece, Unit w) {
    const Unit step = w / 20;
    Unit widest = 0;
    Region room_of_widest;
    for (Unit width = (w / 2 + step - 1) / step * step; 2 * width <= 3 * w; width += step) {
        Region room = mitred(piece, -static_cast<double>(width) / 2);
        if (room.empty()) break;
        widest = width, room_of_widest = std::move(room);
    }
    if (widest == 0) return {};
    return dot(middle_of(room_of_widest), widest);
}

/// Of a disc as wide as the track is anywhere.
double area_of_dot(const PlannedTrack& track) {
    Unit widest = 0;
    for (const ToolPath& path : track.paths) widest = std::max(widest, path.width);
    return std::numbers::pi / 4 * static_cast<double>(widest * widest);
}

/// What is too narrow for a perimeter on both its sides, as tracks of width w; where these have no room either, of
/// `narrower`. They overlap the perimeters that they touch, dots by up to w / 4.
void append_thin_walls(const Region& outline, const Region& outermost, Unit w, Unit narrower, bool printed,
                       LayerPlan& plan) {
    const double width = static_cast<double>(w), smallest = width * width / 16;
    const Region filled = mitred(outermost, width / 2);
    if (signed_area(outline) - signed_area(filled) < smallest) return;
    const NearestSegment perimeters(edges_of(outermost)), border(edges_of(outline));
    const auto along = [&](const Region& piece, Unit of_width) {
        std::vector<PlannedTrack> walls = medial_tracks(piece, of_width, TrackKind::thin_wall, true);
        reach_perimeters(walls, perimeters, border, w);
        std::erase_if(walls, [](const PlannedTrack& wall) { return area_of(wall) < area_of_dot(wall); });
        return walls;
    };
    // A little more than the perimeters, so that no slivers of rounding are left.
    for (const Region& piece :
         connected_pieces(clip(cl::ctDifference, outline, mitred(outermost, width / 2 + border_margin)))) {
        const double area = signed_area(piece);
        if (area < smallest) continue;
        std::vector<PlannedTrack> walls;
        if (printed && area >= width * width / 2) walls = along(piece, w);
        if (printed && walls.empty() && narrower < w) walls = along(piece, narrower);
        double left = 0;  // not printed
        if (walls.empty()) {
            left = area;
            std::optional<PlannedTrack> dot = printed ? widest_dot(piece, w) : std::nullopt;
            if (dot) {
                const Region room = clip(cl::ctIntersection, mitred(piece, width / 4), outline);
                if (std::optional<PlannedTrack> joined = widest_dot(room, w)) dot = std::move(joined);
                left = std::max(0.0, area - area_of_dot(*dot));
                walls.push_back(std::move(*dot));
            }
        }
        if (2 * left > area) ++plan.thin_places, plan.thin_area += left;
        std::move(walls.begin(), walls.end(), std::back_inserter(plan.tracks));
    }
}

/// Where centre lines of covers may run, as connected areas with their holes. Without
/// `narrow` places narrower than half a width are left to append_gap_fill: one line along the middle of a strip at most
/// 3/2 widths wide is printed faster than many short ones across it. Eroding O_i \ C_i is eroding O_i and dilating C_i,
/// and keeps Clipper away from the nearly coincident borders of the two.
std::vector<Region> cover_areas(const Region& outline, const Region& cavity, int perimeters, double width,
                                bool narrow) {
    Region centres = clip(cl::ctDifference, mitred(outline, -(perimeters + 0.5) * width), mitred(cavity, width / 2));
    const double least = width / 4 + clip_rounding;
    if (!narrow) centres = clip(cl::ctIntersection, mitred(mitred(centres, -least), least + border_margin), centres);
    return connected_pieces(std::move(centres));
}

/// Rings where they have room, tracks along the middle elsewhere.
void append_concentric(Region area, Unit w, LayerPlan& plan) {
    const double width = static_cast<double>(w);
    Region room = mitred(area, width / 2);  // what the rings before leave
    while (!room.empty()) {
        Region rings = with_room(area, room, 0, w);
        const Region left = clip(cl::ctDifference, room, mitred(rings, width / 2 + border_margin));
        for (PlannedTrack& middle : medial_tracks(left, w, TrackKind::cover)) plan.tracks.push_back(std::move(middle));
        room = mitred(rings, -width / 2), area = mitred(rings, -width);
        for (Contour& ring : rings) {
            ToolPath path{TrackKind::cover, w, true, std::move(ring)};
            if (2 * length(path) >= width) plan.tracks.push_back({{std::move(path)}, Entry::anywhere, no_stop});
        }
    }
}

void append_covers(const Region& area, Unit w, bool falling, CoverPattern pattern, LayerPlan& plan) {
    if (pattern == CoverPattern::concentric) return append_concentric(area, w, plan);
    const bool monotonic = pattern == CoverPattern::monotonic;
    std::size_t before = no_stop;
    for (Contour& line : cover_lines(area, w, falling, monotonic)) {
        ToolPath path{TrackKind::cover, w, false, std::move(line)};
        if (2 * length(path) < static_cast<double>(w)) continue;
        plan.tracks.push_back({{std::move(path)}, monotonic ? Entry::fixed : Entry::either_end, before});
        if (monotonic) before = plan.tracks.size() - 1;
    }
}

/// What the covers, the plan's tracks from `first_cover` on, print, and `more` around it.
Region printed_covers(const LayerPlan& plan, std::size_t first_cover, double more) {
    std::map<Unit, std::vector<Contour>> lines;  // by width
    for (std::size_t k = first_cover; k < plan.tracks.size(); ++k)
        for (const ToolPath& path : plan.tracks[k].paths) {
            lines[path.width].push_back(path.points);
            if (path.closed) lines[path.width].back().push_back(path.points.front());
        }
    Region printed;
    for (const auto& [width, of_width] : lines) {
        const auto w = static_cast<double>(width);
        for (Contour& c : offset_lines(of_width, w / 2 + more, w / 20)) printed.push_back(std::move(c));
    }
    return printed;
}

/// Tracks in strips that are too narrow for anything else, of width w; where these have no room, of `narrower`. What
/// they fill is taken from plan.unfilled_area.
std::vector<PlannedTrack> strip_tracks(const Region& left, Unit w, Unit narrower, LayerPlan& plan) {
    const double width = static_cast<double>(w);
    std::vector<PlannedTrack> strips;
    Region filled;
    // Only where a track of w / 2 has room, counted with the 2 `border_margin` that the strips lack on either side;
    // most are narrower all along.
    const double least = width / 4 - 2 * border_margin - clip_rounding;
    const Region wide = mitred(mitred(left, -least), least + border_margin);
    if (wide.empty() && narrower == w) return strips;
    for (const Region& piece : clip_to_pieces(cl::ctIntersection, wide, left)) {
        const double area = signed_area(piece);
        if (area < width * width / 2) continue;
        std::vector<PlannedTrack> along = medial_tracks(piece, w, TrackKind::thin_wall);
        if (!along.empty()) plan.unfilled_area -= area;
        if (along.empty())
            if (std::optional<PlannedTrack> dot = widest_dot(piece, w); dot && 4 * dot->paths.front().width >= 3 * w) {
                plan.unfilled_area -= area_of_dot(*dot);
                along.push_back(std::move(*dot));
            }
        if (!along.empty()) std::copy(piece.begin(), piece.end(), std::back_inserter(filled));
        std::move(along.begin(), along.end(), std::back_inserter(strips));
    }
    if (narrower < w) {
        std::vector<PlannedTrack> more = strip_tracks(without(left, filled), narrower, narrower, plan);
        std::move(more.begin(), more.end(), std::back_inserter(strips));
    }
    return strips;
}

/// Strips between perimeters that leave no room for one more on both sides.
void append_between_perimeters(const Region& outline, const std::vector<Region>& centres, Unit w, Unit narrower,
                               GapFill which, LayerPlan& plan) {
    const double width = static_cast<double>(w);
    for (std::size_t j = 1; j < centres.size(); ++j) {
        const Region left = clip(cl::ctDifference, mitred(outline, -static_cast<double>(j) * width - 2 * border_margin),
                                 mitred(centres[j], width / 2 + 2 * border_margin));
        if (signed_area(left) < width * width / 16) continue;
        plan.unfilled_area += signed_area(left);
        if (which == GapFill::none) continue;
        std::vector<PlannedTrack> strips = strip_tracks(left, w, narrower, plan);
        std::move(strips.begin(), strips.end(), std::back_inserter(plan.tracks));
    }
}

/// Strips between perimeters, covers and cavity, and beside covers that do not reach their border, that are too narrow
/// for a cover. The covers are the plan's tracks from `first_cover` on.
void append_gap_fill(const Region& outline, const Region& cavity, int perimeters, Unit w, Unit narrower,
                     std::size_t first_cover, GapFill which, const Covering& covering, LayerPlan& plan) {
    const double width = static_cast<double>(w);
    const Region room = clip(cl::ctDifference, mitred(outline, -perimeters * width - 2 * border_margin), cavity);
    if (signed_area(room) < width * width / 16) return;
    const Region covers = printed_covers(plan, first_cover, 2 * border_margin);
    const Region left = covers.empty() ? room : clip(cl::ctDifference, room, covers);
    plan.unfilled_area += signed_area(left);
    if (which == GapFill::none) return;
    append_strips(strip_tracks(left, w, narrower, plan), which == GapFill::needed ? covering : Covering(), w, plan);
}

}  // namespace

void append_shell_paths(const Slice& slice, const Region& exact_cavity, const Settings& settings,
                        const TrackSettings& tracks, LayerPlan& plan, const Covering& covering) {
    const Unit w = tracks.width_on(slice.layer, settings.nozzle);
    const Region outline = simplify(slice.rounded, tracks.resolution),
                 cavity = simplify(exact_cavity, tracks.resolution);
    std::vector<Region> centres;
    for (int j = 0; j < settings.perimeters; ++j)
        centres.push_back(ring_centres(outline, j, w, j == 0 ? tracks.thin_walls : tracks.fill_gaps != GapFill::none));
    append_perimeters(centres, w, tracks, outline, plan);
    append_thin_walls(outline, centres.front(), w, settings.nozzle, tracks.thin_walls, plan);
    append_between_perimeters(outline, centres, w, settings.nozzle, tracks.fill_gaps, plan);
    const std::vector<Region> areas = cover_areas(
        outline, cavity, settings.perimeters, static_cast<double>(w), tracks.fill_gaps == GapFill::none);
    const std::size_t first_cover = plan.tracks.size();
    for (const Region& area : areas)
        append_covers(area, w, slice.layer % 2 != 0, tracks.covers, plan);
    append_gap_fill(outline, cavity, settings.perimeters, w, settings.nozzle, first_cover, tracks.fill_gaps, covering,
                    plan);
}

}  // namespace ribvault
