#include "ribvault/verify/trace_problem.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace ribvault::verify {

namespace {

// y = m x + k + r sqrt(1 + m^2), the root taken where it is rational: equal keys, equal lines. Vertical: x = k.
using LineKey = std::tuple<bool, Rational, Rational, Rational>;

LineKey key_of(const Vec<Rational>& a, const Vec<Rational>& b, const Rational& radius) {
    const Rational dx = b.x - a.x, dy = b.y - a.y;
    if (sgn(dx) == 0) return {true, Rational(0), Rational(a.x + radius * sgn(dy)), Rational(0)};
    const Rational m = dy / dx;
    const QuadraticNumber at = quadratic(Rational(a.y - m * a.x), Rational(-radius * sgn(dx)), Rational(1 + m * m));
    return {false, m, at.p, at.q};
}

class CurveTable {
public:
    explicit CurveTable(TraceProblem& trace) : trace_(trace) {}

    CurveUse circle(int solid, int centre) {
        const Radius& r = trace_.solids[static_cast<std::size_t>(solid)].stadium.radius;
        const auto [at, fresh] = circles_.try_emplace({centre, r.approx, r.exact}, next());
        if (fresh) enter(solid, {false, centre, centre, 0, r, false});
        CurveUse use;
        use.curve = at->second;
        return use;
    }
    CurveUse line(int solid, int a, int b) {
        const Radius& r = trace_.solids[static_cast<std::size_t>(solid)].stadium.radius;
        const auto [at, fresh] = lines_.try_emplace(key_of(point(a), point(b), number<Rational>(r)), next());
        if (fresh) enter(solid, {true, a, b, -1, r, false});
        const Curve& c = trace_.curves[static_cast<std::size_t>(at->second)];
        const Vec<Rational> u = point(c.b) - point(c.a), v = point(b) - point(a);
        CurveUse use;
        use.curve = at->second;
        use.inside_left = sgn(dot(u, v)) > 0;
        return use;
    }

private:
    int next() const { return static_cast<int>(trace_.curves.size()); }
    Vec<Rational> point(int vertex) const {
        return exact_point<Rational>(trace_.local.vertices[static_cast<std::size_t>(vertex)]);
    }
    void enter(int solid, const Curve& curve) {
        trace_.curves.push_back(curve);
        trace_.owner.push_back(solid);
    }
    TraceProblem& trace_;
    std::map<std::tuple<int, double, const ExactRadius*>, int> circles_;
    std::map<LineKey, int> lines_;
};

void add_curves(TraceProblem& trace, int index, CurveTable& table) {
    Solid& solid = trace.solids[static_cast<std::size_t>(index)];
    const PreparedTrack& t = solid.approx;
    const double r = t.half, slack = 4 * trace.margin;
    const auto box = [&](CurveUse use, double x, double y, double u, double v) {
        use.lo_x = std::min(x, u) - slack, use.hi_x = std::max(x, u) + slack;
        use.lo_y = std::min(y, v) - slack, use.hi_y = std::max(y, v) + slack;
        solid.uses.push_back(use);
    };
    const int a = solid.stadium.a, b = solid.stadium.b;
    if (a == b) return box(table.circle(index, a), t.ax - r, t.ay - r, t.ax + r, t.ay + r);
    // Too short for doubles to tell its direction: all of its curves are near its end.
    const bool tells = t.inverse_norm > 0 && t.length > 0x1p20 * trace.margin;
    const double nx = tells ? t.dy / t.length * r : 0, ny = tells ? -t.dx / t.length * r : 0;
    const double more = tells ? 0 : r + t.length;
    const auto side = [&](CurveUse use, double x, double y, double u, double v) {
        box(use, std::min(x, u) - more, std::min(y, v) - more, std::max(x, u) + more, std::max(y, v) + more);
    };
    side(table.line(index, a, b), t.ax + nx, t.ay + ny, t.bx + nx, t.by + ny);
    box(table.circle(index, b), t.bx - r, t.by - r, t.bx + r, t.by + r);
    side(table.line(index, b, a), t.bx - nx, t.by - ny, t.ax - nx, t.ay - ny);
    box(table.circle(index, a), t.ax - r, t.ay - r, t.ax + r, t.ay + r);
    for (const std::size_t line : {0, 2})
        for (const std::size_t circle : {1, 3})
            trace.tangents.push_back({solid.uses[line].curve, solid.uses[circle].curve});
}

// The tracks without those that are others again, or these turned round.
std::vector<int> distinct(const PrintedPair& pair, std::span<const int> tracks) {
    const auto key = [&](int t) {
        const PrintedTrack& track = pair.upper[static_cast<std::size_t>(t)];
        return std::tuple{std::min(track.a, track.b), std::max(track.a, track.b), track.width};
    };
    std::map<decltype(key(0)), int> known;
    for (const int t : tracks) known.try_emplace(key(t), t);
    std::vector<int> kept;
    for (const auto& [k, t] : known) kept.push_back(t);
    std::sort(kept.begin(), kept.end());
    return kept;
}

// The same of parts, as far as doubles tell.
std::vector<PreparedTrack> distinct(std::vector<PreparedTrack> parts) {
    const auto key = [](const PreparedTrack& p) { return std::tuple{p.ax, p.ay, p.bx, p.by, p.half}; };
    std::sort(parts.begin(), parts.end(),
              [&](const PreparedTrack& p, const PreparedTrack& q) { return key(p) < key(q); });
    const auto same = [&](const PreparedTrack& p, const PreparedTrack& q) { return key(p) == key(q); };
    parts.erase(std::unique(parts.begin(), parts.end(), same), parts.end());
    return parts;
}

}  // namespace

void TraceProblem::near(const PreparedTrack& t, double radius, std::vector<int>& found) const {
    above_grid.near(t, radius, found);
    pair.grid.near(t, radius, scratch_);
    auto site = local.sites.begin();
    for (const int k : scratch_) {  // both ascend
        site = std::lower_bound(site, local.sites.end(), k);
        if (site == local.sites.end()) break;
        if (*site == k)
            found.push_back(static_cast<int>(above.size() + static_cast<std::size_t>(site - local.sites.begin())));
    }
}

std::array<double, 2> TraceProblem::approximate_mm(double x, double y) const {
    return {origin_x + x / scale, origin_y + y / scale};
}

int TraceProblem::node_of(int vertex) {
    while (true) {
        TraceVertex& v = vertices[static_cast<std::size_t>(vertex)];
        if (v.same < 0) return vertex;
        const int next = vertices[static_cast<std::size_t>(v.same)].same;
        if (next < 0) return v.same;
        vertex = v.same = next;
    }
}

void TraceProblem::unite(int vertex, int other) {
    const int v = node_of(vertex), w = node_of(other);
    if (v != w) vertices[static_cast<std::size_t>(std::max(v, w))].same = std::min(v, w);
}

void build_trace_problem(TraceProblem& trace, std::span<const int> tracks, std::vector<PreparedTrack> parts) {
    const PrintedPair& pair = trace.pair;
    trace.margin = pair.margin;
    trace.parts = distinct(std::move(parts));
    trace.part_grid = TrackGrid(trace.parts, 4 * trace.margin);
    double lo_x = HUGE_VAL, lo_y = HUGE_VAL, hi_x = -HUGE_VAL, hi_y = -HUGE_VAL;
    for (const PreparedTrack& p : trace.parts) {
        lo_x = std::min(lo_x, std::min(p.ax, p.bx) - p.half), hi_x = std::max(hi_x, std::max(p.ax, p.bx) + p.half);
        lo_y = std::min(lo_y, std::min(p.ay, p.by) - p.half), hi_y = std::max(hi_y, std::max(p.ay, p.by) + p.half);
    }
    const Square square{(lo_x + hi_x) / 2, (lo_y + hi_y) / 2,
                        std::max(hi_x - lo_x, hi_y - lo_y) / 2 + 8 * trace.margin};
    std::vector<int> which;
    pair.grid.near(square.x, square.y, root_cell_reach * square.half + 2 * window_slack(trace.margin), which);
    const Below below{pair.lower, pair.below, pair.radii, which, {}};
    build_local_problem(pair.upper, distinct(pair, tracks), below, square, trace.margin, trace.local);

    const LocalProblem& local = trace.local;
    trace.scale = local.scale.get_d(), trace.origin_x = local.origin[0].get_d(),
    trace.origin_y = local.origin[1].get_d();
    const auto add = [&](bool above, int track, const Stadium& stadium) {
        const auto k = static_cast<std::size_t>(track);
        Solid solid;
        solid.above = above, solid.track = track, solid.stadium = stadium;
        solid.approx = above ? pair.above[k] : pair.below[k];
        const PrintedTrack& exact = above ? pair.upper[k] : pair.lower[k];
        solid.a = rational(exact.a), solid.b = rational(exact.b);
        const Vec<Rational> p = exact_point<Rational>(local.vertices[static_cast<std::size_t>(stadium.a)]);
        if (local.to_mm(p.x, p.y) != solid.a) {  // sites may be turned round
            std::swap(solid.a, solid.b);
            std::swap(solid.approx.ax, solid.approx.bx), std::swap(solid.approx.ay, solid.approx.by);
            solid.approx.dx = -solid.approx.dx, solid.approx.dy = -solid.approx.dy;
        }
        solid.radius = above ? Rational(Rational(pair.upper[k].width) / 2) : Rational(pair.radii[k]);
        solid.approx.half = solid.radius.get_d();
        trace.solids.push_back(std::move(solid));
    };
    for (std::size_t i = 0; i < local.pieces.size(); ++i) add(true, local.pieces[i], local.problem.pieces[i]);
    for (const Solid& s : trace.solids) trace.above.push_back(s.approx);
    trace.above_grid = TrackGrid(trace.above, 4 * trace.margin);
    for (std::size_t i = 0; i < local.sites.size(); ++i) add(false, local.sites[i], local.problem.sites[i]);
    CurveTable table(trace);
    for (std::size_t i = 0; i < trace.solids.size(); ++i) add_curves(trace, static_cast<int>(i), table);
    std::sort(trace.tangents.begin(), trace.tangents.end());
}

}  // namespace ribvault::verify
