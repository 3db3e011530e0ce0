// What must hold for the supports of any layer, stated with exact predicates.
#pragma once

#include <algorithm>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

#include "ribvault/vault/cavity_boundary.hpp"
#include "ribvault/vault/support_forest.hpp"

namespace ribvault::test {

inline std::string text(Point p) { return "(" + std::to_string(p.x) + ", " + std::to_string(p.y) + ")"; }
inline std::string text(const Segment& s) { return text(s.a) + "-" + text(s.b); }

/// Per vertex, the number of its component.
inline std::vector<std::size_t> components_of(const SupportForest& forest) {
    std::vector<std::size_t> component(num_vertices(forest), static_cast<std::size_t>(-1));
    std::size_t count = 0;
    for (std::size_t start = 0; start < component.size(); ++start) {
        if (component[start] != static_cast<std::size_t>(-1)) continue;
        std::vector<std::size_t> open{start};
        component[start] = count;
        while (!open.empty()) {
            const std::size_t v = open.back();
            open.pop_back();
            for (auto [w, end] = adjacent_vertices(v, forest); w != end; ++w)
                if (component[*w] == static_cast<std::size_t>(-1)) component[*w] = count, open.push_back(*w);
        }
        ++count;
    }
    return component;
}
inline std::size_t component_count(const SupportForest& forest) {
    const std::vector<std::size_t> component = components_of(forest);
    return component.empty() ? 0 : *std::max_element(component.begin(), component.end()) + 1;
}

/// Empty when no component has a cycle or is without a root and no wall is without length; else what is wrong.
inline std::string forest_fault(const SupportForest& forest) {
    const std::vector<std::size_t> component = components_of(forest);
    const std::size_t count = component_count(forest);
    if (num_edges(forest) + count != num_vertices(forest)) return "the supports have a cycle";
    std::vector<char> rooted(count, 0);
    for (std::size_t v = 0; v < component.size(); ++v)
        if (forest[v].root) rooted[component[v]] = 1;
    for (std::size_t v = 0; v < component.size(); ++v)
        if (!rooted[component[v]]) return "no root in the component of " + text(forest[v].at);
    for (auto [e, end] = edges(forest); e != end; ++e)
        if (forest[source(*e, forest)].at == forest[target(*e, forest)].at)
            return "a wall without length at " + text(forest[source(*e, forest)].at);
    return {};
}

/// Empty when every root lies on the shell (within root_tolerance of the boundary) and every other vertex inside the
/// cavity, up to the same tolerance; else what is wrong.
inline std::string placement_fault(const SupportForest& forest, const CavityBoundary& boundary) {
    for (auto [v, end] = vertices(forest); v != end; ++v) {
        const Point at = forest[*v].at;
        const Segment& edge = boundary.edges.segments()[boundary.edges.nearest(at).index];
        const bool near = compare_distance(at, edge, root_tolerance) <= 0;
        if (forest[*v].root ? !near : !near && boundary.location.locate(at) == Side::outside)
            return (forest[*v].root ? "root " : "vertex ") + text(at) + " is not where it should be";
    }
    return {};
}

/// Pairs of walls that cross at inner points of both (exactly), first one as text.
struct Crossings {
    int count = 0;
    std::string first;
};
inline Crossings crossings(const SupportForest& forest) {
    Crossings result;
    const NearestSegment walls(centre_lines(forest));
    for (std::uint32_t k = 0; k < walls.segments().size(); ++k) {
        const Segment& s = walls.segments()[k];
        Box box;
        box.add(s.a), box.add(s.b);
        walls.visit(box, [&](std::uint32_t j) {
            if (j <= k || !segments_cross(s, walls.segments()[j])) return;
            if (result.count++ == 0) result.first = text(s) + " x " + text(walls.segments()[j]);
        });
    }
    return result;
}

}  // namespace ribvault::test
