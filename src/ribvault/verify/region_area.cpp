#include "ribvault/verify/region_area.hpp"

#include <algorithm>
#include <cmath>

namespace ribvault::verify {

namespace {

struct AreaCell {
    double x = 0, y = 0, half = 0;
    double lo = 0, hi = 0;  // enclosure of what of the cell is uncovered
    std::vector<int> pieces, sites;
    bool operator<(const AreaCell& o) const { return hi - lo < o.hi - o.lo; }
};

constexpr double half_diagonal = 1.4142135623730952;

bool contains(const PreparedTrack& t, double reach, double x, double y, double half, double centre) {
    if (centre + half * half_diagonal <= reach) return true;
    if (centre + half > reach) return false;
    for (const double dx : {-half, half})
        for (const double dy : {-half, half})
            if (centre_distance(t, x + dx, y + dy) > reach) return false;
    return true;
}

struct Corner {
    double x, y;
};

// The convex polygon without what has nx x + ny y < least.
void clip(std::vector<Corner>& polygon, std::vector<Corner>& scratch, double nx, double ny, double least) {
    scratch.clear();
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Corner &p = polygon[i], &q = polygon[i + 1 == polygon.size() ? 0 : i + 1];
        const double u = nx * p.x + ny * p.y - least, v = nx * q.x + ny * q.y - least;
        if (u >= 0) scratch.push_back(p);
        if ((u > 0 && v < 0) || (u < 0 && v > 0)) {
            const double t = u / (u - v);
            scratch.push_back({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)});
        }
    }
    std::swap(polygon, scratch);
}
double area_of(const std::vector<Corner>& polygon) {
    double twice = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Corner &p = polygon[i], &q = polygon[i + 1 == polygon.size() ? 0 : i + 1];
        twice += p.x * q.y - p.y * q.x;
    }
    return std::max(0.0, twice / 2);
}

// The distance f to a segment is convex, so it is at least its tangent plane at the cell's centre c; and its second
// derivative is at most 1 / f, so it is at most that plane plus |p - c|^2 / (2 least f). In the cell |p - c|^2 <= 2
// half^2 and f >= f(c) - |p - c|. `above` is the second bound's surplus over the first.
struct Tangent {
    double nx = 0, ny = 0, at = 0, above = HUGE_VAL;  // f about at + n.(p - c)
};
Tangent tangent(const PreparedTrack& t, const AreaCell& cell) {
    const double vx = cell.x - t.ax, vy = cell.y - t.ay;
    const double along = std::clamp((vx * t.dx + vy * t.dy) * t.inverse_norm, 0.0, 1.0);
    Tangent f;
    f.nx = vx - along * t.dx, f.ny = vy - along * t.dy;
    f.at = std::sqrt(f.nx * f.nx + f.ny * f.ny);
    const double least = f.at - cell.half * half_diagonal;
    if (least <= 0) return f;
    f.nx /= f.at, f.ny /= f.at;
    f.above = cell.half * cell.half / least;
    return f;
}

// Encloses what of an open cell is in the one piece (none: all of it is) and outside all sites.
void enclose_open(AreaCell& cell, const PreparedTrack* piece, const LowerTracks& lower, double rho) {
    cell.lo = 0, cell.hi = 4 * cell.half * cell.half;
    if (cell.sites.size() > 8) return;
    std::vector<Corner> least{
        {-cell.half, -cell.half}, {cell.half, -cell.half}, {cell.half, cell.half}, {-cell.half, cell.half}};
    std::vector<Corner> most = least, scratch;
    bool certain = true;  // `least` needs all of the bounds; `most` may leave some out
    const auto outside = [&](const PreparedTrack& t, double radius) {
        const Tangent f = tangent(t, cell);
        if (f.above == HUGE_VAL) {
            certain = false;
            return;
        }
        clip(least, scratch, f.nx, f.ny, radius + lower.margin - f.at);
        clip(most, scratch, f.nx, f.ny, radius - lower.margin - f.above - f.at);
    };
    for (const int k : cell.sites) {
        const PreparedTrack& t = lower.tracks[static_cast<std::size_t>(k)];
        outside(t, t.half + rho);
    }
    if (piece) {
        const Tangent f = tangent(*piece, cell);
        certain = certain && f.above != HUGE_VAL;
        if (f.above != HUGE_VAL) {
            clip(least, scratch, -f.nx, -f.ny, f.at + f.above + lower.margin - piece->half);
            clip(most, scratch, -f.nx, -f.ny, f.at - lower.margin - piece->half);
        }
    }
    if (certain) cell.lo = area_of(least) * (1 - 1e-9);
    cell.hi = std::min(cell.hi, area_of(most) * (1 + 1e-9) + cell.half * lower.margin);
    cell.lo = std::min(cell.lo, cell.hi);
}

}  // namespace

RegionArea enclose_region_area(std::span<const PreparedTrack> pieces, const LowerTracks& lower, double rho,
                               int max_cells) {
    RegionArea area;
    double lo_x = HUGE_VAL, lo_y = HUGE_VAL, hi_x = -HUGE_VAL, hi_y = -HUGE_VAL;
    AreaCell root;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const PreparedTrack& p = pieces[i];
        lo_x = std::min(lo_x, std::min(p.ax, p.bx) - p.half), hi_x = std::max(hi_x, std::max(p.ax, p.bx) + p.half);
        lo_y = std::min(lo_y, std::min(p.ay, p.by) - p.half), hi_y = std::max(hi_y, std::max(p.ay, p.by) + p.half);
        root.pieces.push_back(static_cast<int>(i));
    }
    root.x = (lo_x + hi_x) / 2, root.y = (lo_y + hi_y) / 2;
    root.half = std::max(hi_x - lo_x, hi_y - lo_y) / 2 + lower.margin;
    lower.grid.near(root.x, root.y, root.half * half_diagonal + lower.margin, root.sites);

    const double margin = lower.margin;
    // Whether anything of the cell may be uncovered; its enclosure.
    const auto classify = [&](const AreaCell& parent, AreaCell& cell) {
        const double reach = cell.half * half_diagonal + margin;
        cell.sites.clear(), cell.pieces.clear();
        for (const int k : parent.sites) {
            const PreparedTrack& t = lower.tracks[static_cast<std::size_t>(k)];
            const double d = centre_distance(t, cell.x, cell.y), r = t.half + rho;
            if (d > r + reach) continue;
            if (contains(t, r - margin, cell.x, cell.y, cell.half, d)) return false;
            cell.sites.push_back(k);
        }
        bool inside = false;
        for (const int i : parent.pieces) {
            const PreparedTrack& t = pieces[static_cast<std::size_t>(i)];
            const double d = centre_distance(t, cell.x, cell.y);
            if (d > t.half + reach) continue;
            inside = inside || contains(t, t.half - margin, cell.x, cell.y, cell.half, d);
            cell.pieces.push_back(i);
        }
        if (cell.pieces.empty()) return false;
        if (inside && cell.sites.empty()) {
            cell.lo = cell.hi = 4 * cell.half * cell.half;
            if (cell.half > area.half) area.x = cell.x, area.y = cell.y, area.half = cell.half;
        } else if (inside || cell.pieces.size() == 1) {
            enclose_open(cell, inside ? nullptr : &pieces[static_cast<std::size_t>(cell.pieces.front())], lower, rho);
        } else {
            cell.lo = 0, cell.hi = 4 * cell.half * cell.half;
        }
        return true;
    };
    std::vector<AreaCell> open;  // a heap
    root.hi = 4 * root.half * root.half;
    double lo = 0, hi = root.hi, settled = 0;
    open.push_back(std::move(root));
    AreaCell child;
    for (int cells = 0; !open.empty() && hi - lo > 0.01 * hi && cells < max_cells && open.front().half > 4 * margin;
         cells += 4) {
        std::pop_heap(open.begin(), open.end());
        const AreaCell cell = std::move(open.back());
        open.pop_back();
        lo -= cell.lo, hi -= cell.hi;
        for (int i = 0; i < 4; ++i) {
            child.half = cell.half / 2;
            child.x = cell.x + (i & 1 ? child.half : -child.half);
            child.y = cell.y + (i & 2 ? child.half : -child.half);
            if (!classify(cell, child)) continue;
            lo += child.lo, hi += child.hi;
            if (child.hi <= child.lo) {
                settled += child.lo;
                continue;
            }
            open.push_back(child);
            std::push_heap(open.begin(), open.end());
        }
    }
    // Summed anew, without differences: the rounding of some thousand sums is far below one part in 10^9.
    lo = hi = settled;
    for (const AreaCell& cell : open) lo += cell.lo, hi += cell.hi;
    area.lo = lo * (1 - 1e-9), area.hi = hi * (1 + 1e-9);
    return area;
}

}  // namespace ribvault::verify
