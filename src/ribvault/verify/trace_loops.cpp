#include "ribvault/verify/trace_loops.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>

namespace ribvault::verify {

namespace {

/// An end of an arc seen from the vertex: the direction in which it leaves, along the curve's own direction or against
/// it.
struct Ray {
    int curve = 0;
    bool along = true;
};
Ray start_of(const TraceArc& a) { return {a.curve, a.forward}; }
Ray back_of(const TraceArc& a) { return {a.curve, !a.forward}; }

/// Rays at one vertex by angle.
class Fan {
public:
    Fan(TraceProblem& trace, int vertex) : trace_(trace), at_(trace.vertices[static_cast<std::size_t>(vertex)].at) {}

    /// Whether, turning counterclockwise from `base`, p comes before q.
    bool before(const Ray& base, const Ray& p, const Ray& q) {
        const int i = sector(base, p), j = sector(base, q);
        if (i != j) return i < j;
        const int c = i == 1 || i == 3 ? product(p, q, true) : 0;
        return c != 0 ? c > 0 : compare_bend(p, q) < 0;
    }

private:
    // 0 just left of the base, 1 in the half turn from it, 2 opposite, 3 in the second half turn, 4 just right of the
    // base.
    int sector(const Ray& base, const Ray& p) {
        const int c = product(base, p, true);
        if (c != 0) return c > 0 ? 1 : 3;
        if (product(base, p, false) < 0) return 2;
        return compare_bend(p, base) > 0 ? 0 : 4;
    }

    // Sign of cross or dot product of two directions.
    int product(const Ray& p, const Ray& q, bool want_cross) {
        if (p.curve == q.curve) return want_cross ? 0 : p.along == q.along ? 1 : -1;
        const int s = sign_at(
            at_,
            [&]<class NT>(const Vec<NT>& v) -> NT {
                const Vec<NT> d = direction<NT>(p, v), e = direction<NT>(q, v);
                return want_cross ? cross(d, e) : dot(d, e);
            },
            Stage::algebraic);
        return p.along == q.along ? s : -s;
    }
    template <class NT>
    Vec<NT> direction(const Ray& r, const Vec<NT>& v) const {
        const Curve& c = trace_.curves[static_cast<std::size_t>(r.curve)];
        const auto point = [&](int k) { return exact_point<NT>(trace_.local.vertices[static_cast<std::size_t>(k)]); };
        const Vec<NT> a = point(c.a);
        if (c.line) return point(c.b) - a;
        return {NT(a.y - v.y), NT(v.x - a.x)};
    }

    // Rays in one direction: the one that bends more to the left is farther left. The curvature is +-1 / R, or 0.
    int compare_bend(const Ray& p, const Ray& q) const {
        const auto bend = [&](const Ray& r) {
            return trace_.curves[static_cast<std::size_t>(r.curve)].line ? 0 : r.along ? 1 : -1;
        };
        if (bend(p) != bend(q)) return bend(p) < bend(q) ? -1 : 1;
        if (bend(p) == 0) return 0;
        const auto radius = [&](const Ray& r) {
            return number<Rational>(trace_.curves[static_cast<std::size_t>(r.curve)].radius);
        };
        return bend(p) * cmp(radius(q), radius(p));
    }

    TraceProblem& trace_;
    Located& at_;
};

/// What begins and ends at a point.
struct Joint {
    std::vector<int> out, in;
};

// The interior lies between the ray back along an arc and the next ray clockwise, which therefore is the next arc's.
int next_arc(TraceProblem& trace, const std::vector<TraceArc>& arcs, int node, const Joint& joint, int arriving) {
    if (joint.out.size() == 1) return joint.out.front();
    Fan fan(trace, node);
    const Ray base = back_of(arcs[static_cast<std::size_t>(arriving)]);
    return *std::max_element(joint.out.begin(), joint.out.end(), [&](int i, int j) {
        return fan.before(base, start_of(arcs[static_cast<std::size_t>(i)]),
                          start_of(arcs[static_cast<std::size_t>(j)]));
    });
}

// Merges what goes on along one curve through joints with nothing else.
TraceLoop merged(const std::vector<TraceArc>& arcs, const std::vector<int>& cycle,
                 const std::vector<char>& simple_start) {
    const auto goes_on = [&](std::size_t i) {  // arc i of the cycle is a continuation of the one before
        const TraceArc &a = arcs[static_cast<std::size_t>(cycle[(i + cycle.size() - 1) % cycle.size()])],
                       &b = arcs[static_cast<std::size_t>(cycle[i])];
        return a.from >= 0 && simple_start[static_cast<std::size_t>(cycle[i])] && a.curve == b.curve &&
               a.forward == b.forward;
    };
    std::size_t first = 0;
    while (first < cycle.size() && goes_on(first)) ++first;
    const bool whole = first == cycle.size();  // one circle, all of it
    if (whole) first = 0;
    TraceLoop loop;
    for (std::size_t i = 0; i < cycle.size(); ++i) {
        const std::size_t k = (first + i) % cycle.size();
        const TraceArc& a = arcs[static_cast<std::size_t>(cycle[k])];
        if (i > 0 && goes_on(k)) {
            loop.back().to = a.to, loop.back().angle += a.angle;
        } else {
            loop.push_back({a.curve, a.from, a.to, a.forward, a.angle, cycle[k]});
        }
    }
    if (whole) loop.front().from = loop.front().to = -1;
    return loop;
}

}  // namespace

std::vector<TraceLoop> join_arcs(TraceProblem& trace, const std::vector<TraceArc>& arcs) {
    std::map<int, Joint> joints;
    for (std::size_t i = 0; i < arcs.size(); ++i) {
        if (arcs[i].from < 0) continue;
        joints[trace.node_of(arcs[i].from)].out.push_back(static_cast<int>(i));
        joints[trace.node_of(arcs[i].to)].in.push_back(static_cast<int>(i));
    }
    std::vector<int> next(arcs.size());
    std::vector<char> simple_start(arcs.size(), 0), used(arcs.size(), 0);
    for (std::size_t i = 0; i < arcs.size(); ++i) next[i] = static_cast<int>(i);
    for (const auto& [node, joint] : joints) {
        if (joint.in.size() != joint.out.size()) throw std::logic_error("a traced region's boundary does not close");
        for (const int i : joint.in) next[static_cast<std::size_t>(i)] = next_arc(trace, arcs, node, joint, i);
        if (joint.out.size() == 1) simple_start[static_cast<std::size_t>(joint.out.front())] = 1;
    }
    std::vector<TraceLoop> loops;
    for (std::size_t i = 0; i < arcs.size(); ++i) {
        std::vector<int> cycle;
        for (auto k = i; !used[k]; k = static_cast<std::size_t>(next[k])) {
            used[k] = 1;
            cycle.push_back(static_cast<int>(k));
        }
        if (cycle.empty()) continue;
        if (next[static_cast<std::size_t>(cycle.back())] != cycle.front())
            throw std::logic_error("a traced region's boundary does not close");
        loops.push_back(merged(arcs, cycle, simple_start));
    }
    return loops;
}

}  // namespace ribvault::verify
