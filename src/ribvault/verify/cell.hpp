// A square of the subdivision with everything of a problem that meets it.
#pragma once

#include <boost/container/small_vector.hpp>
#include <memory>

#include "ribvault/verify/height_rows.hpp"
#include "ribvault/verify/prepared_tracks.hpp"
#include "ribvault/verify/subdivide.hpp"

namespace ribvault::verify {

using Indices = boost::container::small_vector<int, 12>;
inline std::span<const int> view(const Indices& list) { return {list.data(), list.size()}; }

/// Centre and half side, in lattice units. The lists hold at least all that comes within Subdivision::margin of the
/// square.
struct Cell {
    double x = 0, y = 0, half = 0;
    Indices sites, edges, pieces, region;
    /// A point of the cell (or of the margin around it) on no line of its edges, and the winding numbers there.
    double ref_x = 0, ref_y = 0;
    int material_winding = 0, region_winding = 0;
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
    std::vector<PreparedTrack> sites, material, pieces;  ///< sites and pieces with their radii, material without
    /// By the heights of the edges of region and material; nothing where there are few windows.
    HeightRows region_rows, material_rows;
    /// What comes near a square. None where there are few windows.
    struct Squares {
        TrackGrid sites, material, pieces;
    };
    std::unique_ptr<const Squares> squares;
};
/// `windows`: how many root cells will be asked for.
Subdivision subdivision(const CoverProblem& problem, std::size_t windows);

/// The square of the first cell for a window: a little larger than the square about it and off its middle, as symmetric
/// input has its edges on lines through the middle.
Window root_square(const Subdivision& s, const Window& window);

/// That cell into `cell`, and its state. The lists and windings are complete in any case.
CellState root_cell(const Subdivision& s, const Window& window, Cell& cell);

/// Moves the reference point of an open cell to its centre. Needed before its quarters are taken.
void refer_to_centre(const Subdivision& s, Cell& cell);

/// Quarter 0..3 of an open cell into `cell`, and its state. The lists and windings are complete when it is open.
CellState quarter(const Subdivision& s, const Cell& parent, int index, Cell& cell);

}  // namespace ribvault::verify
