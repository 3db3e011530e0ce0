#include "ribvault/verify/trace_region.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "ribvault/verify/trace_loops.hpp"

namespace ribvault::verify {

namespace {

/// What was traced, written down without what was not needed.
class Description {
public:
    explicit Description(TraceProblem& trace) : trace_(trace) {
        for (std::size_t i = 0; i < trace.vertices.size(); ++i)
            members_[trace.node_of(static_cast<int>(i))].push_back(static_cast<int>(i));
    }

    BoundaryLoop loop(const TraceLoop& traced) {
        BoundaryLoop loop;
        for (const TracePiece& p : traced) {
            const Curve& c = trace_.curves[static_cast<std::size_t>(p.curve)];
            loop.push_back({curve(p.curve), BoundaryPiece::nowhere, BoundaryPiece::nowhere,
                            c.line      ? 0
                            : p.forward ? 1
                                        : -1,
                            p.angle});
        }
        for (std::size_t i = 0; i < traced.size(); ++i) {
            if (traced[i].from < 0) continue;
            const std::size_t before = (i + traced.size() - 1) % traced.size();
            loop[i].from = loop[before].to = vertex(traced[i].from, traced[before].curve, traced[i].curve);
        }
        return loop;
    }
    RegionBoundary boundary;

private:
    std::size_t curve(int index) {
        const auto [at, fresh] = curves_.try_emplace(index, boundary.curves.size());
        if (!fresh) return at->second;
        const Curve& c = trace_.curves[static_cast<std::size_t>(index)];
        const Solid& solid = trace_.solids[static_cast<std::size_t>(trace_.owner[static_cast<std::size_t>(index)])];
        boundary.curves.push_back(
            {c.line, solid.above, static_cast<std::size_t>(solid.track), solid.end(c.a), solid.end(c.b), solid.radius});
        return at->second;
    }

    // Where curve `in` ends and `out` begins: as the meeting point of these two where they are different.
    std::size_t vertex(int at, int in, int out) {
        int best = at;
        for (const int v : members_[trace_.node_of(at)]) {
            const TraceVertex& t = trace_.vertices[static_cast<std::size_t>(v)];
            if (t.first == std::min(in, out) && t.second == std::max(in, out)) best = v;
        }
        const auto [known, fresh] = vertices_.try_emplace(best, boundary.vertices.size());
        if (!fresh) return known->second;
        TraceVertex& v = trace_.vertices[static_cast<std::size_t>(best)];
        BoundaryVertex out_vertex;
        out_vertex.first = curve(v.first), out_vertex.second = curve(v.second), out_vertex.root = v.root;
        if (v.at.x.sup() - v.at.x.inf() + v.at.y.sup() - v.at.y.inf() > 0x1p-20) refine(v.at);
        const auto mm = [&](const Interval& a, const Rational& origin) {
            const Interval e = enclosure(origin) + a / enclosure(trace_.local.scale);
            return std::array{e.inf(), e.sup()};
        };
        out_vertex.x = mm(v.at.x, trace_.local.origin[0]), out_vertex.y = mm(v.at.y, trace_.local.origin[1]);
        boundary.vertices.push_back(out_vertex);
        return known->second;
    }

    TraceProblem& trace_;
    std::map<int, std::vector<int>> members_;
    std::map<int, std::size_t> curves_, vertices_;
};

/// A loop and what is known of it.
struct Found {
    TraceLoop loop;
    std::array<Rational, 2> area;
    bool outer() const { return area[0] > 0; }
};

// The outer loop in which each hole lies: of those that run round a point of the hole, the one that all others run
// round.
class Nesting {
public:
    Nesting(TraceProblem& trace, const std::vector<TraceArc>& arcs, const std::vector<Found>& loops)
        : trace_(trace), arcs_(arcs), loops_(loops) {
        for (std::size_t i = 0; i < loops.size(); ++i)
            if (loops[i].outer()) outer_.push_back(i);
    }

    std::size_t outer_of(std::size_t hole) const {
        if (outer_.size() == 1) return outer_.front();
        std::vector<std::size_t> around;
        for (const std::size_t i : outer_)
            if (contains(i, hole)) around.push_back(i);
        for (const std::size_t i : around)
            if (std::all_of(around.begin(), around.end(), [&](std::size_t j) { return i == j || contains(j, i); }))
                return i;
        throw std::logic_error("a traced hole lies in no region");
    }

private:
    bool contains(std::size_t outer, std::size_t other) const {
        const TraceArc& arc = arcs_[static_cast<std::size_t>(loops_[other].loop.front().arc)];
        return winding_number(trace_, loops_[outer].loop, arc.sample) != 0;
    }
    TraceProblem& trace_;
    const std::vector<TraceArc>& arcs_;
    const std::vector<Found>& loops_;
    std::vector<std::size_t> outer_;
};

}  // namespace

RegionBoundary trace_region(const PrintedPair& pair, std::span<const int> tracks, std::vector<PreparedTrack> parts) {
    TraceProblem trace(pair);
    build_trace_problem(trace, tracks, std::move(parts));
    find_trace_vertices(trace);
    const std::vector<TraceArc> arcs = find_trace_arcs(trace);
    std::vector<Found> found;
    for (TraceLoop& loop : join_arcs(trace, arcs)) {
        const TraceLoop* const one[] = {&loop};
        const std::array<Rational, 2> area = loops_area(trace, one);
        found.push_back({std::move(loop), area});
    }

    std::map<std::size_t, std::vector<const TraceLoop*>> components;  // by outer loop
    for (std::size_t i = 0; i < found.size(); ++i)
        if (found[i].outer()) components[i].push_back(&found[i].loop);
    const Nesting nesting(trace, arcs, found);
    for (std::size_t i = 0; i < found.size(); ++i)
        if (!found[i].outer()) components.at(nesting.outer_of(i)).push_back(&found[i].loop);

    Description description(trace);
    const Rational square = trace.local.scale * trace.local.scale;
    for (const auto& [outer, loops] : components) {
        const std::array<Rational, 2> area = loops.size() == 1 ? found[outer].area : loops_area(trace, loops);
        RegionComponent component;
        component.area_lo = Rational(area[0] / square).get_d();  // get_d truncates
        component.area_hi = std::nextafter(Rational(area[1] / square).get_d(), HUGE_VAL);
        for (const TraceLoop* loop : loops) component.loops.push_back(description.loop(*loop));
        description.boundary.components.push_back(std::move(component));
    }
    return std::move(description.boundary);
}

}  // namespace ribvault::verify
