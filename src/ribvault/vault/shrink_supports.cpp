#include "ribvault/vault/shrink_supports.hpp"

#include <algorithm>
#include <boost/pending/disjoint_sets.hpp>
#include <cmath>
#include <optional>

#include "ribvault/exact/real_vector.hpp"
#include "ribvault/vault/free_trees.hpp"
#include "ribvault/vault/root_pairs.hpp"
#include "ribvault/vault/segment_grid.hpp"
#include "ribvault/vault/wall_contacts.hpp"

namespace ribvault {
namespace {

constexpr int sweeps = 10;
constexpr double zip_share = 0.9;  ///< of the shorter wall at a corner that is zipped up, at most
constexpr double wide_corner = 2 * M_PI / 3, narrow_corner = M_PI / 9;  ///< 120° and 20°
constexpr Unit steps_apart = 10;  ///< roots farther apart than so many steps do not go towards each other

class Shrinker {
public:
    Shrinker(const SupportForest& forest, const CavityBoundary& boundary, Unit step, Unit pillar_length, Unit braced)
        : boundary_(boundary),
          step_(step),
          braced_(static_cast<double>(braced)),
          grid_(bounding_box(forest), units_per_mm, 2 * step + 2) {  // what begins between walls may move twice as far
        for (auto [v, end] = vertices(forest); v != end; ++v)
            nodes_.push_back({forest[*v].at, forest[*v].root, {forest[*v].at}, {}, forest[*v]});
        for (auto [e, end] = edges(forest); e != end; ++e)
            add_wall(source(*e, forest), target(*e, forest), walls_.size());
        input_walls_ = walls_.size();
        SpareLengths lengths = spare_lengths(forest, pillar_length);
        for (std::size_t v = 0; v < nodes_.size(); ++v)
            nodes_[v].free = forest[v].free, nodes_[v].stays = lengths.of(v) <= 0;
    }

    ShrunkSupports run() {
        cut_between_roots();
        unite_roots();
        zip_corners();
        for (int k = 0; k < sweeps; ++k) {
            bool moved = false;
            for (std::size_t v = 0; v < nodes_.size(); ++v)
                if (!nodes_[v].gone && !nodes_[v].walls.empty()) moved = improve(v) || moved;
            if (!moved) break;
        }
        return finish();
    }

private:
    struct Node {
        Point at;
        bool root;
        std::vector<Point> from;  ///< where the points that are here now were: all within step
        std::vector<std::uint32_t> walls;
        SupportVertex was;  ///< for what else is known of it
        bool gone = false;
        bool free = false;   ///< a root away from the shell
        bool stays = false;  ///< of a free tree with no more track than a pillar
    };
    struct Wall {
        std::size_t a, b;
        Segment was;         ///< before anything moved
        std::size_t origin;  ///< the wall of the input that it is or a part of which it was; of a stem none
        bool alive = true;
    };

    Segment segment(const Wall& w) const { return {nodes_[w.a].at, nodes_[w.b].at}; }
    std::size_t other(std::uint32_t w, std::size_t v) const { return walls_[w].a == v ? walls_[w].b : walls_[w].a; }

    void add_wall(std::size_t a, std::size_t b, std::size_t origin) {
        const auto id = static_cast<std::uint32_t>(walls_.size());
        walls_.push_back({a, b, {nodes_[a].at, nodes_[b].at}, origin});
        nodes_[a].walls.push_back(id);
        nodes_[b].walls.push_back(id);
        grid_.insert(id, segment(walls_.back()));
    }

    bool reachable(const Node& node, Point p) const {
        return std::all_of(node.from.begin(), node.from.end(),
                           [&](Point f) { return squared_length(p - f) <= step_ * step_; });
    }

    /// Would v's walls collide with others if v were at p? `merged`: a neighbour that takes v in, or none.
    bool collides(std::size_t v, Point p, std::size_t merged) const {
        for (const std::uint32_t w : nodes_[v].walls) {
            const std::size_t u = other(w, v);
            if (u == merged) continue;
            const Segment s{p, nodes_[u].at};
            if (s.a == s.b) return true;
            bool hit = false;
            grid_.visit(bounding_box(s), [&](std::uint32_t k) {
                if (hit || !walls_[k].alive || k == w) return;
                const Wall& o = walls_[k];
                if (o.a == v || o.b == v) {
                    // Both end in v: they may not run over each other.
                    const std::size_t x = o.a == v ? o.b : o.a;
                    if (x == merged) return;
                    const Segment t{p, nodes_[x].at};
                    hit = orientation(p, nodes_[u].at, nodes_[x].at) == 0 && t.a != t.b &&
                          ahead(p, nodes_[u].at, nodes_[x].at);
                    return;
                }
                hit = collide(s, segment(o));
            });
            if (hit) return true;
        }
        return false;
    }
    static bool ahead(Point p, Point q, Point r) {
        const Vec a = vec(q) - vec(p), b = vec(r) - vec(p);
        return dot(a, b) > 0;
    }

    /// Where v wants to be: the place between its neighbours that makes its walls short.
    Vec best_place(std::size_t v) const {
        const Node& node = nodes_[v];
        const Vec here = vec(node.at);
        if (node.walls.size() == 1) return vec(nodes_[other(node.walls[0], v)].at);
        if (node.walls.size() == 2) {
            const Vec a = vec(nodes_[other(node.walls[0], v)].at), b = vec(nodes_[other(node.walls[1], v)].at),
                      d = b - a;
            const double l2 = dot(d, d);
            // At the same share of the way, so that vertices stay spread along the chain.
            const double la = norm(here - a), lb = norm(here - b);
            const double t = la + lb > 0 ? la / (la + lb) : 0.5;
            return l2 > 0 ? a + t * d : a;
        }
        Vec sum{};  // Weiszfeld's step towards the point with the least sum of distances
        double weights = 0;
        for (const std::uint32_t w : node.walls) {
            const Vec u = vec(nodes_[other(w, v)].at);
            const double weight = 1 / std::max(norm(u - here), 1.0);
            sum = sum + weight * u, weights += weight;
        }
        return (1 / weights) * sum;
    }

    double length_at(std::size_t v, Point p, std::size_t merged) const {
        double sum = 0;
        for (const std::uint32_t w : nodes_[v].walls)
            if (const std::size_t u = other(w, v); u != merged) sum += length(nodes_[u].at - p);
        return sum;
    }

    bool improve(std::size_t v) {
        if (nodes_[v].stays || nodes_[v].free) return false;
        if (nodes_[v].root) return slide(v);
        if (merge_into_neighbour(v)) return true;
        const Vec here = vec(nodes_[v].at), to = best_place(v);
        Vec way = to - here;
        const double l = norm(way);
        if (l < 2) return false;
        // A tip stops short of its neighbour, into which it merges when both may.
        double share = nodes_[v].walls.size() == 1 ? std::max(0.0, l - 3) / l : 1;
        share = std::min(share, 2.0 * static_cast<double>(step_) / l);
        // The farthest that all of `from` allow, one unit short for the rounding.
        for (const Point f : nodes_[v].from) {
            const double reach = static_cast<double>(step_) - 1;
            const Vec d = here - vec(f);
            const double a = dot(way, way), b = dot(d, way), c = dot(d, d) - reach * reach;
            const double root = b * b - a * c;
            if (root < 0) return false;
            share = std::min(share, (-b + std::sqrt(root)) / a);
        }
        const double before = length_at(v, nodes_[v].at, none);
        for (int attempt = 0; attempt < 3 && share > 0; ++attempt, share /= 2) {
            const Point p = rounded(here + share * way);
            if (p == nodes_[v].at) return false;
            if (!reachable(nodes_[v], p) || length_at(v, p, none) >= before || collides(v, p, none)) continue;
            nodes_[v].at = p;
            return true;
        }
        return false;
    }

    /// v's points go to a neighbour when it is within their reach.
    bool merge_into_neighbour(std::size_t v) {
        for (const std::uint32_t w : nodes_[v].walls) {
            const std::size_t u = other(w, v);
            const Point p = nodes_[u].at;
            if (!reachable(nodes_[v], p)) continue;
            if (length_at(v, p, u) > length_at(v, nodes_[v].at, none)) continue;
            if (collides(v, p, u) || runs_over(v, u)) continue;
            merge(v, u, w);
            return true;
        }
        return false;
    }
    /// Would a wall of v lie on a wall of u once both begin in u?
    bool runs_over(std::size_t v, std::size_t u) const {
        const Point p = nodes_[u].at;
        for (const std::uint32_t w : nodes_[v].walls)
            for (const std::uint32_t k : nodes_[u].walls) {
                const std::size_t x = other(w, v), y = other(k, u);
                if (x == u || y == v) continue;
                if (orientation(p, nodes_[x].at, nodes_[y].at) == 0 && ahead(p, nodes_[x].at, nodes_[y].at))
                    return true;
            }
        return false;
    }
    /// v becomes u; `between`: the wall between them, if there is one.
    void merge(std::size_t v, std::size_t u, std::optional<std::uint32_t> between) {
        if (between) {
            walls_[*between].alive = false;
            std::erase(nodes_[u].walls, *between);
        }
        for (const std::uint32_t w : nodes_[v].walls) {
            if (w == between) continue;
            (walls_[w].a == v ? walls_[w].a : walls_[w].b) = u;
            nodes_[u].walls.push_back(w);
        }
        for (const Point f : nodes_[v].from)
            if (std::find(nodes_[u].from.begin(), nodes_[u].from.end(), f) == nodes_[u].from.end())
                nodes_[u].from.push_back(f);
        nodes_[u].was.wide = nodes_[u].was.wide || nodes_[v].was.wide;
        nodes_[u].was.standing = std::max(nodes_[u].was.standing, nodes_[v].was.standing);
        nodes_[v].gone = true;
        nodes_[v].walls.clear();
    }

    /// Roots of neighbouring trees that can be at the same place become one, others go towards each other from now on.
    void unite_roots() {
        partner_.assign(nodes_.size(), none);
        if (!boundary_.has_shell() || braced_ > 0) return;
        for (bool united = true; united;) {
            pair_roots();
            united = false;
            for (std::size_t v = 0; v < nodes_.size(); ++v) united = (partner_[v] != none && meet(v)) || united;
        }
    }
    void pair_roots() {
        std::vector<TreeRoot> roots;
        std::vector<std::size_t> node;
        const std::vector<std::size_t> tree = trees();
        for (std::size_t v = 0; v < nodes_.size(); ++v) {
            const Node& n = nodes_[v];
            partner_[v] = none;
            if (!n.root || n.gone || n.free || n.stays || n.walls.empty()) continue;
            roots.push_back({n.at, trunk_of(v), tree[v], away_from(v)});
            node.push_back(v);
        }
        const std::vector<std::size_t> partner = ribvault::pair_roots(roots, boundary_, steps_apart * step_);
        for (std::size_t r = 0; r < roots.size(); ++r)
            if (partner[r] != no_root) partner_[node[r]] = node[partner[r]];
    }
    /// Where the walls of a vertex lead, as the sum of unit vectors.
    Vec away_from(std::size_t v) const {
        Vec sum;
        for (const std::uint32_t w : nodes_[v].walls) {
            const Vec d = vec(nodes_[other(w, v)].at) - vec(nodes_[v].at);
            sum = sum + (1 / std::max(norm(d), 1.0)) * d;
        }
        return sum;
    }
    /// For every vertex one of its tree, the same for all of it.
    std::vector<std::size_t> trees() {
        boost::disjoint_sets_with_storage<> sets(nodes_.size());
        for (const Wall& w : walls_)
            if (w.alive) sets.union_set(w.a, w.b);
        std::vector<std::size_t> tree(nodes_.size());
        for (std::size_t v = 0; v < tree.size(); ++v) tree[v] = sets.find_set(v);
        return tree;
    }
    /// The longest way from a root to the first junction or the tip.
    double trunk_of(std::size_t root) const {
        double longest = 0;
        for (const std::uint32_t w : nodes_[root].walls) longest = std::max(longest, trunk_of(root, w));
        return longest;
    }
    double trunk_of(std::size_t v, std::uint32_t w) const {
        double sum = 0;
        for (;;) {
            const std::size_t u = other(w, v);
            sum += length(nodes_[u].at - nodes_[v].at);
            const std::vector<std::uint32_t>& walls = nodes_[u].walls;
            if (walls.size() != 2) return sum;
            w = walls[walls.front() == w ? 1 : 0], v = u;
        }
    }
    /// A place on the shell about `at`.
    Point on_shell(Vec at) const {
        const Point p = rounded(at);
        const Segment& edge = boundary_.edges.segments()[boundary_.edges.nearest(p).index];
        return place_root(nearest_point(p, edge), boundary_);
    }

    /// v's root and its partner become one in the middle between them, if they may.
    bool meet(std::size_t v) {
        const std::size_t u = partner_[v];
        const Point middle = on_shell(0.5 * (vec(nodes_[v].at) + vec(nodes_[u].at))), was = nodes_[u].at;
        if (!reachable(nodes_[v], middle) || !reachable(nodes_[u], middle) || collides(u, middle, none)) return false;
        nodes_[u].at = middle;
        if (collides(v, middle, none) || runs_over(v, u)) {
            nodes_[u].at = was;
            return false;
        }
        merge(v, u, {});
        partner_[v] = partner_[u] = none;
        return true;
    }
    /// A root goes towards its partner.
    bool approach(std::size_t v) {
        const Point there = nodes_[partner_[v]].at;
        return meet(v) || go_along_shell(v, vec(there), there, 0.5 * length(there - nodes_[v].at));
    }

    /// A root goes along the shell towards the point that makes its walls shortest.
    bool slide(std::size_t v) {
        if (partner_[v] != none) return approach(v);
        if (nodes_[v].walls.size() != 1) return false;
        const Point neighbour = nodes_[other(nodes_[v].walls[0], v)].at;
        const Segment& nearest = boundary_.edges.segments()[boundary_.edges.nearest(neighbour).index];
        const Vec wish = vec(nearest_point(neighbour, nearest));
        return go_along_shell(v, wish, neighbour, norm(wish - vec(nodes_[v].at)));
    }

    /// A root goes along the shell towards `wish` by a step or `farthest`, or a part of that, if that leads it nearer
    /// to a point.
    bool go_along_shell(std::size_t v, Vec wish, Point nearer_to, double farthest) {
        const Node& node = nodes_[v];
        const Vec here = vec(node.at), way = wish - here;
        const double before = length(nearer_to - node.at);
        if (norm(way) < 2) return false;
        double reach = std::min(farthest, static_cast<double>(step_) - 4);
        for (int attempt = 0; attempt < 3; ++attempt, reach /= 2) {
            const Point p = on_shell(here + (reach / norm(way)) * way);
            if (p == node.at || !reachable(node, p) || length(nearer_to - p) >= before - 1 || collides(v, p, none))
                continue;
            nodes_[v].at = p;
            return true;
        }
        return false;
    }

    /// Trees with several roots fall apart in the middle of the way between two of them, once no part is longer than a
    /// braced tree.
    void cut_between_roots() {
        const std::size_t n = nodes_.size();
        std::vector<std::int64_t> owner(n, -1);
        std::vector<std::uint32_t> by(n, 0);
        std::vector<double> distance(n, 0);
        // Shortest way along the tree to a root: the walls where two roots' parts meet are cut.
        std::vector<std::pair<double, std::size_t>> heap;
        const auto later = [](const auto& a, const auto& b) { return a > b; };
        for (std::size_t v = 0; v < n; ++v)
            if (nodes_[v].root && !nodes_[v].walls.empty())
                owner[v] = static_cast<std::int64_t>(v), heap.push_back({0, v});
        std::vector<char> done(n, 0);
        std::make_heap(heap.begin(), heap.end(), later);
        while (!heap.empty()) {
            std::pop_heap(heap.begin(), heap.end(), later);
            const auto [d, v] = heap.back();
            heap.pop_back();
            if (done[v]) continue;
            done[v] = 1;
            for (const std::uint32_t w : nodes_[v].walls) {
                const std::size_t u = other(w, v);
                const double l = d + length(nodes_[u].at - nodes_[v].at);
                if (owner[u] >= 0 && distance[u] <= l) continue;
                owner[u] = owner[v], distance[u] = l, by[u] = w;
                heap.push_back({l, u});
                std::push_heap(heap.begin(), heap.end(), later);
            }
        }
        const std::size_t count = walls_.size();
        for (std::size_t w = 0; w < count; ++w) {
            const std::size_t a = walls_[w].a, b = walls_[w].b;
            if (owner[a] < 0 || owner[b] < 0 || owner[a] == owner[b]) continue;
            const double l = length(nodes_[b].at - nodes_[a].at), at = (distance[b] + l - distance[a]) / 2;
            if (l < 4 || (braced_ > 0 && distance[a] + at > braced_)) continue;
            const double t = std::clamp(at / l, 1 / l, 1 - 1 / l);
            const Point p = rounded(vec(nodes_[a].at) + t * (vec(nodes_[b].at) - vec(nodes_[a].at)));
            if (p == nodes_[a].at || p == nodes_[b].at) continue;
            // Two tips in the same place, each free to run back from there.
            const std::size_t tip_a = nodes_.size();
            const SupportVertex cut = vertex_between(nodes_[a].was, nodes_[b].was, p);
            nodes_.push_back({p, false, {p}, {}, cut});
            nodes_.push_back({p, false, {p}, {}, cut});
            std::erase(nodes_[b].walls, static_cast<std::uint32_t>(w));
            walls_[w].a = a, walls_[w].b = tip_a, walls_[w].was = {nodes_[a].at, p};
            nodes_[tip_a].walls.push_back(static_cast<std::uint32_t>(w));
            add_wall(tip_a + 1, b, w);
        }
    }

    /// The walls on both sides of a corner that may be zipped up.
    std::optional<std::pair<std::uint32_t, std::uint32_t>> narrowest_corner(std::size_t v) const {
        const Node& node = nodes_[v];
        if (node.walls.size() < (node.root ? 2u : 3u)) return {};
        std::vector<std::pair<double, std::uint32_t>> around;
        for (const std::uint32_t w : node.walls) {
            const Vec d = vec(nodes_[other(w, v)].at) - vec(node.at);
            around.push_back({std::atan2(d.y, d.x), w});
        }
        std::sort(around.begin(), around.end());
        double narrowest = node.root || node.walls.size() > 3 ? wide_corner : narrow_corner;
        std::size_t best = around.size();
        for (std::size_t k = 0; k < around.size(); ++k) {
            const bool last = k + 1 == around.size();
            const double angle = around[last ? 0 : k + 1].first - around[k].first + (last ? 2 * M_PI : 0);
            if (angle < narrowest) narrowest = angle, best = k;
        }
        if (best == around.size()) return {};
        return std::pair(around[best].second, around[(best + 1) % around.size()].second);
    }

    /// What is at a share of the way from v to the other end of a wall, before anything moved.
    Point place_before(std::uint32_t w, std::size_t v, double share) const {
        const Segment& was = walls_[w].was;
        return walls_[w].a == v ? part_way(was.a, was.b, share) : part_way(was.b, was.a, share);
    }

    /// The narrowest corner of a junction with four walls or more, or of a root with two or more, below 120°, and of a
    /// junction with three walls below 20°: its two walls get a common beginning, as long as what lies on both can meet
    /// in one step, which grows from layer to layer.
    void zip_corners() {
        const std::size_t n = nodes_.size();
        std::vector<char> zipped(walls_.size(), 0);  // once: its other points have moved by then
        for (std::size_t v = 0; v < n; ++v) {
            if (nodes_[v].gone || nodes_[v].stays) continue;
            const std::optional<std::pair<std::uint32_t, std::uint32_t>> corner = narrowest_corner(v);
            if (!corner || zipped[corner->first] || zipped[corner->second]) continue;
            const auto [w1, w2] = *corner;
            const std::size_t a = other(w1, v), b = other(w2, v);
            const Vec here = vec(nodes_[v].at), da = vec(nodes_[a].at) - here, db = vec(nodes_[b].at) - here;
            const double la = norm(da), lb = norm(db);
            if (std::min(la, lb) < 8) continue;
            // What lies as far from v on both walls meets in the middle: as far out as neither moves by more than a
            // step.
            const auto meeting = [&](double reach) {
                return rounded(here + (reach / 2) * ((1 / la) * da + (1 / lb) * db));
            };
            const auto moved = [&](double reach) {
                const Vec p = vec(meeting(reach));
                return std::max(norm(p - vec(place_before(w1, v, reach / la))),
                                norm(p - vec(place_before(w2, v, reach / lb))));
            };
            const double most = static_cast<double>(step_) - 2;
            double reach = zip_share * std::min(la, lb);
            if (moved(reach) > most) {
                double low = 0;
                for (double high = reach; high - low > 1;) {
                    const double middle = (low + high) / 2;
                    (moved(middle) > most ? high : low) = middle;
                }
                reach = low;
            }
            if (reach < 4) continue;
            const Point from_a = place_before(w1, v, reach / la), from_b = place_before(w2, v, reach / lb),
                        p = meeting(reach);
            if (p == nodes_[v].at || p == nodes_[a].at || p == nodes_[b].at) continue;
            const double saved =
                la + lb - norm(vec(nodes_[a].at) - vec(p)) - norm(vec(nodes_[b].at) - vec(p)) - norm(vec(p) - here);
            if (saved <= 1) continue;
            // The corner is empty between the two walls, but another wall may reach into it.
            bool free = true;
            for (const Segment s : {Segment{p, nodes_[a].at}, Segment{p, nodes_[b].at}, Segment{nodes_[v].at, p}}) {
                grid_.visit(bounding_box(s), [&](std::uint32_t k) {
                    if (free && walls_[k].alive && k != w1 && k != w2) free = !collide(s, segment(walls_[k]));
                });
            }
            if (!free) continue;
            const std::size_t joint = nodes_.size();
            SupportVertex middle = vertex_between(nodes_[v].was, nodes_[a].was, from_a);
            const SupportVertex beside = vertex_between(nodes_[v].was, nodes_[b].was, from_b);
            middle.standing = std::max(middle.standing, beside.standing), middle.wide = middle.wide || beside.wide;
            nodes_.push_back({p, false, {from_a, from_b}, {w1, w2}, middle});
            for (const std::uint32_t w : {w1, w2}) {
                zipped[w] = 1;
                if (walls_[w].origin != none) stems_.push_back({walls_[w].origin, walls_.size()});
                (walls_[w].a == v ? walls_[w].a : walls_[w].b) = joint;
                std::erase(nodes_[v].walls, w);
            }
            add_wall(v, joint, none);
        }
    }

    ShrunkSupports finish() {
        ShrunkSupports result;
        std::vector<std::int64_t> vertex(nodes_.size(), -1);
        const auto keep = [&](std::size_t v) {
            if (vertex[v] < 0) {
                vertex[v] = static_cast<std::int64_t>(add_vertex(nodes_[v].was, result.forest));
                SupportVertex& kept = result.forest[static_cast<std::size_t>(vertex[v])];
                kept.at = nodes_[v].at, kept.root = nodes_[v].root, kept.free = nodes_[v].free;
            }
            return static_cast<std::size_t>(vertex[v]);
        };
        for (const Wall& w : walls_)
            if (w.alive) {
                const std::size_t a = keep(w.a), b = keep(w.b);
                add_edge(a, b, result.forest);
                result.left_cavity =
                    result.left_cavity || meets_shell(segment(w), nodes_[w.a].root, nodes_[w.b].root, boundary_);
            }
        for (std::size_t v = 0; v < nodes_.size(); ++v)
            if (!nodes_[v].gone && nodes_[v].root && nodes_[v].walls.empty()) keep(v);
        result.survives.resize(input_walls_);
        for (const Wall& w : walls_)
            if (w.alive && w.origin != none) result.survives[w.origin] = 1;
        for (const auto& [w, stem] : stems_)
            if (walls_[stem].alive) result.survives[w] = 1;
        return result;
    }

    static constexpr std::size_t none = static_cast<std::size_t>(-1);
    const CavityBoundary& boundary_;
    Unit step_;
    double braced_;  ///< 0: trees are not
    std::vector<Node> nodes_;
    std::vector<Wall> walls_;
    std::vector<std::pair<std::size_t, std::size_t>> stems_;  ///< walls of the input and what leads to what is left of
                                                              ///< them beyond a zipped corner
    std::vector<std::size_t> partner_;  ///< of a root, the one it goes towards; none
    std::size_t input_walls_ = 0;
    SegmentGrid grid_;
};

}  // namespace

ShrunkSupports shrink_supports(const SupportForest& forest, const CavityBoundary& boundary, Unit step,
                               Unit pillar_length, Unit braced) {
    return Shrinker(forest, boundary, step, pillar_length, braced).run();
}

}  // namespace ribvault
