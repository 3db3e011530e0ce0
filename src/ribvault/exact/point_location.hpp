// Is a point inside a region? Edges in horizontal strips, exact side tests.
#pragma once

#include <cstdint>
#include <vector>

#include "ribvault/exact/predicates.hpp"

namespace ribvault {

enum class Side { outside, boundary, inside };

/// A region prepared for point location: its edges bucketed into horizontal strips.
class PointLocation {
public:
    PointLocation() = default;
    /// strip: height of a strip; about the spacing of the queries or the edges' length.
    PointLocation(std::vector<Segment> edges, Unit strip);

    /// Where p lies with respect to the region (winding number not zero). Exact.
    Side locate(Point p) const;
    /// Does any edge meet the closed box? Exact.
    bool edge_meets(const Box& box) const;
    const std::vector<Segment>& edges() const { return edges_; }
    const Box& box() const { return box_; }

    /// Calls visit(edge, +1 or -1) for every edge that crosses the horizontal line at y upwards or downwards, in no
    /// stated order.
    template <class Visit>
    void visit_crossings(Unit y, Visit&& visit) const {
        if (empty() || y < box_.lo.y || y > box_.hi.y) return;
        const std::size_t strip = strip_of(y);
        for (std::uint32_t k = starts_[strip]; k < starts_[strip + 1]; ++k) {
            const Segment& e = edges_[members_[k]];
            if ((e.a.y <= y) == (e.b.y <= y)) continue;
            visit(e, e.a.y <= y ? 1 : -1);
        }
    }
    bool empty() const { return edges_.empty(); }

private:
    std::size_t strip_of(Unit y) const { return static_cast<std::size_t>((y - box_.lo.y) / strip_); }
    std::vector<Segment> edges_;
    Box box_;
    Unit strip_ = 1;
    std::vector<std::uint32_t> starts_, members_;
};

}  // namespace ribvault
