// Segments sorted into horizontal rows, to find those near a point or a move fast.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "ribvault/exact/lattice.hpp"

namespace ribvault {

class SegmentRows {
public:
    SegmentRows() = default;
    /// Every segment is entered in all rows that come within `margin` (0 or more) of it.
    explicit SegmentRows(const std::vector<Segment>& segments, Unit margin = 0) {
        Box box;
        for (const Segment& s : segments) box.add(s.a), box.add(s.b);
        if (segments.empty()) return;
        box.grow(margin);
        const auto most_rows = std::clamp<Unit>(static_cast<Unit>(segments.size()), 1, 512);
        bottom_ = box.lo.y;
        height_ = std::max((box.hi.y - box.lo.y) / most_rows, margin) + 1;
        rows_.resize(static_cast<std::size_t>((box.hi.y - box.lo.y) / height_ + 1));
        for (const Segment& s : segments) {
            const auto [lo, hi] = std::minmax(s.a.y, s.b.y);
            const Unit last = (hi + margin - bottom_) / height_;
            for (Unit row = (lo - margin - bottom_) / height_; row <= last; ++row)
                rows_[static_cast<std::size_t>(row)].push_back(s);
        }
    }

    /// Calls visit(segment) for the segments of all rows that meet lo .. hi, some of them several times; stops and
    /// returns true when it does.
    template <class Visit>
    bool any(Unit lo, Unit hi, Visit&& visit) const {
        const auto count = static_cast<Unit>(rows_.size());
        if (count == 0 || hi < bottom_ || lo >= bottom_ + count * height_) return false;
        const Unit first = std::max<Unit>(0, (lo - bottom_) / height_),
                   last = std::min((hi - bottom_) / height_, count - 1);
        for (Unit row = lo < bottom_ ? 0 : first; row <= last; ++row)
            for (const Segment& s : rows_[static_cast<std::size_t>(row)])
                if (visit(s)) return true;
        return false;
    }

    /// How often contours whose edges the segments are wind around a place; rounded at edges.
    int winding(double x, double y) const {
        int times = 0;
        const auto row = static_cast<Unit>(std::floor(y));
        any(row, row, [&](const Segment& s) {
            const auto ay = static_cast<double>(s.a.y), by = static_cast<double>(s.b.y);
            if ((ay <= y) == (by <= y)) return false;
            const double at = static_cast<double>(s.a.x) + (y - ay) * static_cast<double>(s.b.x - s.a.x) / (by - ay);
            if (at > x) times += by > ay ? 1 : -1;
            return false;
        });
        return times;
    }

private:
    Unit bottom_ = 0, height_ = 1;  ///< y of the lowest row's lower side; the height of a row
    std::vector<std::vector<Segment>> rows_;
};

}  // namespace ribvault
