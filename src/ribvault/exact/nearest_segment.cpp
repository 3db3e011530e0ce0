#include "ribvault/exact/nearest_segment.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace ribvault {
namespace {

constexpr std::uint32_t leaf_size = 4;

}  // namespace

NearestSegment::NearestSegment(std::vector<Segment> segments)
    : segments_(std::move(segments)), order_(segments_.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    if (segments_.empty()) return;
    nodes_.reserve(segments_.size());
    nodes_.emplace_back();
    build(0, 0, static_cast<std::uint32_t>(segments_.size()));
}

void NearestSegment::build(std::uint32_t node, std::uint32_t begin, std::uint32_t end) {
    Box box, centres;
    for (std::uint32_t k = begin; k < end; ++k) {
        const Segment& s = segments_[order_[k]];
        box.add(s.a), box.add(s.b);
        centres.add(s.a + s.b);
    }
    nodes_[node].box = box;
    if (end - begin <= leaf_size) {
        nodes_[node].first = begin;
        nodes_[node].count = end - begin;
        return;
    }
    const bool by_x = centres.hi.x - centres.lo.x >= centres.hi.y - centres.lo.y;
    const std::uint32_t middle = begin + (end - begin) / 2;
    std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                     [&](std::uint32_t i, std::uint32_t j) {
                         const Point p = segments_[i].a + segments_[i].b, q = segments_[j].a + segments_[j].b;
                         const Unit u = by_x ? p.x : p.y, v = by_x ? q.x : q.y;
                         return u != v ? u < v : i < j;
                     });
    const auto child = static_cast<std::uint32_t>(nodes_.size());
    nodes_[node].first = child;
    nodes_.resize(nodes_.size() + 2);
    build(child, begin, middle);
    build(child + 1, middle, end);
}

NearestSegment::Hit NearestSegment::nearest(Point p) const {
    Hit best{0, {0, 1}};
    bool found = false;
    double best_value = std::numeric_limits<double>::infinity();  // an upper bound of the best squared distance
    struct Entry {
        double bound;
        std::uint32_t node;
    };
    Entry stack[64];
    int top = 0;
    stack[top++] = {squared_distance_below(p, nodes_[0].box), 0};
    while (top > 0) {
        const Entry entry = stack[--top];
        if (entry.bound > best_value) continue;
        const Node& node = nodes_[entry.node];
        if (node.count > 0) {
            for (std::uint32_t k = node.first; k < node.first + node.count; ++k) {
                const std::uint32_t index = order_[k];
                const SquaredDistance d = squared_distance(p, segments_[index]);
                const int order = found ? compare(d, best.distance) : -1;
                if (order < 0 || (order == 0 && index < best.index)) {
                    best = {index, d};
                    found = true;
                    best_value = d.value() * (1 + 0x1p-50);
                }
            }
            continue;
        }
        Entry near{squared_distance_below(p, nodes_[node.first].box), node.first};
        Entry far{squared_distance_below(p, nodes_[node.first + 1].box), node.first + 1};
        if (far.bound < near.bound) std::swap(near, far);
        stack[top++] = far;
        stack[top++] = near;
    }
    return best;
}

std::vector<Segment> edges_of(const Region& region) {
    std::vector<Segment> edges;
    std::size_t n = 0;
    for (const Contour& c : region) n += c.size();
    edges.reserve(n);
    for (const Contour& c : region)
        for (std::size_t i = 0; i < c.size(); ++i) edges.push_back({c[i], c[i + 1 == c.size() ? 0 : i + 1]});
    return edges;
}

}  // namespace ribvault
