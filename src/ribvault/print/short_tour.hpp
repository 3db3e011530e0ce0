// The order in which to visit tracks so that the nozzle travels little: a travelling salesman with precedences.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "ribvault/exact/lattice.hpp"

namespace ribvault {

/// Where a track may be entered.
enum class Entry {
    fixed,       ///< at its first point only
    either_end,  ///< at its first or its last point: it is printed backwards then
    anywhere     ///< at any of its points: a closed track, left where it was entered
};

inline constexpr std::size_t no_stop = std::numeric_limits<std::size_t>::max();

/// One track as the tour sees it.
struct TourStop {
    Entry entry = Entry::fixed;
    Point first, last;            ///< its ends; equal when it is closed
    const Contour* ring = nullptr;  ///< the points of a track that is entered anywhere
    std::size_t after = no_stop;  ///< the stop that must be visited earlier
};

/// A stop in its turn. `way`: 0 from its first point; 1 backwards; of a ring, the point at which it is entered.
struct Visit {
    std::size_t stop = 0;
    std::size_t way = 0;
};

/// A short way from `from` through all stops (and on to `to`, when given) that respects every `after`.
///
/// Starts with the nearest stop that may come next (the smaller index on ties), then improves: moves runs of up to
/// three stops elsewhere, turned around or not (Or-opt), reverses pieces of the tour (2-opt), changes ways; candidates
/// are the eight nearest stops of each, or, of more than 400 stops, those next to it in the first tour. At most eight
/// rounds, so the cost is bounded: O(n²) for the start, O(n) evaluations a round. Deterministic. Precondition: `after`
/// has no cycles. Postcondition: every stop once, after its `after`; not longer than the first tour.
std::vector<Visit> short_tour(const std::vector<TourStop>& stops, Point from, std::optional<Point> to);

}  // namespace ribvault
