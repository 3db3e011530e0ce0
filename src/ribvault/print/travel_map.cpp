#include "ribvault/print/travel_map.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "ribvault/exact/nearest_segment.hpp"

namespace ribvault {
namespace {

/// How far along ab, from 0 to 1, it meets the line of cd; nothing when they are parallel. Rounded.
std::optional<double> parameter(Point a, Point b, Point c, Point d) {
    const double ux = static_cast<double>(b.x - a.x), uy = static_cast<double>(b.y - a.y);
    const double vx = static_cast<double>(d.x - c.x), vy = static_cast<double>(d.y - c.y);
    const double det = ux * vy - uy * vx;
    if (det == 0) return std::nullopt;
    return (static_cast<double>(c.x - a.x) * vy - static_cast<double>(c.y - a.y) * vx) / det;
}

double length_of(Point from, const std::vector<Point>& via) {
    double sum = 0;
    for (Point p : via) sum += length(p - from), from = p;
    return sum;
}

/// The vertex of a contour nearest to p.
std::size_t nearest_vertex(const Contour& contour, Point p, double& far) {
    std::size_t best = 0;
    far = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < contour.size(); ++i)
        if (const double d = length(contour[i] - p); d < far) far = d, best = i;
    return best;
}

}  // namespace

TravelMap::TravelMap(const Region& outline, const Region& cavity, const LayerPaths& layer)
    : known_(true), outline_(edges_of(outline)), cavity_(edges_of(cavity)) {
    for (const ToolPath& path : layer.paths)
        if (path.kind == TrackKind::outer_perimeter && path.closed) {
            perimeters_.push_back(path.points);
            for (Box& box = boxes_.emplace_back(); Point p : path.points) box.add(p);
        }
}

bool TravelMap::sees(Point a, Point b) const {
    const auto [lo, hi] = std::minmax(a.y, b.y);
    return !outline_.any(lo, hi, [&](const Segment& s) { return segments_touch({a, b}, s); });
}

Travel TravelMap::travel(Point from, Point to, double longest_detour) const {
    Travel way{{to}, length(to - from), false, 0};
    if (!known_) {
        way.open_air = way.length;
        return way;
    }
    if (!sees(from, to)) {
        std::vector<Point> via;
        int views_left = 400;
        if (detour(from, to, 3, views_left, via) && length_of(from, via) <= way.length + longest_detour)
            way.via = std::move(via), way.length = length_of(from, way.via);
        else
            way.leaves_island = true;
    }
    for (Point p : way.via) way.open_air += over_cavity(from, p), from = p;
    return way;
}

bool TravelMap::detour(Point from, Point to, int contours_left, int& views_left, std::vector<Point>& via) const {
    if (contours_left == 0 || perimeters_.empty()) return false;
    double first = 2, last = -1;
    const auto [lo, hi] = std::minmax(from.y, to.y);
    outline_.any(lo, hi, [&](const Segment& s) {
        if (!segments_touch({from, to}, s)) return false;
        if (const auto t = parameter(from, to, s.a, s.b)) first = std::min(first, *t), last = std::max(last, *t);
        return false;
    });
    if (last < first) return false;
    const Contour* ring = nullptr;
    std::size_t enter = 0;
    double nearest = std::numeric_limits<double>::infinity();
    const Point crossed = part_way(from, to, first);
    for (std::size_t k = 0; k < perimeters_.size(); ++k) {
        if (squared_distance_below(crossed, boxes_[k]) > nearest * nearest) continue;
        double far = 0;
        const std::size_t vertex = nearest_vertex(perimeters_[k], crossed, far);
        if (far < nearest) nearest = far, ring = &perimeters_[k], enter = vertex;
    }
    double far = 0;
    const std::size_t n = ring->size(), leave = nearest_vertex(*ring, part_way(from, to, last), far);
    std::vector<Point> best;
    double shortest = std::numeric_limits<double>::infinity();
    for (const std::size_t step : {std::size_t{1}, n - 1}) {
        std::vector<Point> way;
        for (std::size_t i = enter;; i = (i + step) % n) {
            way.push_back((*ring)[i]);
            if (i == leave) break;
        }
        way.push_back(to);
        if (const double l = length_of(from, way); l < shortest) shortest = l, best = std::move(way);
    }
    // From each point on to the farthest that is in view, at most 24 tried.
    Point here = from;
    for (std::size_t next = 0; next < best.size();) {
        std::size_t seen = best.size();
        const std::size_t left = best.size() - next, stride = std::max<std::size_t>(1, left / 24);
        for (std::size_t j = best.size() - 1;; j = j >= next + stride ? j - stride : next) {
            if (--views_left < 0) return false;
            if (sees(here, best[j])) {
                seen = j;
                break;
            }
            if (j == next) break;
        }
        if (seen == best.size()) {
            // The last leg crosses another contour; nothing else may.
            if (next + 1 != best.size()) return false;
            return detour(here, to, contours_left - 1, views_left, via);
        }
        via.push_back(best[seen]);
        here = best[seen];
        next = seen + 1;
    }
    return true;
}

bool TravelMap::in_cavity(double x, double y) const { return cavity_.winding(x, y) != 0; }

double TravelMap::over_cavity(Point a, Point b) const {
    std::vector<double> cuts{0, 1};
    const auto [lo, hi] = std::minmax(a.y, b.y);
    cavity_.any(lo, hi, [&](const Segment& s) {
        if (segments_touch({a, b}, s))
            if (const auto t = parameter(a, b, s.a, s.b); t && *t > 0 && *t < 1) cuts.push_back(*t);
        return false;
    });
    std::sort(cuts.begin(), cuts.end());
    const double whole = length(b - a);
    double sum = 0;
    for (std::size_t i = 1; i < cuts.size(); ++i) {
        const double piece = (cuts[i] - cuts[i - 1]) * whole, middle = (cuts[i] + cuts[i - 1]) / 2;
        if (piece < 1) continue;
        if (in_cavity(static_cast<double>(a.x) + middle * static_cast<double>(b.x - a.x),
                      static_cast<double>(a.y) + middle * static_cast<double>(b.y - a.y)))
            sum += piece;
    }
    return sum;
}

}  // namespace ribvault
