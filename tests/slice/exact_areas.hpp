// Exact areas of slices, and the same from the mesh's triangles alone.
#pragma once

#include <Eigen/Geometry>
#include <random>

#include "mesh/solids.hpp"
#include "ribvault/slice/exact_polygons.hpp"
#include "ribvault/slice/slice_mesh.hpp"

namespace ribvault::test {

inline Rational rational(const ExactKernel::FT& number) { return Rational(CGAL::exact(number)); }

/// mm². Checks on the way that the polygons are what regularised polygons are.
inline Rational area_of(const ExactPolygons& slice) {
    Rational area = 0;
    for (const ExactPolygonWithHoles& polygon : slice.polygons) {
        REQUIRE(polygon.outer_boundary().is_simple());
        REQUIRE(polygon.outer_boundary().orientation() == CGAL::COUNTERCLOCKWISE);
        area += rational(polygon.outer_boundary().area());
        for (auto hole = polygon.holes_begin(); hole != polygon.holes_end(); ++hole) {
            REQUIRE(hole->is_simple());
            REQUIRE(hole->orientation() == CGAL::CLOCKWISE);
            area += rational(hole->area());
        }
    }
    return area;
}
inline std::size_t holes_of(const ExactPolygons& slice) {
    std::size_t holes = 0;
    for (const ExactPolygonWithHoles& polygon : slice.polygons) holes += polygon.number_of_holes();
    return holes;
}

/// Area of the cross-section at height z (no vertex has it) as half the sum of p x q over the chords p -> q of all
/// triangles, material on the left: exact, and right for every closed mesh whose winding numbers are 0 and 1.
inline Rational area_by_triangles(const Mesh& mesh, const Placement& placement, const Rational& z) {
    const auto at = [&](int v, std::size_t k) {
        return Rational(placement.scale * placement.sign[k] * Rational(mesh.vertices(placement.axis[k], v)) +
                        placement.offset[k]);
    };
    Rational twice = 0;
    for (int t = 0; t < mesh.triangles.cols(); ++t) {
        Rational from[2], to[2];
        int crossed = 0;
        for (int k = 0; k < 3; ++k) {
            const int a = mesh.triangles(k, t), b = mesh.triangles((k + 1) % 3, t);
            const Rational za = at(a, 2), zb = at(b, 2);
            REQUIRE(za != z);
            if ((za < z) == (zb < z)) continue;
            const Rational share = (z - za) / (zb - za);
            // Seen from outside, a triangle's boundary rises on its right: the chord leads there from the falling side.
            Rational* point = za < z ? to : from;
            for (std::size_t i = 0; i < 2; ++i) point[i] = at(a, i) + share * (at(b, i) - at(a, i));
            ++crossed;
        }
        if (crossed == 2) twice += from[0] * to[1] - from[1] * to[0];
    }
    return abs(twice / 2);
}

inline Settings layers_of(const char* height) {
    Settings settings;
    settings.layer_height = settings.first_layer_height = parse_length(height, "layer height");
    return settings;
}

inline Rational slice_area(const Slicer& slicer, int layer) { return area_of(*slicer.slice(layer).exact); }

inline Rational squared(const Rational& q) { return q * q; }

/// Faces of a convex polyhedron as polygons, turned so that they face away from the middle of all corners.
inline std::vector<Triangle> convex(const std::vector<std::vector<Corner>>& faces) {
    Corner middle{0, 0, 0};
    double count = 0;
    for (const auto& face : faces)
        for (const Corner& c : face) {
            for (std::size_t i = 0; i < 3; ++i) middle[i] += c[i];
            ++count;
        }
    for (double& m : middle) m /= count;
    std::vector<Triangle> triangles;
    for (const auto& face : faces)
        for (std::size_t k = 2; k < face.size(); ++k) {
            Triangle t{face[0], face[k - 1], face[k]};
            const Eigen::Vector3d a(t[0].data()), b(t[1].data()), c(t[2].data()), m(middle.data());
            if ((b - a).cross(c - a).dot(a - m) < 0) std::swap(t[1], t[2]);
            triangles.push_back(t);
        }
    return triangles;
}

/// |x| + |y| + |z| <= R about a centre.
inline std::vector<Triangle> octahedron(Corner centre, double radius) {
    std::vector<std::vector<Corner>> faces;
    for (const double x : {-radius, radius})
        for (const double y : {-radius, radius})
            for (const double z : {-radius, radius})
                faces.push_back({{centre[0] + x, centre[1], centre[2]},
                                 {centre[0], centre[1] + y, centre[2]},
                                 {centre[0], centre[1], centre[2] + z}});
    return convex(faces);
}

/// A bumpy ball: star-shaped about the middle axis point, rings at the given heights between two poles.
inline std::vector<Triangle> bumpy_ball(std::mt19937_64& random, const std::vector<double>& heights, int corners,
                                        double grain) {
    const auto radius = [&] { return grain * std::uniform_int_distribution<int>(4, 60)(random); };
    std::vector<std::vector<Corner>> rings;
    for (std::size_t r = 1; r + 1 < heights.size(); ++r) {
        std::vector<Corner> ring;
        for (int k = 0; k < corners; ++k) {
            const double angle = 2 * M_PI * k / corners, d = radius();
            ring.push_back({std::round(d * std::cos(angle) / grain) * grain,
                            std::round(d * std::sin(angle) / grain) * grain, heights[r]});
        }
        rings.push_back(ring);
    }
    std::vector<Triangle> triangles;
    const Corner south{0, 0, heights.front()}, north{0, 0, heights.back()};
    for (int k = 0; k < corners; ++k) {
        const auto i = static_cast<std::size_t>(k), j = static_cast<std::size_t>((k + 1) % corners);
        triangles.push_back({south, rings.front()[j], rings.front()[i]});
        for (std::size_t r = 0; r + 1 < rings.size(); ++r) {
            triangles.push_back({rings[r][i], rings[r][j], rings[r + 1][j]});
            triangles.push_back({rings[r][i], rings[r + 1][j], rings[r + 1][i]});
        }
        triangles.push_back({rings.back()[i], rings.back()[j], north});
    }
    return triangles;
}

}  // namespace ribvault::test
