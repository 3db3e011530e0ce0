#include "ribvault/print/support_paths.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string>

#include "ribvault/error.hpp"
#include "ribvault/print/bent_path.hpp"
#include "ribvault/print/wide_walls.hpp"

namespace ribvault {
namespace {

using Vertex = std::size_t;
constexpr Vertex no_vertex = std::numeric_limits<Vertex>::max();
constexpr double nearest_bend = 0.25;  ///< widths: a path leaves its wall no nearer to the corner of a short branch

/// A branch to print: it leaves a junction (or the root) into one of its subtrees.
struct Branch {
    Vertex junction;
    Vertex into;
};

/// How far from its corner a path may leave its wall for the tip of a long branch: 0.7 widths, by trial. A wall above
/// that goes straight on, its far rim too, is within r + ρ of the bend if that is at most √((r + ρ)² - r²), however
/// long the branch is. 0: nowhere, as with a smaller ρ patches would take more than the branches' own tracks.
double farthest_bend_of(const Settings& s) {
    const double width = static_cast<double>(s.support_width), r = width / 2,
                 reach = r + static_cast<double>(s.support_radius);
    const double farthest = 0.7 * width;
    return farthest * farthest > reach * reach - r * r ? 0 : farthest;
}

/// What is known of a forest's vertices once their tree hangs from its root.
struct RootedForest {
    const SupportForest& forest;
    const Unit width;
    const double farthest_bend;  ///< how far from its corner a path may leave its wall; 0: nowhere
    std::vector<Vertex> parent;
    std::vector<double> edge_length;  ///< of the edge to the parent
    std::vector<char> first_layer;    ///< of the edge to the parent
    std::vector<char> to_junction;    ///< the same
    std::vector<double> reach;        ///< length of the longest way down from the vertex
    /// How much of the next branch leaving the vertex is left out: nothing where nothing was printed yet (a root), one
    /// width where a path runs through.
    std::vector<double> gap;
    std::vector<char> seen;
    /// The track of the plan that runs through the vertex; where the branch is too short to be printed, the one before
    /// it.
    std::vector<std::size_t> printed_by;

    RootedForest(const SupportForest& f, const Settings& settings)
        : forest(f),
          width(settings.support_width),
          farthest_bend(settings.gaps == Gaps::proved ? farthest_bend_of(settings) : 0),
          parent(num_vertices(f), no_vertex),
          edge_length(num_vertices(f), 0),
          first_layer(num_vertices(f), 0),
          to_junction(num_vertices(f), 0),
          reach(num_vertices(f), 0),
          gap(num_vertices(f), 0),
          seen(num_vertices(f), 0),
          printed_by(num_vertices(f), no_stop) {}

    Point at(Vertex v) const { return forest[v].at; }
};

[[noreturn]] void throw_not_a_forest(int layer, Point at, const char* what) {
    throw Error(ErrorKind::bad_geometry, "layer " + std::to_string(layer) + ": the support tree at (" +
                                             std::to_string(to_mm(at.x)) + ", " + std::to_string(to_mm(at.y)) +
                                             ") mm " + what + "; tool paths need trees, each with a root on the shell");
}

void hang_from_root(RootedForest& f, Vertex root, int layer) {
    std::vector<Vertex> order{root};
    f.seen[root] = 1;
    for (std::size_t next = 0; next < order.size(); ++next) {
        const Vertex v = order[next];
        bool parent_met = false;
        for (auto [e, end] = out_edges(v, f.forest); e != end; ++e) {
            const Vertex w = target(*e, f.forest);
            if (w == f.parent[v] && !parent_met) {
                parent_met = true;
                continue;
            }
            if (f.seen[w]) throw_not_a_forest(layer, f.at(w), "has a cycle");
            f.seen[w] = 1;
            f.parent[w] = v;
            f.edge_length[w] = length(f.at(w) - f.at(v));
            f.first_layer[w] = f.forest[*e].first_layer;
            f.to_junction[w] = f.forest[*e].to_junction;
            order.push_back(w);
        }
    }
    for (std::size_t i = order.size(); i-- > 1;) {
        const Vertex v = order[i], p = f.parent[v];
        f.reach[p] = std::max(f.reach[p], f.edge_length[v] + f.reach[v]);
    }
}

/// The subtrees of v, the one in which a path goes on first.
void children_by_rank(const RootedForest& f, Vertex v, std::vector<Vertex>& children) {
    children.clear();
    for (auto [w, end] = adjacent_vertices(v, f.forest); w != end; ++w)
        if (*w != f.parent[v]) children.push_back(*w);
    if (children.size() < 2) return;
    const auto straightness = [&](Vertex c) {
        if (f.parent[v] == no_vertex || f.edge_length[c] == 0) return 0.0;
        const Point in = f.at(v) - f.at(f.parent[v]), out = f.at(c) - f.at(v);
        return static_cast<double>(in.x * out.x + in.y * out.y) / f.edge_length[c];
    };
    std::sort(children.begin(), children.end(), [&](Vertex a, Vertex b) {
        const double reach_a = f.edge_length[a] + f.reach[a], reach_b = f.edge_length[b] + f.reach[b];
        if (reach_a != reach_b) return reach_a > reach_b;
        const double straight_a = straightness(a), straight_b = straightness(b);
        if (straight_a != straight_b) return straight_a > straight_b;
        return a < b;
    });
}

/// The end of the branch that goes from v into w; no_vertex when it has several.
Vertex tip_of(const RootedForest& f, Vertex v, Vertex w) {
    while (out_degree(w, f.forest) == 2) {
        auto next = adjacent_vertices(w, f.forest).first;
        if (*next == v) ++next;
        v = w, w = *next;
    }
    return out_degree(w, f.forest) == 1 ? w : no_vertex;
}

/// May the path that leaves the branch from v into w aside take it along?
bool may_be_taken_along(const RootedForest& f, Vertex v, Vertex w) {
    return f.farthest_bend > 0 && (f.first_layer[w] || f.to_junction[w]) && !f.forest[v].outside && !f.forest[v].wide &&
           2 * (f.edge_length[w] + f.reach[w]) <= 3 * static_cast<double>(f.width);
}

/// What leaves a path for `subtrees` at its vertex v, `along` from its beginning.
SideBranches side_branches(const RootedForest& f, Vertex v, double along, std::span<const Vertex> subtrees) {
    SideBranches beside{along, {}, 0};
    for (const Vertex w : subtrees) {
        const Vertex tip = may_be_taken_along(f, v, w) ? tip_of(f, v, w) : no_vertex;
        if (tip == no_vertex) return {along, {}, 0};
        beside.tips.push_back(f.at(tip));
        beside.longest = std::max(beside.longest, f.edge_length[w] + f.reach[w]);
    }
    return beside;
}

/// Sets for every vertex after the first how much a branch leaving it must leave out.
void set_gaps_along(RootedForest& f, const std::vector<Vertex>& vertices, double gap, bool printed) {
    const double width = static_cast<double>(f.width);
    const double to_start = width - f.gap[vertices.front()];
    double along = 0;
    for (std::size_t i = 1; i < vertices.size(); ++i) {
        along += f.edge_length[vertices[i]];
        const double to_parent = to_start + along, to_path = gap - along;
        if (printed && to_path <= 0)
            f.gap[vertices[i]] = width;
        else
            f.gap[vertices[i]] = std::max(0.0, width - (printed ? std::min(to_parent, to_path) : to_parent));
    }
    if (printed && gap <= 0) f.gap[vertices.front()] = width;
}

/// The bends of a path; the branches that it takes along are no longer among those that it leaves aside at its
/// vertices.
std::vector<Bend> take_along(const RootedForest& f, const std::vector<Vertex>& vertices, const PathCorners& corners,
                             double gap, std::vector<std::vector<Vertex>>& aside) {
    std::vector<SideBranches> beside;
    std::vector<std::size_t> at;
    for (std::size_t k = 1; k < vertices.size(); ++k) {
        if (aside[k].empty()) continue;
        beside.push_back(side_branches(f, vertices[k], corners.along[k], aside[k]));
        at.push_back(k);
    }
    std::vector<Bend> bends =
        bends_of(corners, gap, beside, nearest_bend * static_cast<double>(f.width), f.farthest_bend);
    for (const Bend& bend : bends) aside[at[bend.branches]].clear();
    return bends;
}

TrackKind kind_of(const SupportVertex& root) { return root.outside ? TrackKind::external_support : TrackKind::support; }

/// A way down a tree, with what it leaves aside.
struct Way {
    std::vector<Vertex> vertices;
    PathCorners corners;
    std::vector<std::vector<Vertex>> aside;  ///< by vertex the subtrees into which it does not go on
};

/// From v into w and on along the longest reach to a tip.
Way longest_way(const RootedForest& f, Vertex v, Vertex w) {
    Way way{{v, w}, {{f.at(v), f.at(w)}, {0, f.edge_length[w]}}, {{}, {}}};
    std::vector<Vertex> children;
    for (children_by_rank(f, w, children); !children.empty(); children_by_rank(f, way.vertices.back(), children)) {
        const Vertex next = children.front();
        way.aside.back().assign(children.begin() + 1, children.end());
        way.vertices.push_back(next);
        way.corners.at.push_back(f.at(next));
        way.corners.along.push_back(way.corners.along.back() + f.edge_length[next]);
        way.aside.emplace_back();
    }
    return way;
}

bool lies_on_walls(const RootedForest& f, const Way& way) {
    return std::none_of(way.vertices.begin() + 1, way.vertices.end(), [&](Vertex v) { return f.first_layer[v]; });
}

/// From the tip of one way to that of another one from the same vertex.
Way through(const Way& from, const Way& to) {
    Way whole{{from.vertices.rbegin(), from.vertices.rend()},
              {{from.corners.at.rbegin(), from.corners.at.rend()}, {}},
              {from.aside.rbegin(), from.aside.rend()}};
    const double first = from.corners.along.back();
    for (auto along = from.corners.along.rbegin(); along != from.corners.along.rend(); ++along)
        whole.corners.along.push_back(first - *along);
    for (std::size_t k = 1; k < to.vertices.size(); ++k) {
        whole.vertices.push_back(to.vertices[k]);
        whole.corners.at.push_back(to.corners.at[k]);
        whole.corners.along.push_back(first + to.corners.along[k]);
        whole.aside.push_back(to.aside[k]);
    }
    return whole;
}

class TreePaths {
public:
    TreePaths(RootedForest& f, Vertex root, LayerPlan& plan) : f_(f), root_(root), plan_(plan) {}

    void append(bool through_root) {
        std::vector<Vertex> children;
        children_by_rank(f_, root_, children);
        if (!through_root || children.size() < 2 || !run_through(children)) leave(root_, children);
        while (!left_.empty()) {
            const Branch branch = left_.back();
            left_.pop_back();
            print(branch);
        }
    }

private:
    /// To be printed before what was left earlier.
    void leave(Vertex junction, const std::vector<Vertex>& subtrees) {
        for (std::size_t i = subtrees.size(); i-- > 0;) left_.push_back({junction, subtrees[i]});
    }
    void leave_aside(const Way& way) {
        for (std::size_t k = 0; k < way.vertices.size(); ++k) leave(way.vertices[k], way.aside[k]);
    }

    /// The root's two longest ways as one path, if it can begin at a tip.
    bool run_through(const std::vector<Vertex>& children) {
        const Way ways[] = {longest_way(f_, root_, children[0]), longest_way(f_, root_, children[1])};
        const bool begins[] = {lies_on_walls(f_, ways[0]), lies_on_walls(f_, ways[1])};
        if (!begins[0] && !begins[1]) return false;
        const Way &from = ways[begins[1]], &to = ways[!begins[1]];
        Way whole = through(from, to);
        whole.aside[from.vertices.size() - 1].assign(children.begin() + 2, children.end());
        const std::vector<Point> points = points_along(whole, 0);
        for (const Way& way : ways) set_gaps_along(f_, way.vertices, 0, true);
        for (const Vertex v : whole.vertices) f_.printed_by[v] = plan_.tracks.size();
        add(points, begins[0] && begins[1] ? Entry::either_end : Entry::fixed, no_stop, false);
        leave_aside(whole);
        return true;
    }

    void print(const Branch& branch) {
        Way way = longest_way(f_, branch.junction, branch.into);
        const double whole = way.corners.along.back();
        const double gap = f_.first_layer[branch.into] || f_.to_junction[branch.into] ? 0 : f_.gap[branch.junction];
        std::vector<Point> points;
        if (whole > gap) points = points_along(way, gap);
        leave_aside(way);
        const bool printed = points.size() > 1;
        if (gap > 0 && whole > 0) {
            ++plan_.gaps;
            plan_.gap_length += round_to_lattice(printed ? gap : whole);
        }
        const bool on_track = gap <= 0 && f_.gap[branch.junction] == static_cast<double>(f_.width);
        set_gaps_along(f_, way.vertices, gap, printed);
        const std::size_t above = f_.printed_by[branch.junction], own = printed ? plan_.tracks.size() : above;
        for (std::size_t i = 1; i < way.vertices.size(); ++i) f_.printed_by[way.vertices[i]] = own;
        if (!printed) return;
        if (above == no_stop) f_.printed_by[branch.junction] = own;
        add(points, lies_on_walls(f_, way) ? Entry::either_end : Entry::fixed, above, on_track);
    }

    /// With the bends for short branches, which are no longer among those left aside.
    std::vector<Point> points_along(Way& way, double gap) {
        const std::vector<Bend> bends = take_along(f_, way.vertices, way.corners, gap, way.aside);
        plan_.bends += static_cast<int>(bends.size());
        return bent_path(way.corners, gap, bends);
    }
    void add(std::vector<Point> points, Entry entry, std::size_t after, bool on_track) {
        plan_.tracks.push_back(
            {{{kind_of(f_.forest[root_]), f_.width, false, std::move(points), on_track}}, entry, after});
    }

    RootedForest& f_;
    Vertex root_;
    LayerPlan& plan_;
    std::vector<Branch> left_;
};

}  // namespace

void append_support_paths(const SupportForest& forest, const Settings& settings, LayerPlan& plan) {
    RootedForest f(forest, settings);
    for (Vertex v = 0; v < num_vertices(forest); ++v) {
        if (f.seen[v] || !forest[v].root) continue;
        hang_from_root(f, v, plan.layer);
        if (!prints_centre_line(forest[v], settings)) continue;
        if (out_degree(v, forest) == 0)
            plan.tracks.push_back(
                {{{kind_of(forest[v]), settings.support_width, false, {f.at(v)}}}, Entry::fixed, no_stop});
        else
            TreePaths(f, v, plan).append(settings.gaps != Gaps::paper);
    }
    for (Vertex v = 0; v < num_vertices(forest); ++v)
        if (!f.seen[v]) throw_not_a_forest(plan.layer, f.at(v), "has no root");
}

}  // namespace ribvault
