// Equation (2) by an arrangement of circular arcs: exact, and by another road than src/ribvault/verify, which
// constructs no boundary. Offset lines must have rational coefficients, so tracks and edges below run along the axes or
// with a 3-4-5 slope.
#pragma once

#include <CGAL/General_polygon_set_2.h>
#include <CGAL/Gps_circle_segment_traits_2.h>

#include "layers.hpp"

namespace ribvault::test {

using ArcTraits = CGAL::Gps_circle_segment_traits_2<ExactKernel>;
using ArcSet = CGAL::General_polygon_set_2<ArcTraits>;
using ArcPolygon = ArcTraits::Polygon_2;
using Exact = ExactKernel::FT;
using ExactPoint = ExactKernel::Point_2;

inline ArcPolygon straight_polygon(const std::vector<ExactPoint>& points) {
    ArcPolygon polygon;
    for (std::size_t i = 0; i < points.size(); ++i)
        polygon.push_back(ArcTraits::X_monotone_curve_2(points[i], points[(i + 1) % points.size()]));
    return polygon;
}

/// All points within `radius` of the segment. Precondition: the length of b - a is a whole number, or a == b.
inline ArcSet stadium_set(Point a, Point b, Unit radius) {
    const auto disc = [&](Point c) {
        ArcTraits traits;
        const ArcTraits::Curve_2 circle(
            ExactKernel::Circle_2(ExactPoint(Exact(c.x), Exact(c.y)), Exact(radius) * Exact(radius)));
        std::vector<CGAL::Object> parts;
        traits.make_x_monotone_2_object()(circle, std::back_inserter(parts));
        ArcPolygon polygon;
        for (const CGAL::Object& part : parts) {
            ArcTraits::X_monotone_curve_2 arc;
            if (CGAL::assign(arc, part)) polygon.push_back(arc);
        }
        return polygon;
    };
    ArcSet set(disc(a));
    if (a == b) return set;
    set.join(disc(b));
    const Point d = b - a;
    const Unit square = d.x * d.x + d.y * d.y;
    const Unit length = static_cast<Unit>(std::llround(std::sqrt(static_cast<double>(square))));
    if (length * length != square) throw std::logic_error("the length of a segment is no whole number");
    const Exact nx = Exact(-d.y) * Exact(radius) / Exact(length), ny = Exact(d.x) * Exact(radius) / Exact(length);
    set.join(straight_polygon({{Exact(a.x) - nx, Exact(a.y) - ny}, {Exact(b.x) - nx, Exact(b.y) - ny},
                               {Exact(b.x) + nx, Exact(b.y) + ny}, {Exact(a.x) + nx, Exact(a.y) + ny}}));
    return set;
}

inline ArcPolygon in_units(const ExactPolygon& polygon) {
    std::vector<ExactPoint> points;
    for (auto v = polygon.vertices_begin(); v != polygon.vertices_end(); ++v)
        points.emplace_back(v->x() * Exact(units_per_mm), v->y() * Exact(units_per_mm));
    ArcPolygon result = straight_polygon(points);
    if (result.orientation() != CGAL::COUNTERCLOCKWISE) result.reverse_orientation();
    return result;
}

inline ArcSet outline_set(const ExactPolygons& outline) {
    ArcSet set;
    for (const ExactPolygonWithHoles& p : outline.polygons) {
        ArcSet piece(in_units(p.outer_boundary()));
        for (const ExactPolygon& hole : p.holes()) piece.difference(in_units(hole));
        set.join(piece);
    }
    return set;
}

/// X_int and X_ext of docs/verifier.md. `hollow`: int C of each layer as a set.
struct ArcVerdict {
    bool internal = false, external = false;  ///< not empty
};
inline ArcVerdict decide_by_arcs(const Layer& upper, const ArcSet& hollow_above, const Layer& lower,
                                 const ArcSet& hollow_below, const Settings& s) {
    ArcSet material = outline_set(upper.exact);
    material.difference(hollow_above);
    const Unit r = s.support_width / 2, rho = s.support_radius;
    for (const Segment& t : upper.tracks) material.join(stadium_set(t.a, t.b, r));
    ArcVerdict verdict;
    ArcSet external = material;
    external.difference(outline_set(lower.exact));
    for (const Contour& c : lower.outline)
        for (std::size_t i = 0; i < c.size() && !external.is_empty(); ++i)
            external.difference(stadium_set(c[i], c[(i + 1) % c.size()], rho));
    verdict.external = !external.is_empty();
    ArcSet internal = material;
    internal.intersection(hollow_below);
    // The boundary of int C: that of the regularised set.
    std::vector<ArcTraits::Polygon_with_holes_2> parts;
    hollow_below.polygons_with_holes(std::back_inserter(parts));
    const auto take = [&](const ArcPolygon& boundary) {
        for (auto e = boundary.curves_begin(); e != boundary.curves_end() && !internal.is_empty(); ++e) {
            const auto whole = [](const auto& c) { return static_cast<Unit>(std::llround(CGAL::to_double(c))); };
            internal.difference(stadium_set({whole(e->source().x()), whole(e->source().y())},
                                            {whole(e->target().x()), whole(e->target().y())}, rho));
        }
    };
    for (const auto& part : parts) {
        take(part.outer_boundary());
        for (auto h = part.holes_begin(); h != part.holes_end(); ++h) take(*h);
    }
    for (const Segment& t : lower.tracks)
        if (!internal.is_empty()) internal.difference(stadium_set(t.a, t.b, r + rho));
    verdict.internal = !internal.is_empty();
    return verdict;
}

}  // namespace ribvault::test
