// How long a printer needs for a list of moves: acceleration-limited motion, looked ahead as Marlin does.
#pragma once

#include <array>
#include <vector>

#include "ribvault/settings.hpp"

namespace ribvault {

/// One straight move: x, y, z and filament by `step` (mm), at `speed` (mm/s) along x, y, z, or of the filament when
/// nothing else moves.
struct Move {
    std::array<double, 4> step{};
    double speed = 0;
};

/// Seconds from standstill to standstill. Every move is a trapezoid of speed; between moves the speed is limited by the
/// jerk of every axis (Marlin's classic planner, with unlimited look-ahead). Moves of no length take no time.
double motion_seconds(const std::vector<Move>& moves, const MotionLimits& limits);

}  // namespace ribvault
