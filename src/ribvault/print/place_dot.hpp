// Where the smallest addition to the tracks of a layer holds up what hangs a little.
#pragma once

#include <optional>
#include <vector>

#include "ribvault/exact/lattice.hpp"

namespace ribvault {

/// Material: the stadium of this width around a segment of the lattice.
struct Lane {
    Segment centre;
    Unit width = 0;
};

/// A stretch of a track that hangs: what of its cross-sections between `from` and `to` has no material below within ρ.
struct HangingStretch {
    Lane track;
    double from = 0,
           to = 0;  ///< along the centre line from a, lattice units; may exceed its ends, whose round caps count
};

/// What a placement keeps in hand for what lies between samples.
inline constexpr Unit sampling_room = 1000;

/// Points of a stretch's cross-sections that are beyond the reach of all material, 10 µm along and 4 µm across from
/// each other.
std::vector<Point> hanging_points(const HangingStretch& stretch, const std::vector<Lane>& material, Unit rho);
/// The sample of it that is the farthest from all material, within reach or not.
Point nearest_to_hanging(const HangingStretch& stretch, const std::vector<Lane>& material, Unit rho);

struct PlacedDot {
    Point at;
    double way = 0;  ///< to the centre line of the nearest material, lattice units
    bool needed = true;  ///< not when `material` already holds up the stretch with room to spare
};

/// The place for a dot of width `width` from which everything that hangs is within width / 2 + rho, as near to the
/// centre line of one of `material` as can be, so that little is printed and little of that hangs in its turn. What
/// hangs is found by sampling, so the answer is a proposal, to be judged (print/judge_print.hpp); nothing when no dot
/// reaches all of it or there is no material. Cost: the samples (10 µm along, 4 µm across) times the material given,
/// which should be what comes within a few widths.
std::optional<PlacedDot> place_dot(const HangingStretch& stretch, const std::vector<Lane>& material, Unit width,
                                   Unit rho);

}  // namespace ribvault
