#include "ribvault/vault/shrink_supports.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "ribvault/vault/cut_trees.hpp"
#include "ribvault/vault/free_trees.hpp"
#include "ribvault/vault/lean_trees.hpp"
#include "ribvault/vault/straight_chains.hpp"
#include "ribvault/vault/unite_roots.hpp"
#include "ribvault/vault/wall_contacts.hpp"
#include "ribvault/vault/zip_corners.hpp"

namespace ribvault {
namespace {

constexpr int sweeps = 10;

class Shrinker {
public:
    Shrinker(const SupportForest& forest, const CavityBoundary& boundary, Unit step, Unit pillar_length, Unit braced)
        : supports_(forest, boundary, step, boundary.leaning ? 0 : pillar_length), braced_(braced) {}

    ShrunkSupports run() {
        cut_between_roots(supports_, braced_);
        if (supports_.boundary.leaning) leaning_.emplace(supports_).lead();
        if (braced_ == 0) meetings_.emplace(supports_);
        zip_corners(supports_);
        if (leaning_) leaning_->measure();
        for (int k = 0; k < sweeps; ++k) {
            bool moved = false;
            for (std::size_t v = 0; v < supports_.nodes.size(); ++v)
                if (!supports_.nodes[v].gone && !supports_.nodes[v].walls.empty()) moved = improve(v) || moved;
            if (!moved) break;
        }
        if (braced_ > 0) unite_roots_in_place(supports_);
        drop_straight_vertices(supports_);
        return finish();
    }

private:
    /// Where v wants to be: the place between its neighbours that makes its walls short.
    Vec best_place(std::size_t v) const {
        const MovingSupports::Node& node = supports_.nodes[v];
        const Vec here = vec(node.at);
        if (node.walls.size() == 1) return vec(supports_.nodes[supports_.other(node.walls[0], v)].at);
        if (node.walls.size() == 2) {
            const Vec a = vec(supports_.nodes[supports_.other(node.walls[0], v)].at),
                      b = vec(supports_.nodes[supports_.other(node.walls[1], v)].at), d = b - a;
            const double l2 = dot(d, d);
            // At the same share of the way, so that vertices stay spread along the chain.
            const double la = norm(here - a), lb = norm(here - b);
            const double t = la + lb > 0 ? la / (la + lb) : 0.5;
            return l2 > 0 ? a + t * d : a;
        }
        Vec sum{};  // Weiszfeld's step towards the point with the least sum of distances
        double weights = 0;
        for (const std::uint32_t w : node.walls) {
            const Vec u = vec(supports_.nodes[supports_.other(w, v)].at);
            const double weight = 1 / std::max(norm(u - here), 1.0);
            sum = sum + weight * u, weights += weight;
        }
        return (1 / weights) * sum;
    }

    bool may_change(std::size_t v, double by) { return !leaning_ || leaning_->change(v, by); }

    double length_at(std::size_t v, Point p, std::size_t merged) const {
        double sum = 0;
        for (const std::uint32_t w : supports_.nodes[v].walls)
            if (const std::size_t u = supports_.other(w, v); u != merged) sum += length(supports_.nodes[u].at - p);
        return sum;
    }

    bool improve(std::size_t v) {
        if (supports_.nodes[v].stays || supports_.nodes[v].free) return false;
        if (supports_.nodes[v].root) return slide(v);
        if (merge_into_neighbour(v)) return true;
        const Vec here = vec(supports_.nodes[v].at), to = best_place(v);
        Vec way = to - here;
        const double l = norm(way);
        if (l < 2) return false;
        // A tip stops short of its neighbour, into which it merges when both may.
        double share = supports_.nodes[v].walls.size() == 1 ? std::max(0.0, l - 3) / l : 1;
        share = std::min(share, 2.0 * static_cast<double>(supports_.step) / l);
        // The farthest that all of `from` allow, one unit short for the rounding.
        for (const Point f : supports_.nodes[v].from) {
            const double reach = static_cast<double>(supports_.step) - 1;
            const Vec d = here - vec(f);
            const double a = dot(way, way), b = dot(d, way), c = dot(d, d) - reach * reach;
            const double root = b * b - a * c;
            if (root < 0) return false;
            share = std::min(share, (-b + std::sqrt(root)) / a);
        }
        const double before = length_at(v, supports_.nodes[v].at, MovingSupports::none);
        for (int attempt = 0; attempt < 3 && share > 0; ++attempt, share /= 2) {
            const Point p = rounded(here + share * way);
            if (p == supports_.nodes[v].at) return false;
            if (!supports_.reachable(supports_.nodes[v], p)) continue;
            const double longer = length_at(v, p, MovingSupports::none) - before;
            if (longer >= 0 || supports_.collides(v, p, MovingSupports::none) || !may_change(v, longer)) continue;
            supports_.nodes[v].at = p;
            return true;
        }
        return false;
    }

    /// v's points go to a neighbour when it is within their reach.
    bool merge_into_neighbour(std::size_t v) {
        for (const std::uint32_t w : supports_.nodes[v].walls) {
            const std::size_t u = supports_.other(w, v);
            const Point p = supports_.nodes[u].at;
            if (!supports_.reachable(supports_.nodes[v], p)) continue;
            const double longer = length_at(v, p, u) - length_at(v, supports_.nodes[v].at, MovingSupports::none);
            if (longer > 0 || supports_.collides(v, p, u) || supports_.runs_over(v, u) || !may_change(v, longer))
                continue;
            supports_.merge(v, u, w);
            return true;
        }
        return false;
    }
    /// A root goes along the shell towards the point that makes its walls shortest.
    bool slide(std::size_t v) {
        if (meetings_ && meetings_->has(v)) return meetings_->approach(v);
        if (supports_.nodes[v].walls.size() != 1) return false;
        const Point neighbour = supports_.nodes[supports_.other(supports_.nodes[v].walls[0], v)].at;
        const Segment& nearest = supports_.boundary.edges.segments()[supports_.boundary.edges.nearest(neighbour).index];
        const Vec wish = vec(nearest_point(neighbour, nearest));
        return supports_.go_along_shell(v, wish, neighbour, norm(wish - vec(supports_.nodes[v].at)));
    }

    ShrunkSupports finish() {
        ShrunkSupports result;
        std::vector<std::int64_t> vertex(supports_.nodes.size(), -1);
        const auto keep = [&](std::size_t v) {
            if (vertex[v] < 0) {
                vertex[v] = static_cast<std::int64_t>(add_vertex(supports_.nodes[v].was, result.forest));
                SupportVertex& kept = result.forest[static_cast<std::size_t>(vertex[v])];
                kept.at = supports_.nodes[v].at, kept.root = supports_.nodes[v].root,
                kept.free = supports_.nodes[v].free;
            }
            return static_cast<std::size_t>(vertex[v]);
        };
        for (const MovingSupports::Wall& w : supports_.walls)
            if (w.alive) {
                const std::size_t a = keep(w.a), b = keep(w.b);
                add_edge(a, b, result.forest);
                result.left_cavity = result.left_cavity || meets_shell(supports_.segment(w), supports_.nodes[w.a].root,
                                                                       supports_.nodes[w.b].root, supports_.boundary);
            }
        for (std::size_t v = 0; v < supports_.nodes.size(); ++v)
            if (!supports_.nodes[v].gone && supports_.nodes[v].root && supports_.nodes[v].walls.empty()) keep(v);
        result.survives.resize(supports_.input_walls);
        const auto is_left = [&](std::size_t w) { return supports_.walls[supports_.now(w)].alive; };
        for (std::size_t w = 0; w < supports_.walls.size(); ++w)
            if (const std::size_t origin = supports_.walls[w].origin; origin != MovingSupports::none && is_left(w))
                result.survives[origin] = 1;
        for (const auto& [w, stem] : supports_.stems)
            if (is_left(stem)) result.survives[w] = 1;
        if (leaning_) root_trees(result.forest);
        return result;
    }

    MovingSupports supports_;
    Unit braced_;  ///< 0: trees are not
    std::optional<RootMeetings> meetings_;
    std::optional<LeaningTrees> leaning_;
};

}  // namespace

ShrunkSupports shrink_supports(const SupportForest& forest, const CavityBoundary& boundary, Unit step,
                               Unit pillar_length, Unit braced) {
    return Shrinker(forest, boundary, step, pillar_length, braced).run();
}

}  // namespace ribvault
