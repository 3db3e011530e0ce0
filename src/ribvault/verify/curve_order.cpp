#include "ribvault/verify/curve_order.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ribvault/verify/point_signs.hpp"

namespace ribvault::verify {

namespace {

constexpr double turn = 2 * std::numbers::pi;

template <class NT>
Vec<NT> at(const TraceProblem& trace, int vertex) {
    return exact_point<NT>(trace.local.vertices[static_cast<std::size_t>(vertex)]);
}

const Curve& curve_of(const TraceProblem& trace, int curve) { return trace.curves[static_cast<std::size_t>(curve)]; }

TraceVertex& vertex_of(TraceProblem& trace, int vertex) { return trace.vertices[static_cast<std::size_t>(vertex)]; }

double width(const Interval& a) { return a.sup() - a.inf(); }
double middle(const Interval& a) { return (a.inf() + a.sup()) / 2; }

// Angles by the math library are good to some units of 2^-52; 2^-44 and twice the vertex' error are on the safe side.
Place angle_of(TraceProblem& trace, const Curve& circle, int vertex) {
    TraceVertex& v = vertex_of(trace, vertex);
    const Vec<Interval> c = at<Interval>(trace, circle.a);
    const Interval r = number<Interval>(circle.radius);
    Interval x = v.at.x - c.x, y = v.at.y - c.y;
    double error = 2 * (width(x) + width(y)) / r.inf();
    if (!(error < 0x1p-30)) {
        int exponent = 0;
        std::frexp(r.inf(), &exponent);
        const auto bits = static_cast<unsigned>(std::max(64, 64 - exponent));
        const Vec<Rational>& p = approximation(v, bits);
        const Vec<Rational> centre = at<Rational>(trace, circle.a);
        x = Interval(Rational(p.x - centre.x).get_d()), y = Interval(Rational(p.y - centre.y).get_d());
        error = 0x1p-50;
    }
    const double angle = std::atan2(middle(y), middle(x)), slack = error + 0x1p-44;
    return {vertex, angle - slack, angle + slack};
}

// Angles from the middle of the widest gap between them, which is far wider than they are uncertain.
void turn_from_widest_gap(std::vector<Place>& places) {
    std::sort(places.begin(), places.end(), [](const Place& p, const Place& q) { return p.lo < q.lo; });
    double widest = places.front().lo + turn - places.back().hi, from = places.front().lo - widest / 2;
    for (std::size_t i = 1; i < places.size(); ++i) {
        const double gap = places[i].lo - places[i - 1].hi;
        if (gap > widest) widest = gap, from = places[i].lo - gap / 2;
    }
    for (Place& p : places)
        if (p.lo < from) p.lo += turn - 0x1p-48, p.hi += turn + 0x1p-48;
}

Place place_on_line(TraceProblem& trace, const Curve& line, int vertex) {
    const TraceVertex& v = vertex_of(trace, vertex);
    const Vec<Interval> a = at<Interval>(trace, line.a), d = at<Interval>(trace, line.b) - a;
    const Interval t = dot(Vec<Interval>{v.at.x - a.x, v.at.y - a.y}, d) / dot(d, d);
    return {vertex, t.inf(), t.sup()};
}

// Whether v is on the curve. Exact.
bool on_curve(TraceProblem& trace, TraceVertex& v, int curve) {
    if (v.first == curve || v.second == curve) return true;
    const Curve& c = curve_of(trace, curve);
    if (!c.line) return disc_sign(v.at, c.a, c.radius, Stage::algebraic) == 0;
    return strip_sign(v.at, c.a, c.b, c.radius, Stage::algebraic) == 0 &&
           orientation_sign(v.at, c.a, c.b, Stage::algebraic) <= 0;
}

bool apart(const Vec<Rational>& p, const Vec<Rational>& q, unsigned bits) {
    Rational least(2);
    mpq_div_2exp(least.get_mpq_t(), least.get_mpq_t(), bits);
    return abs(Rational(p.x - q.x)) > least || abs(Rational(p.y - q.y)) > least;
}

// Whether two vertices of one curve are one point. v on both curves of w is one of the points that these have in
// common: which one shows when they are computed closely enough.
bool same_point(TraceProblem& trace, int curve, int v_index, int w_index) {
    TraceVertex &v = vertex_of(trace, v_index), &w = vertex_of(trace, w_index);
    if (CGAL::certainly(v.at.x != w.at.x) || CGAL::certainly(v.at.y != w.at.y)) return false;
    const int v_other = v.first == curve ? v.second : v.first, w_other = w.first == curve ? w.second : w.first;
    if (v_other == w_other || !on_curve(trace, v, w_other)) return false;
    if (w.root == 0) return true;
    TraceVertex other{w.first, w.second, -w.root,
                      located(trace.local.problem, candidate_of(trace, w.first, w.second, -w.root)), -1, 0, {}};
    for (unsigned bits = 128;; bits *= 2) {
        if (apart(approximation(v, bits), approximation(w, bits), bits)) return false;
        if (apart(approximation(v, bits), approximation(other, bits), bits)) return true;
    }
}

// Which of two different points comes first, given that they are close to each other: the sign of b's place minus a's,
// to ever more digits. A difference of two coordinates is within 2^-bits 2 of its value.
int closely_ordered(TraceProblem& trace, const Curve& c, int v, int w) {
    const Vec<Rational> a = at<Rational>(trace, c.a);
    for (unsigned bits = 128;; bits *= 2) {
        const Vec<Rational> p = approximation(vertex_of(trace, v), bits), q = approximation(vertex_of(trace, w), bits);
        Rational ahead, size;
        if (c.line) {
            const Vec<Rational> d = at<Rational>(trace, c.b) - a;
            ahead = dot(q - p, d), size = abs(d.x) + abs(d.y);
        } else {  // cross(p - a, q - a) = cross(p - a, q - p)
            ahead = cross(p - a, q - a);
            size = abs(Rational(p.x - a.x)) + abs(Rational(p.y - a.y)) + abs(Rational(q.x - a.x)) +
                   abs(Rational(q.y - a.y)) + 1;
        }
        mpq_div_2exp(size.get_mpq_t(), size.get_mpq_t(), bits - 2);
        if (abs(ahead) > size) return sgn(ahead);
    }
}

// -1, 0, 1: a before, at, after b. Unites a and b when they are one point.
int compare(TraceProblem& trace, int curve, const Place& a, const Place& b) {
    if (a.vertex == b.vertex) return 0;
    if (a.hi < b.lo) return -1;
    if (b.hi < a.lo) return 1;
    if (trace.node_of(a.vertex) == trace.node_of(b.vertex)) return 0;
    if (same_point(trace, curve, a.vertex, b.vertex)) {
        trace.unite(a.vertex, b.vertex);
        return 0;
    }
    return -closely_ordered(trace, curve_of(trace, curve), a.vertex, b.vertex);
}

// The nearest multiple of 2^-bits.
Rational rounded(double a, int bits) { return Rational(std::ldexp(std::round(std::ldexp(a, bits)), -bits)); }

// Enough binary places to stay inside a gap after rounding.
int places_for(double gap) { return std::max(4, 4 - std::ilogb(gap)); }

// The point of the circle at the angle quarter pi / 2 + 2 atan t: rational for rational t.
CurvePoint on_circle(const TraceProblem& trace, int curve, int quarter, const Rational& t) {
    const Solid& solid = trace.solids[static_cast<std::size_t>(trace.owner[static_cast<std::size_t>(curve)])];
    const Curve& c = curve_of(trace, curve);
    const RationalPoint& centre = solid.end(c.a);
    const Rational n = 1 + t * t;
    Rational x = solid.radius * (1 - t * t) / n, y = solid.radius * 2 * t / n;
    for (int i = 0; i < (quarter & 3); ++i) {
        std::swap(x, y);
        x = -x;
    }
    CurvePoint p;
    p.base = {Rational(centre[0] + x), Rational(centre[1] + y)};
    p.x = p.base[0].get_d(), p.y = p.base[1].get_d();
    return p;
}

CurvePoint on_line(const TraceProblem& trace, int curve, const Rational& t) {
    const Solid& solid = trace.solids[static_cast<std::size_t>(trace.owner[static_cast<std::size_t>(curve)])];
    const Curve& c = curve_of(trace, curve);
    const RationalPoint &a = solid.end(c.a), &b = solid.end(c.b);
    const Rational dx = b[0] - a[0], dy = b[1] - a[1];
    CurvePoint p;
    p.base = {Rational(a[0] + t * dx), Rational(a[1] + t * dy)};
    p.normal = {dy, Rational(-dx)};
    p.norm = dx * dx + dy * dy;
    p.across = solid.radius / p.norm;
    const double k = p.across.get_d() * std::sqrt(p.norm.get_d());
    p.x = p.base[0].get_d() + k * dy.get_d(), p.y = p.base[1].get_d() - k * dx.get_d();
    return p;
}

// Between two points that doubles do not tell apart: as far from both as they are from each other, to digits enough.
CurvePoint between_close(TraceProblem& trace, int curve, int v, int w) {
    const Curve& c = curve_of(trace, curve);
    const Vec<Rational> a = at<Rational>(trace, c.a);
    for (unsigned bits = 128;; bits *= 2) {
        const Vec<Rational> p = approximation(vertex_of(trace, v), bits), q = approximation(vertex_of(trace, w), bits);
        // The points are told apart by 2^-bits 2^24 at least: all errors below are small against that.
        const Rational far = abs(Rational(q.x - p.x)) + abs(Rational(q.y - p.y));
        Rational least(1);
        mpq_div_2exp(least.get_mpq_t(), least.get_mpq_t(), bits - 24);
        const Rational size = c.line ? Rational(0) : number<Rational>(c.radius);
        if (far <= least || size * least > 0x1p60) continue;
        const Vec<Rational> m{Rational((p.x + q.x) / 2 - a.x), Rational((p.y + q.y) / 2 - a.y)};
        if (c.line) {
            const Vec<Rational> d = at<Rational>(trace, c.b) - a;
            return on_line(trace, curve, rounded_down(Rational(dot(m, d) / dot(d, d)), bits + 64));
        }
        // With x > |y| after quarter turns, t = tan of half the angle = y / (|m| + x), and |m| = R but for far^2 / 8 R.
        const int quarter = static_cast<int>(
            std::round(std::atan2(m.y.get_d(), m.x.get_d()) / (std::numbers::pi / 2)));
        Vec<Rational> u = m;
        for (int i = 0; i < ((4 - quarter) & 3); ++i) u = {Rational(-u.y), u.x};
        return on_circle(trace, curve, quarter,
                         rounded_down(Rational(u.y / (number<Rational>(c.radius) + u.x)), bits + 64));
    }
}

}  // namespace

std::vector<Place> order_along(TraceProblem& trace, int curve, std::span<const int> which) {
    std::vector<Place> places;
    const Curve& c = curve_of(trace, curve);
    for (const int v : which) places.push_back(c.line ? place_on_line(trace, c, v) : angle_of(trace, c, v));
    if (!c.line && !places.empty()) turn_from_widest_gap(places);
    std::sort(places.begin(), places.end(),
              [&](const Place& a, const Place& b) { return compare(trace, curve, a, b) < 0; });
    std::vector<Place> kept;
    for (const Place& p : places)
        if (kept.empty() || compare(trace, curve, kept.back(), p) != 0) kept.push_back(p);
    return kept;
}

CurvePoint point_between(TraceProblem& trace, int curve, const Place& from, const Place& to, bool round) {
    const bool line = curve_of(trace, curve).line;
    const double end = round ? to.lo + turn - 0x1p-48 : to.lo;
    const double gap = end - from.hi;
    const double doubtful = line ? 0x1p-40 * std::max({1.0, std::abs(end), std::abs(from.hi)}) : 0x1p-36;
    if (!(gap > doubtful)) return between_close(trace, curve, from.vertex, to.vertex);
    const double mid = from.hi + gap / 2;
    if (line) return on_line(trace, curve, rounded(mid, places_for(gap)));
    const int quarter = static_cast<int>(std::round(mid / (std::numbers::pi / 2)));
    const double half = (mid - quarter * (std::numbers::pi / 2)) / 2;
    return on_circle(trace, curve, quarter, rounded(std::tan(half), places_for(gap)));
}

CurvePoint point_of_circle(const TraceProblem& trace, int curve) { return on_circle(trace, curve, 0, Rational(0)); }

// With v = u + k n the way from the track's end to the point, k = across sqrt(norm): every number is one of Q(sqrt
// norm).
int compare_distance(const CurvePoint& p, const RationalPoint& a, const RationalPoint& b, const Rational& radius) {
    const auto square = [&](const Rational& u, const Rational& v) {  // (u + v k)^2
        return QuadraticNumber{Rational(u * u + v * v * p.across * p.across * p.norm), Rational(2 * u * v * p.across),
                               p.norm};
    };
    const Rational dx = b[0] - a[0], dy = b[1] - a[1], dd = dx * dx + dy * dy, rr = radius * radius;
    const Rational &nx = p.normal[0], &ny = p.normal[1];
    const auto to_end = [&](const RationalPoint& end) {
        const QuadraticNumber x = square(Rational(p.base[0] - end[0]), nx),
                              y = square(Rational(p.base[1] - end[1]), ny);
        return sign(QuadraticNumber{Rational(x.p + y.p - rr), Rational(x.q + y.q), p.norm});
    };
    const Rational ux = p.base[0] - a[0], uy = p.base[1] - a[1];
    const Rational ahead = ux * dx + uy * dy, turns = dx * uy - dy * ux, n_ahead = nx * dx + ny * dy,
                   n_turns = dx * ny - dy * nx;
    if (sign(QuadraticNumber{ahead, Rational(n_ahead * p.across), p.norm}) <= 0) return to_end(a);
    if (sign(QuadraticNumber{Rational(ahead - dd), Rational(n_ahead * p.across), p.norm}) >= 0) return to_end(b);
    const QuadraticNumber across = square(turns, n_turns);
    return sign(QuadraticNumber{Rational(across.p - rr * dd), across.q, p.norm});
}

RationalPoint approximation(const CurvePoint& p, unsigned bits) {
    if (sgn(p.across) == 0) return p.base;
    // across sqrt(norm) is some length times 1 / |normal|: more digits than `bits` by those of |normal|.
    int exponent = 0;
    std::frexp(std::abs(p.normal[0].get_d()) + std::abs(p.normal[1].get_d()), &exponent);
    const Rational k =
        enclose(QuadraticNumber{0, p.across, p.norm}, bits + static_cast<unsigned>(std::max(0, exponent)) + 64)[0];
    return {Rational(p.base[0] + k * p.normal[0]), Rational(p.base[1] + k * p.normal[1])};
}

}  // namespace ribvault::verify
