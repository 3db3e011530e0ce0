#include "ribvault/verify/region_area.hpp"

#include <algorithm>
#include <cmath>

namespace ribvault::verify {

namespace {

struct AreaCell {
    double x, y, half;
    std::vector<int> pieces, sites;
};

enum class State { empty, uncovered, open };

constexpr double half_diagonal = 1.4142135623730952;

bool contains(const PreparedTrack& t, double reach, double x, double y, double half, double centre) {
    if (centre + half * half_diagonal <= reach) return true;
    if (centre + half > reach) return false;
    for (const double dx : {-half, half})
        for (const double dy : {-half, half})
            if (centre_distance(t, x + dx, y + dy) > reach) return false;
    return true;
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
    const auto classify = [&](const AreaCell& parent, AreaCell& cell) {
        const double reach = cell.half * half_diagonal + margin;
        cell.sites.clear(), cell.pieces.clear();
        for (const int k : parent.sites) {
            const PreparedTrack& t = lower.tracks[static_cast<std::size_t>(k)];
            const double d = centre_distance(t, cell.x, cell.y), r = t.half + rho;
            if (d > r + reach) continue;
            if (contains(t, r - margin, cell.x, cell.y, cell.half, d)) return State::empty;
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
        if (cell.pieces.empty()) return State::empty;
        return inside && cell.sites.empty() ? State::uncovered : State::open;
    };
    const auto size = [](const AreaCell& cell) { return 4 * cell.half * cell.half; };
    std::vector<AreaCell> level{std::move(root)}, next;
    double uncovered = 0, open = size(level.front());
    // Breadth first, so that stopping at any level leaves an even enclosure.
    for (std::size_t cells = 4; !level.empty() && open > 0.01 * (uncovered + open) &&
                                cells <= static_cast<std::size_t>(max_cells) && level.front().half > 4 * margin;
         cells += 4 * level.size()) {
        next.clear();
        AreaCell child;
        for (const AreaCell& cell : level)
            for (int i = 0; i < 4; ++i) {
                child.half = cell.half / 2;
                child.x = cell.x + (i & 1 ? child.half : -child.half);
                child.y = cell.y + (i & 2 ? child.half : -child.half);
                const State state = classify(cell, child);
                if (state == State::open) next.push_back(child);
                if (state != State::uncovered) continue;
                uncovered += size(child);
                if (child.half > area.half) area.x = child.x, area.y = child.y, area.half = child.half;
            }
        std::swap(level, next);
        open = level.empty() ? 0 : static_cast<double>(level.size()) * size(level.front());
    }
    // Rounding of some thousand sums: far below one part in 10^9.
    area.lo = uncovered * (1 - 1e-9);
    area.hi = (uncovered + open) * (1 + 1e-9);
    return area;
}

}  // namespace ribvault::verify
