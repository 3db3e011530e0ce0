// Cavities: never outside the true erosion, contours that do not cross, overhangs that miss nothing. Decided exactly.
#include "ribvault/slice/cavity.hpp"

#include <catch2/catch.hpp>

#include "exact/rationals.hpp"
#include "ribvault/exact/nearest_segment.hpp"
#include "ribvault/exact/point_location.hpp"
#include "slice/exact_areas.hpp"
#include "vault/random_cavities.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

/// A star with reflex corners whose corners are rational points off the lattice, in lattice units.
struct RationalStar {
    std::vector<RationalPoint> corners;
    Contour rounded;

    RationalStar(Random& g, Point centre, Unit lo, Unit hi, int n, bool hole) {
        for (int k = 0; k < n; ++k) {
            const double angle = (hole ? -2 : 2) * M_PI * k / n, r = static_cast<double>(pick(g, lo, hi));
            const Point p{centre.x + round_to_lattice(r * std::cos(angle)),
                          centre.y + round_to_lattice(r * std::sin(angle))};
            // The farthest that rounding can be off: half a unit in both directions, nearly.
            const auto part = [&] {
                return Rational(whole(pick(g, 0, 3) ? pick(g, -499, 499) : 499 * (2 * pick(g, 0, 1) - 1)), 1000);
            };
            corners.push_back({Rational(whole(p.x)) + part(), Rational(whole(p.y)) + part()});
            rounded.push_back(p);
        }
    }
};

/// Squared distance between two segments that do not cross, one with rational ends.
Rational squared_distance_between(const RationalPoint& a, const RationalPoint& b, const Segment& s) {
    const auto to = [](const RationalPoint& p, const RationalPoint& from, const RationalPoint& end) {
        const RationalPoint u = end - from;
        Rational t = dot(p - from, u) / dot(u, u);
        t = t < 0 ? Rational(0) : t > 1 ? Rational(1) : t;
        const RationalPoint d{p.x - from.x - t * u.x, p.y - from.y - t * u.y};
        return dot(d, d);
    };
    return std::min({rational_squared_distance(a, s), rational_squared_distance(b, s), to(rational(s.a), a, b),
                     to(rational(s.b), a, b)});
}

bool crossing_free(const Region& region) {
    const std::vector<Segment> edges = edges_of(region);
    for (std::size_t i = 0; i < edges.size(); ++i)
        for (std::size_t j = i + 1; j < edges.size(); ++j)
            if (segments_cross(edges[i], edges[j])) return false;
    return true;
}

Unit units(double v) { return static_cast<Unit>(v); }

}  // namespace

TEST_CASE("the eroded slice keeps p d from the slice's exact boundary, at reflex corners and holes too") {
    Random g(41);
    int corners = 0;
    for (int k = 0; k < 60; ++k) {
        Settings settings;
        settings.perimeters = static_cast<int>(pick(g, 1, 3));
        settings.nozzle = 2 * pick(g, 5000, 30000);
        const Unit by = settings.perimeters * settings.nozzle;
        std::vector<RationalStar> stars;
        stars.emplace_back(g, Point{0, 0}, 3 * by, 9 * by, pick(g, 5, 14), false);
        if (k % 2) stars.emplace_back(g, Point{0, 0}, by / 4, 3 * by / 2, pick(g, 3, 9), true);
        Slice slice;
        for (const RationalStar& star : stars) slice.rounded.push_back(star.rounded);
        const Region eroded = erode_slice(slice, settings);
        const PointLocation inside(edges_of(slice.rounded), by);
        const Rational limit(whole(by) * whole(by));
        for (const Segment& e : edges_of(eroded)) {
            ++corners;
            REQUIRE(inside.locate(e.a) == Side::inside);
            for (const RationalStar& star : stars)
                for (std::size_t i = 0, n = star.corners.size(); i < n; ++i)
                    REQUIRE(squared_distance_between(star.corners[i], star.corners[(i + 1) % n], e) >= limit);
        }
    }
    CHECK(corners > 300);
}

TEST_CASE("an eroded square is the square p d + 30 nm within") {
    Slice slice;
    slice.rounded = {rectangle(0, 0, 2000000, 2000000)};
    Settings settings;
    settings.perimeters = 2;
    const Region eroded = erode_slice(slice, settings);
    const Box box = bounding_box(eroded);
    CHECK(box.lo == Point{80003, 80003});
    CHECK(box.hi == Point{1919997, 1919997});
    CHECK(signed_area(eroded) == 1839994.0 * 1839994.0);
    slice.rounded = {rectangle(0, 0, 160006, 2000000)};
    CHECK(erode_slice(slice, settings).empty());
}

TEST_CASE("cavity contours never cross, whatever the intersection of slices leaves") {
    Random g(42);
    int contours = 0;
    for (int k = 0; k < 300; ++k) {
        const Unit size = k % 3 == 0 ? 400 : 600000;  // small ones are nearly all rounding
        Region region = DriftingShapes(g, 3, 3, size, size / 20).at(0);
        for (int n = 0; n < 2; ++n) region = intersect(region, DriftingShapes(g, 4, 3, size, size / 20).at(1));
        const Cavity cavity = make_cavity(k, region, Settings{});
        REQUIRE(cavity.layer == k);
        REQUIRE(crossing_free(cavity.region));
        contours += static_cast<int>(cavity.region.size());
        const PointLocation outline(edges_of(region), size), own(edges_of(cavity.region), size);
        for (const Contour& c : cavity.region)
            for (const Point p : c) REQUIRE(outline.locate(p) != Side::outside);
        for (const Region& part : {cavity.inner, cavity.deep})
            for (const Contour& c : part)
                for (const Point p : c) REQUIRE(own.locate(p) == Side::inside);
    }
    CHECK(contours > 300);
}

TEST_CASE("contours that cross by a unit are pulled apart") {
    // A spike from below that reaches one unit over the top edge of the hole above it.
    const Region crossing{rectangle(0, 0, 100000, 100000), reversed({{20000, 50000}, {80000, 50000}, {50000, 90000}}),
                          reversed({{30000, 10000}, {70000, 10000}, {50000, 50001}})};
    REQUIRE_FALSE(crossing_free(crossing));
    const Cavity cavity = make_cavity(0, crossing, Settings{});
    CHECK(crossing_free(cavity.region));
    CHECK(signed_area(cavity.region) == Approx(signed_area(crossing)).epsilon(0.001));
}

TEST_CASE(
    "the overhang over a cavity misses no point that hangs farther than ρ from the shell, and few others are in it") {
    Random g(43);
    int hanging = 0, held = 0;
    for (int k = 0; k < 120; ++k) {
        Settings settings;
        settings.support_radius = pick(g, 1, 2) * 10000;
        settings.top_layers = static_cast<int>(pick(g, 0, 1));
        const Unit rho = settings.support_radius, slack = settings.slack, size = 20 * rho;
        const DriftingShapes shapes(g, 2, 2, size, rho);
        const Cavity below = make_cavity(0, shapes.at(0), settings), above = make_cavity(1, shapes.at(1), settings);
        Slice slice_above;
        slice_above.rounded = settings.top_layers ? Region{rectangle(-9 * size, -9 * size, 9 * size, 9 * size)}
                                                  : offset(shapes.at(1), 2.1 * static_cast<double>(rho));
        if (below.region.empty()) continue;
        const Region overhang = overhang_over_cavity(below, slice_above, above, settings);
        const NearestSegment shell(edges_of(below.region)), hole(edges_of(above.region)),
            outline(edges_of(slice_above.rounded));
        const PointLocation in_below(edges_of(below.region), rho), in_above(edges_of(above.region), rho),
            in_slice(edges_of(slice_above.rounded), rho), in_overhang(edges_of(overhang), rho);
        const auto beyond = [](const NearestSegment& edges, Point p, Unit r) {
            return edges.empty() || rational_squared_distance(p, edges.segments()[edges.nearest(p).index]) >
                                        Rational(whole(r) * whole(r));
        };
        for (int q = 0; q < 800; ++q) {
            // Anywhere, or where it is hardest to tell: about ρ from an edge of the shell, or along the cavity above.
            Point p{pick(g, -size, size), pick(g, -size, size)};
            if (q % 4 != 0) {
                const NearestSegment& edges = q % 4 != 1 ? shell : q % 8 == 1 || hole.empty() ? outline : hole;
                const Segment& e = edges.segments()[static_cast<std::size_t>(
                    pick(g, 0, static_cast<Unit>(edges.segments().size()) - 1))];
                const double t = std::uniform_real_distribution<double>(0, 1)(g), l = std::max(1.0, length(e));
                const double away =
                    q % 4 == 1 ? 0 : static_cast<double>(rho + pick(g, -1, 2) * (q % 8 == 2 ? 1 : slack));
                p = {units(static_cast<double>(e.a.x) + t * static_cast<double>(e.b.x - e.a.x) -
                           away * static_cast<double>(e.b.y - e.a.y) / l) +
                         pick(g, -1, 1),
                     units(static_cast<double>(e.a.y) + t * static_cast<double>(e.b.y - e.a.y) +
                           away * static_cast<double>(e.b.x - e.a.x) / l) +
                         pick(g, -1, 1)};
            }
            const bool material_above = in_slice.locate(p) != Side::outside && in_above.locate(p) != Side::inside;
            const bool unsupported = material_above && in_below.locate(p) == Side::inside && beyond(shell, p, rho);
            INFO("pair " << k << ", point (" << p.x << ", " << p.y << ")");
            if (unsupported) {
                ++hanging;
                REQUIRE(in_overhang.locate(p) != Side::outside);
            }
            if (in_overhang.locate(p) == Side::inside) {
                REQUIRE(in_below.locate(p) == Side::inside);
                REQUIRE(beyond(shell, p, rho - 2 * slack));
                REQUIRE((in_above.locate(p) != Side::inside || !beyond(hole, p, 2 * slack)));
                REQUIRE((in_slice.locate(p) == Side::inside || !beyond(outline, p, 2 * slack)));
            } else {
                ++held;
            }
        }
    }
    CHECK(hanging > 800);
    CHECK(held > 2000);
}

TEST_CASE("a slope that recedes by exactly ρ adds nothing, one that recedes by a slack more does") {
    const Settings settings;
    const Unit rho = settings.support_radius, mm = units_per_mm;
    Slice above;
    above.rounded = {rectangle(-50 * mm, -50 * mm, 50 * mm, 50 * mm)};
    const auto square = [&](Unit half) { return make_cavity(0, {rectangle(-half, -half, half, half)}, settings); };
    // The same turned by the angle of 3-4-5, so that the distance of parallel edges is a whole number again.
    const auto turned = [&](Unit half) {
        const auto at = [&](Unit x, Unit y) { return Point{(4 * x - 3 * y) / 5, (3 * x + 4 * y) / 5}; };
        return make_cavity(0, {{at(-half, -half), at(half, -half), at(half, half), at(-half, half)}}, settings);
    };
    const Cavity wide = square(5 * mm), slanted = turned(5 * mm);
    CHECK(overhang_over_cavity(wide, above, square(5 * mm - rho), settings).empty());
    CHECK(overhang_over_cavity(slanted, above, turned(5 * mm - rho), settings).empty());
    CHECK(overhang_over_cavity(wide, above, square(5 * mm - rho / 2), settings).empty());
    CHECK(overhang_over_cavity(wide, above, wide, settings).empty());
    for (const Unit more : {5 * settings.slack, rho}) {
        CHECK_FALSE(overhang_over_cavity(wide, above, square(5 * mm - rho - more), settings).empty());
        CHECK_FALSE(overhang_over_cavity(slanted, above, turned(5 * mm - rho - more), settings).empty());
    }
    // A ceiling: all of the cavity deeper than ρ hangs.
    const double ceiling = signed_area(overhang_over_cavity(wide, above, {}, settings)),
                 deep = 2 * static_cast<double>(5 * mm - rho);
    CHECK(ceiling >= deep * deep);
    CHECK(ceiling < (deep + 400) * (deep + 400));
}

TEST_CASE("without covers only what is printed above hangs over a cavity") {
    Settings settings;
    const Unit mm = units_per_mm;
    const Cavity wide = make_cavity(0, {rectangle(-5 * mm, -5 * mm, 5 * mm, 5 * mm)}, settings);
    Slice beam;
    beam.rounded = {rectangle(-mm, -9 * mm, mm, 9 * mm)};
    for (const int covers : {0, 1}) {
        settings.top_layers = covers;
        const double hanging =
            signed_area(overhang_over_cavity(wide, beam, {}, settings)) / static_cast<double>(mm * mm);
        CHECK(hanging == Approx(covers == 0 ? 2 * 9.6 : 9.6 * 9.6).epsilon(0.001));
        CHECK(overhang_over_cavity(wide, Slice(), {}, settings).empty() == (covers == 0));
    }
}

TEST_CASE("the cavities of a roof at 45 degrees need no support but under its tip") {
    const Mesh roof = weld(convex({{{-10, -10, 0}, {10, -10, 0}, {10, 10, 0}, {-10, 10, 0}},
                                   {{-10, -10, 0}, {10, -10, 0}, {0, 0, 10}},
                                   {{10, -10, 0}, {10, 10, 0}, {0, 0, 10}},
                                   {{10, 10, 0}, {-10, 10, 0}, {0, 0, 10}},
                                   {{-10, 10, 0}, {-10, -10, 0}, {0, 0, 10}}}));
    const Settings settings;
    const Slicer slicer(roof, Placement{}, settings);
    std::vector<Slice> slices;
    std::vector<Cavity> cavities;
    for (int i = 0; i < slicer.layer_count(); ++i) slices.push_back(slicer.slice(i));
    for (std::size_t i = 1; i + 1 < slices.size(); ++i)
        cavities.push_back(
            make_cavity(static_cast<int>(i),
                        intersect(erode_slice(slices[i - 1], settings),
                                  intersect(erode_slice(slices[i], settings), erode_slice(slices[i + 1], settings))),
                        settings));
    int open = 0;
    for (std::size_t i = 0; i + 1 < cavities.size() && !cavities[i + 1].region.empty(); ++i, ++open)
        CHECK(overhang_over_cavity(cavities[i], slices[i + 2], cavities[i + 1], settings).empty());
    CHECK(open > 40);
}

TEST_CASE("one unit beyond the tie is unsupported, and found though the sliver is a unit wide") {
    const Settings settings;
    const Unit rho = settings.support_radius, half = 500000;
    Slice above;
    above.rounded = {rectangle(-9 * half, -9 * half, 9 * half, 9 * half)};
    const auto cavity = [&](Unit h) { return make_cavity(0, {rectangle(-h, -h, h, h)}, settings); };
    const Region overhang = overhang_over_cavity(cavity(half), above, cavity(half - rho - 1), settings);
    const PointLocation location(edges_of(overhang), rho);
    // The edge of the upper shell lies rho + 1 from the lower one.
    for (const Unit along : {-half / 2, Unit{0}, half / 3})
        CHECK(location.locate({along, half - rho - 1}) != Side::outside);
}
