// Turns, scales and puts a mesh on the middle of the bed.
#pragma once

#include <array>
#include <optional>

#include "ribvault/mesh/mesh.hpp"

namespace ribvault {

struct PlacementOptions {
    std::optional<Rational> scale;      ///< > 0; not together with height_mm
    std::optional<Rational> height_mm;  ///< > 0: scale so that the turned mesh is exactly this high
    std::array<Rational, 3> rotate_degrees{Rational(0), Rational(0), Rational(0)};  ///< about X, Y, Z
    char up = 'z';                                 ///< the file's axis that points up
    double bed_x = 250, bed_y = 250, bed_z = 250;  ///< mm
    bool round_bed = false;                        ///< a disc of diameter bed_x
    /// Mm: x and y of the front left corner of the bed, or of the square around it.
    std::array<double, 2> bed_corner{};
};

/// Turns first (`up` is a cyclic exchange of the axes: 'y' means x' = z, y' = x, z' = y; 'x' means x' = y, y' = z, z'
/// = x), then rotates, then scales, then moves: the lowest point lies at z = 0 exactly, the middle of the bounding box
/// at the middle of the bed, rounded to the lattice. `up`, rotations by multiples of 90 degrees, scale, height and
/// offset are exact. When an angle is no multiple of 90 degrees the vertices are turned once in doubles and rounded:
/// `mesh` is changed, and what is sliced exactly is the turned mesh.
///
/// Throws Error, usage: scale and height together, one of them not positive, `up` or the bed impossible; bad_geometry:
/// no triangles; does_not_fit: larger than the bed, flat, or smaller than 1 mm in every direction (as after reading a
/// file in metres or inches).
Placement place(Mesh& mesh, const PlacementOptions& options);

}  // namespace ribvault
