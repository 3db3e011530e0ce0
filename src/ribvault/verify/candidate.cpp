#include "ribvault/verify/candidate.hpp"

#include <utility>

namespace ribvault::verify {

namespace {

template <class NT>
struct Line {  // { q : cross(d, q - p) = k }
    Vec<NT> p, d;
    NT k;
};

template <class NT>
Line<NT> line_of(const CoverProblem& problem, const Curve& c) {
    const Vec<NT> p = exact_point<NT>(problem.vertices[c.a]);
    const Vec<NT> d = exact_point<NT>(problem.vertices[c.b]) - p;
    if (c.side == 0) return {p, d, NT(0)};
    return {p, d, NT(NT(c.side) * number<NT>(c.radius) * root(NT(dot(d, d))))};
}

// Two circles about c1, c2 = c1 + D: q = c1 + (A D +- sqrt(disc) rot90 D) / D^2 with A = (D^2 + R1^2 - R2^2) / 2 and
// disc = R1^2 D^2 - A^2. A circle about c and a line: with x = cross(d, p - c), e = x + side R2 L and L^2 = d^2,
// q = c + (e rot90 d +- sqrt(disc) d) / L^2 and disc = R^2 L^2 - e^2 = ((R - side R2) L - x) ((R + side R2) L + x); the
// product loses no digits where K's own curves nearly touch (R = R2). Both are centre + (along u +- sqrt(disc) w) /
// norm.
template <class NT>
struct Meeting {
    Vec<NT> centre, u, w;
    NT along, norm, disc;
};

template <class NT>
Meeting<NT> meeting_of(const CoverProblem& problem, const Curve& circle, const Curve& other) {
    Meeting<NT> m;
    m.centre = exact_point<NT>(problem.vertices[circle.a]);
    const NT r1 = number<NT>(circle.radius);
    if (other.line) {
        const Vec<NT> p = exact_point<NT>(problem.vertices[other.a]);
        const Vec<NT> d = exact_point<NT>(problem.vertices[other.b]) - p;
        const NT x = cross(d, Vec<NT>(p - m.centre));
        m.norm = dot(d, d);
        if (other.side == 0) {
            m.along = x;
            m.disc = NT(r1 * r1 * m.norm - x * x);
        } else {
            const NT length = root(m.norm);
            m.along = NT(x + NT(other.side) * number<NT>(other.radius) * length);
            m.disc = NT((difference<NT>(circle.radius, other.side, other.radius) * length - x) *
                        (difference<NT>(circle.radius, -other.side, other.radius) * length + x));
        }
        m.u = {NT(-d.y), d.x};
        m.w = d;
    } else {
        const Vec<NT> d = exact_point<NT>(problem.vertices[other.a]) - m.centre;
        const NT r2 = number<NT>(other.radius);
        m.norm = dot(d, d);
        m.along = NT((m.norm + r1 * r1 - r2 * r2) / NT(2));
        m.u = d;
        m.w = {NT(-d.y), d.x};
        m.disc = NT(r1 * r1 * m.norm - m.along * m.along);
    }
    return m;
}

template <class NT>
Vec<NT> meet_lines(const CoverProblem& problem, const Curve& c1, const Curve& c2) {
    const Line<NT> l = line_of<NT>(problem, c1), m = line_of<NT>(problem, c2);
    const NT e = NT(m.k + cross(m.d, Vec<NT>(m.p - l.p)));
    const NT det = cross(l.d, m.d);
    return {NT(l.p.x + (l.k * m.d.x - e * l.d.x) / det), NT(l.p.y + (l.k * m.d.y - e * l.d.y) / det)};
}

std::pair<const Curve&, const Curve&> circle_first(const Curve& c1, const Curve& c2) {
    return c1.line ? std::pair<const Curve&, const Curve&>{c2, c1} : std::pair<const Curve&, const Curve&>{c1, c2};
}

// The sign of a number that depends on the input only, by the same ladder as sign_at.
template <class F>
[[gnu::noinline]] int exact_sign(const F& f, Stage& stage) {
    CGAL::Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST);
    try {
        const int s = sign_of(f.template operator()<Rational>());
        if (stage < Stage::rational) stage = Stage::rational;
        return s;
    } catch (const NotRational&) {
    }
    stage = Stage::algebraic;
    return sign_of(f.template operator()<Algebraic>());
}

template <class F>
int input_sign(const F& f, Stage& stage) {
    const int s = sign_of(f.template operator()<Interval>());
    return s != unknown ? s : exact_sign(f, stage);
}

}  // namespace

template <class NT>
Vec<NT> locate(const CoverProblem& problem, const Candidate& candidate) {
    if (candidate.kind == Candidate::Kind::vertex) return exact_point<NT>(problem.vertices[candidate.vertex]);
    if (candidate.kind == Candidate::Kind::leftmost) {
        const Vec<NT> p = exact_point<NT>(problem.vertices[candidate.vertex]);
        return {NT(p.x - number<NT>(candidate.radius)), p.y};
    }
    if (candidate.first.line && candidate.second.line)
        return meet_lines<NT>(problem, candidate.first, candidate.second);
    const auto [circle, other] = circle_first(candidate.first, candidate.second);
    const Meeting<NT> m = meeting_of<NT>(problem, circle, other);
    const NT s = candidate.root == 0 ? NT(0) : NT(NT(candidate.root) * root(m.disc));
    return {NT(m.centre.x + (m.along * m.u.x + s * m.w.x) / m.norm),
            NT(m.centre.y + (m.along * m.u.y + s * m.w.y) / m.norm)};
}
template Vec<Interval> locate<Interval>(const CoverProblem&, const Candidate&);
template Vec<Rational> locate<Rational>(const CoverProblem&, const Candidate&);
template Vec<Algebraic> locate<Algebraic>(const CoverProblem&, const Candidate&);

int meeting_points(const CoverProblem& problem, const Curve& c1, const Curve& c2, Stage& stage) {
    if (c1.line && c2.line) {
        const auto direction_cross = [&]<class NT>() -> NT {
            return cross(line_of<NT>(problem, {true, c1.a, c1.b, 0, 0, false}).d,
                         line_of<NT>(problem, {true, c2.a, c2.b, 0, 0, false}).d);
        };
        return input_sign(direction_cross, stage) == 0 ? 0 : 1;
    }
    const auto [circle, other] = circle_first(c1, c2);
    if (!other.line) {
        const auto apart = [&]<class NT>() -> NT { return meeting_of<NT>(problem, circle, other).norm; };
        if (circle.a == other.a || input_sign(apart, stage) == 0) return 0;
    }
    const auto discriminant = [&]<class NT>() -> NT { return meeting_of<NT>(problem, circle, other).disc; };
    return input_sign(discriminant, stage) + 1;
}

const Vec<Rational>* rational_value(Located& v) {
    if (!v.rational_tried) {
        v.rational_tried = true;
        try {
            v.rational = locate<Rational>(*v.problem, v.candidate);
        } catch (const NotRational&) {
        }
    }
    return v.rational ? &*v.rational : nullptr;
}

Located located(const CoverProblem& problem, const Candidate& candidate) {
    Located v;
    v.problem = &problem;
    v.candidate = candidate;
    const Vec<Interval> p = locate<Interval>(problem, candidate);
    v.x = p.x, v.y = p.y;
    return v;
}

void refine(Located& v) {
    CGAL::Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST);
    if (const Vec<Rational>* q = rational_value(v)) {
        if (v.stage < Stage::rational) v.stage = Stage::rational;
        v.x = enclosure(q->x), v.y = enclosure(q->y);
        return;
    }
    v.stage = Stage::algebraic;
    const Vec<Algebraic> q = locate<Algebraic>(*v.problem, v.candidate);
    v.x = enclosure(q.x), v.y = enclosure(q.y);
}

}  // namespace ribvault::verify
