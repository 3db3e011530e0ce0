// How large M \ K is, from cells that are in it and cells that may be.
#include <algorithm>

#include "ribvault/verify/cell.hpp"

namespace ribvault::verify {

AreaEnclosure enclose_area(const CoverProblem& problem, const Window& window, int max_cells) {
    AreaEnclosure area;
    if (window.lo_x > window.hi_x || window.lo_y > window.hi_y) return area;
    const Subdivision s = subdivision(problem);
    std::vector<Cell> level{root_cell(s, window)}, next;
    Cell child;
    const auto size = [](const Cell& cell) { return 4 * cell.half * cell.half; };
    double uncovered = 0, open = size(level.front());
    // Breadth first, so that stopping at any level leaves an even enclosure.
    for (std::size_t cells = 4; !level.empty() && open > 0.01 * (uncovered + open) &&
                                cells <= static_cast<std::size_t>(max_cells) && level.front().half > 64 * s.margin;
         cells += 4 * level.size()) {
        next.clear();
        for (Cell& cell : level) {
            refer_to_centre(s, cell);
            for (int i = 0; i < 4; ++i) {
                const CellState state = quarter(s, cell, i, child);
                if (state == CellState::open) {
                    next.push_back(std::move(child));
                } else if (state == CellState::uncovered) {
                    uncovered += size(child);
                    if (child.half > area.half) area.x = child.x, area.y = child.y, area.half = child.half;
                }
            }
        }
        std::swap(level, next);
        open = level.empty() ? 0 : static_cast<double>(level.size()) * size(level.front());
    }
    // Rounding of a few thousand sums: far below one part in 10^9.
    area.lo = uncovered * (1 - 1e-9);
    area.hi = (uncovered + open) * (1 + 1e-9);
    return area;
}

}  // namespace ribvault::verify
