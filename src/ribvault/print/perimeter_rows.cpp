#include "ribvault/print/perimeter_rows.hpp"

#include "ribvault/exact/predicates.hpp"

namespace ribvault {

PerimeterRows::PerimeterRows(const LayerPaths& layer, Unit clearance) : clearance_(clearance) {
    std::vector<Segment> segments;
    for (const ToolPath& path : layer.paths) {
        if (path.kind == TrackKind::cover || is_support(path.kind)) continue;
        append_segments(path, segments);
    }
    rows_ = SegmentRows(segments, clearance);
}

bool PerimeterRows::near(Point p) const {
    return rows_.any(p.y, p.y, [&](const Segment& s) { return compare_distance(p, s, clearance_) <= 0; });
}

}  // namespace ribvault
