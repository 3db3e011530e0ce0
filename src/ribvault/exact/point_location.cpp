#include "ribvault/exact/point_location.hpp"

#include <algorithm>

namespace ribvault {

PointLocation::PointLocation(std::vector<Segment> edges, Unit strip) : edges_(std::move(edges)), strip_(strip) {
    for (const Segment& e : edges_) box_.add(e.a), box_.add(e.b);
    if (edges_.empty()) return;
    const Unit height = box_.hi.y - box_.lo.y;
    strip_ = std::max<Unit>({strip_, 1, height / 4096});
    const std::size_t strips = strip_of(box_.hi.y) + 1;
    starts_.assign(strips + 1, 0);
    const auto span = [&](const Segment& e) {
        return std::pair(strip_of(std::min(e.a.y, e.b.y)), strip_of(std::max(e.a.y, e.b.y)));
    };
    for (const Segment& e : edges_) {
        const auto [lo, hi] = span(e);
        for (std::size_t s = lo; s <= hi; ++s) ++starts_[s + 1];
    }
    for (std::size_t s = 0; s < strips; ++s) starts_[s + 1] += starts_[s];
    members_.resize(starts_.back());
    std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
    for (std::uint32_t i = 0; i < edges_.size(); ++i) {
        const auto [lo, hi] = span(edges_[i]);
        for (std::size_t s = lo; s <= hi; ++s) members_[next[s]++] = i;
    }
}

Side PointLocation::locate(Point p) const {
    if (empty() || p.x < box_.lo.x || p.x > box_.hi.x || p.y < box_.lo.y || p.y > box_.hi.y) return Side::outside;
    int winding = 0;
    const std::size_t strip = strip_of(p.y);
    for (std::uint32_t k = starts_[strip]; k < starts_[strip + 1]; ++k) {
        const Segment& e = edges_[members_[k]];
        if (std::max(e.a.x, e.b.x) < p.x) continue;
        const bool in_x = std::min(e.a.x, e.b.x) <= p.x;
        if (in_x && std::min(e.a.y, e.b.y) <= p.y && std::max(e.a.y, e.b.y) >= p.y && orientation(e.a, e.b, p) == 0)
            return Side::boundary;
        if ((e.a.y <= p.y) == (e.b.y <= p.y)) continue;
        const bool upward = e.a.y <= p.y;
        // The crossing lies to the right of p when p is left of an upward (right of a downward) edge.
        if (!in_x || (upward ? orientation(e.a, e.b, p) > 0 : orientation(e.a, e.b, p) < 0)) winding += upward ? 1 : -1;
    }
    return winding != 0 ? Side::inside : Side::outside;
}

bool PointLocation::edge_meets(const Box& box) const {
    if (empty() || box.lo.x > box_.hi.x || box.hi.x < box_.lo.x || box.lo.y > box_.hi.y || box.hi.y < box_.lo.y)
        return false;
    const std::size_t lo = strip_of(std::max(box.lo.y, box_.lo.y)), hi = strip_of(std::min(box.hi.y, box_.hi.y));
    for (std::uint32_t k = starts_[lo]; k < starts_[hi + 1]; ++k) {
        const Segment& e = edges_[members_[k]];
        if (std::max(e.a.x, e.b.x) < box.lo.x || std::min(e.a.x, e.b.x) > box.hi.x ||
            std::max(e.a.y, e.b.y) < box.lo.y || std::min(e.a.y, e.b.y) > box.hi.y)
            continue;
        const int s0 = orientation(e.a, e.b, box.lo), s1 = orientation(e.a, e.b, box.hi);
        const int s2 = orientation(e.a, e.b, {box.lo.x, box.hi.y}), s3 = orientation(e.a, e.b, {box.hi.x, box.lo.y});
        if (std::max({s0, s1, s2, s3}) >= 0 && std::min({s0, s1, s2, s3}) <= 0) return true;
    }
    return false;
}

}  // namespace ribvault
