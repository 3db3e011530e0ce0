#include "ribvault/verify/point_signs.hpp"

#include <algorithm>

#include "ribvault/verify/winding.hpp"

namespace ribvault::verify {

namespace {

bool is_circle(const Curve& c, int centre, const Radius& radius) {
    return !c.line && c.a == centre && c.radius == radius;
}
bool is_line(const Curve& c, int a, int b, const Radius& radius) {
    return c.line && ((c.a == a && c.b == b) || (c.a == b && c.b == a)) && c.radius == radius;
}
bool known_on_circle(const Candidate& c, int centre, const Radius& radius) {
    if (c.kind == Candidate::Kind::leftmost) return c.vertex == centre && c.radius == radius;
    return c.kind == Candidate::Kind::meeting &&
           (is_circle(c.first, centre, radius) || is_circle(c.second, centre, radius));
}
bool known_on_lines(const Candidate& c, int a, int b, const Radius& radius) {
    return c.kind == Candidate::Kind::meeting && (is_line(c.first, a, b, radius) || is_line(c.second, a, b, radius));
}

template <class NT>
Vec<NT> at(const CoverProblem& problem, int vertex) {
    return exact_point<NT>(problem.vertices[vertex]);
}

/// On which side of the edge's line (x, y) is.
int line_side(const CoverProblem& problem, const Edge& e, double x, double y) {
    const Vec<Interval> a = at<Interval>(problem, e.a), b = at<Interval>(problem, e.b);
    const int side = sign_of(cross(Vec<Interval>(b - a), Vec<Interval>(Vec<Interval>{Interval(x), Interval(y)} - a)));
    if (side != unknown) return side;
    // Edges may be too short for machine numbers to tell their sides from any distance.
    Located point = double_point(problem, x, y);
    return orientation_sign(point, e.a, e.b, Stage::algebraic);
}

}  // namespace

int disc_sign(Located& v, int centre, const Radius& radius, Stage last) {
    if (known_on_circle(v.candidate, centre, radius)) return 0;
    const CoverProblem& problem = *v.problem;
    return sign_at(
        v,
        [&]<class NT>(const Vec<NT>& p) -> NT {
            const Vec<NT> d = p - at<NT>(problem, centre);
            const NT r = number<NT>(radius);
            return NT(dot(d, d) - r * r);
        },
        last);
}

int strip_sign(Located& v, int a, int b, const Radius& radius, Stage last) {
    if (known_on_lines(v.candidate, a, b, radius)) return 0;
    const CoverProblem& problem = *v.problem;
    return sign_at(
        v,
        [&]<class NT>(const Vec<NT>& p) -> NT {
            const Vec<NT> pa = at<NT>(problem, a), d = at<NT>(problem, b) - pa;
            const NT c = cross(d, Vec<NT>(p - pa)), r = number<NT>(radius);
            return NT(c * c - r * r * dot(d, d));
        },
        last);
}

int ahead_sign(Located& v, int a, int b, Stage last) {
    if (v.candidate.kind == Candidate::Kind::vertex && v.candidate.vertex == a) return 0;
    const CoverProblem& problem = *v.problem;
    return sign_at(
        v,
        [&]<class NT>(const Vec<NT>& p) -> NT {
            const Vec<NT> pa = at<NT>(problem, a);
            return dot(Vec<NT>(p - pa), Vec<NT>(at<NT>(problem, b) - pa));
        },
        last);
}

int orientation_sign(Located& v, int a, int b, Stage last) {
    const Candidate& c = v.candidate;
    if (c.kind == Candidate::Kind::vertex && (c.vertex == a || c.vertex == b)) return 0;
    if (known_on_lines(c, a, b, 0)) return 0;
    const CoverProblem& problem = *v.problem;
    return sign_at(
        v,
        [&]<class NT>(const Vec<NT>& p) -> NT {
            const Vec<NT> pa = at<NT>(problem, a);
            return cross(Vec<NT>(at<NT>(problem, b) - pa), Vec<NT>(p - pa));
        },
        last);
}

Side side_of_stadium(Located& v, const Stadium& s, Stage last) {
    const auto side = [](int sign) {
        return sign == unknown ? Side::unknown : sign < 0 ? Side::inside : sign == 0 ? Side::on : Side::outside;
    };
    if (s.a == s.b) return side(disc_sign(v, s.a, s.radius, last));
    int after_a = ahead_sign(v, s.a, s.b, Stage::interval);
    if (after_a < 0) return side(disc_sign(v, s.a, s.radius, last));
    int before_b = ahead_sign(v, s.b, s.a, Stage::interval);
    if (before_b < 0) return side(disc_sign(v, s.b, s.radius, last));
    if (after_a == unknown || before_b == unknown) {
        // Near an end: settled when strip and discs agree, else the place along the segment is needed exactly.
        if (strip_sign(v, s.a, s.b, s.radius, Stage::interval) == 1) return Side::outside;
        if (disc_sign(v, s.a, s.radius, Stage::interval) == -1 || disc_sign(v, s.b, s.radius, Stage::interval) == -1)
            return Side::inside;
        if (last == Stage::interval) return Side::unknown;
        after_a = ahead_sign(v, s.a, s.b, last);
        if (after_a <= 0) return side(disc_sign(v, s.a, s.radius, last));
        before_b = ahead_sign(v, s.b, s.a, last);
        if (before_b <= 0) return side(disc_sign(v, s.b, s.radius, last));
    }
    return side(strip_sign(v, s.a, s.b, s.radius, last));
}

Located double_point(const CoverProblem& problem, double x, double y) {
    Located v;
    v.problem = &problem;
    v.candidate.vertex = -1;
    v.x = Interval(x), v.y = Interval(y);
    v.rational_tried = true;
    v.rational = Vec<Rational>{Rational(x), Rational(y)};
    return v;
}

bool off_lines(const CoverProblem& problem, std::span<const Edge> all, std::span<const int> which, double x, double y) {
    return std::all_of(which.begin(), which.end(), [&](int e) { return line_side(problem, all[e], x, y) != 0; });
}

int crossings(std::span<const Edge> all, std::span<const int> which, double from_x, double from_y, Located& to) {
    const CoverProblem& problem = *to.problem;
    const Stage exact = Stage::algebraic;
    // A vertex on the line through both points counts as left of it, for both edges that meet there.
    const auto left_of_path = [&](int vertex) {
        return sign_at(
                   to,
                   [&]<class NT>(const Vec<NT>& p) -> NT {
                       const Vec<NT> f{number<NT>(from_x), number<NT>(from_y)};
                       return cross(Vec<NT>(p - f), Vec<NT>(at<NT>(problem, vertex) - f));
                   },
                   exact) >= 0;
    };
    return winding_change(
        all, which, [&](int e) { return line_side(problem, all[e], from_x, from_y); },
        [&](int e) { return orientation_sign(to, all[e].a, all[e].b, exact); }, left_of_path);
}

}  // namespace ribvault::verify
