// Small layers for the verifier's tests.
#pragma once

#include <random>

#include "ribvault/slice/exact_polygons.hpp"
#include "ribvault/verify/verify_layer.hpp"

namespace ribvault::test {

/// A layer that owns what LayerGeometry points to. Coordinates in lattice units.
struct Layer {
    Region outline;  ///< outer contours counter-clockwise, each followed by its holes (clockwise)
    Region cavity;
    std::vector<Segment> tracks;
    ExactPolygons exact;
};

inline Contour rectangle(Unit x0, Unit y0, Unit x1, Unit y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }
inline Contour reversed(Contour c) { return {c.rbegin(), c.rend()}; }
inline Contour square(Unit half) { return rectangle(-half, -half, half, half); }

inline bool counter_clockwise(const Contour& c) { return signed_area({c}) > 0; }

inline ExactPolygon exact_polygon(const Contour& c) {
    ExactPolygon polygon;
    for (const Point p : c)
        polygon.push_back({ExactKernel::FT(static_cast<double>(p.x)) / ExactKernel::FT(units_per_mm),
                           ExactKernel::FT(static_cast<double>(p.y)) / ExactKernel::FT(units_per_mm)});
    return polygon;
}

inline Layer layer(Region outline, Region cavity, std::vector<Segment> tracks = {}) {
    Layer l{std::move(outline), std::move(cavity), std::move(tracks), {}};
    for (std::size_t i = 0; i < l.outline.size();) {
        const ExactPolygon outer = exact_polygon(l.outline[i++]);
        std::vector<ExactPolygon> holes;
        while (i < l.outline.size() && !counter_clockwise(l.outline[i])) holes.push_back(exact_polygon(l.outline[i++]));
        l.exact.polygons.emplace_back(outer, holes.begin(), holes.end());
    }
    return l;
}

inline LayerGeometry view(const Layer& l) { return {&l.exact, &l.cavity, l.tracks}; }

/// r is of the supports; the nozzle's makes no difference here.
inline Settings settings(Unit r, Unit rho) {
    Settings s;
    s.support_width = 2 * r;
    s.support_radius = rho;
    return s;
}

inline LayerVerdict verify(const Layer& upper, const Layer& lower, const Settings& s) {
    return verify_layer(1, view(upper), view(lower), s);
}

}  // namespace ribvault::test
