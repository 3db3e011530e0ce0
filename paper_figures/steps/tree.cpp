#include <boost/graph/connected_components.hpp>
#include <cmath>
#include <limits>

#include "commands.hpp"
#include "ribvault/error.hpp"
#include "ribvault/print/order_paths.hpp"
#include "ribvault/print/support_paths.hpp"
#include "ribvault/vault/straighten_supports.hpp"

namespace ribvault::steps {
namespace {

using Vertex = SupportForest::vertex_descriptor;

SupportForest subforest(const SupportForest& forest, const std::vector<char>& chosen) {
    SupportForest part;
    std::vector<Vertex> place(num_vertices(forest));
    for (Vertex v = 0; v < place.size(); ++v)
        if (chosen[v]) place[v] = add_vertex(forest[v], part);
    for (auto [e, end] = edges(forest); e != end; ++e)
        if (chosen[source(*e, forest)] && chosen[target(*e, forest)])
            add_edge(place[source(*e, forest)], place[target(*e, forest)], forest[*e], part);
    return part;
}

/// The tree with one root whose number of branches (tips) is nearest to `branches`; of those alike the longest.
SupportForest choose_tree(const SupportForest& forest, int branches, int layer) {
    std::vector<int> component(num_vertices(forest));
    const int count = boost::connected_components(forest, component.data());
    struct Tree {
        int tips = 0, roots = 0;
        double length = 0;
    };
    std::vector<Tree> trees(static_cast<std::size_t>(count));
    for (Vertex v = 0; v < component.size(); ++v) {
        Tree& t = trees[static_cast<std::size_t>(component[v])];
        t.roots += forest[v].root;
        t.tips += !forest[v].root && out_degree(v, forest) == 1;
    }
    for (auto [e, end] = edges(forest); e != end; ++e)
        trees[static_cast<std::size_t>(component[source(*e, forest)])].length +=
            length(forest[source(*e, forest)].at - forest[target(*e, forest)].at);
    int best = -1;
    for (int k = 0; k < count; ++k) {
        const Tree& t = trees[static_cast<std::size_t>(k)];
        if (t.roots != 1 || t.tips == 0) continue;
        const auto off = [&](int tree) { return std::abs(trees[static_cast<std::size_t>(tree)].tips - branches); };
        if (best < 0 || off(k) < off(best) ||
            (off(k) == off(best) && t.length > trees[static_cast<std::size_t>(best)].length))
            best = k;
    }
    if (best < 0) throw Error(ErrorKind::usage, "--layer " + std::to_string(layer) + ": has no tree with one root");
    std::vector<char> chosen(component.size());
    for (std::size_t v = 0; v < chosen.size(); ++v) chosen[v] = component[v] == best;
    return subforest(forest, chosen);
}

bool passes(Vertex v, const SupportForest& forest) { return out_degree(v, forest) == 2 && !forest[v].root; }

/// The branch-free chain of any tree that straightening shortens most, from end to end.
std::vector<Point> most_bent_chain(const SupportForest& forest) {
    std::vector<Point> best;
    double most = -1;
    for (Vertex start = 0; start < num_vertices(forest); ++start) {
        if (passes(start, forest)) continue;
        for (auto [first, end] = adjacent_vertices(start, forest); first != end; ++first) {
            std::vector<Point> chain{forest[start].at, forest[*first].at};
            double along = length(chain[1] - chain[0]);
            Vertex before = start, v = *first;
            while (passes(v, forest)) {
                auto [a, stop] = adjacent_vertices(v, forest);
                const Vertex next = *a != before ? *a : *std::next(a);
                before = v, v = next;
                along += length(forest[v].at - chain.back());
                chain.push_back(forest[v].at);
            }
            const double saved = along - length(chain.back() - chain.front());
            if (saved > most) most = saved, best = chain;
        }
    }
    return best;
}

SupportForest chain_forest(const std::vector<Point>& chain) {
    SupportForest forest;
    for (std::size_t k = 0; k < chain.size(); ++k) {
        add_vertex(SupportVertex{chain[k], false}, forest);
        if (k > 0) add_edge(k - 1, k, forest);
    }
    return forest;
}

/// p_i^e of Section 4.1: the points at the same fraction of the chain's length on its chord.
std::vector<Point> targets_of(const std::vector<Point>& chain) {
    std::vector<double> along{0};
    for (std::size_t k = 1; k < chain.size(); ++k) along.push_back(along.back() + length(chain[k] - chain[k - 1]));
    std::vector<Point> targets;
    const Point chord = chain.back() - chain.front();
    for (const double d : along)
        targets.push_back({chain.front().x + round_to_lattice(d / along.back() * static_cast<double>(chord.x)),
                           chain.front().y + round_to_lattice(d / along.back() * static_cast<double>(chord.y))});
    return targets;
}

/// Straightens again and again, without erosion, until nothing moves; every state, the first one included.
Json straightening(SupportForest forest, const CavityBoundary& boundary, Unit step) {
    Json states = Json::array({json_of(forest)});
    for (int round = 0; round < 10000; ++round) {
        forest = straighten_supports(forest, std::vector<char>(num_vertices(forest), 0), boundary, step).forest;
        Json state = json_of(forest);
        if (state == states.back()) break;
        states.push_back(std::move(state));
    }
    return states;
}

Json points_json(const std::vector<Point>& points) {
    Json list = Json::array();
    for (const Point p : points) list.push_back(json_of(p));
    return list;
}

}  // namespace

Json tree(const Options& options, int layer, int branches) {
    const Run run = sweep(options, layer);
    const SweptLayer& here = layer_of(run, layer);
    const CavityBoundary boundary = prepare_boundary(here.material.cavity->region);
    const SupportForest chosen = choose_tree(here.forest, branches, layer);
    const std::vector<Point> chain = most_bent_chain(here.forest);

    LayerPlan plan;
    plan.layer = layer;
    append_support_paths(chosen, run.settings, plan);
    const LayerPaths paths = order_paths(plan, here.material.slice->rounded);

    Json result = result_head("tree", options, run.settings);
    result["layer"] = layer;
    result["cavity"] = json_of(here.material.cavity->region);
    result["supports"] = json_of(here.forest);
    result["tree"] = json_of(chosen);
    result["straightening"] = straightening(chosen, boundary, run.settings.straighten_step);
    result["chain"] = {{"points", points_json(chain)}, {"targets", points_json(targets_of(chain))},
                       {"states", straightening(chain_forest(chain), boundary, run.settings.straighten_step)}};
    result["paths"] = json_of(paths.paths);
    result["gaps"] = paths.gaps;
    return result;
}

}  // namespace ribvault::steps
