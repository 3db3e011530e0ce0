#include "ribvault/print/drop_tiny_steps.hpp"

#include <algorithm>
#include <utility>

#include "ribvault/exact/nearest_segment.hpp"

namespace ribvault {
namespace {

bool is_dot(const PlannedTrack& track) {
    return track.paths.size() == 1 && track.paths[0].points.size() == 1 && is_support(track.paths[0].kind);
}

/// Per track: is it a dot at a place that another track, which is none or comes first, prints?
std::vector<char> repeated_dots(const LayerPlan& plan) {
    std::vector<char> repeated(plan.tracks.size(), 0);
    if (std::none_of(plan.tracks.begin(), plan.tracks.end(), is_dot)) return repeated;
    std::vector<Segment> segments;
    std::vector<std::pair<std::size_t, const ToolPath*>> of;
    for (std::size_t t = 0; t < plan.tracks.size(); ++t)
        for (const ToolPath& path : plan.tracks[t].paths) {
            append_segments(path, segments);
            of.resize(segments.size(), {t, &path});
        }
    const NearestSegment lines(std::move(segments));
    for (std::size_t t = 0; t < plan.tracks.size(); ++t) {
        if (!is_dot(plan.tracks[t])) continue;
        const ToolPath& dot = plan.tracks[t].paths[0];
        const Segment at{dot.points[0], dot.points[0]};
        lines.visit(bounding_box(at, shortest_step), [&](std::uint32_t k) {
            const auto& [other, path] = of[k];
            if (other == t || repeated[other] || path->kind != dot.kind || path->width < dot.width) return;
            if (other > t && is_dot(plan.tracks[other])) return;
            if (compare_distance(dot.points[0], lines.segments()[k], shortest_step) <= 0) repeated[t] = 1;
        });
    }
    return repeated;
}

}  // namespace

void drop_tiny_steps(ToolPath& path) {
    std::vector<Point>& points = path.points;
    if (path.kind == TrackKind::external_support && length(path) >= static_cast<double>(shortest_step)) {
        points.erase(std::unique(points.begin(), points.end()), points.end());
        return;
    }
    std::vector<Point> kept{points.front()};
    for (std::size_t k = 1; k < points.size(); ++k)
        if (!is_tiny_step(kept.back(), points[k])) kept.push_back(points[k]);
    if (path.closed) {
        while (kept.size() > 1 && is_tiny_step(kept.back(), kept.front())) kept.pop_back();
        path.closed = kept.size() > 2;
    } else if (kept.back() != points.back()) {
        // The last point counts more than those before it.
        while (kept.size() > 1 && is_tiny_step(kept.back(), points.back())) kept.pop_back();
        if (!is_tiny_step(kept.back(), points.back())) kept.push_back(points.back());
    }
    points = std::move(kept);
}

void drop_tiny_steps(LayerPlan& plan) {
    for (PlannedTrack& track : plan.tracks)
        for (ToolPath& path : track.paths) drop_tiny_steps(path);
    const std::vector<char> repeated = repeated_dots(plan);
    std::vector<std::size_t> place(plan.tracks.size(), 0);
    for (std::size_t t = 1; t < place.size(); ++t) place[t] = place[t - 1] + !repeated[t - 1];
    std::vector<PlannedTrack> kept;
    for (std::size_t t = 0; t < place.size(); ++t) {
        if (repeated[t]) continue;
        PlannedTrack& track = kept.emplace_back(std::move(plan.tracks[t]));
        // What waits for a track that is left out waits for what that waited for.
        while (track.after != no_stop && repeated[track.after]) track.after = plan.tracks[track.after].after;
        if (track.after != no_stop) track.after = place[track.after];
    }
    plan.tracks = std::move(kept);
}

}  // namespace ribvault
