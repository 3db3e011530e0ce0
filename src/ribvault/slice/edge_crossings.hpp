// Slice vertices: where mesh edges cross a plane. Heavy (CGAL).
#pragma once

#include <array>
#include <cstdint>

#include "ribvault/mesh/mesh.hpp"
#include "ribvault/slice/exact_polygons.hpp"

namespace ribvault {

/// Where edges of a placed mesh cross one horizontal plane, exactly. The points' exact values are known from the start,
/// as Slice promises, and come from few operations on integers: mesh coordinates are integers on a grid of
/// 2^-grid_bits.
class EdgeCrossings {
public:
    /// `plane`: mm over the bed. `grid_bits`: see mesh_grid_bits. Keeps references to mesh and placement.
    EdgeCrossings(const Mesh& mesh, const Placement& placement, const Rational& plane, long grid_bits);

    /// The crossing of the edge between two vertices, mm on the bed. It depends on the ends' places and not on their
    /// order. Precondition: the plane is not at the height of both.
    ExactKernel::Point_2 at(const std::array<std::int32_t, 2>& ends) const;

private:
    double coordinate(std::size_t k, std::int32_t vertex) const;
    mpz_class on_grid(double value) const;

    const Mesh& mesh_;
    const Placement& placement_;
    long grid_bits_;
    mpz_class plane_numerator_, plane_denominator_;  // of the plane, in units of the grid
    struct Axis {  // bed coordinate = (factor * grid coordinate + shift) / denominator
        mpz_class factor, shift, denominator;
    };
    std::array<Axis, 2> axes_;
};

/// The least n >= 0 with which every coordinate is a multiple of 2^-n.
long mesh_grid_bits(const Mesh& mesh);

}  // namespace ribvault
