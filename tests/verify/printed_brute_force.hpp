// Equations (1) and (2) for printed layers by subdivision in integers: slow, exact where it answers, and independent of
// everything in src/ribvault/verify.
#pragma once

#include <cstdint>
#include <vector>

namespace ribvault::test {

/// Integer coordinates below 2^30, so that every product of the tests fits 128 bits.
struct GridTrack {
    std::int64_t ax = 0, ay = 0, bx = 0, by = 0;
    std::int64_t half = 0;  ///< above: half the width; below: half the width plus ρ
};

enum class Printed {
    supported,    ///< proved
    unsupported,  ///< proved: a point is in M and in no stadium of K
    tie,          ///< down to single units no point is uncovered and some square is not covered as a whole
    open          ///< the budget ended
};

/// (2): squares of a power of two down to 1, settled by one stadium of K that holds all four corners.
Printed printed_areas(const std::vector<GridTrack>& upper, const std::vector<GridTrack>& lower);
/// (1): halves of the centre lines, settled by one stadium that holds both ends. `steps`: how often the coordinates'
/// differences can be halved.
Printed printed_lines(const std::vector<GridTrack>& upper, const std::vector<GridTrack>& lower, int steps);

}  // namespace ribvault::test
