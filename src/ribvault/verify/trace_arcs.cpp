#include "ribvault/verify/trace_arcs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ribvault::verify {

namespace {

/// What is beside a point of a curve.
struct Beside {
    bool left = false, right = false;
};

const CurveUse* use_of(const Solid& solid, int curve) {
    for (const CurveUse& use : solid.uses)
        if (use.curve == curve) return &use;
    return nullptr;
}

class ArcFinder {
public:
    explicit ArcFinder(TraceProblem& trace) : trace_(trace) {}
    std::vector<TraceArc> find();

private:
    void look_along(int curve, std::span<const int> vertices);
    void look_at(int curve, const Place* from, const Place* to, bool round);
    int side_of(const Solid& solid, const CurveUse* use, const CurvePoint& p) const;
    Beside beside(int curve, const CurvePoint& p);

    TraceProblem& trace_;
    std::vector<char> is_disc_;  ///< per curve: the circle of a dot
    std::vector<int> near_;
    std::vector<TraceArc> arcs_;
};

// -1, 0, 1: p inside the stadium, on its boundary, outside.
int ArcFinder::side_of(const Solid& solid, const CurveUse* use, const CurvePoint& p) const {
    const PreparedTrack& t = solid.approx;
    const double d = centre_distance(t, p.x, p.y) - t.half, slack = 2 * trace_.margin;
    if (std::abs(d) > slack) return d < 0 ? -1 : 1;
    if (use && t.length > 8 * slack && t.inverse_norm > 0) {
        // On a curve of the stadium: on its boundary where the curve is that, which is known away from the ends.
        const double along = ((p.x - t.ax) * t.dx + (p.y - t.ay) * t.dy) / t.length;
        const bool line = trace_.curves[static_cast<std::size_t>(use->curve)].line;
        const bool beside = along > slack && along < t.length - slack,
                   past = along < -slack || along > t.length + slack;
        if (line ? beside : past) return 0;
    }
    return compare_distance(p, solid.a, solid.b, solid.radius);
}

// Which of the two sides of the curve at p belong to the region, p being no vertex. Where p is on the boundary of a
// stadium that does not have this curve, it is not in the closure of the region, or it is in the interior of M and that
// boundary or this curve is M's alone: else it would be a vertex.
Beside ArcFinder::beside(int curve, const CurvePoint& p) {
    PreparedTrack at;
    at.ax = at.bx = p.x, at.ay = at.by = p.y;
    trace_.part_grid.near(p.x, p.y, 4 * trace_.margin, near_);
    const bool in_part = std::any_of(near_.begin(), near_.end(), [&](int k) {
        const PreparedTrack& part = trace_.parts[static_cast<std::size_t>(k)];
        return centre_distance(part, p.x, p.y) <= part.half + 2 * trace_.margin;
    });
    if (!in_part) return {};
    trace_.near(at, 4 * trace_.margin, near_);
    Beside above, below;
    bool on_other = false;
    for (auto k = near_.rbegin(); k != near_.rend(); ++k) {  // K first: it often covers both sides
        const Solid& solid = trace_.solids[static_cast<std::size_t>(*k)];
        Beside& by = solid.above ? above : below;
        if (by.left && by.right) continue;
        const CurveUse* use = use_of(solid, curve);
        const int side = side_of(solid, use, p);
        if (side > 0) continue;
        if (side == 0 && !use) {
            if (!solid.above) return {};
            on_other = true;
            continue;
        }
        by.left = by.left || side < 0 || use->inside_left;
        by.right = by.right || side < 0 || !use->inside_left;
        if (below.left && below.right) return {};
    }
    if (on_other && !(above.left && above.right)) return {};
    return {above.left && !below.left, above.right && !below.right};
}

void ArcFinder::look_at(int curve, const Place* from, const Place* to, bool round) {
    TraceArc arc;
    arc.curve = curve;
    arc.sample = from ? point_between(trace_, curve, *from, *to, round) : point_of_circle(trace_, curve);
    const Beside b = beside(curve, arc.sample);
    if (b.left == b.right) return;
    arc.forward = b.left;
    if (from) {
        arc.from = from->vertex, arc.to = to->vertex;
        if (!arc.forward) std::swap(arc.from, arc.to);
    }
    if (!trace_.curves[static_cast<std::size_t>(curve)].line)
        arc.angle = from ? (to->lo + to->hi - from->lo - from->hi) / 2 + (round ? 2 * std::numbers::pi : 0)
                         : 2 * std::numbers::pi;
    arcs_.push_back(std::move(arc));
}

void ArcFinder::look_along(int curve, std::span<const int> vertices) {
    const bool line = trace_.curves[static_cast<std::size_t>(curve)].line;
    if (vertices.empty()) {
        // Of a circle all can be boundary only when it is a disc's: half of any other is inside its own stadium.
        if (is_disc_[static_cast<std::size_t>(curve)]) look_at(curve, nullptr, nullptr, true);
        return;
    }
    const std::vector<Place> places = order_along(trace_, curve, vertices);
    for (std::size_t i = 0; i + 1 < places.size(); ++i) look_at(curve, &places[i], &places[i + 1], false);
    if (!line) look_at(curve, &places.back(), &places.front(), true);
}

std::vector<TraceArc> ArcFinder::find() {
    std::vector<std::vector<int>> on(trace_.curves.size());
    for (std::size_t v = 0; v < trace_.vertices.size(); ++v) {
        on[static_cast<std::size_t>(trace_.vertices[v].first)].push_back(static_cast<int>(v));
        on[static_cast<std::size_t>(trace_.vertices[v].second)].push_back(static_cast<int>(v));
    }
    is_disc_.assign(trace_.curves.size(), 0);
    for (const Solid& solid : trace_.solids)
        if (solid.uses.size() == 1) is_disc_[static_cast<std::size_t>(solid.uses[0].curve)] = 1;
    for (std::size_t c = 0; c < on.size(); ++c) look_along(static_cast<int>(c), on[c]);
    return std::move(arcs_);
}

}  // namespace

std::vector<TraceArc> find_trace_arcs(TraceProblem& trace) { return ArcFinder(trace).find(); }

}  // namespace ribvault::verify
