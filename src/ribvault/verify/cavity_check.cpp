#include "ribvault/verify/cavity_check.hpp"

#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "ribvault/exact/int128.hpp"
#include "ribvault/verify/height_rows.hpp"
#include "ribvault/verify/point_signs.hpp"
#include "ribvault/verify/winding.hpp"

namespace ribvault::verify {

namespace {

using EdgeBox = CGAL::Box_intersection_d::Box_with_info_d<double, 2, int>;

std::string place(double x, double y) {
    std::ostringstream out;
    out.precision(12);
    out << "(" << x / static_cast<double>(units_per_mm) << ", " << y / static_cast<double>(units_per_mm) << ") mm";
    return out.str();
}
std::string place(Point p) { return place(static_cast<double>(p.x), static_cast<double>(p.y)); }

// In 128 bits, unlike exact/predicates.hpp: nothing is known yet about the coordinates.
int orientation(Point a, Point b, Point c) {
    const Point u = b - a, w = c - a;
    const Int128 turn = static_cast<Int128>(u.x) * w.y - static_cast<Int128>(u.y) * w.x;
    return (turn > 0) - (turn < 0);
}
Int128 along(const Segment& s, Point p) {
    const Point d = s.b - s.a, u = p - s.a;
    return static_cast<Int128>(u.x) * d.x + static_cast<Int128>(u.y) * d.y;
}
bool inside_segment(Point p, const Segment& s) {
    return orientation(s.a, s.b, p) == 0 && along(s, p) > 0 && along(s, p) < along(s, s.b);
}

EdgeBox box_of(const Segment& s, int index) {
    const auto lo = [](Unit a, Unit b) { return static_cast<double>(std::min(a, b)); };
    const auto hi = [](Unit a, Unit b) { return static_cast<double>(std::max(a, b)); };
    return EdgeBox(CGAL::Bbox_2(lo(s.a.x, s.b.x), lo(s.a.y, s.b.y), hi(s.a.x, s.b.x), hi(s.a.y, s.b.y)), index);
}
EdgeBox box_of(std::span<const Vertex> vertices, const Edge& e, int index) {
    const Vertex &a = vertices[e.a], &b = vertices[e.b];
    return EdgeBox(CGAL::Bbox_2(std::min(a.x.inf(), b.x.inf()), std::min(a.y.inf(), b.y.inf()),
                                std::max(a.x.sup(), b.x.sup()), std::max(a.y.sup(), b.y.sup())),
                   index);
}

std::vector<Segment> edges_of(const Region& region) {
    std::vector<Segment> edges;
    for (const Contour& c : region)
        for (std::size_t i = 0; i < c.size(); ++i)
            if (const Point p = c[i], q = c[(i + 1) % c.size()]; p != q) edges.push_back({p, q});
    return edges;
}

// Every edge cut where another one touches it, in the order given. Fills `crossing` when two cross at inner points of
// both.
std::vector<Segment> cut_at_contacts(const std::vector<Segment>& edges, std::string& crossing) {
    std::vector<EdgeBox> boxes;
    for (std::size_t i = 0; i < edges.size(); ++i) boxes.push_back(box_of(edges[i], static_cast<int>(i)));
    std::map<int, std::vector<Point>> cuts;
    const auto meet = [&](const EdgeBox& p, const EdgeBox& q) {
        const Segment &e = edges[p.info()], &f = edges[q.info()];
        for (const Point end : {f.a, f.b})
            if (inside_segment(end, e)) cuts[p.info()].push_back(end);
        for (const Point end : {e.a, e.b})
            if (inside_segment(end, f)) cuts[q.info()].push_back(end);
        if (orientation(e.a, e.b, f.a) * orientation(e.a, e.b, f.b) < 0 &&
            orientation(f.a, f.b, e.a) * orientation(f.a, f.b, e.b) < 0)
            crossing = "contours of the cavity cross on the edge from " + place(e.a) + " to " + place(e.b);
    };
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), meet);
    std::vector<Segment> pieces;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const Segment& e = edges[i];
        Point from = e.a;
        if (const auto found = cuts.find(static_cast<int>(i)); found != cuts.end()) {
            std::sort(found->second.begin(), found->second.end(),
                      [&](Point p, Point q) { return along(e, p) < along(e, q); });
            for (const Point p : found->second)
                if (p != from) pieces.push_back({from, p}), from = p;
        }
        pieces.push_back({from, e.b});
    }
    return pieces;
}

/// Coincident edges as one: crossing it from right to left adds `jump` to the winding number.
struct Wall {
    Segment edge;
    int jump;
};

// Winding number on the right of walls[of], which meets the others at end points only: a ray from its middle to +x,
// with the axes turned for a horizontal edge so that the ray leaves it. A vertex on the ray counts as above it.
int winding_right(const std::vector<Wall>& walls, std::size_t of) {
    const bool turn = walls[of].edge.a.y == walls[of].edge.b.y;
    const auto seen = [turn](Point p) { return turn ? Point{-p.y, p.x} : p; };
    const Point a = seen(walls[of].edge.a), b = seen(walls[of].edge.b), twice_middle = a + b;
    int winding = 0;
    for (std::size_t i = 0; i < walls.size(); ++i) {
        if (i == of) continue;
        const Point p = seen(walls[i].edge.a), q = seen(walls[i].edge.b);
        const bool upward = 2 * q.y >= twice_middle.y;
        if ((2 * p.y >= twice_middle.y) == upward) continue;
        const Point lo = upward ? p : q, u = (upward ? q : p) - lo, w = twice_middle - lo - lo;
        if (static_cast<Int128>(u.x) * w.y - static_cast<Int128>(u.y) * w.x > 0)
            winding += upward ? walls[i].jump : -walls[i].jump;
    }
    return b.y > a.y ? winding : winding - walls[of].jump;
}

// One edge of each closed chain: those whose start is not the end of the edge before.
std::vector<int> chain_starts(std::span<const Edge> edges) {
    std::vector<int> starts;
    for (std::size_t i = 0; i < edges.size(); ++i)
        if (i == 0 || edges[i].a != edges[i - 1].b) starts.push_back(static_cast<int>(i));
    return starts;
}

Located at_vertex(const CoverProblem& problem, int vertex) {
    return located(problem, {Candidate::Kind::vertex, vertex, 0, {}, {}, 0});
}

/// A boundary in rows by height, for winding numbers about many points.
class BoundaryRows {
public:
    BoundaryRows(const CoverProblem& problem, std::span<const Edge> edges)
        : problem_(problem), edges_(edges), rows_(edges.size(), [&](std::size_t i) {
              const Vertex &a = problem.vertices[edges[i].a], &b = problem.vertices[edges[i].b];
              return std::pair(std::min(a.y.inf(), b.y.inf()), std::max(a.y.sup(), b.y.sup()));
          }) {}

    /// About a vertex that is on none of the edges: of those that a ray to +x crosses. A vertex on the ray counts as
    /// above it.
    int winding_at(int vertex) const {
        Located v = at_vertex(problem_, vertex);
        int winding = 0;
        rows_.visit(v.y.inf(), v.y.sup(), [&](std::uint32_t i) { winding += crossing(edges_[i], v, vertex); });
        return winding;
    }

private:
    bool above(int end, const Located& v, int vertex) const {
        const Vertex& p = problem_.vertices[end];
        if (p.y.inf() >= v.y.sup()) return true;
        if (p.y.sup() < v.y.inf()) return false;
        return exact_point<Rational>(p).y >= exact_point<Rational>(problem_.vertices[vertex]).y;
    }
    /// 1 when the ray is crossed upwards, -1 downwards, 0 when it is not.
    int crossing(const Edge& e, Located& v, int vertex) const {
        const Vertex &a = problem_.vertices[e.a], &b = problem_.vertices[e.b];
        if (std::max(a.x.sup(), b.x.sup()) < v.x.inf()) return 0;
        return ray_crossing(above(e.a, v, vertex), above(e.b, v, vertex),
                            [&] { return orientation_sign(v, e.a, e.b, Stage::algebraic); });
    }

    const CoverProblem& problem_;
    std::span<const Edge> edges_;
    HeightRows rows_;
};

// Closed segments without a common point.
bool apart(const CoverProblem& problem, const Edge& e, const Edge& f) {
    const auto side = [&](const Edge& line, int vertex) {
        Located v = at_vertex(problem, vertex);
        return orientation_sign(v, line.a, line.b, Stage::rational);
    };
    const int fa = side(e, f.a), fb = side(e, f.b);
    if (fa * fb > 0) return true;
    if (side(f, e.a) * side(f, e.b) > 0) return true;
    if (fa != 0 || fb != 0) return false;
    for (const int end : {f.a, f.b}) {
        Located v = at_vertex(problem, end);
        if (side_of_stadium(v, {e.a, e.b, 0}, Stage::rational) != Side::outside) return false;
    }
    Located v = at_vertex(problem, e.a);
    return side_of_stadium(v, {f.a, f.b, 0}, Stage::rational) == Side::outside;
}

}  // namespace

CavityBoundary cavity_boundary(const Region& cavity) {
    CavityBoundary result;
    const std::vector<Segment> edges = cut_at_contacts(edges_of(cavity), result.malformed);
    if (!result.malformed.empty()) return result;

    std::vector<Point> starts;
    for (const Segment& e : edges) starts.push_back(e.a);
    std::sort(starts.begin(), starts.end());
    const bool contacts = std::adjacent_find(starts.begin(), starts.end()) != starts.end();
    std::vector<Wall> walls;
    if (!contacts) {
        for (const Segment& e : edges) walls.push_back({e, 1});
    } else {
        std::map<std::pair<Point, Point>, int> net;
        for (const Segment& e : edges) (e.a < e.b ? net[{e.a, e.b}] : net[{e.b, e.a}]) += e.a < e.b ? 1 : -1;
        for (const auto& [ends, jump] : net)
            if (jump != 0) walls.push_back({{ends.first, ends.second}, jump});
    }
    int right = 0;
    for (std::size_t i = 0; i < walls.size(); ++i) {
        // Without contacts the winding numbers beside a contour are the same all along it.
        if (contacts || i == 0 || walls[i].edge.a != walls[i - 1].edge.b) right = winding_right(walls, i);
        const Segment& e = walls[i].edge;
        if ((right == 0) != (right + walls[i].jump == 0)) result.edges.push_back(right == 0 ? e : Segment{e.b, e.a});
    }
    return result;
}

std::string check_inside(std::span<const Vertex> vertices, std::span<const Edge> cavity, std::span<const Edge> slice) {
    if (cavity.empty()) return {};
    CoverProblem problem;
    problem.vertices = vertices;
    std::vector<EdgeBox> inner, outer;
    for (std::size_t i = 0; i < cavity.size(); ++i) inner.push_back(box_of(vertices, cavity[i], static_cast<int>(i)));
    for (std::size_t i = 0; i < slice.size(); ++i) outer.push_back(box_of(vertices, slice[i], static_cast<int>(i)));
    std::string malformed;
    const auto meet = [&](const EdgeBox& c, const EdgeBox& o) {
        if (!malformed.empty() || apart(problem, cavity[c.info()], slice[o.info()])) return;
        const Vertex &a = vertices[cavity[c.info()].a], &b = vertices[cavity[c.info()].b];
        malformed = "the cavity meets the outline on the edge from " + place(a.cx, a.cy) + " to " + place(b.cx, b.cy);
    };
    CGAL::box_intersection_d(inner.begin(), inner.end(), outer.begin(), outer.end(), meet);
    if (!malformed.empty()) return malformed;

    // A vertex at which a chain starts whose winding number in the other boundary is wrong.
    const auto find_start = [&](std::span<const Edge> chains, std::span<const Edge> boundary, const auto& wrong) {
        const BoundaryRows rows(problem, boundary);
        for (const int i : chain_starts(chains))
            if (wrong(rows.winding_at(chains[i].a))) return &vertices[chains[i].a];
        return static_cast<const Vertex*>(nullptr);
    };
    if (const Vertex* v = find_start(cavity, slice, [](int winding) { return winding == 0; }))
        return "the cavity leaves the outline at " + place(v->cx, v->cy);
    if (const Vertex* v = find_start(slice, cavity, [](int winding) { return winding != 0; }))
        return "the cavity contains the outline's hole at " + place(v->cx, v->cy);
    return {};
}

}  // namespace ribvault::verify
