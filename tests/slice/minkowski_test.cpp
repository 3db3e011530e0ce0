// Offsets against exact Minkowski sums: the shell, dilated by polygons inscribed in the disc and circumscribed about
// it, bounds what erosion may and must leave of a cavity.
#include <CGAL/Polygon_set_2.h>
#include <CGAL/minkowski_sum_2.h>

#include <catch2/catch.hpp>

#include "ribvault/slice/cavity.hpp"
#include "ribvault/slice/exact_polygons.hpp"
#include "vault/random_cavities.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

using Set = CGAL::Polygon_set_2<ExactKernel>;

ExactPolygon exact(const Contour& contour) {
    ExactPolygon polygon;
    for (const Point p : contour) polygon.push_back({static_cast<double>(p.x), static_cast<double>(p.y)});
    return polygon;
}

/// Contours that may touch, outer ones before the holes in them.
Set exact(const Region& region) {
    Set set;
    for (const bool hole : {false, true})
        for (const Contour& c : region) {
            ExactPolygon polygon = exact(c);
            if ((polygon.orientation() == CGAL::CLOCKWISE) != hole) continue;
            if (hole) {
                polygon.reverse_orientation();
                set.difference(polygon);
            } else {
                set.join(polygon);
            }
        }
    return set;
}

/// Regular polygon inside the disc whose corners lie within a unit of its circle.
ExactPolygon inscribed(double radius, int corners) { return exact(disc({0, 0}, radius - 1, corners)); }
/// Regular polygon around the disc.
ExactPolygon circumscribed(double radius, int corners) {
    return exact(disc({0, 0}, (radius + 1) / std::cos(M_PI / corners), corners));
}

/// What of the region lies farther than the polygon reaches from everything else: region minus (complement + polygon).
/// Subtracts the interior's closure; its boundary does not matter to containment tests of closed regions below.
Set eroded(const Region& region, const ExactPolygon& by) {
    Box box = bounding_box(region);
    box.grow(1000000);
    Set complement(exact(rectangle(box.lo.x, box.lo.y, box.hi.x, box.hi.y)));
    complement.difference(exact(region));
    std::vector<ExactPolygonWithHoles> parts;
    complement.polygons_with_holes(std::back_inserter(parts));
    Set left = exact(region);
    for (const ExactPolygonWithHoles& part : parts) left.difference(CGAL::minkowski_sum_2(part, by));
    return left;
}

bool contains(const Set& large, const Set& small) {
    Set rest = small;
    rest.difference(large);
    return rest.is_empty();
}

Region random_region(std::mt19937_64& random, Unit size) {
    while (true) {
        Region region = DriftingShapes(random, 2, 2, size, size / 20).at(0);
        region = make_cavity(0, region, Settings{}).region;
        if (!region.empty()) return region;
    }
}

}  // namespace

TEST_CASE("the eroded slice lies within the erosion by a disc and contains the one by what its corners cut off") {
    std::mt19937_64 random(51);
    for (int k = 0; k < 40; ++k) {
        const Settings settings;
        Slice slice;
        slice.rounded = random_region(random, 600000);
        const double by = static_cast<double>(settings.perimeters * settings.nozzle);
        const Set proposal = exact(erode_slice(slice, settings));
        // The inscribed polygon's sides lie 0.1 % within the disc: less is subtracted than the disc would.
        CHECK(contains(eroded(slice.rounded, inscribed(by, 64)), proposal));
        // At reflex corners two tangents replace the arc: they meet at most sqrt(2) times as far away.
        CHECK(contains(proposal, eroded(slice.rounded, circumscribed(1.4143 * (by + 3) + 3, 24))));
    }
}

TEST_CASE(
    "the deep part of a cavity holds every point farther than ρ from the shell and none nearer than ρ - 2 slacks") {
    std::mt19937_64 random(52);
    for (int k = 0; k < 40; ++k) {
        const Settings settings;
        const Cavity cavity = make_cavity(0, random_region(random, 500000), settings);
        const double rho = static_cast<double>(settings.support_radius), slack = static_cast<double>(settings.slack);
        const Set deep = exact(cavity.deep);
        CHECK(contains(deep, eroded(cavity.region, inscribed(rho, 48))));
        CHECK(contains(eroded(cavity.region, inscribed(rho - 2 * slack, 64)), deep));
        const Set inner = exact(cavity.inner);
        CHECK(contains(exact(cavity.region), inner));
        CHECK(contains(inner, eroded(cavity.region, circumscribed(6, 24))));
    }
}
