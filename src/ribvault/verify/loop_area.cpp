// The area and the inside of a closed loop of lines and arcs.
#include <mpfr.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ribvault/verify/trace_loops.hpp"

namespace ribvault::verify {

namespace {

/// The corners of a loop, rational and within `error` of the true ones in both coordinates; local units. bits 0: as
/// doubles enclose them, where they do.
struct Corners {
    std::vector<Vec<Rational>> at;  ///< where piece i begins
    Rational error;
};
Corners corners_of(TraceProblem& trace, const TraceLoop& loop, unsigned bits) {
    Corners corners;
    double widest = 0;
    for (const TracePiece& piece : loop) {
        if (piece.from < 0) {
            corners.at.push_back({Rational(0), Rational(0)});
            continue;
        }
        TraceVertex& v = trace.vertices[static_cast<std::size_t>(piece.from)];
        const Interval &x = v.at.x, &y = v.at.y;
        // The sides of tracks that are all but parallel meet where intervals cannot say.
        if (bits > 0 || !std::isfinite((x.sup() - x.inf()) + (y.sup() - y.inf()))) {
            corners.at.push_back(approximation(v, std::max(bits, 128U)));
            continue;
        }
        corners.at.push_back({Rational((x.inf() + x.sup()) / 2), Rational((y.inf() + y.sup()) / 2)});
        widest = std::max(
            {widest, x.sup() - x.inf(), y.sup() - y.inf(), 0x1p-51 * std::abs(x.sup()), 0x1p-51 * std::abs(y.sup())});
    }
    corners.error = bits > 0 ? power_of_two(-static_cast<int>(bits)) : std::max(Rational(widest), power_of_two(-128));
    return corners;
}

Vec<Rational> centre_of(const TraceProblem& trace, const Curve& circle) {
    return exact_point<Rational>(trace.local.vertices[static_cast<std::size_t>(circle.a)]);
}

/// A number of MPFR's, rounded to nearest by every operation.
class Real {
public:
    explicit Real(mpfr_prec_t precision) { mpfr_init2(value_, precision); }
    Real(const Real&) = delete;
    Real& operator=(const Real&) = delete;
    ~Real() { mpfr_clear(value_); }
    operator mpfr_ptr() { return value_; }

private:
    mpfr_t value_;
};

// D - sin D to within 2^-(bits - 6) for the angle D of (cross, dot) plus the multiple of 2 pi that brings it nearest to
// `about`. |D| <= 2 pi + 1. The quotients, the arctangent, 2 pi, the sum and the sine are each good to 2^-bits of at
// most 8.
Rational segment_factor(const Rational& cross, const Rational& dot, double about, unsigned bits) {
    Real y(bits), x(bits), angle(bits), turn(bits), sine(bits);
    mpfr_set_q(y, cross.get_mpq_t(), MPFR_RNDN);
    mpfr_set_q(x, dot.get_mpq_t(), MPFR_RNDN);
    mpfr_atan2(angle, y, x, MPFR_RNDN);
    const double turns = std::round((about - mpfr_get_d(angle, MPFR_RNDN)) / (2 * std::numbers::pi));
    mpfr_const_pi(turn, MPFR_RNDN);
    mpfr_mul_d(turn, turn, 2 * turns, MPFR_RNDN);
    mpfr_add(angle, angle, turn, MPFR_RNDN);
    mpfr_sin(sine, angle, MPFR_RNDN);
    mpfr_sub(angle, angle, sine, MPFR_RNDN);
    Rational r;
    mpfr_get_q(r.get_mpq_t(), angle);
    return r;
}

// Between the arc and its chord: R^2 (D - sin D) / 2, positive for arcs to the left. When both ends are off by e or
// less, their directions are off by 1.2 e / R each (e < R / 8), D - sin D by 2 as much as D, and this by 5 R e.
std::array<Rational, 2> segment_area(const TraceProblem& trace, const TracePiece& piece, const Vec<Rational>& from,
                                     const Vec<Rational>& to, const Rational& error, unsigned bits) {
    const Curve& c = trace.curves[static_cast<std::size_t>(piece.curve)];
    const Rational r = number<Rational>(c.radius);
    const Vec<Rational> centre = centre_of(trace, c);
    Vec<Rational> u{Rational(1), Rational(0)}, w = u;
    if (piece.from != piece.to) u = from - centre, w = to - centre;
    if (!piece.forward) std::swap(u, w);
    const Rational area = r * r / 2 * segment_factor(cross(u, w), dot(u, w), piece.angle, bits);
    const Rational off = 5 * r * error + r * r * power_of_two(6 - static_cast<int>(bits));
    return {piece.forward ? area : Rational(-area), off};
}

std::optional<std::array<Rational, 2>> area_with(const TraceProblem& trace, const TraceLoop& loop,
                                                 const Corners& corners, unsigned bits) {
    const auto size = [](const Vec<Rational>& p) { return Rational(abs(p.x) + abs(p.y)); };
    Rational area, off;
    const Vec<Rational> origin = corners.at.front();
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec<Rational>&from = corners.at[i], &to = corners.at[(i + 1) % loop.size()];
        if (loop[i].from != loop[i].to) {
            const Vec<Rational> p = from - origin, q = to - origin;
            area += cross(p, q) / 2;
            // The origin is any point. Both factors off by e or less.
            off += corners.error * (size(p) + size(q) + 2 * corners.error) / 2;
        }
        const Curve& c = trace.curves[static_cast<std::size_t>(loop[i].curve)];
        if (c.line) continue;
        if (corners.error * 8 >= number<Rational>(c.radius)) return std::nullopt;
        const auto [segment, segment_off] = segment_area(trace, loop[i], from, to, corners.error * 3 / 2, bits);
        area += segment, off += segment_off;
    }
    return std::array{Rational(area - off), Rational(area + off)};
}

/// How often a loop runs round p.
class Around {
public:
    Around(const TraceProblem& trace, const TraceLoop& loop, const Corners& corners, const Vec<Rational>& p)
        : trace_(trace), loop_(loop), corners_(corners), p_(p), least_(corners.error * 4) {}

    /// The winding number, when p is surely far enough from every piece.
    std::optional<int> number() const {
        int winding = 0;
        for (std::size_t i = 0; i < loop_.size(); ++i) {
            const std::optional<int> n = crossing(i);
            if (!n) return std::nullopt;
            winding += *n;
        }
        return winding;
    }

private:
    static bool beyond(const Rational& a, const Rational& squared,
                       const Rational& least) {  // |a| > least sqrt(squared)
        return a * a > least * least * squared;
    }

    // How often the chord, or what runs from end to end of it and has p on its left when p is on it, crosses the ray
    // from p in the direction of x: 1 upwards, -1 downwards. An end level with p counts as below it.
    int chord_crossing(const Vec<Rational>& from, const Vec<Rational>& to, const Rational& side) const {
        if ((from.y > p_.y) != (to.y > p_.y)) {
            const bool up = to.y > from.y;
            return up ? side >= 0 : -(side < 0);
        }
        return side == 0 && from.x > p_.x && p_.x > to.x ? 1 : 0;
    }

    // What piece i adds to the winding number: its chord, and what is between it and its chord.
    std::optional<int> crossing(std::size_t i) const {
        const TracePiece& piece = loop_[i];
        const Curve& c = trace_.curves[static_cast<std::size_t>(piece.curve)];
        const Vec<Rational>&from = corners_.at[i], &to = corners_.at[(i + 1) % loop_.size()];
        const bool closed = piece.from == piece.to;
        const Vec<Rational> d = closed ? Vec<Rational>{Rational(0), Rational(0)} : to - from;
        const Rational side = closed ? Rational(0) : cross(d, p_ - from), norm = dot(d, d);
        const bool off_chord = !closed && beyond(side, norm, least_);
        const int n = closed ? 0 : chord_crossing(from, to, side);
        if (c.line) {
            const Rational ahead = dot(d, p_ - from);
            const bool past =
                ahead < 0 ? beyond(ahead, norm, least_) : ahead > norm && beyond(Rational(ahead - norm), norm, least_);
            return off_chord || past ? std::optional(n) : std::nullopt;
        }
        const Rational r = verify::number<Rational>(c.radius);
        const Vec<Rational> v = p_ - centre_of(trace_, c);
        const Rational vv = dot(v, v), inner = r - least_, outer = r + least_;
        const bool in = inner > 0 && vv < inner * inner, out = vv > outer * outer;
        const bool arc_side =
            closed || (piece.forward ? side < 0 : side > 0);  // an arc to the left is right of its chord
        if (arc_side ? !in && !out : !in && !out && !off_chord) return std::nullopt;
        return arc_side && in ? n + (piece.forward ? 1 : -1) : n;
    }

    const TraceProblem& trace_;
    const TraceLoop& loop_;
    const Corners& corners_;
    const Vec<Rational>& p_;
    Rational least_;
};

}  // namespace

std::array<Rational, 2> loops_area(TraceProblem& trace, std::span<const TraceLoop* const> loops) {
    for (unsigned bits = 0;; bits = bits == 0 ? 128 : 2 * bits) {
        Rational lo, hi;
        bool known = true;
        for (const TraceLoop* loop : loops) {
            const auto area = area_with(trace, *loop, corners_of(trace, *loop, bits), bits + 128);
            known = known && area;
            if (!known) break;
            lo += (*area)[0], hi += (*area)[1];
        }
        const Rational size = lo > 0 ? lo : hi < 0 ? Rational(-hi) : Rational(0);
        if (known && size > 0 && (hi - lo) * 1000000000 <= size) return {lo, hi};
    }
}

// A path moved by less than its distance to p runs round p as often. The loop is that far from the rational polygon of
// its corners with the arcs on its chords, moved to these; and the polygon's number and that of the circular segments
// are known.
int winding_number(TraceProblem& trace, const TraceLoop& loop, const CurvePoint& p) {
    for (unsigned bits = 0;; bits = bits == 0 ? 128 : 2 * bits) {
        const Corners corners = corners_of(trace, loop, bits);
        const RationalPoint mm = approximation(p, bits + 128);
        const LocalProblem& local = trace.local;
        const Vec<Rational> q{Rational((mm[0] - local.origin[0]) * local.scale),
                              Rational((mm[1] - local.origin[1]) * local.scale)};
        if (const std::optional<int> n = Around(trace, loop, corners, q).number()) return *n;
    }
}

}  // namespace ribvault::verify
