// A square of the subdivision with everything of a problem that meets it.
#pragma once

#include <boost/container/small_vector.hpp>

#include "ribvault/verify/subdivide.hpp"

namespace ribvault::verify {

using Indices = boost::container::small_vector<int, 12>;
inline std::span<const int> view(const Indices& list) { return {list.data(), list.size()}; }

/// Centre and half side, in lattice units. The lists hold at least all that comes within Subdivision::margin of the square.
struct Cell {
    double x = 0, y = 0, half = 0;
    Indices sites, edges, pieces, region;
    double ref_x = 0, ref_y = 0;  ///< a point of the cell on no line of the edges of its parent
    int material_winding = 0, region_winding = 0;  ///< there
};

enum class CellState {
    settled,    ///< M is empty in the cell, or all of the cell is covered; so in a neighbourhood of it
    uncovered,  ///< all of the cell belongs to M \ K
    open
};

/// Cells of one problem. Distances are computed in doubles; `margin` is far above their error, see subdivision().
struct Subdivision {
    const CoverProblem* problem = nullptr;
    double margin = 0;
};
Subdivision subdivision(const CoverProblem& problem);

Cell root_cell(const Subdivision& s, const Window& window);
CellState state_of(const Subdivision& s, const Cell& cell);
/// Quarter 0..3 of a cell.
Cell quarter(const Subdivision& s, const Cell& cell, int index);

/// Distance from (x, y) to the segment between the approximate places of vertices a and b.
double distance(const CoverProblem& problem, int a, int b, double x, double y);

}  // namespace ribvault::verify
