// The unsupported region as square cells: its pixels, and where between them something is not covered yet.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "ribvault/exact/point_location.hpp"
#include "ribvault/settings.hpp"
#include "ribvault/vault/growing_supports.hpp"

namespace ribvault {

/// The cells that meet the region. A cell holds 8 x 8 pixels, the points of a lattice of settings.sampling_pitch.
class UnsupportedCells {
public:
    struct Cell {
        Box box;
        std::uint64_t pixels = 0;  ///< one bit each: inside the region
    };

    UnsupportedCells(const Region& unsupported, const Settings& settings);

    const std::vector<Cell>& cells() const { return cells_; }
    Point pixel(const Cell& cell, Unit bit) const;

    /// Looks for points of the region inside a cell (index in cells()) that no wall covers: halves the cell until each
    /// part lies within r + ρ of one wall or shows a point that is not covered. Calls found(p) for such points, at most
    /// one a part, until it returns true; returns whether it did. A part smaller than the slack is covered when its
    /// centre is, with the slack to spare, so this ends; parts outside `window` are left out.
    template <class Found>
    bool find_uncovered(std::size_t cell, const Box& window, const GrowingSupports& supports, Found&& found) const {
        return search(cells_[cell].box, window, supports, true, Side::boundary, found);
    }
    /// The cells that have points of the region in `window` that are not covered (indices in cells()).
    std::vector<std::size_t> uncovered(const Box& window, const GrowingSupports& supports) const;
    /// Is every point of the region in this cell and in `window` covered?
    bool covered(std::size_t cell, const Box& window, const GrowingSupports& supports) const {
        return !find_uncovered(cell, window, supports, [](Point) { return true; });
    }

    static Point centre(const Box& box) { return {(box.lo.x + box.hi.x) / 2, (box.lo.y + box.hi.y) / 2}; }
    /// Upper bound of the distance from the centre to any point of the box.
    static double half_diagonal(const Box& box) { return 0.5 * length(box.hi - box.lo) + 1; }

private:
    /// `edges`: edges of the region may meet the box; otherwise all of it lies on this `side`.
    template <class Found>
    bool search(const Box& box, const Box& window, const GrowingSupports& supports, bool edges, Side side,
                Found&& found) const {
        if (box.lo.x > window.hi.x || box.hi.x < window.lo.x || box.lo.y > window.hi.y || box.hi.y < window.lo.y)
            return false;
        const Point c = centre(box);
        const double half = half_diagonal(box);
        if (supports.covers_around(c, half, radius_)) return false;
        if (edges) edges = location_.edge_meets(box), side = location_.locate(c);
        if (!edges && side == Side::outside) return false;
        if (!supports.covers(c, radius_ - slack_) && (side != Side::outside || half <= static_cast<double>(slack_)))
            return found(c);
        for (const Box& part : {Box{box.lo, c}, Box{{c.x, box.lo.y}, {box.hi.x, c.y}},
                                Box{{box.lo.x, c.y}, {c.x, box.hi.y}}, Box{c, box.hi}})
            if (search(part, window, supports, edges, side, found)) return true;
        return false;
    }

    Unit pitch_, radius_, slack_;
    PointLocation location_;
    std::vector<Cell> cells_;
    std::map<std::pair<Unit, Unit>, std::size_t> cell_at_;  ///< by row and column
};

}  // namespace ribvault
