#include "ribvault/print/reach_perimeters.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace ribvault {
namespace {

struct WallEnd {
    Point at, before;  ///< `before` lies on the wall, far enough back to say where it goes
    Unit width;
};

WallEnd end_of_wall(const ToolPath& path, bool at_back, Unit far) {
    const std::vector<Point>& points = path.points;
    const std::size_t n = points.size();
    const auto from_end = [&](std::size_t k) { return at_back ? points[n - 1 - k] : points[k]; };
    std::size_t k = 1;
    while (k + 1 < n && length(from_end(k) - from_end(0)) < static_cast<double>(far)) ++k;
    return {from_end(0), from_end(k), path.width};
}

class Reach {
public:
    Reach(const NearestSegment& perimeters, const NearestSegment& outline, Unit w)
        : perimeters_(perimeters), outline_(outline), w_(w), width_(static_cast<double>(w)) {}

    /// Where the wall goes on to; nothing when it stays.
    std::optional<Point> beyond(const WallEnd& end) const {
        const NearestSegment::Hit hit = perimeters_.nearest(end.at);
        const double far = std::sqrt(hit.distance.value());
        if (far <= width_ / 2 || far > touching(w_, end.width)) return {};
        const Point ahead = end.at - end.before;
        if (std::optional<Point> on = straight_on(end.at, ahead, far); on && has_room({end.at, *on}, end.width))
            return on;
        const Point nearest = nearest_point(end.at, perimeters_.segments()[hit.index]), across = nearest - end.at;
        const double along = static_cast<double>(ahead.x) * static_cast<double>(across.x) +
                             static_cast<double>(ahead.y) * static_cast<double>(across.y);
        if (2 * along < length(ahead) * length(across)) return {};
        const Point to = part_way(nearest, end.at, width_ / 2 / far);
        return has_room({end.at, to}, end.width) ? std::optional(to) : std::nullopt;
    }

private:
    std::optional<Point> straight_on(Point from, Point ahead, double far) const {
        const double unit = length(ahead);
        if (unit == 0) return {};
        Point at = from;
        // By the distance that is left, which no perimeter can be nearer than; a hundredth of a track counts as there.
        for (double way = 0; far > 0.51 * width_;) {
            way += far - width_ / 2;
            if (way > 2 * width_) return {};
            at = part_way(from, from + ahead, way / unit);
            far = std::sqrt(perimeters_.nearest(at).distance.value());
        }
        return at;
    }

    bool has_room(const Segment& centre, Unit wide) const {
        double wanted = static_cast<double>(wide) / 2;
        const Box near = bounding_box(centre, wide / 2);
        const Segment from{centre.a, centre.a};
        outline_.visit(near,
                       [&](std::uint32_t k) { wanted = std::min(wanted, distance(outline_.segments()[k], from)); });
        bool room = true;
        outline_.visit(near, [&](std::uint32_t k) {
            if (room) room = distance(outline_.segments()[k], centre) >= wanted - 2;
        });
        return room;
    }

    const NearestSegment& perimeters_;
    const NearestSegment& outline_;
    Unit w_;
    double width_;  ///< w_
};

}  // namespace

void reach_perimeters(std::vector<PlannedTrack>& walls, const NearestSegment& perimeters, const NearestSegment& outline,
                      Unit w) {
    if (perimeters.empty()) return;
    const Reach reach(perimeters, outline, w);
    for (PlannedTrack& wall : walls) {
        std::vector<Point>&first = wall.paths.front().points, &last = wall.paths.back().points;
        if (first.front() == last.back()) continue;  // a ring, or a dot
        const std::optional<Point> front = reach.beyond(end_of_wall(wall.paths.front(), false, w / 4)),
                                   back = reach.beyond(end_of_wall(wall.paths.back(), true, w / 4));
        if (front) first.insert(first.begin(), *front);
        if (back) last.push_back(*back);
    }
}

}  // namespace ribvault
