// Nearest segment to a point: a static tree of boxes with exact comparisons at its leaves.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "ribvault/exact/predicates.hpp"

namespace ribvault {

/// Whether the boxes of two segments are at most `reach` apart in both coordinates.
inline bool boxes_near(const Segment& s, const Segment& t, double reach) {
    const auto apart = [reach](Unit a, Unit b, Unit c, Unit d) {
        return static_cast<double>(std::min(c, d) - std::max(a, b)) > reach ||
               static_cast<double>(std::min(a, b) - std::max(c, d)) > reach;
    };
    return !apart(s.a.x, s.b.x, t.a.x, t.b.x) && !apart(s.a.y, s.b.y, t.a.y, t.b.y);
}

/// Lower bound of the squared distance of a point to a box: rounded down by more than its roundings may add (2^-51 of
/// it). 0 inside.
inline double squared_distance_below(Point p, const Box& box) {
    const double dx = static_cast<double>(std::max<Unit>({box.lo.x - p.x, p.x - box.hi.x, 0}));
    const double dy = static_cast<double>(std::max<Unit>({box.lo.y - p.y, p.y - box.hi.y, 0}));
    return (dx * dx + dy * dy) * (1 - 0x1p-50);
}

/// A packed box tree over segments. Lighter than a segment Voronoi diagram and held against one in the tests: both give
/// the exact nearest segment.
class NearestSegment {
public:
    NearestSegment() = default;
    explicit NearestSegment(std::vector<Segment> segments);

    bool empty() const { return segments_.empty(); }
    const std::vector<Segment>& segments() const { return segments_; }

    struct Hit {
        std::uint32_t index;  ///< into segments()
        SquaredDistance distance;
    };
    /// The segment nearest to p, the lowest index among equally near ones. Precondition: not empty. Exact.
    Hit nearest(Point p) const;

    /// Calls visit(index) for every segment whose box meets the box; indices come in no stated order.
    template <class Visit>
    void visit(const Box& box, Visit&& visit) const {
        if (nodes_.empty()) return;
        std::uint32_t stack[64];
        int top = 0;
        stack[top++] = 0;
        while (top > 0) {
            const Node& node = nodes_[stack[--top]];
            if (node.box.lo.x > box.hi.x || node.box.hi.x < box.lo.x || node.box.lo.y > box.hi.y ||
                node.box.hi.y < box.lo.y)
                continue;
            if (node.count > 0) {
                for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
                    const Segment& s = segments_[order_[k]];
                    if (std::max(s.a.x, s.b.x) >= box.lo.x && std::min(s.a.x, s.b.x) <= box.hi.x &&
                        std::max(s.a.y, s.b.y) >= box.lo.y && std::min(s.a.y, s.b.y) <= box.hi.y)
                        visit(order_[k]);
                }
            } else {
                stack[top++] = node.first;
                stack[top++] = node.first + 1;
            }
        }
    }

private:
    struct Node {
        Box box;
        std::uint32_t first = 0;  ///< leaf: into order_; inner node: index of the first child, the second follows
        std::uint32_t count = 0;  ///< 0 for inner nodes
    };
    void build(std::uint32_t node, std::uint32_t begin, std::uint32_t end);

    std::vector<Segment> segments_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
};

/// The edges of a region's contours, in order.
std::vector<Segment> edges_of(const Region& region);

}  // namespace ribvault
