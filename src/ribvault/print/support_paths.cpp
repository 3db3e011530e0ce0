#include "ribvault/print/support_paths.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "ribvault/error.hpp"
#include "ribvault/print/wide_walls.hpp"

namespace ribvault {
namespace {

using Vertex = std::size_t;
constexpr Vertex no_vertex = std::numeric_limits<Vertex>::max();

/// A branch to print: it leaves a junction (or the root) into one of its subtrees.
struct Branch {
    Vertex junction;
    Vertex into;
};

/// What is known of a forest's vertices once their tree hangs from its root.
struct RootedForest {
    const SupportForest& forest;
    const Unit width;
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

    RootedForest(const SupportForest& f, Unit w)
        : forest(f),
          width(w),
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

/// The path over `vertices` without the part before arc length `gap`. Fewer than two points: nothing is left.
std::vector<Point> points_after_gap(const RootedForest& f, const std::vector<Vertex>& vertices, double gap) {
    std::vector<Point> points;
    const auto add = [&](Point p) {
        if (points.empty() || points.back() != p) points.push_back(p);
    };
    if (gap <= 0) add(f.at(vertices.front()));
    double before = 0;
    for (std::size_t i = 1; i < vertices.size(); ++i) {
        const double after = before + f.edge_length[vertices[i]];
        if (after >= gap) {
            if (before < gap) {
                add(part_way(f.at(vertices[i - 1]), f.at(vertices[i]), (gap - before) / (after - before)));
            }
            add(f.at(vertices[i]));
        }
        before = after;
    }
    return points;
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

TrackKind kind_of(const SupportVertex& root) { return root.outside ? TrackKind::external_support : TrackKind::support; }

void append_tree(RootedForest& f, Vertex root, LayerPlan& plan) {
    std::vector<Branch> left;
    std::vector<Vertex> children, vertices;
    children_by_rank(f, root, children);
    for (std::size_t i = children.size(); i-- > 0;) left.push_back({root, children[i]});
    while (!left.empty()) {
        const Branch branch = left.back();
        left.pop_back();
        vertices.assign({branch.junction, branch.into});
        for (children_by_rank(f, branch.into, children); !children.empty();
             children_by_rank(f, vertices.back(), children)) {
            for (std::size_t i = children.size(); i-- > 1;) left.push_back({vertices.back(), children[i]});
            vertices.push_back(children.front());
        }
        const double whole = f.edge_length[branch.into] + f.reach[branch.into];
        const bool first_layer = f.first_layer[branch.into];
        const double gap = first_layer || f.to_junction[branch.into] ? 0 : f.gap[branch.junction];
        std::vector<Point> points;
        if (whole > gap) points = points_after_gap(f, vertices, gap);
        const bool printed = points.size() > 1;
        if (gap > 0 && whole > 0) {
            ++plan.gaps;
            plan.gap_length += round_to_lattice(printed ? gap : whole);
        }
        set_gaps_along(f, vertices, gap, printed);
        const std::size_t above = f.printed_by[branch.junction], own = printed ? plan.tracks.size() : above;
        for (std::size_t i = 1; i < vertices.size(); ++i) f.printed_by[vertices[i]] = own;
        if (!printed) continue;
        if (above == no_stop) f.printed_by[branch.junction] = own;
        const bool lies_on_walls =
            std::none_of(vertices.begin() + 1, vertices.end(), [&](Vertex v) { return f.first_layer[v]; });
        const Entry entry = lies_on_walls ? Entry::either_end : Entry::fixed;
        plan.tracks.push_back({{{kind_of(f.forest[root]), f.width, false, std::move(points)}}, entry, above});
    }
}

}  // namespace

void append_support_paths(const SupportForest& forest, const Settings& settings, LayerPlan& plan) {
    RootedForest f(forest, settings.nozzle);
    for (Vertex v = 0; v < num_vertices(forest); ++v) {
        if (f.seen[v] || !forest[v].root) continue;
        hang_from_root(f, v, plan.layer);
        if (!prints_centre_line(forest[v], settings)) continue;
        if (out_degree(v, forest) == 0)
            plan.tracks.push_back({{{kind_of(forest[v]), settings.nozzle, false, {f.at(v)}}}, Entry::fixed, no_stop});
        else
            append_tree(f, v, plan);
    }
    for (Vertex v = 0; v < num_vertices(forest); ++v)
        if (!f.seen[v]) throw_not_a_forest(plan.layer, f.at(v), "has no root");
}

}  // namespace ribvault
