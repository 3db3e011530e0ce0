// Equations (1) and (2) for two printed layers, decided exactly. Light: no CGAL.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "ribvault/verify/printed_layer.hpp"
#include "ribvault/verify/region_boundary.hpp"
#include "ribvault/verify/verdict.hpp"

namespace ribvault {

/// A maximal stretch of one track's centre line that violates equation (1). It has a positive length, or the track is
/// a dot and from_mm = to_mm = 0.
struct UnsupportedPiece {
    std::size_t track = 0;                    ///< index into upper.tracks
    double from_mm = 0, to_mm = 0;            ///< along the track from a; rounded outward: contains the stretch
    bool from_start = false, to_end = false;  ///< it reaches the track's end a, b (a dot: both). Exact
    std::array<Rational, 2> length;  ///< mm; bounds of its length, 2^-189 of it apart; equal where it is rational
    double distance_lo = 0, distance_hi = 0;  ///< mm; enclosure of the greatest distance of its points to the
                                              ///< material below (more than ρ); infinite when there is none
    std::array<double, 2> worst{0, 0};        ///< mm; a point of the stretch (rounded) at least distance_lo away
};

/// What of the material above has no material within ρ below: a group of parts of tracks that touch each other and
/// violate (2). Each connected component belongs to one group; a group may hold several.
struct UnsupportedRegion {
    std::vector<std::size_t> tracks;          ///< the tracks above to which it belongs
    RegionBoundary boundary;                  ///< all of it, exactly
    double area_lo = 0, area_hi = 0;          ///< mm²; enclosure of its area, 1e-9 of it wide or less
    double distance_lo = 0, distance_hi = 0;  ///< mm; enclosure of the greatest distance of its points to the material
                                              ///< below; infinite when there is none
    std::array<Rational, 2> witness;  ///< mm; a point of the region, exactly: in a stadium above, in none of the
                                      ///< stadiums below dilated by ρ
    double witness_distance = 0;      ///< mm from the witness to the material below, rounded down
    bool witness_certified = true;    ///< false when only a place near the region could be given; none is known
};

/// A stretch of a track above beside which something of its stadium violates (2): all that does lies in the stadiums of
/// these stretches.
struct OpenStretch {
    std::size_t track = 0;         ///< index into upper.tracks
    double from_mm = 0, to_mm = 0; ///< along it from a; may exceed its ends, whose round caps count
};

struct PrintedVerdict {
    bool centre_lines_supported = true;  ///< (1): every point of every judged centre line is within ρ of the material
                                         ///< below. Exact
    bool supported = true;               ///< (2): every point of every judged stadium is. Exact; implies (1)
    std::vector<std::array<double, 2>> unsupported_length;  ///< per track above: enclosure [lo, hi], mm, of the length
                                                            ///< of centre line that violates (1); {0, 0}: none,
                                                            ///< or not asked for
    std::vector<UnsupportedPiece> pieces;                   ///< in the order of the tracks, then along each; the same
    std::vector<char> track_supported;       ///< per track above: 1 when its stadium satisfies (2) or is not judged
    std::vector<UnsupportedRegion> regions;  ///< empty when supported, or not asked for
    std::vector<OpenStretch> stretches;      ///< empty when supported, or not asked for
    StageCounts stages;
};

struct PrintedOptions {
    std::vector<char> judged;  ///< per track above; 0: not judged, not material above either. Empty: all are
    bool areas = true;         ///< decide (2) at all; else `supported` is that of (1)
    bool lengths = true;       ///< measure what violates (1): unsupported_length and pieces
    bool regions = true;       ///< describe what violates (2)
    bool stretches = false;    ///< where (2) is violated, without a description
    int distance_cells = 300;  ///< effort of a region's greatest distance: about so many cells
};

/// Decides for the layer `upper` over `lower` whether every point of the judged tracks of `upper` has material of
/// `lower` within ρ: of their centre lines (equation (1)) and of their stadiums (equation (2)). Exactly ρ counts. No
/// sampling and no tolerance, whatever the size of the coordinates (docs/verifier.md, "Printed layers").
/// Precondition: ρ > 0, every width > 0, `judged` empty or one entry a track; throws Error (usage) otherwise.
/// May be called from several threads at once on shared input.
///
///     const PrintedVerdict v = verify_printed(layers[i + 1], layers[i], rho);
///     for (const UnsupportedPiece& p : v.pieces) report(layers[i + 1].tracks[p.track].line, p.distance_hi);
PrintedVerdict verify_printed(const PrintedLayer& upper, const PrintedLayer& lower, const Rational& rho,
                              const PrintedOptions& options = {});

}  // namespace ribvault
