// Slow and plain geometry to check results against.
#pragma once

#include <algorithm>
#include <cmath>

#include "ribvault/print/tool_path.hpp"

namespace ribvault::test {

inline double distance(Point p, Segment s) {
    const long double dx = s.b.x - s.a.x, dy = s.b.y - s.a.y, tx = p.x - s.a.x, ty = p.y - s.a.y;
    const long double square = dx * dx + dy * dy;
    const long double t = square > 0 ? std::clamp((tx * dx + ty * dy) / square, 0.0L, 1.0L) : 0.0L;
    return static_cast<double>(std::hypot(tx - t * dx, ty - t * dy));
}

inline int side(Point a, Point b, Point p) {
    const long double cross = static_cast<long double>(b.x - a.x) * static_cast<long double>(p.y - a.y) -
                              static_cast<long double>(b.y - a.y) * static_cast<long double>(p.x - a.x);
    return cross > 0 ? 1 : cross < 0 ? -1 : 0;
}

inline double distance(Segment s, Segment t) {
    if (side(s.a, s.b, t.a) * side(s.a, s.b, t.b) < 0 && side(t.a, t.b, s.a) * side(t.a, t.b, s.b) < 0) return 0;
    return std::min({distance(s.a, t), distance(s.b, t), distance(t.a, s), distance(t.b, s)});
}

inline std::vector<Segment> segments(const ToolPath& path) {
    std::vector<Segment> all;
    for (std::size_t i = 1; i < path.points.size(); ++i) all.push_back({path.points[i - 1], path.points[i]});
    if (path.closed) all.push_back({path.points.back(), path.points.front()});
    return all;
}

inline std::vector<Segment> segments(const Region& region) {
    std::vector<Segment> all;
    for (const Contour& c : region)
        for (std::size_t i = 0; i < c.size(); ++i) all.push_back({c[i], c[(i + 1) % c.size()]});
    return all;
}

inline double distance(const std::vector<Segment>& a, const std::vector<Segment>& b) {
    double nearest = INFINITY;
    for (const Segment& s : a)
        for (const Segment& t : b) nearest = std::min(nearest, test::distance(s, t));
    return nearest;
}

inline int winding_number(const Region& region, Point p) {
    int winding = 0;
    for (const Segment& s : segments(region)) {
        if (s.a.y <= p.y && s.b.y > p.y && side(s.a, s.b, p) > 0) ++winding;
        if (s.a.y > p.y && s.b.y <= p.y && side(s.a, s.b, p) < 0) --winding;
    }
    return winding;
}

}  // namespace ribvault::test
