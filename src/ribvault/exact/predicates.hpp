// Predicates on lattice points. Each is exact: machine arithmetic where its bound decides, wide integers otherwise.
#pragma once

#include "ribvault/exact/int128.hpp"
#include "ribvault/exact/lattice.hpp"

namespace ribvault {

/// Twice the signed area of the triangle (a, b, c): positive when c lies to the left of a -> b. Exact: coordinate
/// differences stay below 2^31 (lattice_bound), so both products and their difference fit 64 bits.
inline std::int64_t cross(Point a, Point b, Point c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}
inline int sign(std::int64_t v) { return (v > 0) - (v < 0); }
inline int orientation(Point a, Point b, Point c) { return sign(cross(a, b, c)); }
inline std::int64_t squared_length(Point d) { return d.x * d.x + d.y * d.y; }

/// Distance of a point to a closed segment as an exact square: numerator / denominator (denominator > 0).
struct SquaredDistance {
    Int128 numerator;
    std::int64_t denominator;
    double value() const { return static_cast<double>(numerator) / static_cast<double>(denominator); }
};
SquaredDistance squared_distance(Point p, const Segment& s);

/// Sign of distance(p, s) - radius, whatever the radius. Exact.
int compare_distance(Point p, const Segment& s, Unit radius);
/// Sign of distance(s, t) - radius, radius >= 0. Exact.
int compare_distance(const Segment& s, const Segment& t, Unit radius);

/// Of two closed segments, rounded: for measures and placements.
double distance(const Segment& s, const Segment& t);

/// Sign of a - b for two squared distances. Exact: long double triage, 192-bit products when it cannot tell.
int compare(const SquaredDistance& a, const SquaredDistance& b);

/// Sign of (sqrt(a) - bias_a) - (sqrt(b) - bias_b): the comparison of equation (4), whose bonus shortens distances.
/// Exact: long double triage, rational arithmetic on the squared inequality when it cannot tell.
int compare_biased(const SquaredDistance& a, Unit bias_a, const SquaredDistance& b, Unit bias_b);

/// Do two closed segments have a point in common? Exact.
bool segments_touch(const Segment& s, const Segment& t);

/// Do the interiors of two segments cross in one point (no touching at ends, no overlap)? Exact.
bool segments_cross(const Segment& s, const Segment& t);

/// Point of s nearest to p, rounded once to the lattice (a placement, not a decision).
Point nearest_point(Point p, const Segment& s);

}  // namespace ribvault
