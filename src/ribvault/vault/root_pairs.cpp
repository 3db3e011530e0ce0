#include "ribvault/vault/root_pairs.hpp"

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <tuple>

namespace ribvault {
namespace {

/// Where a root lies on the boundary.
struct Place {
    std::size_t contour;
    double along;  ///< from the contour's beginning
    std::size_t root;
};

struct Neighbours {
    double gap;
    std::size_t a, b;  ///< roots
};

bool lead_the_same_way(const TreeRoot& a, const TreeRoot& b) {
    return a.at == b.at || 2 * dot(a.away, b.away) >= norm(a.away) * norm(b.away);
}

/// The places of all roots, contour by contour and in the order along it; `around`: the contours' lengths.
std::vector<Place> places_along(const std::vector<TreeRoot>& roots, const NearestSegment& boundary,
                                std::vector<double>& around) {
    const std::vector<Segment>& edges = boundary.segments();
    std::vector<std::size_t> contour(edges.size());
    std::vector<double> begin(edges.size());
    for (std::size_t k = 0; k < edges.size(); ++k) {
        if (k == 0 || edges[k].a != edges[k - 1].b) around.push_back(0);
        contour[k] = around.size() - 1, begin[k] = around.back();
        around.back() += length(edges[k]);
    }
    std::vector<Place> places;
    for (std::size_t r = 0; r < roots.size(); ++r) {
        const std::uint32_t k = boundary.nearest(roots[r].at).index;
        places.push_back({contour[k], begin[k] + length(nearest_point(roots[r].at, edges[k]) - edges[k].a), r});
    }
    std::sort(places.begin(), places.end(), [](const Place& a, const Place& b) {
        return std::tie(a.contour, a.along, a.root) < std::tie(b.contour, b.along, b.root);
    });
    return places;
}

}  // namespace

std::vector<std::size_t> pair_roots(const std::vector<TreeRoot>& roots, const CavityBoundary& boundary, Unit farthest) {
    std::vector<std::size_t> partner(roots.size(), no_root);
    if (roots.size() < 2) return partner;
    std::vector<double> around;
    const std::vector<Place> places = places_along(roots, boundary.edges, around);
    std::vector<Neighbours> pairs;
    for (std::size_t first = 0; first < places.size();) {
        std::size_t end = first;
        while (end < places.size() && places[end].contour == places[first].contour) ++end;
        for (std::size_t k = first; k < end; ++k) {
            const bool last = k + 1 == end;
            const Place &a = places[k], &b = places[last ? first : k + 1];
            const TreeRoot &one = roots[a.root], &other = roots[b.root];
            const double gap = b.along - a.along + (last ? around[a.contour] : 0);
            if (lead_the_same_way(one, other) && gap <= static_cast<double>(farthest) &&
                gap <= 2 * std::min(one.trunk, other.trunk))
                pairs.push_back({gap, a.root, b.root});
        }
        first = end;
    }
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const Neighbours& p, const Neighbours& q) { return p.gap < q.gap; });
    std::size_t trees = 0;
    for (const TreeRoot& root : roots) trees = std::max(trees, root.tree + 1);
    boost::disjoint_sets_with_storage<> joined(trees);
    for (const Neighbours& p : pairs) {
        const std::size_t a = joined.find_set(roots[p.a].tree), b = joined.find_set(roots[p.b].tree);
        if (partner[p.a] != no_root || partner[p.b] != no_root || a == b) continue;
        joined.link(a, b);
        partner[p.a] = p.b, partner[p.b] = p.a;
    }
    return partner;
}

}  // namespace ribvault
