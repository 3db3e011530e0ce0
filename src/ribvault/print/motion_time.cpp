#include "ribvault/print/motion_time.hpp"

#include <algorithm>
#include <cmath>

namespace ribvault {
namespace {

constexpr std::size_t axes = 4;

/// A move with its limits applied.
struct Block {
    double distance, cruise, acceleration;  ///< mm, mm/s, mm/s²
    double safe;                            ///< mm/s: from here no axis needs more than its jerk to stand
    double entry, most_entry;               ///< mm/s
    std::array<double, axes> speed;         ///< of every axis at cruise
};

Block block_of(const Move& move, double distance, bool moves_head, const MotionLimits& limits) {
    Block b{distance, move.speed, 0, 0, 0, 0, {}};
    for (std::size_t a = 0; a < axes; ++a)
        if (const double share = std::fabs(move.step[a]) / distance; share > 0)
            b.cruise = std::min(b.cruise, limits.speed[a] / share);
    b.acceleration = !moves_head        ? limits.retract_acceleration
                     : move.step[3] > 0 ? limits.print_acceleration
                                        : limits.travel_acceleration;
    for (std::size_t a = 0; a < axes; ++a)
        if (const double share = std::fabs(move.step[a]) / distance; share > 0)
            b.acceleration = std::min(b.acceleration, limits.acceleration[a] / share);
    b.safe = b.cruise;
    for (std::size_t a = 0; a < axes; ++a) {
        b.speed[a] = b.cruise * move.step[a] / distance;
        if (std::fabs(b.speed[a]) > limits.jerk[a]) b.safe = std::min(b.safe, limits.jerk[a]);
    }
    return b;
}

/// The speed at which one block may become the next.
double junction_speed(const Block& before, const Block& b, const MotionLimits& limits) {
    const double slower = std::min(before.cruise, b.cruise);
    double factor = 1;
    for (std::size_t a = 0; a < axes; ++a) {
        const double out = before.speed[a] * (slower / before.cruise) * factor,
                     in = b.speed[a] * (slower / b.cruise) * factor;
        const double jerk = out * in > 0 ? std::fabs(out - in) : std::max(std::fabs(out), std::fabs(in));
        if (jerk > limits.jerk[a]) factor *= limits.jerk[a] / jerk;
    }
    const double speed = slower * factor;
    return before.safe > 0.99 * speed && b.safe > 0.99 * speed ? std::min(b.safe, before.cruise) : speed;
}

double reachable(double speed, const Block& b) { return std::sqrt(speed * speed + 2 * b.acceleration * b.distance); }

double seconds_of(const Block& b, double exit) {
    const double up = std::max(0.0, (b.cruise * b.cruise - b.entry * b.entry) / (2 * b.acceleration));
    const double down = std::max(0.0, (b.cruise * b.cruise - exit * exit) / (2 * b.acceleration));
    if (up + down <= b.distance)
        return (b.cruise - b.entry) / b.acceleration + (b.cruise - exit) / b.acceleration +
               (b.distance - up - down) / b.cruise;
    const double peak = std::sqrt(std::max(
        {b.acceleration * b.distance + (b.entry * b.entry + exit * exit) / 2, b.entry * b.entry, exit * exit}));
    return (2 * peak - b.entry - exit) / b.acceleration;
}

}  // namespace

double motion_seconds(const std::vector<Move>& moves, const MotionLimits& limits) {
    std::vector<Block> blocks;
    blocks.reserve(moves.size());
    for (const Move& move : moves) {
        const double head =
            std::sqrt(move.step[0] * move.step[0] + move.step[1] * move.step[1] + move.step[2] * move.step[2]);
        const double distance = head > 0 ? head : std::fabs(move.step[3]);
        if (distance <= 0 || move.speed <= 0) continue;
        Block b = block_of(move, distance, head > 0, limits);
        b.most_entry = blocks.empty() ? b.safe : junction_speed(blocks.back(), b, limits);
        b.entry = b.most_entry;
        blocks.push_back(b);
    }
    double next = blocks.empty() ? 0 : blocks.back().safe;
    for (std::size_t i = blocks.size(); i-- > 0; next = blocks[i].entry)
        blocks[i].entry = std::min(blocks[i].most_entry, reachable(next, blocks[i]));
    double sum = 0;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        const bool last = i + 1 == blocks.size();
        const double limit = std::min(reachable(blocks[i].entry, blocks[i]), blocks[i].cruise);
        const double exit = std::min(last ? blocks[i].safe : blocks[i + 1].entry, limit);
        if (!last) blocks[i + 1].entry = exit;
        sum += seconds_of(blocks[i], exit);
    }
    return sum;
}

}  // namespace ribvault
