// How far from the material below: branch and bound in doubles with margins. Light.
#pragma once

#include <span>

#include "ribvault/verify/prepared_tracks.hpp"

namespace ribvault::verify {

/// The layer below, prepared.
struct LowerTracks {
    const std::vector<PreparedTrack>& tracks;
    const TrackGrid& grid;
    double margin;  ///< margin_of() the largest coordinate
};

/// Enclosure of a greatest distance to the material below, mm, and a point (rounded) that is about as far.
struct Farthest {
    double lo = 0, hi = 0;
    double x = 0, y = 0;
};

/// The greatest distance along the stretch [from, to] (mm from a) of a track's centre line.
Farthest farthest_on_line(const PreparedTrack& track, double from, double to, const LowerTracks& lower);

/// The greatest distance over the stadiums of `pieces`, to about 1e-3 of it or as far as about `effort` cells go.
Farthest farthest_in(std::span<const PreparedTrack> pieces, const LowerTracks& lower, int effort);

}  // namespace ribvault::verify
