#include "ribvault/print/ring_centres.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ribvault/exact/nearest_segment.hpp"
#include "ribvault/exact/point_location.hpp"
#include "ribvault/print/medial_tracks.hpp"
#include "ribvault/print/reach_perimeters.hpp"
#include "ribvault/slice/lattice_clip.hpp"

namespace ribvault {
namespace {

namespace cl = ClipperLib;

double around(const Region& region) {
    double sum = 0;
    for (const Segment& e : edges_of(region)) sum += length(e);
    return sum;
}

void append(const Region& region, Region& to) { to.insert(to.end(), region.begin(), region.end()); }

/// The material of medial tracks in an area; at ends that (nearly) touch a ring with the round end, which closes the
/// gap to it.
double material_along(const Region& area, Unit w, const NearestSegment& rings) {
    double sum = 0;
    const auto add_end = [&](Point end, Unit width) {
        const double reach = touching(w, width);
        if (!rings.empty() && rings.nearest(end).distance.value() <= reach * reach)
            sum += std::numbers::pi / 8 * static_cast<double>(width) * static_cast<double>(width);
    };
    for (const PlannedTrack& track : medial_tracks(area, w, TrackKind::thin_wall, true)) {
        sum += area_of(track);
        add_end(track.paths.front().points.front(), track.paths.front().width);
        add_end(track.paths.back().points.back(), track.paths.back().width);
    }
    return sum;
}

/// Which of the narrow `tips` of a ring a track of their own would fill better than the ring, which prints them there
/// and back: those as wide all along, but not those that end in a wedge. `outline`: what the ring lies w / 2 inside of;
/// `narrow`: what else the ring leaves out.
Region stubs(const Region& outline, const Region& centres, const Region& narrow, const std::vector<Region>& tips,
             Unit w) {
    const double width = static_cast<double>(w);
    const NearestSegment border(edges_of(centres));
    const auto longer_ring = [&](const Region& tip) {  // than without the tip
        double sum = 0;
        for (const Segment& e : edges_of(tip)) {
            const bool shared =
                border.nearest(part_way(e.a, e.b, 0.5)).distance.value() <= border_margin * border_margin;
            sum += shared ? length(e) : -length(e);
        }
        return sum;
    };
    Region left_out = narrow, found;
    for (const Region& tip : tips) append(tip, left_out);
    const Region others = without(centres, left_out);
    const NearestSegment other_border(edges_of(others));
    for (const Region& room : clip_to_pieces(cl::ctDifference, outline, mitred(others, width / 2 + border_margin))) {
        const double area = signed_area(room);
        if (area < width * width / 2) continue;
        const PointLocation inside(edges_of(room), w);
        Region here;
        double ring = 0;
        for (const Region& tip : tips) {
            const auto in_room = [&](Point p) { return inside.locate(p) == Side::inside; };
            if (std::none_of(tip.front().begin(), tip.front().end(), in_room)) continue;
            append(tip, here);
            ring += width * longer_ring(tip);
        }
        if (here.empty()) continue;
        const double track = material_along(room, w, other_border);
        if (track == 0) continue;
        ring += material_along(clip(cl::ctDifference, room, mitred(here, width / 2 + border_margin)), w, border);
        if (std::abs(track - area) < std::abs(ring - area)) append(here, found);
    }
    return found;
}

}  // namespace

Region without(const Region& region, const Region& parts) {
    return parts.empty() ? region : clip(cl::ctDifference, region, mitred(parts, border_margin));
}

Region with_room(const Region& centres, const Region& outline, double inset, Unit w) {
    const double width = static_cast<double>(w);
    const double least = width / 4 + clip_rounding;  // exactly w / 2 is narrow, however the edges lie
    const Region wide = mitred(mitred(centres, -least), least + border_margin);
    Region narrow;
    std::vector<Region> tips;
    for (Region& piece : clip_to_pieces(cl::ctDifference, centres, wide)) {
        const double around_piece = around(piece);
        if (around_piece >= 6 * width)
            append(piece, narrow);
        else if (around_piece >= 2 * width)
            tips.push_back(std::move(piece));
    }
    if (!tips.empty()) append(stubs(mitred(outline, -inset), centres, narrow, tips, w), narrow);
    return without(centres, narrow);
}

Region ring_centres(const Region& outline, int j, Unit w, bool room_only) {
    const double width = static_cast<double>(w);
    Region centres = mitred(outline, -(j + 0.5) * width);
    return room_only ? with_room(centres, outline, j * width, w) : centres;
}

}  // namespace ribvault
