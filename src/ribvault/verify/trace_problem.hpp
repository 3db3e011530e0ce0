// What the tracing of a region's boundary works on: stadiums, the curves they lie on, and where these meet. Heavy:
// include in .cpp files only.
#pragma once

#include <span>
#include <vector>

#include "ribvault/verify/printed_pair.hpp"
#include "ribvault/verify/region_boundary.hpp"

namespace ribvault::verify {

/// A piece of a stadium's boundary: the curve that carries it.
struct CurveUse {
    int curve = 0;            ///< index into TraceProblem::curves
    bool inside_left = true;  ///< the stadium is on the left of the curve's direction (circles run counterclockwise)
    double lo_x = 0, lo_y = 0, hi_x = 0, hi_y = 0;  ///< mm; contains the piece, margins included
};

/// A stadium of M, or one of K.
struct Solid {
    bool above = false;
    int track = 0;                       ///< index into the layer's tracks
    Stadium stadium;                     ///< in the local problem
    RationalPoint a, b;                  ///< mm; its ends, a that of stadium.a
    PreparedTrack approx;                ///< mm; from a to b; `half` is the stadium's radius
    Rational radius;                     ///< mm
    std::vector<CurveUse> uses;          ///< a dot: its circle; else side, cap, side, cap, counterclockwise
    const RationalPoint& end(int vertex) const { return vertex == stadium.a ? a : b; }
};

/// A point where two curves meet, in the closure of the region as far as doubles tell.
struct TraceVertex {
    int first = 0, second = 0, root = 0;  ///< curves, first < second
    Located at;
    int same = -1;               ///< another vertex at the same point, or -1 (a forest, see node_of())
    unsigned bits = 0;           ///< of `close`; 0: none
    Vec<Rational> close;         ///< within 2^-bits of the point, local units
};

/// A group of open parts with all that comes near them. Local coordinates as in LocalProblem.
struct TraceProblem {
    explicit TraceProblem(const PrintedPair& p) : pair(p) {}
    TraceProblem(const TraceProblem&) = delete;
    const PrintedPair& pair;
    LocalProblem local;
    std::vector<PreparedTrack> parts;          ///< their stadiums contain the region
    TrackGrid part_grid;
    std::vector<PreparedTrack> above;          ///< the stadiums of M, as solids[0...]
    TrackGrid above_grid;
    std::vector<Solid> solids;                 ///< those of M, then those of K
    std::vector<Curve> curves;  ///< lines to the right of a to b (side -1), so that the stadium is on the left
    std::vector<int> owner;                    ///< per curve: one of the solids that use it
    std::vector<std::array<int, 2>> tangents;  ///< sorted: sides and the circles at their ends, which touch
    std::vector<TraceVertex> vertices;
    double margin = 0;                         ///< mm; more than every error of a double
    double scale = 1, origin_x = 0, origin_y = 0;  ///< those of `local`, mm

    /// All solids that may come within `radius` of the centre line of `t` (mm).
    void near(const PreparedTrack& t, double radius, std::vector<int>& found) const;
    /// A local point in mm, to within `margin`.
    std::array<double, 2> approximate_mm(double x, double y) const;
    int node_of(int vertex);
    void unite(int vertex, int other);

private:
    mutable std::vector<int> scratch_;
};

/// Solids and curves around `parts` of the tracks `tracks` above. Equal stadiums are one solid, equal circles and equal
/// lines one curve, decided exactly. Under upward rounding, as all that follows.
void build_trace_problem(TraceProblem& trace, std::span<const int> tracks, std::vector<PreparedTrack> parts);

/// Enters the vertices: at least all points of the closure of the region where two curves meet that have a piece of a
/// stadium's boundary there; in the interior of a stadium of M, where those of two stadiums of K meet.
void find_trace_vertices(TraceProblem& trace);

/// How many points the two curves have in common (0, 1 or 2; 0 for parallel lines and concentric circles). Exact.
int meeting_count(const TraceProblem& trace, int first, int second);

/// The vertex (first, second, root), first < second.
Candidate candidate_of(const TraceProblem& trace, int first, int second, int root);

/// A rational point within 2^-bits of the vertex in both coordinates, local units.
const Vec<Rational>& approximation(TraceVertex& v, unsigned bits);

}  // namespace ribvault::verify
