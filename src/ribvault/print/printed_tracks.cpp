#include "ribvault/print/printed_tracks.hpp"

namespace ribvault {
namespace {

Rational mm(Unit length) {
    Rational q(static_cast<long>(length), static_cast<unsigned long>(units_per_mm));
    q.canonicalize();
    return q;
}

}  // namespace

PrintedLayer printed_layer(const LayerPlan& plan) {
    PrintedLayer layer;
    for (std::size_t k = 0; k < plan.tracks.size(); ++k)
        for (const ToolPath& path : plan.tracks[k].paths) {
            PrintedTrack track;
            track.width = mm(path.width);
            track.feature = static_cast<int>(path.kind);
            track.line = static_cast<std::int64_t>(k);
            track.outline = path.closed && path.kind == TrackKind::outer_perimeter;
            track.a = {mm(path.points.front().x), mm(path.points.front().y)};
            const std::size_t n = path.points.size();
            if (n == 1) {
                track.b = track.a;
                layer.tracks.push_back(track);
            }
            for (std::size_t i = 1; i < n + (path.closed && n > 1 ? 1 : 0); ++i) {
                const Point to = path.points[i % n];
                track.b = {mm(to.x), mm(to.y)};
                layer.tracks.push_back(track);
                track.a = track.b;
            }
        }
    return layer;
}

}  // namespace ribvault
