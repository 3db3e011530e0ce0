// A triangle mesh as read, and where it is placed on the bed.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>

#include "ribvault/exact/rational.hpp"

namespace ribvault {

/// Triangles over welded vertices. Coordinates are the file's numbers (binary floats exactly; decimals of text formats
/// rounded once to the nearest double, a choice made when read), in the file's units and axes.
struct Mesh {
    Eigen::Matrix<double, 3, Eigen::Dynamic> vertices;
    Eigen::Matrix<int, 3, Eigen::Dynamic> triangles;  ///< counter-clockwise seen from outside
    std::size_t degenerate_triangles = 0;             ///< dropped when read: two corners at the same point
};

/// Exact placement: bed coordinate k (mm) = scale * sign[k] * file coordinate axis[k] + offset[k].
struct Placement {
    /// Rows of the matrix that the file's coordinates were multiplied by before, rounded: turns that are no quarters.
    std::optional<std::array<std::array<double, 3>, 3>> rotation;
    std::array<int, 3> axis{0, 1, 2};
    std::array<int, 3> sign{1, 1, 1};
    Rational scale{1};
    std::array<Rational, 3> offset{Rational(0), Rational(0), Rational(0)};
};

/// +1 when the placement keeps orientation, -1 when it mirrors.
inline int handedness(const Placement& placement) {
    int sign = placement.sign[0] * placement.sign[1] * placement.sign[2];
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = i + 1; j < 3; ++j)
            if (placement.axis[i] > placement.axis[j]) sign = -sign;
    return sign;
}

}  // namespace ribvault
