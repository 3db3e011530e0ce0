#include "ribvault/vault/brace_trees.hpp"

#include <algorithm>
#include <optional>

#include "ribvault/vault/segment_grid.hpp"
#include "ribvault/vault/tree_walk.hpp"
#include "ribvault/vault/wall_contacts.hpp"

namespace ribvault {
namespace {

class Bracer {
public:
    Bracer(SupportForest& forest, const CavityBoundary& boundary, Unit longest)
        : forest_(forest),
          boundary_(boundary),
          longest_(static_cast<double>(longest)),
          grid_(boundary.location.box(), units_per_mm, 0) {
        for (auto [e, end] = edges(forest); e != end; ++e) enter(source(*e, forest), target(*e, forest));
    }

    int run() {
        int braces = 0;
        const std::size_t before = num_vertices(forest_);
        for (std::size_t v = 0; v < before; ++v) {
            if (!forest_[v].root || out_degree(v, forest_) == 0) continue;
            const TreeWalk tree = walk_from(v, forest_);
            const bool alone =
                std::none_of(tree.order.begin() + 1, tree.order.end(), [&](std::size_t w) { return forest_[w].root; });
            if (alone && tree.distance[tree.farthest()] > longest_) braces += brace(tree);
        }
        return braces;
    }

private:
    struct Brace {
        std::size_t from;
        Point foot;
    };
    struct Wall {
        std::size_t a, b;
    };

    void enter(std::size_t a, std::size_t b) {
        walls_.push_back({a, b});
        grid_.insert(static_cast<std::uint32_t>(walls_.size() - 1), {forest_[a].at, forest_[b].at});
    }

    bool brace(const TreeWalk& tree) {
        const std::size_t tip = tree.farthest();
        const double reach = tree.distance[tip];
        std::optional<Brace> best;
        double least = reach;
        for (std::size_t k = tip; k != 0 && reach - tree.distance[k] < least; k = tree.parent[k]) {
            const double left = reach - tree.distance[k];
            if (const auto found = shortest(tree.order[k], least - left, forest_[tree.order[0]].at))
                best = found, least = left + length(found->foot - forest_[tree.order[k]].at);
        }
        if (!best) return false;
        const std::size_t root = add_vertex(SupportVertex{.at = best->foot, .root = true}, forest_);
        add_edge(best->from, root, forest_);
        enter(best->from, root);
        return true;
    }

    /// The shortest free way from v to the shell below `limit`, away from the root at `first`.
    std::optional<Brace> shortest(std::size_t v, double limit, Point first) const {
        const Point at = forest_[v].at;
        const Unit by = static_cast<Unit>(limit) + 1;
        std::vector<std::pair<double, Point>> feet;
        boundary_.edges.visit({{at.x - by, at.y - by}, {at.x + by, at.y + by}}, [&](std::uint32_t k) {
            const Point foot = nearest_point(at, boundary_.edges.segments()[k]);
            if (const double l = length(foot - at); l < limit && length(foot - first) >= longest_ / 2)
                feet.push_back({l, foot});
        });
        std::sort(feet.begin(), feet.end());
        for (const auto& [l, foot] : feet)
            if (const Point root = place_root(foot, boundary_); root != at && is_free(v, {at, root}))
                return Brace{v, root};
        return std::nullopt;
    }

    bool is_free(std::size_t v, const Segment& way) const {
        if (meets_shell(way, forest_[v].root, true, boundary_)) return false;
        bool barred = false;
        grid_.visit(bounding_box(way), [&](std::uint32_t w) {
            if (barred) return;
            const Segment wall{forest_[walls_[w].a].at, forest_[walls_[w].b].at};
            barred = walls_[w].a == v || walls_[w].b == v ? collide(way, wall) : segments_touch(way, wall);
        });
        return !barred;
    }

    SupportForest& forest_;
    const CavityBoundary& boundary_;
    double longest_;
    SegmentGrid grid_;
    std::vector<Wall> walls_;
};

}  // namespace

int brace_trees(SupportForest& forest, const CavityBoundary& boundary, Unit longest) {
    if (longest <= 0 || !boundary.has_shell()) return 0;
    return Bracer(forest, boundary, longest).run();
}

}  // namespace ribvault
