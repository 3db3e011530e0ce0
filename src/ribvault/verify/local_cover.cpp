#include "ribvault/verify/local_cover.hpp"

#include <boost/container/small_vector.hpp>
#include <cmath>

#include "ribvault/verify/point_signs.hpp"

namespace ribvault::verify {

namespace {

template <class T>
using Few = boost::container::small_vector<T, 8>;
template <class T>
std::span<const T> view(const Few<T>& list) {
    return {list.data(), list.size()};
}

template <class NT>
Vec<NT> at(const CoverProblem& problem, int vertex) {
    return exact_point<NT>(problem.vertices[vertex]);
}

/// A direction at v: rot90^turns of (vertex b - vertex a), or of (vertex a - v) when b < 0.
struct Direction {
    int a = 0, b = -1;
    int turns = 0;
};
Direction turned(Direction d, int turns) { return {d.a, d.b, (d.turns + turns) & 3}; }

template <class NT>
Vec<NT> base_of(const CoverProblem& problem, const Direction& d, const Vec<NT>& p) {
    const Vec<NT> a = at<NT>(problem, d.a);
    return d.b < 0 ? Vec<NT>(a - p) : Vec<NT>(at<NT>(problem, d.b) - a);
}

// conj(d1) d2 as complex numbers is dot + i cross, and rot90 is multiplication by i, so with k = turns2 - turns1 the
// pair (dot, cross) of the directions is i^k times the pair of their bases.
int base_product_sign(Located& v, const Direction& d, const Direction& e, bool want_cross) {
    if (d.a == e.a && d.b == e.b) return want_cross ? 0 : 1;
    if (d.a == e.b && d.b == e.a) return want_cross ? 0 : -1;
    const CoverProblem& problem = *v.problem;
    return sign_at(
        v,
        [&]<class NT>(const Vec<NT>& p) -> NT {
            const Vec<NT> u = base_of<NT>(problem, d, p), w = base_of<NT>(problem, e, p);
            return want_cross ? cross(u, w) : dot(u, w);
        },
        Stage::algebraic);
}
int dot_sign(Located& v, const Direction& d, const Direction& e) {
    switch ((e.turns - d.turns) & 3) {
        case 0:
            return base_product_sign(v, d, e, false);
        case 1:
            return -base_product_sign(v, d, e, true);
        case 2:
            return -base_product_sign(v, d, e, false);
        default:
            return base_product_sign(v, d, e, true);
    }
}
int cross_sign(Located& v, const Direction& d, const Direction& e) { return dot_sign(v, turned(d, 1), e); }

/// A boundary ray of M at v. Crossing it counter-clockwise changes the winding number by `jump`.
struct Ray {
    Direction along;
    int jump = 0;
    Radius radius;  ///< of the boundary's curvature, away from the material's outside; 0 when straight
};

/// A stadium of K with v on its boundary.
struct LocalSite {
    Direction normal;      ///< inward
    Radius radius;         ///< of the boundary where it is curved
    bool segment = false;  ///< the boundary is straight along `axis` (forward) or against it (backward)
    Direction axis;
    bool forward = false, backward = false;
};

// The normal, and on which sides the boundary is straight. Precondition: v is on the stadium's boundary.
LocalSite local_site(Located& v, const Stadium& s) {
    LocalSite site;
    site.radius = s.radius;
    const Stage all = Stage::algebraic;
    if (s.a != s.b) {
        const int after_a = ahead_sign(v, s.a, s.b, all), before_b = ahead_sign(v, s.b, s.a, all);
        if (after_a >= 0 && before_b >= 0) {
            site.segment = true;
            site.axis = {s.a, s.b, 0};
            site.normal = turned(site.axis, orientation_sign(v, s.a, s.b, all) > 0 ? 3 : 1);
            site.forward = before_b > 0, site.backward = after_a > 0;
            return site;
        }
        site.normal = {after_a < 0 ? s.a : s.b, -1, 0};
        return site;
    }
    site.normal = {s.a, -1, 0};
    return site;
}

// Whether the site's boundary leaves v straight along d, one of the two tangent directions.
bool straight_along(Located& v, const LocalSite& site, const Direction& d) {
    if (!site.segment) return false;
    return dot_sign(v, d, site.axis) > 0 ? site.forward : site.backward;
}

struct Extent {
    bool left = false, right = false;  ///< M has points on that side of the ray, however close to it
    Radius radius;  ///< curvature radius of M's boundary along the ray when only one side is M; 0 straight
};

// How M lies along direction d, from its boundary rays (none: v is an inner point of M).
Extent extent_along(Located& v, std::span<const Ray> rays, const Direction& d) {
    if (rays.empty()) return {true, true, 0};
    struct Placed {
        const Ray* ray;
        int half;  // 0: along d, 1: left of it, 2: opposite, 3: right of it
        int jump;
    };
    Few<Placed> groups;
    for (const Ray& ray : rays) {
        const int c = cross_sign(v, d, ray.along);
        const int half = c > 0 ? 1 : c < 0 ? 3 : dot_sign(v, d, ray.along) > 0 ? 0 : 2;
        bool merged = false;
        for (Placed& g : groups)
            if (g.half == half && (half % 2 == 0 || cross_sign(v, g.ray->along, ray.along) == 0)) {
                g.jump += ray.jump;
                merged = true;
                break;
            }
        if (!merged) groups.push_back({&ray, half, ray.jump});
    }
    const Placed* last = nullptr;  // the boundary ray next to d clockwise
    const Placed* on = nullptr;
    bool any = false;
    for (const Placed& g : groups) {
        if (g.jump == 0) continue;
        any = true;
        if (g.half == 0)
            on = &g;
        else if (!last || g.half > last->half ||
                 (g.half == last->half && cross_sign(v, last->ray->along, g.ray->along) > 0))
            last = &g;
    }
    if (!any) return {true, true, 0};  // edges that cancel: inside a region whose parts share a boundary
    Extent extent;
    extent.right = last ? last->jump > 0 : on->jump < 0;
    extent.left = on ? on->jump > 0 : extent.right;
    if (on && extent.left != extent.right) extent.radius = on->ray->radius;
    return extent;
}

Vec<double> approximate(const Located& v, const Direction& d) {
    const Vertex& a = v.problem->vertices[d.a];
    Vec<double> u = d.b < 0 ? Vec<double>{a.cx - (v.x.inf() + v.x.sup()) / 2, a.cy - (v.y.inf() + v.y.sup()) / 2}
                            : Vec<double>{v.problem->vertices[d.b].cx - a.cx, v.problem->vertices[d.b].cy - a.cy};
    for (int t = 0; t < d.turns; ++t) u = {-u.y, u.x};
    const double n = std::sqrt(u.x * u.x + u.y * u.y);
    return n > 0 ? Vec<double>{u.x / n, u.y / n} : Vec<double>{1, 0};
}

// M's points on that side are those at more than s^2 / 2 R_M from the ray, K's at more than s^2 / 2 R for the largest
// R.
Leaving leaving_along(Located& v, const Direction& d, const Extent& m, std::span<const LocalSite* const> beside,
                      int side) {
    Leaving leaving{d.a, d.b, d.turns, side, 0};
    double flattest = 0;
    for (const LocalSite* site : beside)
        if (cross_sign(v, d, site->normal) == side) flattest = std::max(flattest, site->radius.approx);
    const double from = m.radius.approx > 0 ? 1 / m.radius.approx : 0;
    if (flattest > 0) leaving.c = (from + 1 / flattest) / 4;
    if (flattest == 0 && from > 0) leaving.c = from;
    return leaving;
}

bool cone_covered(Located& v, std::span<const Ray> rays, std::span<const LocalSite> sites, Vec<double>& hint,
                  Leaving* leaving) {
    Few<Direction> critical;
    for (const Ray& ray : rays) critical.push_back(ray.along);
    for (const LocalSite& site : sites) {
        critical.push_back(turned(site.normal, 1));
        critical.push_back(turned(site.normal, 3));
    }
    if (critical.empty()) {
        hint = {1, 0};
        return false;
    }
    for (const Direction& d : critical) {
        const Extent m = extent_along(v, rays, d);
        if (!m.left && !m.right) continue;
        bool ahead = false;
        Few<const LocalSite*> beside;
        for (const LocalSite& site : sites) {
            const int s = dot_sign(v, d, site.normal);
            if (s > 0) {
                ahead = true;
                break;
            }
            if (s == 0) beside.push_back(&site);
        }
        if (ahead) continue;
        bool left = !m.left, right = !m.right;
        for (const LocalSite* site : beside) {
            const bool flat_enough =
                straight_along(v, *site, d) || (m.radius.approx > 0 && no_greater(m.radius, site->radius));
            if (!flat_enough) continue;
            (cross_sign(v, d, site->normal) > 0 ? left : right) = true;
        }
        if (!left || !right) {
            hint = approximate(v, d);
            if (leaving) *leaving = leaving_along(v, d, m, view(beside), left ? -1 : 1);
            return false;
        }
    }
    return true;
}

}  // namespace

Local decide_locally(Located& v, const Surroundings& near, Vec<double>& hint, Leaving* leaving) {
    const CoverProblem& problem = *v.problem;
    const Stage all = Stage::algebraic;
    Few<int> on_or_unknown;
    for (const int s : near.sites) {
        const Side side = side_of_stadium(v, problem.sites[s], Stage::interval);
        if (side == Side::inside) return Local::covered;
        if (side != Side::outside) on_or_unknown.push_back(s);
    }

    // M at v. The region counts as one piece, each stadium as another: M is in K when every piece is.
    bool inner_point = false;
    Few<Ray> region_rays;
    Few<int> boundary_pieces;
    for (const int e : near.edges) {
        const int a = problem.material[e].a, b = problem.material[e].b;
        if (orientation_sign(v, a, b, all) != 0) continue;
        const int after_a = ahead_sign(v, a, b, all), before_b = ahead_sign(v, b, a, all);
        if (after_a < 0 || before_b < 0) continue;
        if (before_b > 0) region_rays.push_back({{a, b, 0}, 1, 0});
        if (after_a > 0) region_rays.push_back({{b, a, 0}, -1, 0});
    }
    if (region_rays.empty())
        inner_point =
            near.winding + (near.edges.empty() ? 0 : crossings(problem.material, near.edges, near.x, near.y, v)) != 0;
    for (std::size_t i = 0; i < near.pieces.size() && !inner_point; ++i) {
        const Side side = side_of_stadium(v, problem.pieces[near.pieces[i]], all);
        if (side == Side::inside) inner_point = true;
        if (side == Side::on) boundary_pieces.push_back(near.pieces[i]);
    }
    if (!inner_point && region_rays.empty() && boundary_pieces.empty()) return Local::not_in_m;

    Few<LocalSite> sites;
    for (const int s : on_or_unknown) {
        const Side side = side_of_stadium(v, problem.sites[s], all);
        if (side == Side::inside) return Local::covered;
        if (side == Side::on) sites.push_back(local_site(v, problem.sites[s]));
    }
    if (inner_point) return cone_covered(v, {}, view(sites), hint, leaving) ? Local::covered : Local::uncovered;
    if (!region_rays.empty() && !cone_covered(v, view(region_rays), view(sites), hint, leaving))
        return Local::uncovered;
    for (const int piece : boundary_pieces) {
        const LocalSite m = local_site(v, problem.pieces[piece]);
        // Material lies to the left of the tangent direction rot-90 of the inward normal.
        const Direction before = turned(m.normal, 3), after = turned(m.normal, 1);
        const auto curvature = [&](const Direction& d) { return straight_along(v, m, d) ? Radius(0) : m.radius; };
        const Ray rays[2] = {{before, 1, curvature(before)}, {after, -1, curvature(after)}};
        if (!cone_covered(v, rays, view(sites), hint, leaving)) return Local::uncovered;
    }
    return Local::covered;
}

}  // namespace ribvault::verify
