#include "ribvault/print/skirt.hpp"

#include <algorithm>
#include <iterator>

#include "ribvault/exact/predicates.hpp"
#include "ribvault/print/drop_tiny_steps.hpp"
#include "ribvault/print/medial_tracks.hpp"
#include "ribvault/print/simplify.hpp"
#include "ribvault/slice/lattice_clip.hpp"

namespace ribvault {
namespace {

constexpr double arc_tolerance = 400;  // lattice units, 4 µm (9 where a corner has one chord)

/// The nearest number; but a brim that is asked for has a loop.
int brim_loops(Unit width, const TrackSettings& tracks) {
    const auto loops = static_cast<int>((tracks.brim_width + width / 2) / width);
    return tracks.brim_width > 0 ? std::max(1, loops) : 0;
}

/// The convex hull of all contours, counter-clockwise (Andrew's chains; exact).
Contour hull_of(const Region& region) {
    std::vector<Point> points;
    for (const Contour& c : region) points.insert(points.end(), c.begin(), c.end());
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3) return points;
    Contour hull;
    for (const bool back : {false, true}) {
        const std::size_t begin = hull.size();
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Point p = back ? points[points.size() - 1 - i] : points[i];
            while (hull.size() >= begin + 2 && orientation(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
            hull.push_back(p);
        }
        hull.pop_back();
    }
    return hull;
}

/// The outer contours as loops; those around holes lie inside them and are left out.
void append_loops(const Region& around, Unit width, Unit resolution, std::vector<ToolPath>& paths) {
    for (Contour& loop : simplify(around, resolution))
        if (signed_area({loop}) > 0) paths.push_back({TrackKind::skirt, width, true, std::move(loop)});
}

Region round_offset(const Region& region, double distance) {
    return offset(region, distance, ClipperLib::jtRound, arc_tolerance);
}

/// Loop k of the brim, 0 the innermost. Between islands, where there is no room for two side by side, at most 3/2
/// widths between the loops before, one track of its own width takes their place.
void append_brim_loop(const Region& outline, int k, Unit w, Unit resolution, std::vector<ToolPath>& paths) {
    const double width = static_cast<double>(w);
    const Region joined = round_offset(outline, (k + 0.75) * width);
    Region before = round_offset(outline, k * width + 2 * arc_tolerance);
    for (const Contour& c : outline)
        if (signed_area({c}) < 0) before.emplace_back(c.rbegin(), c.rend());  // no brim in holes
    before = clip(ClipperLib::ctUnion, before, {});
    const Region strips = clip(ClipperLib::ctDifference, mitred(joined, -0.75 * width), before);
    for (const Region& piece : connected_pieces(strips))
        if (signed_area(piece) >= width * width / 2)
            for (PlannedTrack& track : medial_tracks(piece, w, TrackKind::skirt))
                std::move(track.paths.begin(), track.paths.end(), std::back_inserter(paths));
    append_loops(mitred(joined, -width / 4), w, resolution, paths);
}

}  // namespace

std::vector<ToolPath> skirt_and_brim(const Region& object, const Settings& settings, const TrackSettings& tracks,
                                     const std::vector<Segment>& supports) {
    std::vector<ToolPath> paths;
    const Region outline = supports.empty()
                               ? object
                               : clip(ClipperLib::ctUnion, object,
                                      offset(supports, static_cast<double>(settings.support_width) / 2, arc_tolerance));
    const Unit w = tracks.width_on(0, settings.nozzle);
    const double width = static_cast<double>(w);
    const int brim = brim_loops(w, tracks);
    if (outline.empty()) return paths;
    if (tracks.skirt_loops > 0) {
        const Region hull{hull_of(outline)};
        for (int k = tracks.skirt_loops; k-- > 0;)
            append_loops(round_offset(hull, (brim + k + 0.5) * width + static_cast<double>(tracks.skirt_distance)), w,
                         tracks.resolution, paths);
    }
    for (int k = brim; k-- > 0;) append_brim_loop(outline, k, w, tracks.resolution, paths);
    for (ToolPath& path : paths) drop_tiny_steps(path);
    return paths;
}

Unit reach_of_skirt_and_brim(const Settings& settings, const TrackSettings& tracks) {
    const Unit w = tracks.width_on(0, settings.nozzle);
    const Unit brim = brim_loops(w, tracks) * w;
    return tracks.skirt_loops > 0 ? brim + tracks.skirt_distance + tracks.skirt_loops * w : brim;
}

}  // namespace ribvault
