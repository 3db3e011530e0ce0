// The box tree against CGAL's segment Voronoi diagram: the lighter structure gives the same exact nearest distance.
#include <CGAL/Exact_rational.h>
#include <CGAL/Segment_Delaunay_graph_filtered_traits_2.h>
#include <CGAL/Segment_Delaunay_graph_hierarchy_2.h>
#include <CGAL/Simple_cartesian.h>

#include <catch2/catch.hpp>

#include "rationals.hpp"
#include "ribvault/exact/nearest_segment.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

using Double = CGAL::Simple_cartesian<double>;
using Exact = CGAL::Simple_cartesian<CGAL::Exact_rational>;
using Traits =
    CGAL::Segment_Delaunay_graph_filtered_traits_without_intersections_2<Double, CGAL::Field_with_sqrt_tag, Exact,
                                                                         CGAL::Integral_domain_without_division_tag>;
using Diagram = CGAL::Segment_Delaunay_graph_hierarchy_2<Traits>;

/// Segments no two of which touch.
std::vector<Segment> disjoint_segments(Random& g, std::size_t count, Unit size, Unit length) {
    std::vector<Segment> segments;
    while (segments.size() < count) {
        const Point a{pick(g, -size, size), pick(g, -size, size)};
        const Segment s{a, {a.x + pick(g, -length, length), a.y + pick(g, -length, length)}};
        if (s.a == s.b) continue;
        if (std::none_of(segments.begin(), segments.end(), [&](const Segment& t) { return segments_touch(s, t); }))
            segments.push_back(s);
    }
    return segments;
}

Double::Point_2 to_cgal(Point p) { return {static_cast<double>(p.x), static_cast<double>(p.y)}; }
Point to_lattice(const Double::Point_2& p) { return {static_cast<Unit>(p.x()), static_cast<Unit>(p.y())}; }

Segment site_of(const Diagram& diagram, Point p) {
    const Diagram::Site_2 site = diagram.nearest_neighbor(to_cgal(p))->site();
    if (site.is_point()) return {to_lattice(site.point()), to_lattice(site.point())};
    return {to_lattice(site.source()), to_lattice(site.target())};
}

}  // namespace

TEST_CASE("the box tree and the Voronoi diagram of segments give the same exact nearest distance") {
    Random g(31);
    for (int k = 0; k < 40; ++k) {
        const Unit size = k % 2 ? 60 : 2000000;  // a coarse lattice makes ties and degenerate Voronoi vertices
        const std::vector<Segment> segments = disjoint_segments(g, k % 2 ? 60 : 400, size,
                                                                k % 2        ? 12
                                                                : k % 3 == 0 ? 1000000
                                                                             : 150000);
        const NearestSegment tree(segments);
        Diagram diagram;
        for (const Segment& s : segments) diagram.insert(to_cgal(s.a), to_cgal(s.b));
        REQUIRE(diagram.is_valid(false, 1));
        for (int q = 0; q < 250; ++q) {
            const Segment& e = segments[static_cast<std::size_t>(pick(g, 0, static_cast<Unit>(segments.size()) - 1))];
            const Point p = q % 3 == 0 ? near_segment(g, e) : Point{pick(g, -size, size), pick(g, -size, size)};
            const Segment by_diagram = site_of(diagram, p);
            INFO("set " << k << ", point (" << p.x << ", " << p.y << ")");
            REQUIRE(rational_squared_distance(p, segments[tree.nearest(p).index]) ==
                    rational_squared_distance(p, by_diagram));
        }
    }
}
