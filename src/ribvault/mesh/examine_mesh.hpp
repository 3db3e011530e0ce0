// What there is to say about a mesh before it is sliced: size, volume, parts, defects.
#pragma once

#include <array>
#include <cstddef>

#include "ribvault/mesh/mesh.hpp"

namespace ribvault {

struct MeshFacts {
    std::size_t triangles = 0;
    std::size_t vertices = 0;
    std::array<double, 3> size_mm{0, 0, 0};  ///< bounding box as placed
    double volume_mm3 = 0;                   ///< signed: inverted surfaces count negative, voids are subtracted
    std::size_t components = 0;              ///< parts of the surface connected through shared edges
    std::size_t boundary_edges = 0;          ///< used by one triangle
    std::size_t non_manifold_edges = 0;      ///< used by more than two triangles
    std::size_t unbalanced_edges = 0;        ///< not used equally often in both directions; includes boundary edges
    std::size_t degenerate_triangles = 0;    ///< dropped when read
    std::size_t duplicate_triangles = 0;     ///< whose three vertices, in any order, an earlier triangle has too
    std::size_t inverted_components = 0;     ///< closed, of negative volume, and no void of another component

    /// Every plane cuts the surface in closed contours, so that the winding number is defined everywhere.
    bool closed() const { return unbalanced_edges == 0; }
};

/// Facts of the mesh as placed. A closed component of negative volume counts as a void when its bounding box lies
/// inside that of a component of positive volume (a sufficient test would need the solids; for a report the boxes are
/// enough). Sizes and volumes are doubles, good to about 1e-12 of the bounding box. O(n log n) with n the number of
/// triangles.
MeshFacts examine(const Mesh& mesh, const Placement& placement);

}  // namespace ribvault
