#include "ribvault/vault/lean_trees.hpp"

#include <algorithm>
#include <cmath>

#include "ribvault/vault/free_trees.hpp"

namespace ribvault {
namespace {

/// How much farther than what is nearest now a tree is taken to go: the shell of the layers below may recede. Between 1
/// and 2 there is less track on some models and more on others; with more, fewer trees stand free.
constexpr double farther = 1.5;

}  // namespace

void lean_where_cheaper(SupportForest& forest, const CavityBoundary& boundary, Unit step) {
    free_where_cheaper(forest, boundary.layers_below, step, [&](std::size_t middle) {
        const double way = farther * std::sqrt(boundary.edges.nearest(forest[middle].at).distance.value());
        const double layers = std::min(way / static_cast<double>(step), static_cast<double>(boundary.layers_below));
        // On its way there, and running back once it is rooted.
        const double foot = boundary.leaning->track(forest[middle].standing + layers);
        const double back = std::min(foot / (2 * static_cast<double>(step)), boundary.layers_below - layers);
        return layers * boundary.leaning->track(forest[middle].standing + layers / 2) + back * foot;
    });
}

LeaningTrees::LeaningTrees(MovingSupports& supports)
    : supports_(supports), leaning_(*supports.boundary.leaning), tree_(supports.trees()) {}

std::vector<LeaningTrees::Tree> LeaningTrees::trees() const {
    std::vector<Tree> trees(tree_.size());
    for (std::size_t v = 0; v < tree_.size(); ++v) {
        const MovingSupports::Node& node = supports_.nodes[v];
        if (node.gone) continue;
        Tree& tree = trees[tree_[v]];
        tree.nodes.push_back(v);
        tree.standing = std::max(tree.standing, static_cast<int>(node.was.standing));
        if (node.root) (node.free ? tree.free : tree.rooted) = true;
    }
    for (const MovingSupports::Wall& w : supports_.walls)
        if (w.alive) trees[tree_[w.a]].track += length(supports_.segment(w));
    return trees;
}

void LeaningTrees::lead() {
    std::vector<Tree> all = trees();
    was_free_.assign(tree_.size(), 0);
    for (const Tree& tree : all)
        for (const std::size_t v : tree.nodes) {
            MovingSupports::Node& node = supports_.nodes[v];
            was_free_[v] = tree.free;
            // A dot keeps its root: nothing else tells of it.
            if (node.free && !node.walls.empty()) node.root = node.free = false;
        }
    for (const Tree& tree : all) {
        if (!tree.free || tree.joined ||
            tree.track > leaning_.track(tree.standing) + static_cast<double>(supports_.step))
            continue;
        const Target target = nearest_target(tree);
        if (target.distance > static_cast<double>(supports_.step) - 4) {
            approach(target);
        } else if (target.wall == none) {
            root_on_shell(target);
        } else {
            const std::size_t other = tree_[supports_.walls[target.wall].a];
            if (join_wall(target)) all[other].joined = true;
        }
    }
}

LeaningTrees::Target LeaningTrees::nearest_target(const Tree& tree) const {
    Target target{HUGE_VAL, none, {}, none};
    const NearestSegment& shell = supports_.boundary.edges;
    for (const std::size_t v : tree.nodes) {
        const Point p = supports_.nodes[v].at;
        const NearestSegment::Hit hit = shell.nearest(p);
        if (const double d = std::sqrt(hit.distance.value()); d < target.distance)
            target = {d, v, nearest_point(p, shell.segments()[hit.index]), none};
    }
    for (const std::size_t v : tree.nodes) {
        const Point p = supports_.nodes[v].at;
        // Searched in growing squares.
        for (double reach = units_per_mm;; reach *= 2) {
            const Unit by = static_cast<Unit>(std::min(reach, target.distance)) + 1;
            supports_.visit_walls({{p.x - by, p.y - by}, {p.x + by, p.y + by}}, [&](std::uint32_t w) {
                const MovingSupports::Wall& wall = supports_.walls[w];
                if (!wall.alive || tree_[wall.a] == tree_[v]) return;
                const Point foot = nearest_point(p, supports_.segment(wall));
                if (const double d = length(foot - p); d < target.distance) target = {d, v, foot, w};
            });
            if (reach >= target.distance) break;
        }
    }
    return target;
}

void LeaningTrees::approach(const Target& target) {
    MovingSupports::Node& head = supports_.nodes[target.head];
    const auto step = static_cast<double>(supports_.step);
    const Vec here = vec(head.at), way = vec(target.at) - here;
    for (double by = std::min(step - 2, target.distance - 4); by > step / 8; by /= 2) {
        const Point p = rounded(here + (by / norm(way)) * way);
        if (!supports_.reachable(head, p) || supports_.collides(target.head, p, none)) continue;
        head.at = p, head.stays = true;
        return;
    }
}

void LeaningTrees::root_on_shell(const Target& target) {
    MovingSupports::Node& head = supports_.nodes[target.head];
    const Point p = supports_.on_shell(vec(target.at));
    if (!supports_.reachable(head, p) || supports_.collides(target.head, p, none)) return;
    head.at = p, head.root = true, head.free = false;
}

bool LeaningTrees::join_wall(const Target& target) {
    const std::size_t joint = supports_.split(target.wall, target.at);
    if (joint == tree_.size()) {
        const std::size_t beside = supports_.walls[target.wall].a;
        tree_.push_back(tree_[beside]), was_free_.push_back(was_free_[beside]);
    }
    if (supports_.collides(target.head, target.at, none) || supports_.runs_over(target.head, joint)) return false;
    supports_.merge(target.head, joint, {});
    return true;
}

void LeaningTrees::measure() {
    was_free_.resize(supports_.nodes.size(), 0);  // what zipping corners added has others beside it
    tree_ = supports_.trees();
    const std::vector<Tree> all = trees();
    track_.clear(), least_.clear();
    std::vector<char> free(all.size(), 0);
    for (std::size_t v = 0; v < tree_.size(); ++v)
        if (was_free_[v]) free[tree_[v]] = 1;
    for (std::size_t t = 0; t < all.size(); ++t) {
        track_.push_back(all[t].track);
        least_.push_back(free[t] && !all[t].rooted ? leaning_.track(all[t].standing) : -HUGE_VAL);
    }
}

bool LeaningTrees::change(std::size_t v, double by) {
    double& track = track_[tree_[v]];
    if (by < 0 && track + by < least_[tree_[v]]) return false;
    track += by;
    return true;
}

}  // namespace ribvault
