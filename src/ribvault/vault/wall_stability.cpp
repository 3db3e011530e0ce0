#include "ribvault/vault/wall_stability.hpp"

#include <algorithm>
#include <boost/graph/connected_components.hpp>
#include <cmath>
#include <limits>
#include <optional>
#include <queue>
#include <vector>

#include "ribvault/exact/nearest_segment.hpp"
#include "ribvault/vault/tree_walk.hpp"

namespace ribvault {
namespace {

double standing_height(const SupportVertex& v, const Settings& settings) {
    return static_cast<double>(v.standing + 1) * static_cast<double>(settings.layer_height);
}

/// One wall between two vertices: what stands on it changes evenly along it, the way to a root rises to a peak and
/// falls.
class WallProfile {
public:
    WallProfile(const SupportVertex& a, const SupportVertex& b, double root_a, double root_b, const Settings& settings)
        : a_(a.at),
          b_(b.at),
          l_(length(b.at - a.at)),
          root_a_(root_a),
          root_b_(root_b),
          height_a_(standing_height(a, settings)),
          height_b_(standing_height(b, settings)),
          width_(static_cast<double>(wall_width(a, settings))) {}

    SlenderPlace worst() const {
        const double peak = std::clamp((root_b_ + l_ - root_a_) / 2, 0.0, l_),
                     slope = l_ > 0 ? (height_b_ - height_a_) / l_ : 0;
        SlenderPlace worst;
        const auto look = [&](double t) {
            if (!(t >= 0 && t <= l_)) return;
            const SlenderPlace place = at(t);
            if (place.ratio > worst.ratio) worst = place;
        };
        for (const double t : {0.0, peak, l_}) look(t);
        look((height_a_ - root_a_) / (1 - slope));         // height_a + slope t = root_a + t
        look((root_b_ + l_ - height_a_) / (slope + 1));    // height_a + slope t = root_b + l - t
        return worst;
    }

private:
    SlenderPlace at(double t) const {
        const double share = l_ > 0 ? t / l_ : 0;
        SlenderPlace place;
        place.standing = height_a_ + share * (height_b_ - height_a_);
        place.to_root = std::min(root_a_ + t, root_b_ + l_ - t);
        place.ratio = std::min(place.standing, place.to_root) / width_;
        place.at = part_way(a_, b_, share);
        return place;
    }

    Point a_, b_;
    double l_, root_a_, root_b_, height_a_, height_b_, width_;
};

/// How wide points lie across the direction in which they are narrowest.
double narrowest_extent(std::vector<Point> points) {
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3) return 0;
    std::vector<Point> hull;
    for (int side = 0; side < 2; ++side) {
        const std::size_t first = hull.size();
        for (const Point p : points) {
            while (hull.size() >= first + 2 && orientation(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
            hull.push_back(p);
        }
        hull.pop_back();
        std::reverse(points.begin(), points.end());
    }
    // One side of the narrowest strip lies along an edge of the hull.
    double narrowest = HUGE_VAL;
    for (std::size_t k = 0; k < hull.size(); ++k) {
        const Point a = hull[k], b = hull[(k + 1) % hull.size()];
        std::int64_t farthest = 0;
        for (const Point p : hull) farthest = std::max(farthest, cross(a, b, p));
        narrowest = std::min(narrowest, static_cast<double>(farthest) / length(b - a));
    }
    return narrowest;
}

/// A tree that stands free, as a column.
SlenderPlace whole_tree(std::size_t root, const SupportForest& forest, const Settings& settings) {
    std::vector<Point> points;
    SlenderPlace place;
    place.at = forest[root].at;
    for (const std::size_t v : walk_from(root, forest).order) {
        points.push_back(forest[v].at);
        place.standing = std::max(place.standing, standing_height(forest[v], settings));
    }
    const auto track = static_cast<double>(wall_width(forest[root], settings));
    place.ratio = place.standing / (narrowest_extent(std::move(points)) + track);
    return place;
}

/// For every vertex the way along its tree to the nearest root, in lattice units; infinite in a tree without roots.
std::vector<double> distances_to_roots(const SupportForest& forest) {
    std::vector<double> distance(num_vertices(forest), std::numeric_limits<double>::infinity());
    using Entry = std::pair<double, std::size_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
    for (std::size_t v = 0; v < distance.size(); ++v)
        if (forest[v].root) queue.push({distance[v] = 0, v});
    while (!queue.empty()) {
        const auto [d, v] = queue.top();
        queue.pop();
        if (d > distance[v]) continue;
        for (auto [w, end] = adjacent_vertices(v, forest); w != end; ++w)
            if (const double way = d + length(forest[*w].at - forest[v].at); way < distance[*w])
                queue.push({distance[*w] = way, *w});
    }
    return distance;
}

/// Where the tips of wide trees are drawn back to (tapered_trees).
class Taper {
public:
    Taper(const SupportForest& forest, const Settings& settings)
        : forest_(forest), back_(num_vertices(forest), 0), towards_root_(num_vertices(forest)) {
        const double by = 0.5 * static_cast<double>((settings.wall_lines - 1) * settings.support_width);
        std::vector<double> longest(num_vertices(forest), 0);
        std::vector<char> done(num_vertices(forest), 0);
        std::vector<std::size_t> walls(num_vertices(forest)), tips;
        for (std::size_t v = 0; v < walls.size(); ++v) {
            walls[v] = out_degree(v, forest);
            if (walls[v] == 1 && !forest[v].root) tips.push_back(v);
        }
        while (!tips.empty()) {
            const std::size_t v = tips.back();
            tips.pop_back();
            done[v] = 1;
            back_[v] = std::max(0.0, by - longest[v]);
            for (auto [next, end] = adjacent_vertices(v, forest); next != end; ++next) {
                const std::size_t w = *next;
                if (done[w]) continue;
                towards_root_[v] = w;
                longest[w] = std::max(longest[w], longest[v] + length_to_root(v));
                if (--walls[w] == 1 && !forest[w].root) tips.push_back(w);
            }
        }
    }

    /// What is left of the wall a-b; nothing, or the wall with the end away from the root drawn back.
    std::optional<Segment> left_of(std::size_t a, std::size_t b) const {
        const auto end = [&](std::size_t v, std::size_t other) {
            if (back_[v] <= 0 || towards_root_[v] != other) return std::optional(forest_[v].at);
            const double l = length_to_root(v);
            return back_[v] < l ? std::optional(part_way(forest_[v].at, forest_[other].at, back_[v] / l))
                                : std::nullopt;
        };
        const std::optional<Point> from = end(a, b), to = end(b, a);
        return from && to ? std::optional(Segment{*from, *to}) : std::nullopt;
    }

    /// Draws tips back by less where what is left is farther than `reach` from one of these points and the wall is not.
    void hold(const std::vector<Point>& points, double reach) {
        if (points.empty()) return;
        std::vector<Segment> left, whole;
        std::vector<std::size_t> from;  // of `whole`: the vertex at its end away from the root
        for (auto [e, end] = edges(forest_); e != end; ++e) {
            std::size_t a = source(*e, forest_), b = target(*e, forest_);
            if (!forest_[a].wide) continue;
            if (const std::optional<Segment> s = left_of(a, b)) left.push_back(*s);
            for (int turn = 0; turn < 2; ++turn, std::swap(a, b))
                if (back_[a] > 0 && towards_root_[a] == b)
                    whole.push_back({forest_[a].at, forest_[b].at}), from.push_back(a);
        }
        if (whole.empty()) return;
        const NearestSegment walls(std::move(whole)), rest(std::move(left));
        const auto within = [&](const NearestSegment& segments, Point p) {
            return !segments.empty() && segments.nearest(p).distance.value() <= reach * reach;
        };
        for (const Point p : points) {
            if (within(rest, p) || !within(walls, p)) continue;
            const std::uint32_t nearest = walls.nearest(p).index;
            std::size_t v = from[nearest];
            back_[v] = std::min(back_[v], length(nearest_point(p, walls.segments()[nearest]) - forest_[v].at));
            for (v = towards_root_[v]; back_[v] > 0; v = towards_root_[v]) back_[v] = 0;
        }
    }

private:
    double length_to_root(std::size_t v) const { return length(forest_[towards_root_[v]].at - forest_[v].at); }

    const SupportForest& forest_;
    std::vector<double> back_;  ///< how far from the vertex towards the root nothing is left; lattice units
    std::vector<std::size_t> towards_root_;  ///< the vertex next to it on the way to the root, where there is one way
};

}  // namespace

SlenderPlace most_slender(const SupportForest& forest, const Settings& settings) {
    const std::vector<double> to_root = distances_to_roots(forest);
    SlenderPlace worst;
    for (auto [e, end] = edges(forest); e != end; ++e) {
        const std::size_t a = source(*e, forest), b = target(*e, forest);
        const SlenderPlace place = WallProfile(forest[a], forest[b], to_root[a], to_root[b], settings).worst();
        if (place.ratio > worst.ratio) worst = place;
    }
    for (auto [v, end] = vertices(forest); v != end; ++v)
        if (forest[*v].free)
            if (const SlenderPlace tree = whole_tree(*v, forest, settings); tree.ratio > worst.ratio) worst = tree;
    return worst;
}

void mark_wide_trees(SupportForest& forest, const Settings& settings) {
    if (settings.wall_lines < 2) return;
    const std::vector<double> to_root = distances_to_roots(forest);
    std::vector<std::size_t> tree(num_vertices(forest));
    if (!tree.empty()) connected_components(forest, tree.data());
    std::vector<char> wide(num_vertices(forest), 0), left(num_vertices(forest), 0);
    for (std::size_t v = 0; v < tree.size(); ++v)
        if (forest[v].wide || to_root[v] > static_cast<double>(settings.wall_lines_longer) ||
            standing_height(forest[v], settings) > static_cast<double>(settings.wall_lines_taller))
            wide[tree[v]] = 1;
    const Taper taper(forest, settings);
    for (auto [e, end] = edges(forest); e != end; ++e)
        if (taper.left_of(source(*e, forest), target(*e, forest))) left[tree[source(*e, forest)]] = 1;
    for (std::size_t v = 0; v < tree.size(); ++v)
        if (forest[v].free) left[tree[v]] = 1;
    for (std::size_t v = 0; v < tree.size(); ++v) forest[v].wide = wide[tree[v]] && left[tree[v]];
    for (auto [e, end] = edges(forest); e != end; ++e)
        if (forest[source(*e, forest)].wide) forest[*e].to_junction = true;
}

SupportForest tapered_trees(const SupportForest& forest, const Settings& settings, const std::vector<Point>& above) {
    Taper taper(forest, settings);
    taper.hold(above, static_cast<double>(settings.support_radius));
    SupportForest result;
    std::vector<std::size_t> vertex(num_vertices(forest), 0);
    std::vector<char> there(num_vertices(forest), 0);
    const auto add = [&](std::size_t v, Point at) {
        if (!there[v]) vertex[v] = add_vertex(forest[v], result), there[v] = 1;
        if (at != forest[v].at) result[vertex[v]].at = at;
        return vertex[v];
    };
    for (auto [e, end] = edges(forest); e != end; ++e) {
        const std::size_t a = source(*e, forest), b = target(*e, forest);
        const auto left = forest[a].wide ? taper.left_of(a, b) : std::optional(Segment{forest[a].at, forest[b].at});
        if (!left) continue;
        const std::size_t from = add(a, left->a), to = add(b, left->b);
        add_edge(from, to, forest[*e], result);
    }
    for (std::size_t v = 0; v < there.size(); ++v)
        if (!there[v] && (out_degree(v, forest) == 0 || (forest[v].wide && forest[v].free))) add(v, forest[v].at);
    return result;
}

std::vector<Point> ends_of_wide_trees(const SupportForest& forest) {
    std::vector<Point> ends;
    for (auto [v, end] = vertices(forest); v != end; ++v)
        if (forest[*v].wide && out_degree(*v, forest) < (forest[*v].root ? 1u : 2u)) ends.push_back(forest[*v].at);
    return ends;
}

int wide_trees(const SupportForest& forest) {
    int trees = 0;  // a tree has one vertex more than edges
    for (auto [v, end] = vertices(forest); v != end; ++v) trees += forest[*v].wide;
    for (auto [e, end] = edges(forest); e != end; ++e) trees -= forest[source(*e, forest)].wide;
    return trees;
}

}  // namespace ribvault
