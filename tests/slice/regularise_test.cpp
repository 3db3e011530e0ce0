// Overlapping, touching, repeated and inverted shells: solid is where the winding number is not zero.
#include <catch2/catch.hpp>

#include "exact_areas.hpp"
#include "ribvault/slice/nest_contours.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

std::vector<Triangle> tower(double x0, double y0, double x1, double y1, bool inverted = false) {
    return box({x0, y0, 0}, {x1, y1, 5}, inverted);
}

ExactPolygons slice_of(const std::vector<Triangle>& triangles) {
    const Mesh mesh = weld(triangles);
    return *Slicer(mesh, Placement{}, layers_of("0.2")).slice(11).exact;
}

ExactContour contour(const std::vector<std::array<int, 2>>& points) {
    ExactContour c;
    for (const auto& [x, y] : points) c.emplace_back(x, y);
    return c;
}
ExactContour rectangle(int x0, int y0, int x1, int y1) { return contour({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}); }
ExactContour reversed(ExactContour c) { return {c.rbegin(), c.rend()}; }

/// Is p in the interior of the polygons, outside them, or on their boundary?
CGAL::Bounded_side side(const ExactPolygons& slice, const ExactPoint& p) {
    for (const ExactPolygonWithHoles& polygon : slice.polygons) {
        CGAL::Bounded_side s = polygon.outer_boundary().bounded_side(p);
        if (s == CGAL::ON_UNBOUNDED_SIDE) continue;
        for (auto hole = polygon.holes_begin(); s == CGAL::ON_BOUNDED_SIDE && hole != polygon.holes_end(); ++hole) {
            const CGAL::Bounded_side in_hole = hole->bounded_side(p);
            if (in_hole == CGAL::ON_BOUNDARY) s = CGAL::ON_BOUNDARY;
            if (in_hole == CGAL::ON_BOUNDED_SIDE) s = CGAL::ON_UNBOUNDED_SIDE;
        }
        if (s != CGAL::ON_UNBOUNDED_SIDE) return s;
    }
    return CGAL::ON_UNBOUNDED_SIDE;
}

int winding(const std::vector<ExactContour>& contours, const ExactPoint& p) {
    int w = 0;
    for (const ExactContour& c : contours)
        for (std::size_t i = 0; i < c.size(); ++i) {
            const ExactPoint &a = c[i], &b = c[(i + 1) % c.size()];
            if ((a.y() <= p.y()) == (b.y() <= p.y())) continue;
            const auto at = a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
            if (at > p.x()) w += a.y() <= p.y() ? 1 : -1;
        }
    return w;
}

/// No two polygons share a piece of an edge, nor does one with its own holes.
void check_no_shared_edges(const ExactPolygons& slice) {
    std::vector<ExactKernel::Segment_2> edges;
    for (const ExactPolygonWithHoles& polygon : slice.polygons) {
        edges.insert(edges.end(), polygon.outer_boundary().edges_begin(), polygon.outer_boundary().edges_end());
        for (auto hole = polygon.holes_begin(); hole != polygon.holes_end(); ++hole)
            edges.insert(edges.end(), hole->edges_begin(), hole->edges_end());
    }
    for (std::size_t i = 0; i < edges.size(); ++i)
        for (std::size_t j = i + 1; j < edges.size(); ++j) {
            const auto &e = edges[i], &f = edges[j];
            if (CGAL::orientation(e.source(), e.target(), f.source()) != CGAL::COLLINEAR ||
                CGAL::orientation(e.source(), e.target(), f.target()) != CGAL::COLLINEAR)
                continue;
            const auto lo = std::max(std::min(e.source(), e.target()), std::min(f.source(), f.target()));
            const auto hi = std::min(std::max(e.source(), e.target()), std::max(f.source(), f.target()));
            REQUIRE(lo >= hi);
        }
}

}  // namespace

TEST_CASE("shells that overlap are one solid") {
    const ExactPolygons cross = slice_of(tower(0, 4, 12, 8) + tower(4, 0, 8, 12));
    CHECK(area_of(cross) == 12 * 4 + 12 * 4 - 16);
    CHECK(cross.polygons.size() == 1);
    CHECK(area_of(slice_of(tower(0, 0, 9, 9) + tower(2, 2, 5, 5))) == 81);
}

TEST_CASE("shells that touch along a face, an edge or twice at the same place") {
    const ExactPolygons face = slice_of(tower(0, 0, 4, 4) + tower(4, 0, 9, 4));
    CHECK(area_of(face) == 36);
    CHECK(face.polygons.size() == 1);
    check_no_shared_edges(face);
    const ExactPolygons part_of_face = slice_of(tower(0, 0, 4, 4) + tower(4, 1, 9, 2));
    CHECK(area_of(part_of_face) == 21);
    CHECK(part_of_face.polygons.size() == 1);
    const ExactPolygons edge = slice_of(tower(0, 0, 4, 4) + tower(4, 4, 6, 6));
    CHECK(area_of(edge) == 20);
    check_no_shared_edges(edge);
    const ExactPolygons twice = slice_of(tower(0, 0, 4, 4) + tower(0, 0, 4, 4));
    CHECK(area_of(twice) == 16);
    CHECK(twice.polygons.size() == 1);
}

TEST_CASE("inverted shells: alone solid, inside another a cavity, over another's part nothing there") {
    CHECK(area_of(slice_of(tower(0, 0, 4, 4, true))) == 16);
    const ExactPolygons hollow = slice_of(tower(0, 0, 9, 9) + tower(2, 2, 5, 5, true));
    CHECK(area_of(hollow) == 81 - 9);
    CHECK(holes_of(hollow) == 1);
    const ExactPolygons island = slice_of(tower(0, 0, 9, 9) + tower(2, 2, 7, 7, true) + tower(3, 3, 5, 5));
    CHECK(area_of(island) == 81 - 25 + 4);
    CHECK(island.polygons.size() == 2);
    CHECK(holes_of(island) == 1);
    const ExactPolygons bite = slice_of(tower(0, 0, 6, 6) + tower(4, 4, 8, 8, true));
    CHECK(area_of(bite) == 36 - 4 + 16 - 4);
    CHECK(slice_of(tower(0, 0, 6, 6) + tower(0, 0, 6, 6, true)).polygons.empty());
    // Winding numbers 2 and 1 are both solid: the boundary between them is none.
    const ExactPolygons nested = slice_of(tower(0, 0, 9, 9) + tower(1, 1, 8, 8) + tower(2, 2, 5, 5, true));
    CHECK(area_of(nested) == 81);
    CHECK(holes_of(nested) == 0);
}

TEST_CASE("a hole that touches the outer contour from within, at a corner and along an edge") {
    const ExactPolygons corner = slice_of(tower(0, 0, 9, 9) + box({0, 0, 0}, {3, 3, 5}, true));
    CHECK(area_of(corner) == 81 - 9);
    CHECK(holes_of(corner) == 0);
    const ExactPolygons diagonal = regularise({rectangle(0, 0, 9, 9), reversed(contour({{0, 4}, {4, 2}, {4, 6}}))});
    CHECK(side(diagonal, {1, 4}) == CGAL::ON_UNBOUNDED_SIDE);
    CHECK(side(diagonal, {5, 4}) == CGAL::ON_BOUNDED_SIDE);
    check_no_shared_edges(diagonal);
}

TEST_CASE("random boxes, some inverted: area and winding number unit square by unit square") {
    std::mt19937_64 random(13);
    const auto pick = [&](int lo, int hi) { return std::uniform_int_distribution<int>(lo, hi)(random); };
    int nested = 0;
    for (int k = 0; k < 250; ++k) {
        std::vector<ExactContour> contours;
        for (int n = pick(1, 6); n > 0; --n) {
            const int x = pick(0, 8), y = pick(0, 8);
            const ExactContour c = rectangle(x, y, x + pick(1, 5), y + pick(1, 5));
            contours.push_back(pick(0, 2) ? c : reversed(c));
        }
        const ExactPolygons slice = regularise(contours);
        int squares = 0;
        for (int x = 0; x < 14; ++x)
            for (int y = 0; y < 14; ++y) {
                const ExactPoint middle(x + 0.5, y + 0.5);
                const bool solid = winding(contours, middle) != 0;
                squares += solid;
                REQUIRE(side(slice, middle) == (solid ? CGAL::ON_BOUNDED_SIDE : CGAL::ON_UNBOUNDED_SIDE));
            }
        // A face whose boundary touches itself at a point is no simple polygon: only its area counts here.
        Rational area = 0;
        for (const ExactPolygonWithHoles& polygon : slice.polygons) {
            area += rational(polygon.outer_boundary().area());
            for (auto hole = polygon.holes_begin(); hole != polygon.holes_end(); ++hole) area += rational(hole->area());
        }
        REQUIRE(area == squares);
        check_no_shared_edges(slice);
        if (const std::optional<ExactPolygons> direct = nest_contours(contours)) {
            ++nested;
            REQUIRE(area_of(*direct) == squares);
            REQUIRE(direct->polygons.size() == slice.polygons.size());
            REQUIRE(holes_of(*direct) == holes_of(slice));
        }
    }
    CHECK(nested > 20);
}

TEST_CASE("contours that cross themselves or each other: solid where the winding number is not zero") {
    std::mt19937_64 random(14);
    const auto pick = [&](int lo, int hi) { return std::uniform_int_distribution<int>(lo, hi)(random); };
    int solid = 0, empty = 0;
    for (int k = 0; k < 120; ++k) {
        std::vector<ExactContour> contours;
        for (int n = pick(1, 3); n > 0; --n) {
            ExactContour c;
            for (int corners = pick(3, 7); corners > 0; --corners) c.emplace_back(pick(-9, 9), pick(-9, 9));
            contours.push_back(c);
        }
        const ExactPolygons slice = regularise(contours);
        check_no_shared_edges(slice);
        for (int q = 0; q < 60; ++q) {
            const ExactPoint p(pick(-70, 70) / 7.0 + 0.01234, pick(-70, 70) / 7.0 + 0.00567);
            const bool truth = winding(contours, p) != 0;
            ++(truth ? solid : empty);
            const CGAL::Bounded_side s = side(slice, p);
            if (s != CGAL::ON_BOUNDARY) REQUIRE(s == (truth ? CGAL::ON_BOUNDED_SIDE : CGAL::ON_UNBOUNDED_SIDE));
        }
    }
    CHECK(solid > 1000);
    CHECK(empty > 1000);
}

TEST_CASE("nesting is left to the arrangement when contours meet, however little") {
    const ExactContour square = rectangle(0, 0, 9, 9);
    CHECK(nest_contours({square, reversed(rectangle(2, 2, 5, 5))}));
    CHECK_FALSE(nest_contours({square, rectangle(9, 9, 12, 12)}));            // a corner on a corner
    CHECK_FALSE(nest_contours({square, contour({{4, 0}, {6, 3}, {2, 3}})}));  // a corner on an edge
    CHECK_FALSE(nest_contours({square, square}));
    CHECK_FALSE(nest_contours({contour({{0, 0}, {6, 0}, {3, 0}})}));                  // no area: turns back
    CHECK_FALSE(nest_contours({contour({{0, 0}, {4, 4}, {4, 0}, {0, 4}})}));          // crosses itself
    CHECK_FALSE(nest_contours({contour({{0, 0}, {6, 0}, {3, 0}, {3, 5}, {0, 5}})}));  // turns back along an edge
}

TEST_CASE("holes belong to the solid next around them, whatever the order of the contours") {
    // Squares one inside the other, solid and empty in turn; the sizes tell whose hole is whose.
    std::vector<ExactContour> squares;
    for (int k = 0; k < 8; ++k) {
        const ExactContour c = rectangle(-20 + k, -20 + k, 20 - k, 20 - k);
        squares.push_back(k % 2 ? reversed(c) : c);
    }
    std::mt19937_64 random(15);
    for (int k = 0; k < 20; ++k) {
        std::shuffle(squares.begin(), squares.end(), random);
        const std::optional<ExactPolygons> nested = nest_contours(squares);
        REQUIRE(nested);
        REQUIRE(nested->polygons.size() == 4);
        for (const ExactPolygonWithHoles& polygon : nested->polygons) {
            REQUIRE(polygon.number_of_holes() == 1);
            const double outer = polygon.outer_boundary().bbox().xmax();
            REQUIRE(polygon.holes_begin()->bbox().xmax() == outer - 1);
            REQUIRE(polygon.outer_boundary().is_counterclockwise_oriented());
            REQUIRE(polygon.holes_begin()->is_clockwise_oriented());
        }
        // Inside out the same is solid.
        for (ExactContour& c : squares) c = reversed(c);
    }
}
