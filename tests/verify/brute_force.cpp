#include "brute_force.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

namespace ribvault::test {

namespace {

double distance_to(const Segment& s, double x, double y) {
    const double dx = static_cast<double>(s.b.x - s.a.x), dy = static_cast<double>(s.b.y - s.a.y);
    const double vx = x - static_cast<double>(s.a.x), vy = y - static_cast<double>(s.a.y);
    const double n = dx * dx + dy * dy;
    const double t = n > 0 ? std::clamp((vx * dx + vy * dy) / n, 0.0, 1.0) : 0.0;
    return std::hypot(vx - t * dx, vy - t * dy);
}

// Negative inside.
double signed_distance(const Region& region, double x, double y) {
    double least = HUGE_VAL;
    int winding = 0;
    for (const Contour& c : region)
        for (std::size_t i = 0; i < c.size(); ++i) {
            const Segment s{c[i], c[(i + 1) % c.size()]};
            least = std::min(least, distance_to(s, x, y));
            const double ay = static_cast<double>(s.a.y), by = static_cast<double>(s.b.y);
            if ((ay <= y) == (by <= y)) continue;
            const double at = static_cast<double>(s.a.x) + (y - ay) / (by - ay) * static_cast<double>(s.b.x - s.a.x);
            if (at > x) winding += by > ay ? 1 : -1;
        }
    return winding != 0 ? -least : least;
}

// Distance to BS: the shell O \ int C and the tracks' material.
double distance_to_material(const Layer& l, double r, double x, double y) {
    double d = std::max({0.0, signed_distance(l.outline, x, y), -signed_distance(l.cavity, x, y)});
    for (const Segment& t : l.tracks) d = std::min(d, std::max(0.0, distance_to(t, x, y) - r));
    return d;
}

template <class F>
Truth largest(const Layer& upper, double r, double scale, const F& f) {
    struct Cell {
        double bound, x, y, half;
        bool operator<(const Cell& o) const { return bound < o.bound; }
    };
    Box box = bounding_box(upper.outline);
    for (const Segment& t : upper.tracks) box.add(t.a), box.add(t.b);
    box.grow(static_cast<Unit>(r));
    const double tolerance = 1e-9 * scale;
    std::priority_queue<Cell> open;
    bool near_zero = false;
    double best = -HUGE_VAL;
    const auto push = [&](double x, double y, double half) {
        const double diagonal = half * 1.41421357, m = distance_to_material(upper, r, x, y);
        if (m > diagonal) return;
        const double value = f(x, y);
        best = std::max(best, value - m);
        if (value + diagonal > -tolerance) {
            if (half > 1e-10 * scale)
                open.push({value + diagonal, x, y, half});
            else
                near_zero = true;
        }
    };
    push(static_cast<double>(box.lo.x + box.hi.x) / 2, static_cast<double>(box.lo.y + box.hi.y) / 2,
         static_cast<double>(std::max(box.hi.x - box.lo.x, box.hi.y - box.lo.y)) / 2 + 0.0123 * scale);
    for (int budget = 40000; !open.empty(); --budget) {
        if (best > 10 * tolerance) return Truth::unsupported;
        const Cell c = open.top();
        if (budget < 0) return c.bound < 0.01 * scale ? Truth::open : Truth::unsupported;
        open.pop();
        const double h = c.half / 2;
        for (const double dx : {-h, h})
            for (const double dy : {-h, h}) push(c.x + dx, c.y + dy, h);
    }
    if (best > 10 * tolerance) return Truth::unsupported;
    return near_zero ? Truth::tie : Truth::supported;
}

}  // namespace

Truth brute_force_internal(const Layer& upper, const Layer& lower, const Settings& s, double scale) {
    const double r = static_cast<double>(s.support_width) / 2, rho = static_cast<double>(s.support_radius);
    return largest(upper, r, scale, [&](double x, double y) {
        double f = -signed_distance(lower.cavity, x, y) - rho;
        for (const Segment& t : lower.tracks) f = std::min(f, distance_to(t, x, y) - r - rho);
        return f;
    });
}

Truth brute_force_external(const Layer& upper, const Layer& lower, const Settings& s, double scale) {
    const double r = static_cast<double>(s.support_width) / 2, rho = static_cast<double>(s.support_radius);
    return largest(upper, r, scale, [&](double x, double y) { return signed_distance(lower.outline, x, y) - rho; });
}

}  // namespace ribvault::test
