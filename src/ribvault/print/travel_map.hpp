// Where the nozzle may travel on a layer without leaving the island, and how much of a travel is over open air.
#pragma once

#include "ribvault/print/segment_rows.hpp"
#include "ribvault/print/tool_path.hpp"

namespace ribvault {

/// A travel without extrusion.
struct Travel {
    std::vector<Point> via;      ///< after its start; the last one is its end
    double length = 0;           ///< lattice units
    bool leaves_island = false;  ///< it crosses the outside of the slice
    double open_air = 0;         ///< how much of it lies over the cavity, lattice units
};

/// What travels on one layer meet.
class TravelMap {
public:
    /// Knows nothing: every travel is straight, stays on the island and is over open air.
    TravelMap() = default;

    /// `outline`: the slice's rounded contours; `cavity`: C_i; the outer perimeters of `layer` are where detours run.
    /// Keeps no reference to them.
    TravelMap(const Region& outline, const Region& cavity, const LayerPaths& layer);

    /// The way from one point inside the slice to another. Straight, unless that crosses the outline (decided exactly).
    /// Then along the outer perimeter that follows the crossed contour, cut short wherever one sees farther, provided
    /// that this stays inside and is at most `longest_detour` lattice units longer than straight (combing; Section 5.1
    /// retracts otherwise). The search looks at one perimeter a contour, three contours at most, and tries at most 400
    /// views.
    Travel travel(Point from, Point to, double longest_detour) const;

    /// Whether the straight way does not meet the outline; exact.
    bool sees(Point a, Point b) const;

private:
    bool detour(Point from, Point to, int contours_left, int& views_left, std::vector<Point>& via) const;
    double over_cavity(Point a, Point b) const;
    bool in_cavity(double x, double y) const;

    bool known_ = false;
    SegmentRows outline_, cavity_;
    std::vector<Contour> perimeters_;
    std::vector<Box> boxes_;  ///< of the perimeters
};

}  // namespace ribvault
