// O_i: the exact cross-section of the mesh with the middle plane of layer i (MODEL: sets; paper, Section 3.1).
#pragma once

#include <memory>

#include "ribvault/exact/rational.hpp"

namespace ribvault {

struct ExactPolygons;  // slice/exact_polygons.hpp: CGAL polygons with holes over exact rationals

/// Slice i. `exact` is the geometry; `rounded` the same contours with every vertex at its nearest lattice point (at
/// most 7.1 nm away), from which cavities and tool paths are proposed, never decided. The vertices' exact values are
/// known, so that what others ask of them, and in which order, changes no enclosure: verdicts and witnesses are the
/// same for any number of threads.
struct Slice {
    int layer = 0;
    std::shared_ptr<const ExactPolygons> exact;
    Region rounded;
    bool lost_contours = false;    ///< `exact` has contours of which rounding left less than three points
    bool slivers_removed = false;  ///< see slice/slivers.hpp
};

}  // namespace ribvault
