#include "ribvault/vault/copy_supports.hpp"

#include <algorithm>

namespace ribvault {
namespace {

/// A place on a segment where it meets the boundary: numerator / denominator of the way from its first to its last
/// point.
struct Meeting {
    std::int64_t numerator, denominator;  ///< 0 <= numerator <= denominator
    bool operator<(const Meeting& o) const {
        return static_cast<Int128>(numerator) * o.denominator < static_cast<Int128>(o.numerator) * denominator;
    }
    Point on(const Segment& s) const {
        return part_way(s.a, s.b, static_cast<double>(numerator) / static_cast<double>(denominator));
    }
};

void find_meetings(const Segment& s, const CavityBoundary& boundary, std::vector<Meeting>& meetings) {
    meetings.clear();
    boundary.edges.visit(bounding_box(s), [&](std::uint32_t k) {
        const Segment& e = boundary.edges.segments()[k];
        if (!segments_touch(s, e)) return;
        std::int64_t from = cross(e.a, e.b, s.a), to = cross(e.a, e.b, s.b);
        if (from == to) return;  // along the edge: its neighbours give the places
        if (from < 0 || to > 0) from = -from, to = -to;
        // from >= 0 >= to now, and from - to > 0; of very long segments it fits 63 bits only once both are quartered.
        if (from > (std::int64_t{1} << 61) || to < -(std::int64_t{1} << 61)) from >>= 2, to >>= 2;
        meetings.push_back({from, from - to});
    });
    std::sort(meetings.begin(), meetings.end());
    meetings.erase(std::unique(meetings.begin(), meetings.end(),
                               [](const Meeting& a, const Meeting& b) { return !(a < b) && !(b < a); }),
                   meetings.end());
}

class Copier {
public:
    Copier(const SupportForest& above, const CavityBoundary& boundary, bool shell_holds_tracks)
        : above_(above),
          boundary_(boundary),
          shell_holds_tracks_(shell_holds_tracks),
          vertex_(num_vertices(above), -1),
          inside_(num_vertices(above)) {}

    CopiedSupports run() {
        for (std::size_t v = 0; v < inside_.size(); ++v)
            inside_[v] = boundary_.location.locate(above_[v].at) == Side::inside;
        std::int32_t index = 0;
        for (auto [e, end] = edges(above_); e != end; ++e, ++index)
            copy_edge(source(*e, above_), target(*e, above_), index);
        for (std::size_t v = 0; v < inside_.size(); ++v) {
            const bool dot = out_degree(v, above_) == 0;
            if (dot && (inside_[v] || !shell_holds_tracks_)) inherit({above_[v].at, above_[v].at}, v);
            if (!above_[v].root || !inside_[v] || (!dot && vertex_[v] < 0)) continue;
            if (above_[v].free || !boundary_.has_shell())
                stand(v);
            else if (!prolong(v, false))
                barred_.push_back(v);
        }
        for (const std::size_t v : barred_) prolong(v, true);
        return std::move(result_);
    }

private:
    std::size_t vertex(std::size_t v) {
        if (vertex_[v] < 0) {
            const SupportVertex& was = above_[v];
            vertex_[v] = static_cast<std::int64_t>(
                add_vertex({.at = was.at, .wide = was.wide, .standing = was.standing}, result_.forest));
        }
        return static_cast<std::size_t>(vertex_[v]);
    }

    /// A root away from the shell: its tree stands on what is below.
    void stand(std::size_t v) {
        SupportVertex& own = result_.forest[vertex(v)];
        if (!own.root) own.root = own.free = true;
    }

    void inherit(const Segment& piece, std::size_t v) {
        result_.inherited.push_back(piece);
        result_.inherited_outside.push_back(above_[v].outside);
    }

    void add(std::size_t a, std::size_t b, std::int32_t origin) {
        add_edge(a, b, result_.forest);
        result_.origin.push_back(origin);
    }

    void copy_edge(std::size_t a, std::size_t b, std::int32_t index) {
        const Segment s{above_[a].at, above_[b].at};
        find_meetings(s, boundary_, meetings_);
        // Even a wall inside the shell may reach into the cavity by more than the shell holds up.
        if (!shell_holds_tracks_) inherit(s, a);
        if (meetings_.empty()) {
            if (!inside_[a]) return;
            add(vertex(a), vertex(b), index);
            if (shell_holds_tracks_) inherit(s, a);
            return;
        }
        // Between two meetings the wall is on one side; which, is read off at the rounded middle: what to keep of a
        // wall that runs along the shell within a rounding is a choice.
        for (std::size_t k = 0; k <= meetings_.size(); ++k) {
            const Point from = k == 0 ? s.a : meetings_[k - 1].on(s),
                        to = k == meetings_.size() ? s.b : meetings_[k].on(s);
            const Point middle{(from.x + to.x) / 2, (from.y + to.y) / 2};
            if (squared_length(to - from) <= root_tolerance * root_tolerance ||
                boundary_.location.locate(middle) != Side::inside) {
                // Held against what is below like any other piece, for all its last nanometres may reach into the
                // cavity.
                if (shell_holds_tracks_ && at_boundary(middle)) inherit({from, to}, a);
                if (k == 0 && inside_[a]) anchor(a);
                if (k == meetings_.size() && inside_[b]) anchor(b);
                continue;
            }
            const auto new_root = [&](Point p, bool at_end, std::size_t v) {
                return root(vertex_between(above_[a], above_[b], p), at_end ? v : no_vertex);
            };
            const std::size_t va = k == 0 && inside_[a] ? vertex(a) : new_root(from, k <= 1, a);
            const std::size_t vb =
                k == meetings_.size() && inside_[b] ? vertex(b) : new_root(to, k + 1 >= meetings_.size(), b);
            add(va, vb, index);
            if (shell_holds_tracks_) inherit({from, to}, a);
        }
    }

    /// A new root; the place of the old root v is kept when it is still one, so that walls above each other align.
    std::size_t root(SupportVertex vertex, std::size_t v) {
        const bool stays = boundary_.rooted && v != no_vertex && above_[v].root && !inside_[v] &&
                           squared_length(above_[v].at - vertex.at) <= root_tolerance * root_tolerance;
        vertex.root = boundary_.rooted;
        vertex.at = stays ? above_[v].at : place_root(vertex.at, boundary_);
        return add_vertex(vertex, result_.forest);
    }

    bool at_boundary(Point p) const {
        const SquaredDistance d = boundary_.edges.nearest(p).distance;
        return d.numerator <= static_cast<Int128>(root_tolerance * root_tolerance) * d.denominator;
    }

    void make_root(std::size_t v, Point at) { result_.forest[v].at = at, result_.forest[v].root = true; }

    /// The wall between v and the shell is too short to keep: v itself becomes a root, so that its tree still has one.
    void anchor(std::size_t v) {
        if (!boundary_.rooted) {
            vertex(v);
            return;
        }
        const Point at = above_[v].at;
        const Segment& edge = boundary_.edges.segments()[boundary_.edges.nearest(at).index];
        make_root(vertex(v), place_root(nearest_point(at, edge), boundary_));
    }

    /// Says no, for now, when v's own tree stands in the way. In the end such a root is given up, for its wall would
    /// cross the tree, unless the tree has no other root.
    bool prolong(std::size_t v, bool in_the_end) {
        SupportForest& forest = result_.forest;
        const std::size_t own = vertex(v);
        if (forest[own].root) return true;
        const Point at = above_[v].at;
        const NearestSegment::Hit hit = boundary_.edges.nearest(at);
        const double distance = std::sqrt(hit.distance.value());
        const Point foot = place_root(nearest_point(at, boundary_.edges.segments()[hit.index]), boundary_);
        if (out_degree(own, forest) == 1) {
            const Point from = forest[*adjacent_vertices(own, forest).first].at;
            const double l = length(at - from), reach = 2 * distance + 2;
            const Segment ray{at, {at.x + round_to_lattice(static_cast<double>(at.x - from.x) / l * reach),
                                   at.y + round_to_lattice(static_cast<double>(at.y - from.y) / l * reach)}};
            find_meetings(ray, boundary_, meetings_);
            if (!meetings_.empty() && !crosses_walls({at, meetings_.front().on(ray)}, own)) {
                make_root(own, place_root(meetings_.front().on(ray), boundary_));
                return true;
            }
        }
        if (squared_length(foot - at) <= root_tolerance * root_tolerance) {
            make_root(own, foot);
            return true;
        }
        const std::vector<char> own_tree = tree_of(own);
        if (barred({at, foot}, own, own_tree)) {
            if (!in_the_end) return false;
            for (std::size_t w = 0; w < own_tree.size(); ++w)
                if (own_tree[w] && forest[w].root) return true;
        }
        if (!join_wall({at, foot}, own, own_tree))
            add(add_vertex({.at = foot, .root = true, .wide = forest[own].wide}, forest), own, -1);
        return true;
    }

    Segment wall(SupportForest::edge_descriptor e) const {
        return {result_.forest[source(e, result_.forest)].at, result_.forest[target(e, result_.forest)].at};
    }
    bool crosses_walls(const Segment& way, std::size_t from) const {
        const SupportForest& forest = result_.forest;
        for (auto [e, end] = edges(forest); e != end; ++e)
            if (source(*e, forest) != from && target(*e, forest) != from && segments_touch(way, wall(*e))) return true;
        return false;
    }

    std::vector<char> tree_of(std::size_t from) const {
        const SupportForest& forest = result_.forest;
        std::vector<char> own_tree(num_vertices(forest), 0);
        std::vector<std::size_t> open{from};
        own_tree[from] = 1;
        while (!open.empty()) {
            const std::size_t v = open.back();
            open.pop_back();
            for (auto [w, end] = adjacent_vertices(v, forest); w != end; ++w)
                if (!own_tree[*w]) own_tree[*w] = 1, open.push_back(*w);
        }
        return own_tree;
    }
    /// Is a wall of the same tree, elsewhere than at `from`, in the way?
    bool barred(const Segment& way, std::size_t from, const std::vector<char>& own_tree) const {
        const SupportForest& forest = result_.forest;
        for (auto [e, end] = edges(forest); e != end; ++e)
            if (own_tree[source(*e, forest)] && source(*e, forest) != from && target(*e, forest) != from &&
                segments_touch(way, wall(*e)))
                return true;
        return false;
    }

    /// When other walls stand in the way to the shell, the tree joins the nearest of them instead, if that is another
    /// tree: this one then stands on the other's roots. Says no when the way is free, or only its own tree is in it.
    bool join_wall(const Segment& way, std::size_t from, const std::vector<char>& own_tree) {
        SupportForest& forest = result_.forest;
        std::int64_t nearest = -1, index = 0;
        SquaredDistance nearest_distance{0, 1};
        SupportForest::edge_descriptor met;
        for (auto [e, end] = edges(forest); e != end; ++e, ++index) {
            if (own_tree[source(*e, forest)] || !segments_touch(way, wall(*e))) continue;
            const SquaredDistance d = squared_distance(way.a, wall(*e));
            if (nearest >= 0 && compare(d, nearest_distance) >= 0) continue;
            nearest = index, nearest_distance = d, met = *e;
        }
        if (nearest < 0) return false;
        const std::size_t a = source(met, forest), b = target(met, forest);
        const Point at = nearest_point(way.a, wall(met));
        std::size_t joint = at == forest[a].at ? a : b;
        if (at != forest[a].at && at != forest[b].at) {
            const std::int32_t origin = result_.origin[static_cast<std::size_t>(nearest)];
            result_.origin.erase(result_.origin.begin() + nearest);
            remove_edge(met, forest);
            joint = add_vertex(vertex_between(forest[a], forest[b], at), forest);
            add(a, joint, origin);
            add(joint, b, origin);
        }
        add(joint, from, -1);
        return true;
    }

    static constexpr std::size_t no_vertex = static_cast<std::size_t>(-1);
    const SupportForest& above_;
    const CavityBoundary& boundary_;
    bool shell_holds_tracks_;
    std::vector<std::int64_t> vertex_;
    std::vector<char> inside_;
    std::vector<std::size_t> barred_;
    std::vector<Meeting> meetings_;
    CopiedSupports result_;
};

}  // namespace

CopiedSupports copy_supports(const SupportForest& above, const CavityBoundary& boundary, bool shell_holds_tracks) {
    return Copier(above, boundary, shell_holds_tracks).run();
}

}  // namespace ribvault
