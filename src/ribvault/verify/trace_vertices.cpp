// Where the curves of a trace problem meet.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "ribvault/verify/trace_problem.hpp"

namespace ribvault::verify {

namespace {

bool overlap(const CurveUse& a, const CurveUse& b) {
    return a.lo_x <= b.hi_x && b.lo_x <= a.hi_x && a.lo_y <= b.hi_y && b.lo_y <= a.hi_y;
}

/// The pieces of curves near the parts, and which of their meeting points may matter.
class Finder {
public:
    explicit Finder(TraceProblem& trace) : trace_(trace) {}
    void find();

private:
    struct Met {
        int count = 0;
        std::array<std::optional<Located>, 2> points;
    };
    void mark();
    void meet(const Solid& s, const CurveUse& u, const Solid& t, const CurveUse& v);
    bool matters(const Located& v, const Solid& s, const Solid& t);

    TraceProblem& trace_;
    std::vector<std::vector<char>> marked_;  ///< per solid and piece: near a part
    std::map<std::array<int, 2>, Met> met_;  ///< curves of the solid that is looked at; many may have others in common
    std::vector<int> near_;
};

void Finder::mark() {
    for (const Solid& s : trace_.solids) marked_.emplace_back(s.uses.size(), 0);
    for (const PreparedTrack& part : trace_.parts) {
        const double slack = part.half + 4 * trace_.margin;
        CurveUse window;
        window.lo_x = std::min(part.ax, part.bx) - slack, window.hi_x = std::max(part.ax, part.bx) + slack;
        window.lo_y = std::min(part.ay, part.by) - slack, window.hi_y = std::max(part.ay, part.by) + slack;
        trace_.near(part, slack, near_);
        for (const int k : near_) {
            const auto i = static_cast<std::size_t>(k);
            for (std::size_t u = 0; u < marked_[i].size(); ++u)
                if (overlap(trace_.solids[i].uses[u], window)) marked_[i][u] = 1;
        }
    }
}

void Finder::find() {
    mark();
    std::vector<int> others;
    for (std::size_t i = 0; i < trace_.solids.size(); ++i) {
        if (std::count(marked_[i].begin(), marked_[i].end(), 1) == 0) continue;
        const Solid& s = trace_.solids[i];
        trace_.near(s.approx, s.approx.half + 4 * trace_.margin, others);
        met_.clear();
        for (const int k : others) {
            const auto j = static_cast<std::size_t>(k);
            if (j > i) break;  // they ascend
            const Solid& t = trace_.solids[j];
            for (std::size_t u = 0; u < s.uses.size(); ++u)
                for (std::size_t v = 0; v < (i == j ? u : t.uses.size()); ++v)
                    if (marked_[i][u] && marked_[j][v] && s.uses[u].curve != t.uses[v].curve &&
                        overlap(s.uses[u], t.uses[v]))
                        meet(s, s.uses[u], t, t.uses[v]);
        }
    }
}

// A point of the closure of the region is in a part, on both pieces, and in no stadium of K's interior. A point in the
// interior of a stadium of M has only the borders of K's stadiums in that closure: their meeting points among
// themselves are all that matters there.
bool Finder::matters(const Located& v, const Solid& s, const Solid& t) {
    const auto [x, y] = trace_.approximate_mm((v.x.inf() + v.x.sup()) / 2, (v.y.inf() + v.y.sup()) / 2);
    const double error = ((v.x.sup() - v.x.inf()) + (v.y.sup() - v.y.inf())) / trace_.scale + 4 * trace_.margin;
    if (!std::isfinite(x + y + error)) return true;  // doubles do not place it
    for (const Solid* solid : {&s, &t})
        if (std::abs(centre_distance(solid->approx, x, y) - solid->approx.half) > error) return false;
    const auto within = [&, x = x, y = y](const PreparedTrack& p, double half) {
        return centre_distance(p, x, y) < half - error;
    };
    const PrintedPair& pair = trace_.pair;
    if (pair.grid.any_at(x, y, [&](int k) {
            const PreparedTrack& below = pair.below[static_cast<std::size_t>(k)];
            return within(below, below.half + pair.rho_approx);
        }))
        return false;
    if ((s.above || t.above) && trace_.above_grid.any_at(x, y, [&](int k) {
            const PreparedTrack& above = trace_.above[static_cast<std::size_t>(k)];
            return within(above, above.half);
        }))
        return false;
    trace_.part_grid.near(x, y, error, near_);
    return std::any_of(near_.begin(), near_.end(), [&, x = x, y = y](int k) {
        const PreparedTrack& part = trace_.parts[static_cast<std::size_t>(k)];
        return centre_distance(part, x, y) <= part.half + error;
    });
}

void Finder::meet(const Solid& s, const CurveUse& u, const Solid& t, const CurveUse& v) {
    const int first = std::min(u.curve, v.curve), second = std::max(u.curve, v.curve);
    const auto [known, fresh] = met_.try_emplace({first, second});
    Met& met = known->second;
    if (fresh) met.count = meeting_count(trace_, first, second);
    if (&s == &t && met.count != 1) return;  // a stadium's own curves are its boundary where they touch only
    for (int root = met.count == 2 ? -1 : 0; root <= 1 && met.count > 0; root += 2) {
        std::optional<Located>& at = met.points[root > 0];
        if (!at) at = located(trace_.local.problem, candidate_of(trace_, first, second, root));
        if (matters(*at, s, t)) trace_.vertices.push_back({first, second, root, *at, -1, 0, {}});
    }
}

}  // namespace

int meeting_count(const TraceProblem& trace, int first, int second) {
    const Curve &p = trace.curves[static_cast<std::size_t>(first)], &q = trace.curves[static_cast<std::size_t>(second)];
    if (p.line != q.line) {
        const std::array<int, 2> key = p.line ? std::array{first, second} : std::array{second, first};
        if (std::binary_search(trace.tangents.begin(), trace.tangents.end(), key)) return 1;
    }
    Stage stage = Stage::interval;
    return meeting_points(trace.local.problem, p, q, stage);
}

Candidate candidate_of(const TraceProblem& trace, int first, int second, int root) {
    Candidate c;
    c.kind = Candidate::Kind::meeting;
    c.first = trace.curves[static_cast<std::size_t>(first)], c.second = trace.curves[static_cast<std::size_t>(second)];
    c.root = root;
    return c;
}

const Vec<Rational>& approximation(TraceVertex& v, unsigned bits) {
    if (v.bits >= bits) return v.close;
    CGAL::Protect_FPU_rounding<true> nearest(CGAL_FE_TONEAREST);
    v.bits = bits;
    if (const Vec<Rational>* q = rational_value(v.at)) return v.close = *q;
    const Vec<Algebraic> p = locate<Algebraic>(*v.at.problem, v.at.candidate);
    return v.close = {approximation(p.x, bits), approximation(p.y, bits)};
}

void find_trace_vertices(TraceProblem& trace) {
    Finder(trace).find();
    const auto key = [](const TraceVertex& v) { return std::tuple{v.first, v.second, v.root}; };
    std::sort(trace.vertices.begin(), trace.vertices.end(),
              [&](const TraceVertex& v, const TraceVertex& w) { return key(v) < key(w); });
    trace.vertices.erase(std::unique(trace.vertices.begin(), trace.vertices.end(),
                                     [&](const TraceVertex& v, const TraceVertex& w) { return key(v) == key(w); }),
                         trace.vertices.end());
}

}  // namespace ribvault::verify
