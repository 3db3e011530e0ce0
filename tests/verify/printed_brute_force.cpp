#include "printed_brute_force.hpp"

#include <algorithm>

namespace ribvault::test {

namespace {

__extension__ typedef __int128 Wide;

// Whether (x, y) is within `reach` of the track's segment.
bool within(const GridTrack& t, std::int64_t x, std::int64_t y, std::int64_t reach) {
    const std::int64_t vx = x - t.ax, vy = y - t.ay, dx = t.bx - t.ax, dy = t.by - t.ay;
    const Wide rr = static_cast<Wide>(reach) * reach;
    const Wide ahead = static_cast<Wide>(vx) * dx + static_cast<Wide>(vy) * dy;
    const Wide norm = static_cast<Wide>(dx) * dx + static_cast<Wide>(dy) * dy;
    if (ahead <= 0) return static_cast<Wide>(vx) * vx + static_cast<Wide>(vy) * vy <= rr;
    if (ahead >= norm) {
        const std::int64_t wx = x - t.bx, wy = y - t.by;
        return static_cast<Wide>(wx) * wx + static_cast<Wide>(wy) * wy <= rr;
    }
    const Wide turn = static_cast<Wide>(dx) * vy - static_cast<Wide>(dy) * vx;
    // turn^2 <= reach^2 norm without 128 bits running over: |turn| / |d| is at most 2^31, compare in two steps.
    const long double quotient = static_cast<long double>(turn) * static_cast<long double>(turn),
                      bound = static_cast<long double>(rr) * static_cast<long double>(norm);
    if (quotient < bound * (1 - 1e-17L)) return true;
    if (quotient > bound * (1 + 1e-17L)) return false;
    return turn * turn <= rr * norm;
}
bool inside(const GridTrack& t, std::int64_t x, std::int64_t y) { return within(t, x, y, t.half); }
bool in_any(const std::vector<GridTrack>& tracks, std::int64_t x, std::int64_t y) {
    return std::any_of(tracks.begin(), tracks.end(), [&](const GridTrack& t) { return inside(t, x, y); });
}

struct Square {
    std::int64_t x, y, side;  // lower left corner
};

Printed areas_of(const GridTrack& m, const std::vector<GridTrack>& lower) {
    std::int64_t side = 1;
    const std::int64_t lo_x = std::min(m.ax, m.bx) - m.half, lo_y = std::min(m.ay, m.by) - m.half;
    const std::int64_t extent = std::max(std::max(m.ax, m.bx) + m.half - lo_x, std::max(m.ay, m.by) + m.half - lo_y);
    while (side < extent) side *= 2;
    std::vector<Square> level{{lo_x, lo_y, side}}, next;
    for (int budget = 60000; !level.empty(); std::swap(level, next)) {
        next.clear();
        for (const Square& q : level) {
            if (--budget < 0) return Printed::open;
            // Doubled coordinates put the centre on the grid; the half diagonal is at most 0.7072 side + 1.
            const GridTrack twice{2 * m.ax, 2 * m.ay, 2 * m.bx, 2 * m.by, 0};
            const std::int64_t reach = 2 * m.half + (q.side * 14143) / 10000 + 2;
            if (!within(twice, 2 * q.x + q.side, 2 * q.y + q.side, reach)) continue;
            const std::int64_t xs[] = {q.x, q.x + q.side, q.x, q.x + q.side};
            const std::int64_t ys[] = {q.y, q.y, q.y + q.side, q.y + q.side};
            const bool settled = std::any_of(lower.begin(), lower.end(), [&](const GridTrack& t) {
                return inside(t, xs[0], ys[0]) && inside(t, xs[1], ys[1]) && inside(t, xs[2], ys[2]) &&
                       inside(t, xs[3], ys[3]);
            });
            if (settled) continue;
            for (int i = 0; i < 4; ++i)
                if (inside(m, xs[i], ys[i]) && !in_any(lower, xs[i], ys[i])) return Printed::unsupported;
            if (q.side == 1) return Printed::tie;
            const std::int64_t h = q.side / 2;
            for (const std::int64_t dx : {std::int64_t{0}, h})
                for (const std::int64_t dy : {std::int64_t{0}, h}) next.push_back({q.x + dx, q.y + dy, h});
        }
    }
    return Printed::supported;
}

Printed line_of(const GridTrack& m, const std::vector<GridTrack>& lower, int steps) {
    const std::int64_t parts = std::int64_t{1} << steps, dx = (m.bx - m.ax) / parts, dy = (m.by - m.ay) / parts;
    struct Piece {
        std::int64_t from, size;
    };
    std::vector<Piece> open{{0, parts}};
    bool tie = false;
    while (!open.empty()) {
        const Piece p = open.back();
        open.pop_back();
        const std::int64_t x0 = m.ax + p.from * dx, y0 = m.ay + p.from * dy, x1 = x0 + p.size * dx,
                           y1 = y0 + p.size * dy;
        if (!in_any(lower, x0, y0) || !in_any(lower, x1, y1)) return Printed::unsupported;
        if (std::any_of(lower.begin(), lower.end(),
                        [&](const GridTrack& t) { return inside(t, x0, y0) && inside(t, x1, y1); }))
            continue;
        if (p.size == 1) {
            tie = true;
            continue;
        }
        open.push_back({p.from, p.size / 2});
        open.push_back({p.from + p.size / 2, p.size / 2});
    }
    return tie ? Printed::tie : Printed::supported;
}

// Unsupported if any is; then open, then a tie.
template <class F>
Printed worst(const std::vector<GridTrack>& upper, const F& f) {
    bool tie = false, open = false;
    for (const GridTrack& m : upper) {
        const Printed p = f(m);
        if (p == Printed::unsupported) return p;
        tie = tie || p == Printed::tie, open = open || p == Printed::open;
    }
    return open ? Printed::open : tie ? Printed::tie : Printed::supported;
}

}  // namespace

Printed printed_areas(const std::vector<GridTrack>& upper, const std::vector<GridTrack>& lower) {
    return worst(upper, [&](const GridTrack& m) { return areas_of(m, lower); });
}
Printed printed_lines(const std::vector<GridTrack>& upper, const std::vector<GridTrack>& lower, int steps) {
    return worst(upper, [&](const GridTrack& m) { return line_of(m, lower, steps); });
}

}  // namespace ribvault::test
