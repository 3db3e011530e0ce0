// The vertices of a trace problem in order along their curves. Exact. Heavy: include in .cpp files only.
#pragma once

#include "ribvault/verify/trace_problem.hpp"

namespace ribvault::verify {

/// A vertex on a curve and an enclosure of its place there: circles: its angle, counterclockwise from a direction that
/// is far from all vertices of the curve, in radians; lines: the t of a + t (b - a) abreast of it.
struct Place {
    int vertex = 0;
    double lo = 0, hi = 0;
};

/// The vertices among `which` that lie at different points, in order along the curve; those that lie at one point are
/// united. Precondition: all lie on the curve. Under upward rounding.
std::vector<Place> order_along(TraceProblem& trace, int curve, std::span<const int> which);

/// A point of a curve, mm, exactly: base + across sqrt(norm) normal.
struct CurvePoint {
    RationalPoint base, normal{0, 0};
    Rational across, norm;
    double x = 0, y = 0;  ///< within the margin
};

/// A point of the curve strictly between two places that follow each other. `round`: from the last place of a circle to
/// the first, which may be the same.
CurvePoint point_between(TraceProblem& trace, int curve, const Place& from, const Place& to, bool round);

/// A point of a circle.
CurvePoint point_of_circle(const TraceProblem& trace, int curve);

/// Sign of the distance of the point to the segment from a to b minus `radius`. Exact.
int compare_distance(const CurvePoint& p, const RationalPoint& a, const RationalPoint& b, const Rational& radius);

/// Rational point within 2^-bits (mm) of p.
RationalPoint approximation(const CurvePoint& p, unsigned bits);

}  // namespace ribvault::verify
