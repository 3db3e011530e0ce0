// The supports of one layer while their points move to where they are on the next one (thrifty strategy).
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "ribvault/exact/real_vector.hpp"
#include "ribvault/vault/cavity_boundary.hpp"
#include "ribvault/vault/segment_grid.hpp"
#include "ribvault/vault/support_forest.hpp"

namespace ribvault {

/// Vertices and walls by numbers that stay: what is gone keeps its place. Whoever changes something keeps this true:
/// every point that was on a wall is within `step` of what has become of the wall, no two walls cross that did not
/// before.
struct MovingSupports {
    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

    struct Node {
        Point at;
        bool root;
        std::vector<Point> from;  ///< where the points that are here now were: all within step
        std::vector<std::uint32_t> walls;
        SupportVertex was;  ///< for what else is known of it
        bool gone = false;
        bool free = false;   ///< a root away from the shell
        bool stays = false;  ///< of a free tree with no more track than a pillar, or led to its place on this layer
    };
    /// Where a vertex was, as Node::from, and what stands there.
    struct Passed {
        Point from;
        std::int32_t standing;
    };
    struct Wall {
        std::size_t a, b;
        Segment was;         ///< before anything moved
        std::size_t origin;  ///< the wall of the input that it is or a part of which it was; of a stem none
        bool alive = true;
        std::size_t merged = none;    ///< the wall that goes on in its place (straight_chains.hpp)
        std::vector<Passed> passed{};  ///< of vertices that lie on it now
    };

    /// `boundary` must outlive this. In a free tree with no more track than `pillar_length` everything stays.
    MovingSupports(const SupportForest& forest, const CavityBoundary& boundary, Unit step, Unit pillar_length);

    Segment segment(const Wall& w) const { return {nodes[w.a].at, nodes[w.b].at}; }
    /// The wall that goes on in the place of this one: itself while it is alive.
    std::size_t now(std::size_t w) const {
        while (walls[w].merged != none) w = walls[w].merged;
        return w;
    }
    std::size_t other(std::uint32_t w, std::size_t v) const { return walls[w].a == v ? walls[w].b : walls[w].a; }
    void add_wall(std::size_t a, std::size_t b, std::size_t origin);
    /// A vertex on a wall, made where there is none; `at` is on it up to rounding. To be called before walls are
    /// merged.
    std::size_t split(std::size_t w, Point at);
    /// By node the number of its tree: that of one of its nodes.
    std::vector<std::size_t> trees() const;
    /// Calls visit(w) for the walls that come near the box, some of them several times, gone ones too.
    template <class Visit>
    void visit_walls(const Box& box, Visit&& visit) const {
        grid_.visit(box, visit);
    }

    /// May what is in this vertex be at p?
    bool reachable(const Node& node, Point p) const;
    /// Would v's walls collide with others if v were at p? `merged`: a neighbour that takes v in, or none.
    bool collides(std::size_t v, Point p, std::size_t merged) const;
    /// Would a wall of v lie on a wall of u once both begin in u?
    bool runs_over(std::size_t v, std::size_t u) const;
    /// v becomes u; `between`: the wall between them, if there is one.
    void merge(std::size_t v, std::size_t u, std::optional<std::uint32_t> between);

    /// A place on the shell about `at`.
    Point on_shell(Vec at) const;
    /// A root goes along the shell towards `wish` by a step or `farthest`, or a part of that, if that leads it nearer
    /// to a point. Did it?
    bool go_along_shell(std::size_t v, Vec wish, Point nearer_to, double farthest);

    const CavityBoundary& boundary;
    const Unit step;
    std::vector<Node> nodes;
    std::vector<Wall> walls;
    std::size_t input_walls = 0;  ///< the first of `walls`
    /// Walls of the input and what leads to what is left of them beyond a zipped corner.
    std::vector<std::pair<std::size_t, std::size_t>> stems;

private:
    SegmentGrid grid_;
};

}  // namespace ribvault
