// Short branches that a path takes along: it bends to their tips, so that they need no track of their own.
#pragma once

#include <vector>

#include "ribvault/exact/lattice.hpp"

namespace ribvault {

/// The corners of a path, each with its way from the beginning along the path, lattice units.
struct PathCorners {
    std::vector<Point> at;
    std::vector<double> along;
};

/// The branches that leave a path at one of its corners.
struct SideBranches {
    double along = 0;  ///< of the corner
    /// The tips of all of them; none when the path has to run through the corner, because a branch starts there that
    /// has a track of its own.
    std::vector<Point> tips;
    double longest = 0;  ///< length of the longest of them, lattice units
};

/// Between `from` and `to`, along a path, it leaves its walls for these tips, in this order.
struct Bend {
    std::size_t branches;  ///< whose tips: an index
    double from, to;
    std::vector<Point> tips;
};

/// Bends for all of `beside` (by increasing `along`) that have tips, of a path without its first `gap`. A bend begins
/// and ends as far from its corner as its longest branch is long, but between `least` and `most`: it goes aside at
/// 45°, less steeply to shorter branches and more steeply to longer ones, nearer where the next branch or an end of the
/// path is; where it would have less than half of that there is none. Beside a straight wall it takes less track than
/// wall and branch up to a length of 4/3 `most`; where it is steeper, where the path turns or branches lie opposite, at
/// most the branches' length more, and a travel less in any case. It may cut across a corner of the shell by less than
/// the branches' length: S_i lies in the cavity, its bends are tracks. Precondition: least <= most, where any has tips.
std::vector<Bend> bends_of(const PathCorners& corners, double gap, const std::vector<SideBranches>& beside,
                           double least, double most);

/// The path without its first `gap`, with these bends (by increasing `from`, apart from each other). Points between
/// corners are rounded to the lattice, once; consecutive points differ. Precondition: it is longer than `gap`.
std::vector<Point> bent_path(const PathCorners& corners, double gap, const std::vector<Bend>& bends);

}  // namespace ribvault
