#include "ribvault/print/printed_tracks.hpp"

namespace ribvault {
Millimetres printed_length(Unit length) {
    return Millimetres::of_picometres(length * (Millimetres::picometres_per_mm / units_per_mm));
}

PrintedLayer printed_layer(const LayerPlan& plan) {
    PrintedLayer layer;
    for (std::size_t k = 0; k < plan.tracks.size(); ++k)
        for (const ToolPath& path : plan.tracks[k].paths) {
            PrintedTrack track;
            track.width = printed_length(path.width);
            track.feature = static_cast<int>(path.kind);
            track.line = static_cast<std::int64_t>(k);
            track.outline = path.closed && path.kind == TrackKind::outer_perimeter;
            track.a = {printed_length(path.points.front().x), printed_length(path.points.front().y)};
            const std::size_t n = path.points.size();
            if (n == 1) {
                track.b = track.a;
                layer.tracks.push_back(track);
            }
            for (std::size_t i = 1; i < n + (path.closed && n > 1 ? 1 : 0); ++i) {
                const Point to = path.points[i % n];
                track.b = {printed_length(to.x), printed_length(to.y)};
                layer.tracks.push_back(track);
                track.a = track.b;
            }
        }
    return layer;
}

}  // namespace ribvault
