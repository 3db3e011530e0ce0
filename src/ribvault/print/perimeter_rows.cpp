#include "ribvault/print/perimeter_rows.hpp"

#include <algorithm>

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
    Box box;
    for (const ToolPath& path : layer.paths) {
        if (path.kind != TrackKind::outer_perimeter && path.kind != TrackKind::inner_perimeter) continue;
        for (std::size_t i = 0, n = path.points.size(); i + (path.closed ? 0 : 1) < n; ++i) {
            segments.push_back({path.points[i], path.points[(i + 1) % n]});
            box.add(path.points[i]);
            box.add(path.points[(i + 1) % n]);
        }
    }
    if (segments.empty()) return;
    box.grow(clearance);
    constexpr Unit most_rows = 256;
    bottom_ = box.lo.y;
    row_height_ = std::max((box.hi.y - box.lo.y) / most_rows, clearance) + 1;
    rows_.resize(static_cast<std::size_t>((box.hi.y - box.lo.y) / row_height_ + 1));
    for (const Segment& s : segments) {
        const auto [lo, hi] = std::minmax(s.a.y, s.b.y);
        const Unit last = (hi + clearance - bottom_) / row_height_;
        for (Unit row = (lo - clearance - bottom_) / row_height_; row <= last; ++row)
            rows_[static_cast<std::size_t>(row)].push_back(s);
    }
}

bool PerimeterRows::near(Point p) const {
    if (rows_.empty() || p.y < bottom_) return false;
    const auto row = static_cast<std::size_t>((p.y - bottom_) / row_height_);
    if (row >= rows_.size()) return false;
    return std::any_of(rows_[row].begin(), rows_[row].end(), [&](const Segment& s) {
        return distance(p, s) <= static_cast<double>(clearance_);
    });
}

}  // namespace ribvault
