// Equation (1) along one centre line: which stretches of it no stadium below covers. Exact. Light: GMP only.
#pragma once

#include <optional>
#include <span>

#include "ribvault/verify/quadratic_number.hpp"
#include "ribvault/verify/track_frame.hpp"
#include "ribvault/verify/verdict.hpp"

namespace ribvault::verify {

/// A maximal uncovered stretch a + t (b - a), from < t < to (and t = 0, t = 1 when it reaches them). Positive length
/// unless the track is a dot.
struct CentreGap {
    QuadraticNumber from, to;  ///< when ends were asked for
    double from_lo = 0, from_hi = 0, to_lo = 0,
           to_hi = 0;  ///< mm along the track: where it begins and ends lies between these
};

/// Where a + t (b - a), any t, is within `radius` of the centre line of `below`; nothing when nowhere.
/// Preconditions: a != b, radius >= 0.
std::optional<std::array<QuadraticNumber, 2>> exact_stretch(const PrintedTrack& track, const PrintedTrack& below,
                                                            const Rational& radius);

/// What is below one track.
struct Below {
    std::span<const PrintedTrack> tracks;     ///< of the layer below
    std::span<const PreparedTrack> prepared;  ///< the same
    std::span<const Millimetres> radii;       ///< half their widths plus ρ
    std::span<const int> which;               ///< those that come near
    std::span<const FrameStadium> seen;       ///< those in the frame of the track
};

/// The stretches of the centre line outside all stadiums of `below`, in order, decided exactly; their ends exactly only
/// with `exact_ends`. Adds its decision to `stages`.
std::vector<CentreGap> centre_gaps(const PrintedTrack& track, const PreparedTrack& prepared, const Below& below,
                                   double margin, bool exact_ends, StageCounts& stages);

}  // namespace ribvault::verify
