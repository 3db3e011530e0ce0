// Where the curves of a trace problem meet.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "ribvault/verify/trace_problem.hpp"

namespace ribvault::verify {

namespace {

bool overlap(const CurveUse& a, const CurveUse& b) {
    return a.lo_x <= b.hi_x && b.lo_x <= a.hi_x && a.lo_y <= b.hi_y && b.lo_y <= a.hi_y;
}

/// The curves near one part, and which of their meeting points may matter.
class Finder {
public:
    explicit Finder(TraceProblem& trace) : trace_(trace) {}
    void look_at(const PreparedTrack& part);

private:
    struct Near {
        int solid;
        const CurveUse* use;
    };
    void meet(const Near& p, const Near& q);
    bool matters(const Located& v, const Near& p, const Near& q) const;

    TraceProblem& trace_;
    const PreparedTrack* part_ = nullptr;
    std::vector<int> solids_;
    std::vector<Near> uses_;
};

void Finder::look_at(const PreparedTrack& part) {
    part_ = &part;
    const double slack = part.half + 4 * trace_.margin;
    CurveUse window;
    window.lo_x = std::min(part.ax, part.bx) - slack, window.hi_x = std::max(part.ax, part.bx) + slack;
    window.lo_y = std::min(part.ay, part.by) - slack, window.hi_y = std::max(part.ay, part.by) + slack;
    trace_.near(part, slack, solids_);
    uses_.clear();
    for (const int s : solids_)
        for (const CurveUse& use : trace_.solids[static_cast<std::size_t>(s)].uses)
            if (overlap(use, window)) uses_.push_back({s, &use});
    for (std::size_t i = 0; i < uses_.size(); ++i)
        for (std::size_t j = i + 1; j < uses_.size(); ++j)
            if (uses_[i].use->curve != uses_[j].use->curve && overlap(*uses_[i].use, *uses_[j].use))
                meet(uses_[i], uses_[j]);
}

// A point of the closure of the region is in the part or in another one, on both pieces, and in no stadium of K's
// interior.
bool Finder::matters(const Located& v, const Near& p, const Near& q) const {
    const double scale = trace_.local.scale.get_d();
    const auto [x, y] = trace_.approximate_mm((v.x.inf() + v.x.sup()) / 2, (v.y.inf() + v.y.sup()) / 2);
    const double error = ((v.x.sup() - v.x.inf()) + (v.y.sup() - v.y.inf())) / scale + 4 * trace_.margin;
    if (centre_distance(*part_, x, y) > part_->half + error) return false;
    for (const int s : {p.solid, q.solid}) {
        const PreparedTrack& t = trace_.solids[static_cast<std::size_t>(s)].approx;
        if (std::abs(centre_distance(t, x, y) - t.half) > error) return false;
    }
    return std::none_of(solids_.begin(), solids_.end(), [&](int s) {
        const Solid& solid = trace_.solids[static_cast<std::size_t>(s)];
        return !solid.above && centre_distance(solid.approx, x, y) < solid.approx.half - error;
    });
}

void Finder::meet(const Near& p, const Near& q) {
    const int first = std::min(p.use->curve, q.use->curve), second = std::max(p.use->curve, q.use->curve);
    const int count = meeting_count(trace_, first, second);
    if (p.solid == q.solid && count != 1) return;  // a stadium's own curves are its boundary where they touch only
    for (int root = count == 2 ? -1 : 0; root <= 1 && count > 0; root += 2) {
        TraceVertex v{first, second, root, located(trace_.local.problem, candidate_of(trace_, first, second, root)),
                      -1,    0,      {}};
        if (matters(v.at, p, q)) trace_.vertices.push_back(std::move(v));
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
    const std::lock_guard lock(algebraic_mutex());
    const Vec<Algebraic> p = locate<Algebraic>(*v.at.problem, v.at.candidate);
    // The relative bound suffices for coordinates below 2^64, which local ones are by far.
    const auto close = [&](const Algebraic& a) {
        return Rational(a.approx(CORE::extLong(bits + 64), CORE::extLong(bits)).BigRatValue().get_mp());
    };
    return v.close = {close(p.x), close(p.y)};
}

void find_trace_vertices(TraceProblem& trace) {
    Finder finder(trace);
    for (const PreparedTrack& part : trace.parts) finder.look_at(part);
    const auto key = [](const TraceVertex& v) { return std::tuple{v.first, v.second, v.root}; };
    std::sort(trace.vertices.begin(), trace.vertices.end(),
              [&](const TraceVertex& v, const TraceVertex& w) { return key(v) < key(w); });
    trace.vertices.erase(std::unique(trace.vertices.begin(), trace.vertices.end(),
                                     [&](const TraceVertex& v, const TraceVertex& w) { return key(v) == key(w); }),
                         trace.vertices.end());
}

}  // namespace ribvault::verify
