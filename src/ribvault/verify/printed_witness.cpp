// Rational points of M \ K, however small it is.
#include <algorithm>
#include <cmath>

#include "ribvault/verify/printed_pair.hpp"

namespace ribvault::verify {

namespace {

/// A point of the closure of M \ K and a direction of about unit length, local units, to many digits.
struct Start {
    Vec<Rational> at, along;
};

Start start_of(const CoverProblem& problem, const Uncovered& found, unsigned digits) {
    const CGAL::Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST);
    const Vec<Algebraic> v = locate<Algebraic>(problem, *found.candidate);
    Start start{{approximation(v.x, digits), approximation(v.y, digits)}, {Rational(1), Rational(0)}};
    const Leaving& l = found.leaving;
    if (l.a < 0) return start;
    const auto vertex = [&](int i) { return exact_point<Rational>(problem.vertices[static_cast<std::size_t>(i)]); };
    Vec<Rational> d = l.b < 0 ? vertex(l.a) - start.at : vertex(l.b) - vertex(l.a);
    for (int t = 0; t < l.turns; ++t) d = {Rational(-d.y), d.x};
    const double norm = std::hypot(d.x.get_d(), d.y.get_d());
    if (norm > 0) start.along = {Rational(d.x / Rational(norm)), Rational(d.y / Rational(norm))};
    return start;
}

}  // namespace

void build_part_problem(const PrintedPair& pair, const OpenPart& part, LocalProblem& local) {
    const PreparedTrack piece = part_of(pair, part);
    const Square square{(piece.ax + piece.bx) / 2, (piece.ay + piece.by) / 2,
                        std::max(std::abs(piece.dx), std::abs(piece.dy)) / 2 + piece.half + 4 * pair.margin};
    std::vector<int> near;
    pair.grid.near(square.x, square.y, root_cell_reach * square.half + 2 * window_slack(pair.margin), near);
    const Below below{pair.lower, pair.below, pair.radii, near, {}};
    const int pieces[] = {0};
    build_local_problem({part.piece ? &*part.piece : &pair.upper[static_cast<std::size_t>(part.track)], 1}, pieces,
                        below, square, pair.margin, local);
}

bool in_upper(const PrintedPair& pair, int track, const RationalPoint& p) {
    const PrintedTrack& t = pair.upper[static_cast<std::size_t>(track)];
    return compare_distance(p, t, Rational(Rational(t.width) / 2)) <= 0;
}

bool outside_lower(const PrintedPair& pair, const RationalPoint& p) {
    const double x = p[0].get_d(), y = p[1].get_d();
    std::vector<int> near;
    pair.grid.near(x, y, 8 * pair.margin, near);
    return std::all_of(near.begin(), near.end(), [&](int k) {
        const auto i = static_cast<std::size_t>(k);
        const double d = centre_distance(pair.below[i], x, y), r = pair.radii[i].get_d();
        if (d > r + pair.margin) return true;
        return d >= r - pair.margin && compare_distance(p, pair.lower[i], pair.radii[i]) > 0;
    });
}

std::optional<RationalPoint> witness_from(const PrintedPair& pair, int track, const LocalProblem& local,
                                          const Uncovered& found) {
    constexpr unsigned digits = 700;  // binary ones
    const auto attempt = [&](const Vec<Rational>& q) -> std::optional<RationalPoint> {
        const RationalPoint mm = local.to_mm(q.x, q.y);
        if (in_upper(pair, track, mm) && outside_lower(pair, mm)) return mm;
        return std::nullopt;
    };
    if (!found.candidate) return attempt({Rational(found.x), Rational(found.y)});
    const Start start = start_of(local.problem, found, digits);
    if (const auto mm = attempt(start.at)) return mm;
    const Vec<Rational> normal{Rational(-start.along.y), start.along.x};
    // v + s (d + t n), rounded so that the digits grow with the closeness only.
    const auto place = [&](int step, const Rational& across) {
        const Rational s = power_of_two(step);
        const unsigned bits = static_cast<unsigned>(std::max(0, 16 - 2 * step));
        const auto coordinate = [&](const Rational& v, const Rational& d, const Rational& n) {
            return rounded_down(Rational(v + s * (d + across * n)), std::min(bits + 64, digits));
        };
        return Vec<Rational>{coordinate(start.at.x, start.along.x, normal.x),
                             coordinate(start.at.y, start.along.y, normal.y)};
    };
    const int first = 20, last = -320;
    const int side = found.leaving.side == 0 ? 1 : found.leaving.side;
    for (int step = first; step > last; --step) {
        const Rational curved = Rational(found.leaving.c) * power_of_two(step) * side;
        for (const Rational& across :
             {curved, Rational(side, 2), Rational(side, 16), Rational(side, 256), Rational(2 * side)})
            if (const auto mm = attempt(place(step, across))) return mm;
    }
    for (int step = first; step > last; step -= 2)
        for (int turn = 3; turn > last; turn -= 2)
            for (const int s : {side, -side})
                if (const auto mm = attempt(place(step, Rational(power_of_two(turn) * s)))) return mm;
    return std::nullopt;
}

RationalPoint point_of_gap(const PrintedTrack& track, const CentreGap& gap) {
    const RationalPoint a = rational(track.a), b = rational(track.b);
    if (a == b) return a;
    // The multiple of the largest power of two inside the stretch.
    Rational t;
    for (unsigned bits = 1;; bits += bits < 16 ? 1 : bits / 4) {
        const std::array<Rational, 2> from = enclose(gap.from, bits + 8), to = enclose(gap.to, bits + 8);
        t = rounded_down(Rational((from[1] + to[0]) / 2), bits);
        if (t > from[1] && t < to[0]) break;
    }
    return {Rational(a[0] + t * (b[0] - a[0])), Rational(a[1] + t * (b[1] - a[1]))};
}

}  // namespace ribvault::verify
