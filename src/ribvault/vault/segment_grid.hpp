// A uniform grid over the segments of one layer's supports, which grow while they are searched.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "ribvault/exact/lattice.hpp"

namespace ribvault {

/// Each segment is entered in every cell that lies within `reach` of it (a cell may be entered needlessly, never
/// missed).
class SegmentGrid {
public:
    SegmentGrid(const Box& box, Unit cell, Unit reach)
        : lo_(box.lo), cell_(cell), reach_(reach), nx_(columns(box.hi.x - box.lo.x)), ny_(columns(box.hi.y - box.lo.y)),
          heads_(static_cast<std::size_t>(nx_ * ny_), -1) {}

    void insert(std::uint32_t id, const Segment& s) {
        const Unit x0 = column(std::min(s.a.x, s.b.x) - reach_, lo_.x, nx_),
                   x1 = column(std::max(s.a.x, s.b.x) + reach_, lo_.x, nx_);
        const Unit y0 = column(std::min(s.a.y, s.b.y) - reach_, lo_.y, ny_),
                   y1 = column(std::max(s.a.y, s.b.y) + reach_, lo_.y, ny_);
        const double dx = static_cast<double>(s.b.x - s.a.x), dy = static_cast<double>(s.b.y - s.a.y);
        const double l = std::hypot(dx, dy);
        // A cell farther from the segment's line than reach and half its diagonal cannot hold a point within reach.
        const double far = (static_cast<double>(reach_) + 0.7072 * static_cast<double>(cell_)) * l + 1;
        for (Unit y = y0; y <= y1; ++y)
            for (Unit x = x0; x <= x1; ++x) {
                const double cx = static_cast<double>(lo_.x + x * cell_ + cell_ / 2 - s.a.x);
                const double cy = static_cast<double>(lo_.y + y * cell_ + cell_ / 2 - s.a.y);
                const bool rim = x == 0 || y == 0 || x == nx_ - 1 || y == ny_ - 1;  // takes what lies outside the box
                if (!rim && std::fabs(dx * cy - dy * cx) > far) continue;
                std::int32_t& head = heads_[static_cast<std::size_t>(y * nx_ + x)];
                nodes_.push_back({id, head});
                head = static_cast<std::int32_t>(nodes_.size()) - 1;
            }
    }

    /// Calls visit(id) for every segment within reach of p (and some farther ones); stops when it returns true.
    template <class Visit>
    bool any_near(Point p, Visit&& visit) const {
        for (std::int32_t k = heads_[index(p)]; k >= 0; k = nodes_[static_cast<std::size_t>(k)].next)
            if (visit(nodes_[static_cast<std::size_t>(k)].id)) return true;
        return false;
    }

    /// Calls visit(id) for every segment within reach of the box, some of them several times.
    template <class Visit>
    void visit(const Box& box, Visit&& visit) const {
        const Unit x0 = column(box.lo.x, lo_.x, nx_), x1 = column(box.hi.x, lo_.x, nx_);
        const Unit y0 = column(box.lo.y, lo_.y, ny_), y1 = column(box.hi.y, lo_.y, ny_);
        for (Unit y = y0; y <= y1; ++y)
            for (Unit x = x0; x <= x1; ++x)
                for (std::int32_t k = heads_[static_cast<std::size_t>(y * nx_ + x)]; k >= 0;
                     k = nodes_[static_cast<std::size_t>(k)].next)
                    visit(nodes_[static_cast<std::size_t>(k)].id);
    }

private:
    struct Node {
        std::uint32_t id;
        std::int32_t next;
    };
    Unit columns(Unit extent) const { return std::max<Unit>(1, extent / cell_ + 1); }
    Unit column(Unit v, Unit lo, Unit n) const { return std::clamp<Unit>((v - lo) / cell_, 0, n - 1); }
    std::size_t index(Point p) const {
        return static_cast<std::size_t>(column(p.y, lo_.y, ny_) * nx_ + column(p.x, lo_.x, nx_));
    }

    Point lo_;
    Unit cell_, reach_, nx_, ny_;
    std::vector<std::int32_t> heads_;
    std::vector<Node> nodes_;
};

}  // namespace ribvault
