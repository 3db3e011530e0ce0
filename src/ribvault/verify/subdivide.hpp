// The search for uncovered points: cells that are settled as a whole, and candidate points in the few that are not.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "ribvault/verify/local_cover.hpp"

namespace ribvault::verify {

/// An axis-parallel box in lattice units; M \ K is looked for inside it.
struct Window {
    double lo_x = 0, lo_y = 0, hi_x = 0, hi_y = 0;
};
constexpr Window empty_window{HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
inline Window united(const Window& v, const Window& w) {
    return {std::min(v.lo_x, w.lo_x), std::min(v.lo_y, w.lo_y), std::max(v.hi_x, w.hi_x), std::max(v.hi_y, w.hi_y)};
}

/// A point of the closure of M \ K, and a direction in which to look for a point of M \ K itself. Lattice units.
struct Uncovered {
    double x = 0, y = 0;
    Vec<double> hint{1, 0};
    std::optional<Candidate> candidate;  ///< the point exactly; else (x, y) is in M \ K itself
    Leaving leaving;
};

/// Decides M \ K = {} exactly (docs/verifier.md). Nothing when it is empty. Precondition: M \ K lies inside the
/// windows, which may overlap. Under upward rounding; adds to `stages`.
std::optional<Uncovered> find_uncovered(const CoverProblem& problem, std::span<const Window> windows,
                                        StageCounts& stages);

/// Certified enclosure of the area of M \ K, to 1 % or as far as about `max_cells` cells go, and a point that as far as
/// doubles tell is in the largest part found to be uncovered. Precondition: as for find_uncovered.
struct AreaEnclosure {
    double lo = 0, hi = 0;  ///< square lattice units
    double x = 0, y = 0;    ///< that point
    bool known = false;     ///< whether there is one
};
AreaEnclosure enclose_area(const CoverProblem& problem, std::span<const Window> windows, int max_cells);

}  // namespace ribvault::verify
