// Two printed layers prepared for the verifier, and what it finds open on one track. Heavy: include in .cpp files only.
#pragma once

#include <memory>
#include <vector>

#include "ribvault/verify/greatest_distance.hpp"
#include "ribvault/verify/local_problem.hpp"
#include "ribvault/verify/verify_printed.hpp"

namespace ribvault::verify {

/// Both layers. It does not own the tracks it points to.
struct PrintedPair {
    std::span<const PrintedTrack> upper, lower;
    std::vector<PreparedTrack> above, below;
    std::vector<Millimetres> radii;  ///< of the lower tracks: half the width plus ρ
    Rational rho;
    double rho_approx = 0, margin = 0;
    TrackGrid grid;  ///< over `below`, dilated by ρ
    LowerTracks lower_tracks() const { return {below, grid, margin}; }
};

/// A stretch of a track above where its stadium meets what is not supported, and how that is known.
struct OpenPart {
    int track = 0;
    Stretch stretch;                    ///< along it, mm
    std::optional<CentreGap> gap;       ///< on the centre line
    std::optional<Uncovered> found;     ///< else: in the local problem of the part
    std::optional<PrintedTrack> piece;  ///< M of that problem when it is not all of the track: the part itself
    /// That problem; alive as long as `found`, which points into it.
    std::shared_ptr<const LocalProblem> local = nullptr;
};

/// The part of the stretch as a track of its own: its stadium holds all of the track's stadium beside the stretch, and
/// no more than the track's.
PreparedTrack part_of(const PrintedPair& pair, const OpenPart& part);

/// The problem of the part's track near it. Under upward rounding.
void build_part_problem(const PrintedPair& pair, const OpenPart& part, LocalProblem& local);

/// Whether the point is in the stadium of the track above, and whether it is in none of those below dilated by ρ.
/// Exact.
bool in_upper(const PrintedPair& pair, int track, const RationalPoint& p);
bool outside_lower(const PrintedPair& pair, const RationalPoint& p);

/// A rational point of M \ K from a point of its closure: along the direction in which it leaves that point, ever
/// closer to it, with as many digits as it takes. Nothing when none was found. mm. Under upward rounding.
std::optional<RationalPoint> witness_from(const PrintedPair& pair, int track, const LocalProblem& local,
                                          const Uncovered& found);

/// A point of an uncovered stretch, with few digits.
RationalPoint point_of_gap(const PrintedTrack& track, const CentreGap& gap);

/// Groups parts whose tracks touch and describes each group.
std::vector<UnsupportedRegion> describe_regions(const PrintedPair& pair, std::vector<OpenPart>& parts,
                                                const PrintedOptions& options);

}  // namespace ribvault::verify
