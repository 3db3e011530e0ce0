// How large M \ K is, from cells that are in it and cells that may be.
#include <algorithm>

#include "ribvault/verify/cell.hpp"

namespace ribvault::verify {

namespace {

bool overlap(const Window& p, const Window& q) {
    return std::max(p.lo_x, q.lo_x) < std::min(p.hi_x, q.hi_x) && std::max(p.lo_y, q.lo_y) < std::min(p.hi_y, q.hi_y);
}

/// Windows whose root cells do not overlap, in place of these.
std::vector<Window> apart(const Subdivision& s, std::span<const Window> windows) {
    std::vector<Window> result;
    for (Window window : windows) {
        for (std::size_t k = 0; k < result.size();) {
            if (!overlap(root_square(s, result[k]), root_square(s, window))) {
                ++k;
                continue;
            }
            window = {std::min(window.lo_x, result[k].lo_x), std::min(window.lo_y, result[k].lo_y), std::max(window.hi_x, result[k].hi_x),
                      std::max(window.hi_y, result[k].hi_y)};
            result[k] = result.back();
            result.pop_back();
            k = 0;
        }
        result.push_back(window);
    }
    return result;
}

double size(const Cell& cell) { return 4 * cell.half * cell.half; }

}  // namespace

AreaEnclosure enclose_area(const CoverProblem& problem, std::span<const Window> windows, int max_cells) {
    AreaEnclosure area;
    const Subdivision s = subdivision(problem);
    std::vector<Cell> level, next;
    Cell child;
    double uncovered = 0, open = 0, largest = 0;
    const auto enter = [&](CellState state) {
        if (state == CellState::open) {
            next.push_back(std::move(child));
        } else if (state == CellState::uncovered) {
            uncovered += size(child);
            if (child.half > area.half) area.x = child.x, area.y = child.y, area.half = child.half;
        }
    };
    const auto descend = [&] {
        std::swap(level, next);
        next.clear();
        open = largest = 0;
        for (const Cell& cell : level) open += size(cell), largest = std::max(largest, cell.half);
    };
    for (const Window& window : apart(s, windows)) enter(root_cell(s, window, child));
    descend();
    // The largest cells in each round, so that stopping after any round leaves an even enclosure.
    for (std::size_t cells = 4; open > 0.01 * (uncovered + open) && cells <= static_cast<std::size_t>(max_cells) && largest > 64 * s.margin;
         cells += 4 * level.size()) {
        for (Cell& cell : level) {
            if (cell.half <= largest / 2) {
                next.push_back(std::move(cell));
                continue;
            }
            refer_to_centre(s, cell);
            for (int i = 0; i < 4; ++i) enter(quarter(s, cell, i, child));
        }
        descend();
    }
    // Rounding of a few thousand sums: far below one part in 10^9.
    area.lo = uncovered * (1 - 1e-9);
    area.hi = (uncovered + open) * (1 + 1e-9);
    return area;
}

}  // namespace ribvault::verify
