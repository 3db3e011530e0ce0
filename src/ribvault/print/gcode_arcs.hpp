// Arcs as chords, with a bound.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "ribvault/print/gcode_machine.hpp"

namespace ribvault {

/// How far, in mm, the chords lie from their arc at most: 1 µm, rounding of their ends included. Where the file's
/// centre is not equally far from both ends (its decimals are rounded), the arc's radius goes evenly from one to the
/// other.
inline constexpr double arc_bound_mm = 0.001;

/// The points after motion.from, the last one exactly motion.to; x, y, z, with z rising evenly. What is wrong with the
/// arc, or empty. Also its length in the plane, mm. Precondition: motion is an arc.
std::string arc_points(const GcodeMotion& motion, std::vector<std::array<Decimal, 3>>& points, double& length_mm);

}  // namespace ribvault
