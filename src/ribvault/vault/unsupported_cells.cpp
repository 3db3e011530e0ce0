#include "ribvault/vault/unsupported_cells.hpp"

#include <algorithm>

#include "ribvault/exact/nearest_segment.hpp"

namespace ribvault {
namespace {

constexpr Unit cell_pixels = 8;

Unit floor_div(Unit a, Unit b) { return a >= 0 ? a / b : -((b - 1 - a) / b); }

}  // namespace

UnsupportedCells::UnsupportedCells(const Region& unsupported, const Settings& settings)
    : pitch_(settings.sampling_pitch),
      radius_(settings.reach_of_support()),
      slack_(settings.slack),
      location_(edges_of(unsupported), settings.sampling_pitch) {
    const Unit size = cell_pixels * pitch_;
    const Box& box = location_.box();
    const Unit x0 = floor_div(box.lo.x, size), x1 = floor_div(box.hi.x, size);
    const Unit y0 = floor_div(box.lo.y, size), y1 = floor_div(box.hi.y, size);
    std::vector<std::uint64_t> row(static_cast<std::size_t>(x1 - x0 + 1));
    std::vector<std::pair<double, int>> crossings;
    for (Unit cy = y0; cy <= y1; ++cy) {
        std::fill(row.begin(), row.end(), 0);
        for (Unit line = 0; line < cell_pixels; ++line) {
            const Unit y = cy * size + line * pitch_ + pitch_ / 2;
            crossings.clear();
            location_.visit_crossings(y, [&](const Segment& e, int winding) {
                const double t = static_cast<double>(y - e.a.y) / static_cast<double>(e.b.y - e.a.y);
                crossings.push_back({static_cast<double>(e.a.x) + t * static_cast<double>(e.b.x - e.a.x), winding});
            });
            std::sort(crossings.begin(), crossings.end());
            int winding = 0;
            for (std::size_t k = 0; k + 1 < crossings.size(); ++k) {
                winding += crossings[k].second;
                if (winding == 0) continue;
                const double half = static_cast<double>(pitch_ / 2), pitch = static_cast<double>(pitch_);
                const Unit first = static_cast<Unit>(std::ceil((crossings[k].first - half) / pitch));
                const Unit last = static_cast<Unit>(std::floor((crossings[k + 1].first - half) / pitch));
                for (Unit px = first; px <= last; ++px) {
                    const Unit cx = floor_div(px, cell_pixels);
                    row[static_cast<std::size_t>(cx - x0)] |= std::uint64_t{1}
                                                              << (line * cell_pixels + (px - cx * cell_pixels));
                }
            }
        }
        for (Unit cx = x0; cx <= x1; ++cx) {
            const Cell cell{{{cx * size, cy * size}, {(cx + 1) * size, (cy + 1) * size}},
                            row[static_cast<std::size_t>(cx - x0)]};
            if (cell.pixels == 0 && !location_.edge_meets(cell.box)) continue;
            cell_at_.emplace_hint(cell_at_.end(), std::pair(cy, cx), cells_.size());
            cells_.push_back(cell);
        }
    }
}

Point UnsupportedCells::pixel(const Cell& cell, Unit bit) const {
    return {cell.box.lo.x + bit % cell_pixels * pitch_ + pitch_ / 2,
            cell.box.lo.y + bit / cell_pixels * pitch_ + pitch_ / 2};
}

std::vector<std::size_t> UnsupportedCells::uncovered(const Box& window, const GrowingSupports& supports) const {
    std::vector<std::size_t> open;
    const Unit size = cell_pixels * pitch_;
    for (Unit cy = floor_div(window.lo.y, size); cy <= floor_div(window.hi.y, size); ++cy) {
        const Unit last = floor_div(window.hi.x, size);
        for (auto it = cell_at_.lower_bound({cy, floor_div(window.lo.x, size)});
             it != cell_at_.end() && it->first <= std::pair(cy, last); ++it)
            if (!covered(it->second, window, supports)) open.push_back(it->second);
    }
    return open;
}

}  // namespace ribvault
