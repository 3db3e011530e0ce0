#include "ribvault/print/perimeter_rows.hpp"

namespace ribvault {
namespace {

double distance(Point p, const Segment& s) {
    const Point d = s.b - s.a, to = p - s.a;
    const double square = static_cast<double>(d.x) * static_cast<double>(d.x) +
                          static_cast<double>(d.y) * static_cast<double>(d.y);
    const double dot = static_cast<double>(to.x) * static_cast<double>(d.x) +
                       static_cast<double>(to.y) * static_cast<double>(d.y);
    const double t = square > 0 ? std::clamp(dot / square, 0.0, 1.0) : 0.0;
    return std::hypot(static_cast<double>(to.x) - t * static_cast<double>(d.x),
                      static_cast<double>(to.y) - t * static_cast<double>(d.y));
}

}  // namespace

PerimeterRows::PerimeterRows(const LayerPaths& layer, Unit clearance) : clearance_(clearance) {
    std::vector<Segment> segments;
    for (const ToolPath& path : layer.paths) {
        if (path.kind == TrackKind::cover || is_support(path.kind)) continue;
        append_segments(path, segments);
    }
    rows_ = SegmentRows(segments, clearance);
}

bool PerimeterRows::near(Point p) const {
    return rows_.any(p.y, p.y, [&](const Segment& s) { return distance(p, s) <= static_cast<double>(clearance_); });
}

}  // namespace ribvault
