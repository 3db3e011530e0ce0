// Where a located point lies relative to stadiums, lines and oriented boundaries; exact.
#pragma once

#include <span>

#include "ribvault/verify/candidate.hpp"

namespace ribvault::verify {

enum class Side { inside, on, outside, unknown };

/// Where v lies relative to a closed stadium, using stages up to `last`.
Side side_of_stadium(Located& v, const Stadium& stadium, Stage last);

/// Sign of |v - centre| - radius.
int disc_sign(Located& v, int centre, const Radius& radius, Stage last);

/// Sign of the distance of v from the line through vertices a and b, minus radius.
int strip_sign(Located& v, int a, int b, const Radius& radius, Stage last);

/// Orientation of (vertex a, vertex b, v): 1 when v is to the left.
int orientation_sign(Located& v, int a, int b, Stage last);

/// Sign of (v - a) . (b - a): 0 on the normal line through vertex a.
int ahead_sign(Located& v, int a, int b, Stage last);

/// Winding number at `to` minus that at (from_x, from_y) for the oriented edges all[which...]. Precondition: no other
/// edge of that boundary meets the segment between the two points, `to` is on none of the edges, `from` on none of
/// their lines.
int crossings(std::span<const Edge> all, std::span<const int> which, double from_x, double from_y, Located& to);

/// The point (x, y) of a problem, for the predicates above. Coordinates in lattice units, exactly these binary floats.
Located double_point(const CoverProblem& problem, double x, double y);

/// Whether (x, y) is on none of the lines of all[which...]. Exact.
bool off_lines(const CoverProblem& problem, std::span<const Edge> all, std::span<const int> which, double x, double y);

}  // namespace ribvault::verify
