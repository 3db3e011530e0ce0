// "Is M inside K?" for a few printed tracks, in coordinates of their own. Heavy (CGAL): include in .cpp files only.
#pragma once

#include <deque>

#include "ribvault/verify/centre_line.hpp"
#include "ribvault/verify/exact_stadium.hpp"
#include "ribvault/verify/subdivide.hpp"

namespace ribvault::verify {

/// A problem without edges: M = stadiums above, K = stadiums below, equal points and equal radii being one. Local
/// coordinates are (mm - origin) * scale, exactly; all machine numbers of the problem are enclosures of these, so that
/// their errors are relative to the problem's size whatever its place. Where decimals allow it the scale makes them
/// integers, whose ties intervals decide.
struct LocalProblem {
    CoverProblem problem;
    Window window;
    RationalPoint origin;  ///< mm
    Rational scale;        ///< local units per mm
    /// Which track's centre line each piece and site is.
    std::vector<int> pieces, sites;

    std::vector<Vec<Rational>> points;  ///< the vertices where the scale does not make them integers
    std::vector<Vertex> vertices;
    std::deque<ExactRadius> radii;

    LocalProblem() = default;
    LocalProblem(const LocalProblem&) = delete;  // the problem points into this object

    RationalPoint to_mm(const Rational& x, const Rational& y) const {
        return {Rational(origin[0] + x / scale), Rational(origin[1] + y / scale)};
    }
};

/// A square window in mm, doubles.
struct Square {
    double x = 0, y = 0, half = 0;
};

/// All of the root cell of a square is within so many of its half sides from its middle: the cell is 1.0173 times as
/// large and off by 0.0137 and 0.0091 (root_square()), so its corners are at 1.46.
inline constexpr double root_cell_reach = 1.5;

/// More than all by which the root cell of a window exceeds 1.031 times the window: 64 margins of the local problem,
/// each 2^-34 of its extent, which is below 2^2 c, c being the layers' largest coordinate and `margin` 2^-40 c.
inline double window_slack(double margin) { return 0x1p16 * margin; }

/// The problem of the tracks `pieces` of `upper` over those of below.which that come near `square`. The window is the
/// square; M \ K is right inside the root cell around it, so below.which must hold all stadiums that come within
/// root_cell_reach half sides and window_slack() of its middle. Under upward rounding.
void build_local_problem(std::span<const PrintedTrack> upper, std::span<const int> pieces, const Below& below,
                         const Square& square, double margin, LocalProblem& local);

}  // namespace ribvault::verify
