#include "ribvault/verify/greatest_distance.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

namespace ribvault::verify {

namespace {

// Both searches use that the distance to one stadium is convex: over a segment or a square it is greatest at an end or
// a corner. So is the distance to the material, which is no greater, than the greatest of those of any one stadium.

struct Interval1 {
    double bound, from, to;
    bool operator<(const Interval1& o) const { return bound < o.bound; }
};

struct Cell2 {
    double bound, x, y, half;
    std::size_t piece;
    bool operator<(const Cell2& o) const { return bound < o.bound; }
};

double to_stadium(const PreparedTrack& t, double x, double y) { return centre_distance(t, x, y) - t.half; }

}  // namespace

Farthest farthest_on_line(const PreparedTrack& track, double from, double to, const LowerTracks& lower) {
    Farthest best{-HUGE_VAL, HUGE_VAL, track.ax, track.ay};
    const double ux = track.length > 0 ? track.dx / track.length : 0,
                 uy = track.length > 0 ? track.dy / track.length : 0;
    if (lower.tracks.empty()) return {HUGE_VAL, HUGE_VAL, track.ax + from * ux, track.ay + from * uy};
    const auto evaluate = [&](double s) {
        const double x = track.ax + s * ux, y = track.ay + s * uy;
        double distance = 0;
        const int k = lower.grid.nearest(x, y, distance);
        if (distance > best.lo) best.lo = distance, best.x = x, best.y = y;
        return k;
    };
    const auto bound = [&](int k, double s, double t) {
        const PreparedTrack& below = lower.tracks[static_cast<std::size_t>(k)];
        return std::max(to_stadium(below, track.ax + s * ux, track.ay + s * uy),
                        to_stadium(below, track.ax + t * ux, track.ay + t * uy));
    };
    std::priority_queue<Interval1> open;
    const int first = evaluate(from), last = evaluate(to);
    open.push({std::min(bound(first, from, to), bound(last, from, to)), from, to});
    const double tolerance = 1e-9 * (to - from) + 2 * lower.margin;
    for (int budget = 300; budget > 0 && open.top().bound > best.lo + tolerance; --budget) {
        const Interval1 i = open.top();
        open.pop();
        const double middle = (i.from + i.to) / 2;
        const int k = evaluate(middle);
        open.push({std::min(i.bound, bound(k, i.from, middle)), i.from, middle});
        open.push({std::min(i.bound, bound(k, middle, i.to)), middle, i.to});
    }
    best.hi = std::max(open.top().bound, best.lo) + 2 * lower.margin;
    best.lo -= 2 * lower.margin;
    return best;
}

Farthest farthest_in(std::span<const PreparedTrack> pieces, const LowerTracks& lower, int effort) {
    Farthest best{-HUGE_VAL, HUGE_VAL, pieces[0].ax, pieces[0].ay};
    if (lower.tracks.empty()) return {HUGE_VAL, HUGE_VAL, best.x, best.y};
    std::priority_queue<Cell2> open;
    const auto push = [&](double x, double y, double half, std::size_t piece, double bound) {
        const PreparedTrack& p = pieces[piece];
        const double inside = centre_distance(p, x, y);
        if (inside - p.half > half * 1.4142136 + lower.margin) return;
        double distance = 0;
        const int k = lower.grid.nearest(x, y, distance);
        bound = std::min(bound, distance + half * 1.4142136);
        const PreparedTrack& below = lower.tracks[static_cast<std::size_t>(k)];
        bound =
            std::min(bound, std::max({to_stadium(below, x - half, y - half), to_stadium(below, x + half, y - half),
                                      to_stadium(below, x - half, y + half), to_stadium(below, x + half, y + half)}));
        if (bound <= best.lo) return;
        double px = x, py = y;
        if (inside > 0 && inside > p.half - lower.margin) {
            // Drawn into the stadium, towards its centre line.
            double t = ((x - p.ax) * p.dx + (y - p.ay) * p.dy) * p.inverse_norm;
            t = std::clamp(t, 0.0, 1.0);
            const double fx = p.ax + t * p.dx, fy = p.ay + t * p.dy, by = std::max(0.0, p.half - lower.margin) / inside;
            px = fx + (x - fx) * by, py = fy + (y - fy) * by;
            lower.grid.nearest(px, py, distance);
        }
        if (distance > best.lo) best.lo = distance, best.x = px, best.y = py;
        open.push({bound, x, y, half, piece});
    };
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const PreparedTrack& p = pieces[i];
        push((p.ax + p.bx) / 2, (p.ay + p.by) / 2, std::max(std::abs(p.dx), std::abs(p.dy)) / 2 + p.half, i, HUGE_VAL);
    }
    while (effort > 0 && !open.empty() && open.top().bound > best.lo + 1e-3 * std::abs(best.lo) + 4 * lower.margin) {
        const Cell2 c = open.top();
        open.pop();
        for (const double dx : {-c.half / 2, c.half / 2})
            for (const double dy : {-c.half / 2, c.half / 2}) push(c.x + dx, c.y + dy, c.half / 2, c.piece, c.bound);
        effort -= 4;
    }
    best.hi = std::max(open.empty() ? best.lo : open.top().bound, best.lo) + 2 * lower.margin;
    best.lo -= 2 * lower.margin;
    return best;
}

}  // namespace ribvault::verify
