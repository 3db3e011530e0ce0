#include "ribvault/print/medial_tracks.hpp"

#include <algorithm>
#include <boost/polygon/voronoi.hpp>
#include <cmath>
#include <map>

#include "ribvault/print/segment_rows.hpp"

namespace ribvault {
namespace {

namespace bp = boost::polygon;
using Node = std::size_t;
using Diagram = bp::voronoi_diagram<double>;

struct BoostPoint {
    int x, y;
};
struct BoostSegment {
    BoostPoint low, high;
};

}  // namespace
}  // namespace ribvault

template <>
struct boost::polygon::geometry_concept<ribvault::BoostPoint> {
    using type = point_concept;
};
template <>
struct boost::polygon::point_traits<ribvault::BoostPoint> {
    using coordinate_type = int;
    static int get(const ribvault::BoostPoint& p, orientation_2d o) { return o == HORIZONTAL ? p.x : p.y; }
};
template <>
struct boost::polygon::geometry_concept<ribvault::BoostSegment> {
    using type = segment_concept;
};
template <>
struct boost::polygon::segment_traits<ribvault::BoostSegment> {
    using coordinate_type = int;
    using point_type = ribvault::BoostPoint;
    static point_type get(const ribvault::BoostSegment& s, direction_1d d) { return d.to_int() ? s.high : s.low; }
};

namespace ribvault {
namespace {

struct Position {
    double x, y;
};

double distance(Position p, const BoostSegment& s) {
    const double dx = s.high.x - double{0} - s.low.x, dy = s.high.y - double{0} - s.low.y, tx = p.x - s.low.x,
                 ty = p.y - s.low.y;
    const double square = dx * dx + dy * dy;
    const double t = square > 0 ? std::clamp((tx * dx + ty * dy) / square, 0.0, 1.0) : 0;
    return std::hypot(tx - t * dx, ty - t * dy);
}

bool inside(const SegmentRows& border, Position p) { return border.winding(p.x, p.y) != 0; }

/// The medial axis as a graph; nodes carry their distance to the border.
struct Axis {
    struct Arc {
        Node to;
        std::size_t edge;
    };
    std::vector<Position> at;
    std::vector<double> radius;
    std::vector<std::vector<Arc>> arcs;
    std::vector<char> used;  ///< by edge

    Node add(Position p, double r) {
        at.push_back(p), radius.push_back(r), arcs.emplace_back();
        return at.size() - 1;
    }
    void join(Node a, Node b) {
        if (a == b) return;
        arcs[a].push_back({b, used.size()}), arcs[b].push_back({a, used.size()});
        used.push_back(0);
    }
    double length(Node a, Node b) const { return std::hypot(at[a].x - at[b].x, at[a].y - at[b].y); }
};

std::vector<BoostSegment> border_of(const Region& area, Point origin) {
    std::vector<BoostSegment> border;
    const auto local = [&](Point p) {
        return BoostPoint{static_cast<int>(p.x - origin.x), static_cast<int>(p.y - origin.y)};
    };
    for (const Contour& c : area)
        for (std::size_t i = 0; i < c.size(); ++i)
            if (c[i] != c[(i + 1) % c.size()]) border.push_back({local(c[i]), local(c[(i + 1) % c.size()])});
    return border;
}

constexpr double rounded = 25;  // lattice units that rounding and clearances may change on either side of a wall

/// The part of the axis inside the area whose distance to the border lies between `least` and `most`; where it is one
/// of them all along, rounding does not decide.
Axis axis_of(const std::vector<BoostSegment>& border, double least, double most, double step) {
    Diagram diagram;
    std::vector<Segment> edges;
    for (const BoostSegment& s : border) edges.push_back({{s.low.x, s.low.y}, {s.high.x, s.high.y}});
    const SegmentRows rows(edges);
    bp::construct_voronoi(border.begin(), border.end(), &diagram);
    Axis axis;
    std::map<const Diagram::vertex_type*, Node> nodes;
    const auto radius = [&](const Diagram::edge_type& edge, Position p) {
        return distance(p, border[edge.cell()->source_index()]);
    };
    for (std::size_t e = 0; e < diagram.edges().size(); e += 2) {
        const Diagram::edge_type& edge = diagram.edges()[e];
        if (!edge.is_primary() || !edge.is_finite()) continue;
        const Position a{edge.vertex0()->x(), edge.vertex0()->y()}, b{edge.vertex1()->x(), edge.vertex1()->y()};
        if (!inside(rows, {(a.x + b.x) / 2, (a.y + b.y) / 2})) continue;
        const double ra = radius(edge, a), rb = radius(edge, b);
        const bool at_least = std::min(ra, rb) >= least - rounded && std::max(ra, rb) <= least + rounded,
                   at_most = std::min(ra, rb) >= most - rounded && std::max(ra, rb) <= most + rounded;
        if ((std::max(ra, rb) < least && !at_least) || (std::min(ra, rb) > most && !at_most)) continue;
        const auto node = [&](const Diagram::vertex_type* v, Position p, double r, Position q, double rq) {
            const double limit = at_least || at_most ? r : std::clamp(r, least, most);
            if (r == limit) {
                const auto [found, added] = nodes.try_emplace(v, axis.at.size());
                return added ? axis.add(p, r) : found->second;
            }
            const double t = (limit - r) / (rq - r);
            return axis.add({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)}, limit);
        };
        const Node na = node(edge.vertex0(), a, ra, b, rb), nb = node(edge.vertex1(), b, rb, a, ra);
        // Where the width changes, in steps of at most `step`.
        const auto pieces =
            static_cast<std::size_t>(std::ceil(std::max(1.0, 2 * std::fabs(axis.radius[na] - axis.radius[nb]) / step)));
        Node before = na;
        for (std::size_t k = 1; k < pieces; ++k) {
            const double t = static_cast<double>(k) / static_cast<double>(pieces);
            const auto mix = [t](double from, double to) { return from + t * (to - from); };
            const Node next = axis.add({mix(axis.at[na].x, axis.at[nb].x), mix(axis.at[na].y, axis.at[nb].y)},
                                       mix(axis.radius[na], axis.radius[nb]));
            axis.join(before, next);
            before = next;
        }
        axis.join(before, nb);
    }
    return axis;
}

/// The way from `from` over arc `k` up to the next end or junction.
std::vector<Node> chain_from(const Axis& axis, Node from, std::size_t k) {
    std::vector<Node> chain{from};
    Axis::Arc arc = axis.arcs[from][k];
    while (true) {
        chain.push_back(arc.to);
        if (arc.to == from || axis.arcs[arc.to].size() != 2) return chain;
        const std::size_t came = arc.edge;
        const auto& next = axis.arcs[arc.to];
        arc = next[0].edge == came ? next[1] : next[0];
    }
}

double length_of(const Axis& axis, const std::vector<Node>& chain) {
    double sum = 0;
    for (std::size_t i = 1; i < chain.size(); ++i) sum += axis.length(chain[i - 1], chain[i]);
    return sum;
}

void remove(Axis& axis, const std::vector<Node>& chain) {
    for (std::size_t i = 1; i < chain.size(); ++i) {
        std::erase_if(axis.arcs[chain[i - 1]], [&](const Axis::Arc& a) { return a.to == chain[i]; });
        std::erase_if(axis.arcs[chain[i]], [&](const Axis::Arc& a) { return a.to == chain[i - 1]; });
    }
}

/// Takes away side branches shorter than `limit`, at a blunt end both that lead to its corners. Where nothing else
/// leads to a junction the longest stays, and where one chain does that is shorter than the limit too, the longest if
/// it leads farther than two radii of the junction, so to no corner of 60 degrees or more: with it there may be a
/// track, without it there is none.
void prune(Axis& axis, double limit) {
    struct Branch {
        double length;
        std::vector<Node> chain;  ///< up to the junction
    };
    std::map<Node, std::vector<Branch>> branches;  // by junction
    for (Node v = 0; v < axis.at.size(); ++v) {
        if (axis.arcs[v].size() != 1) continue;
        std::vector<Node> chain = chain_from(axis, v, 0);
        const Node junction = chain.back();
        if (axis.arcs[junction].size() < 3) continue;
        if (const double along = length_of(axis, chain); along < limit)
            branches[junction].push_back({along, std::move(chain)});
    }
    for (auto& [junction, at_it] : branches) {
        const auto longest = std::max_element(at_it.begin(), at_it.end(),
                                              [](const Branch& a, const Branch& b) { return a.length < b.length; });
        for (auto branch = at_it.begin(); branch != at_it.end(); ++branch)
            if (branch != longest) remove(axis, branch->chain);
        const std::vector<Axis::Arc>& left = axis.arcs[junction];  // the longest, and what is no short branch
        const auto shorter = [&](std::size_t k) { return length_of(axis, chain_from(axis, junction, k)) < limit; };
        const bool leads_on = longest->length > 2 * axis.radius[junction];
        const bool stays = left.size() == 1 || (left.size() == 2 && leads_on && shorter(0) && shorter(1));
        if (!stays) remove(axis, longest->chain);
    }
}

}  // namespace

std::vector<PlannedTrack> medial_tracks(const Region& area, Unit width, TrackKind kind, bool however_short) {
    std::vector<PlannedTrack> tracks;
    if (area.empty()) return tracks;
    const Point origin = bounding_box(area).lo;
    const double d = static_cast<double>(width);
    Axis axis = axis_of(border_of(area, origin), d / 4, 3 * d / 4, d / 20);
    prune(axis, d);

    const auto emit = [&](const std::vector<Node>& chain) {
        const bool whole = axis.arcs[chain.front()].size() == 1 && axis.arcs[chain.back()].size() == 1;
        if (!(however_short && whole) && length_of(axis, chain) < d) return;
        PlannedTrack track{{}, Entry::either_end, no_stop};
        const auto place = [&](Node n) {
            return origin + Point{round_to_lattice(axis.at[n].x), round_to_lattice(axis.at[n].y)};
        };
        const Unit step = std::max<Unit>(1, width / 20);
        for (std::size_t i = 1; i < chain.size(); ++i) {
            const Point a = place(chain[i - 1]), b = place(chain[i]);
            if (a == b) continue;
            const auto room = static_cast<Unit>(2 * std::min(axis.radius[chain[i - 1]], axis.radius[chain[i]]));
            const Unit w = std::clamp(room / step * step, width / 2, 3 * width / 2);
            if (track.paths.empty() || track.paths.back().width != w) track.paths.push_back({kind, w, false, {a}});
            track.paths.back().points.push_back(b);
        }
        if (!track.paths.empty()) tracks.push_back(std::move(track));
    };
    const auto mark = [&](const std::vector<Node>& chain) {
        for (std::size_t i = 1; i < chain.size(); ++i)
            for (const Axis::Arc& a : axis.arcs[chain[i - 1]])
                if (a.to == chain[i]) axis.used[a.edge] = 1;
    };
    for (const bool rings : {false, true})  // first what has ends, then closed rings
        for (Node v = 0; v < axis.at.size(); ++v) {
            if (!rings && axis.arcs[v].size() == 2) continue;
            for (std::size_t k = 0; k < axis.arcs[v].size(); ++k) {
                if (axis.used[axis.arcs[v][k].edge]) continue;
                const std::vector<Node> chain = chain_from(axis, v, k);
                mark(chain);
                emit(chain);
            }
        }
    return tracks;
}

}  // namespace ribvault
