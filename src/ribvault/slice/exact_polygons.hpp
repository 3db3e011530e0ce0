// The exact polygons of a slice. Heavy (CGAL): include in .cpp files only.
#pragma once

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_with_holes_2.h>

#include <vector>

namespace ribvault {

using ExactKernel = CGAL::Exact_predicates_exact_constructions_kernel;
using ExactPolygon = CGAL::Polygon_2<ExactKernel>;
using ExactPolygonWithHoles = CGAL::Polygon_with_holes_2<ExactKernel>;

/// Disjoint regularised polygons with holes: outer boundaries counter-clockwise, holes clockwise. Coordinates in mm on the bed.
struct ExactPolygons {
    std::vector<ExactPolygonWithHoles> polygons;
};

}  // namespace ribvault
