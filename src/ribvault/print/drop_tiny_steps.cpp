#include "ribvault/print/drop_tiny_steps.hpp"

namespace ribvault {

void drop_tiny_steps(ToolPath& path) {
    std::vector<Point>& points = path.points;
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
}

}  // namespace ribvault
