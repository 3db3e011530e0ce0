// How large M \ K is, from cells that are in it and cells that may be.
#include <algorithm>

#include "ribvault/verify/cell.hpp"

namespace ribvault::verify {

AreaEnclosure enclose_area(const CoverProblem& problem, const Window& window, int max_cells) {
    AreaEnclosure area;
    if (window.lo_x > window.hi_x || window.lo_y > window.hi_y) return area;
    const Subdivision s = subdivision(problem);
    std::vector<Cell> level{root_cell(s, window)}, next;
    double uncovered = 0, open = 0;
    // Breadth first, so that stopping at any level leaves an even enclosure.
    for (int cells = 0;;) {
        std::vector<const Cell*> open_cells;
        open = 0;
        for (const Cell& cell : level) {
            const CellState state = state_of(s, cell);
            const double size = 4 * cell.half * cell.half;
            if (state == CellState::uncovered) {
                uncovered += size;
                if (cell.half > area.half) area.x = cell.x, area.y = cell.y, area.half = cell.half;
            } else if (state == CellState::open) {
                open += size;
                open_cells.push_back(&cell);
            }
        }
        cells += static_cast<int>(level.size());
        if (open <= 0.01 * (uncovered + open) || cells + 4 * static_cast<int>(open_cells.size()) > max_cells ||
            (!level.empty() && level.front().half < 64 * s.margin))
            break;
        next.clear();
        next.reserve(4 * open_cells.size());
        for (const Cell* cell : open_cells)
            for (int i = 0; i < 4; ++i) next.push_back(quarter(s, *cell, i));
        std::swap(level, next);
    }
    // Rounding of a few thousand sums: far below one part in 10^9.
    area.lo = uncovered * (1 - 1e-9);
    area.hi = (uncovered + open) * (1 + 1e-9);
    return area;
}

}  // namespace ribvault::verify
