// Tracks above that several tracks below cover together: the rule that settles most of what no single one covers.
// Light.
#pragma once

#include <span>

#include "ribvault/verify/track_frame.hpp"

namespace ribvault::verify {

/// Stretches of a track, along it from a (negative and beyond its length: at its round ends), outside which its stadium
/// is certainly covered by `below`. Empty: all of it is. The track is cut across into rectangles, in one, two and four
/// lanes, and its ends into trapezia around the half discs; each piece is the convex hull of its corners, so it lies in
/// a stadium when they do. Precondition: frame.wide_enough.
std::vector<Stretch> lane_gaps(const TrackFrame& frame, double half, std::span<const FrameStadium> below,
                               double margin);

/// The parts of [from, to] outside the closed stretches `covered`, by increasing place. Sorts `covered`.
void uncovered_stretches(std::vector<Stretch>& covered, double from, double to, std::vector<Stretch>& gaps);

}  // namespace ribvault::verify
