// Slice vertices on mesh edges that are nearly parallel to the plane: the machine-number enclosures that come with lazy
// exact numbers are then wide, and nothing may rely on their middle.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "ribvault/slice/cavity.hpp"
#include "ribvault/slice/exact_polygons.hpp"
#include "ribvault/slice/slice_mesh.hpp"

using namespace ribvault;

namespace {

/// A 20 mm box whose lid falls from z = 0.7 + up (at the corner y = 20: 1.7 up) at x = 0 to z = 0.7 - down at x = 20,
/// mm.
Mesh nearly_level_lid(double down, double up) {
    const double lo = 0.7 - down, hi = 0.7 + up;
    Mesh mesh;
    mesh.vertices.resize(3, 8);
    const double corners[8][3] = {{0, 0, 0},  {20, 0, 0},  {20, 20, 0},  {0, 20, 0},
                                  {0, 0, hi}, {20, 0, lo}, {20, 20, lo}, {0, 20, 0.7 + 1.7 * up}};
    for (int v = 0; v < 8; ++v)
        for (int k = 0; k < 3; ++k) mesh.vertices(k, v) = corners[v][k];
    const int triangles[12][3] = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                                  {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
    mesh.triangles.resize(3, 12);
    for (int t = 0; t < 12; ++t)
        for (int k = 0; k < 3; ++k) mesh.triangles(k, t) = triangles[t][k];
    return mesh;
}

}  // namespace

TEST_CASE(
    "vertices of a slice are rounded to the nearest lattice point however flat the mesh edges through the plane are") {
    for (const double size : {1e-9, 1e-10, 3e-11, 1e-11, 4e-12, 2e-12, 1e-12, 1e-13, 1e-15})
        for (const double share : {1.0, 0.37, 2.9}) {
            const Mesh mesh = nearly_level_lid(size, size * share);
            Placement placement;
            placement.offset = {Rational(115), Rational(115), Rational(0)};
            const Settings settings;
            const Slicer slicer(mesh, placement, settings);
            const int layer = 3;  // z = 7/10
            if (slicer.layer_count() <= layer) continue;
            const Slice slice = slicer.slice(layer);
            REQUIRE(slice.exact->polygons.size() == 1);
            // Every rounded vertex is the nearest lattice point of an exact one.
            const auto& outer = slice.exact->polygons[0].outer_boundary();
            double worst = 0;
            for (const Point p : slice.rounded.at(0)) {
                double least = HUGE_VAL;
                for (auto v = outer.vertices_begin(); v != outer.vertices_end(); ++v) {
                    const Rational x = CGAL::exact(v->x()), y = CGAL::exact(v->y());
                    const Rational dx = x * units_per_mm - Rational(static_cast<long>(p.x)),
                                   dy = y * units_per_mm - Rational(static_cast<long>(p.y));
                    least = std::min(least, std::max(std::abs(dx.get_d()), std::abs(dy.get_d())));
                }
                worst = std::max(worst, least);
            }
            INFO("lid from " << size * share << " above to " << size << " below the plane");
            CHECK(worst <= 0.5000001);
        }
}
