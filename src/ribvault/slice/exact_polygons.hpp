// The exact polygons of a slice. Heavy (CGAL): include in .cpp files only.
#pragma once

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_with_holes_2.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "ribvault/exact/lattice.hpp"

namespace ribvault {

using ExactKernel = CGAL::Exact_predicates_exact_constructions_kernel;
using ExactPolygon = CGAL::Polygon_2<ExactKernel>;
using ExactPolygonWithHoles = CGAL::Polygon_with_holes_2<ExactKernel>;

/// Enclosure of a coordinate by machine numbers, no wider than 2^-51 of its magnitude. A lazy number's own enclosure
/// has no such bound: on a mesh edge nearly parallel to the plane it can be as long as the edge. Then the exact value
/// is computed.
inline std::pair<double, double> tight_enclosure(const ExactKernel::FT& a) {
    const auto tight = [](const std::pair<double, double>& e) {
        return e.second - e.first <= 0x1p-51 * std::max(std::fabs(e.first), std::fabs(e.second));
    };
    std::pair<double, double> enclosure = CGAL::to_interval(a);
    if (!tight(enclosure)) enclosure = CGAL::to_interval(CGAL::exact(a));
    return enclosure;
}
/// Within 2^-51 of its magnitude.
inline double approximate(const ExactKernel::FT& a) {
    const auto [lo, hi] = tight_enclosure(a);
    return lo + (hi - lo) / 2;
}

/// Disjoint regularised polygons with holes: outer boundaries counter-clockwise, holes clockwise. Coordinates in mm on
/// the bed.
struct ExactPolygons {
    std::vector<ExactPolygonWithHoles> polygons;
};

/// Calls visit(boundary) for every outer boundary and every hole, each an ExactPolygon.
template <class Visit>
void for_each_boundary(const ExactPolygons& polygons, Visit&& visit) {
    for (const ExactPolygonWithHoles& polygon : polygons.polygons) {
        visit(polygon.outer_boundary());
        for (const ExactPolygon& hole : polygon.holes()) visit(hole);
    }
}

/// Lattice lengths and points in mm, exactly.
inline ExactKernel::FT exact_mm(Unit length) {
    return ExactKernel::FT(static_cast<double>(length)) / ExactKernel::FT(static_cast<double>(units_per_mm));
}
inline ExactKernel::Point_2 exact_mm(Point p) { return {exact_mm(p.x), exact_mm(p.y)}; }

}  // namespace ribvault
