// What of a printed layer hangs outside the object below it: external overhangs, which no internal support can hold.
// Light.
#pragma once

#include "ribvault/verify/printed_layer.hpp"

namespace ribvault {

/// The stretches of upper's centre lines that lie outside the outline of `lower`, as tracks. The outline bounds the
/// points that a ray leaves through an odd number of lower's tracks marked `outline`, its centre lines; when these do
/// not close (an end where an odd number of them meets) there is none, and everything is outside. Each result is as
/// wide as the narrowest outline track of lower (as upper's own track without one). Exact.
///
/// What it is for: let K be lower's tracks and V the result, both dilated by ρ. If verify_printed(upper, K ∪ V) says
/// `supported`, every point of upper's material inside the outline has material of lower within ρ: a point x inside
/// that is in V is within R = w/2 + ρ of a stretch outside, so the way there crosses an outline track, no narrower than
/// w, within R. Conversely nothing outside is held against it, when upper's tracks are no wider than w + 2 ρ: a point x
/// outside lies within half a width of a point of its centre line; that one is outside (then x is in V) or the way
/// crosses the outline (then x is in K).
std::vector<PrintedTrack> stretches_outside(const PrintedLayer& upper, const PrintedLayer& lower);
/// The same stretches, each as wide as its track: what is extruded there.
std::vector<PrintedTrack> extruded_outside(const PrintedLayer& upper, const PrintedLayer& lower);
/// Both.
struct OutsideTracks {
    std::vector<PrintedTrack> stretches, extruded;
};
OutsideTracks tracks_outside(const PrintedLayer& upper, const PrintedLayer& lower);

}  // namespace ribvault
