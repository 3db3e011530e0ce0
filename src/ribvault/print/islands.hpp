// The separate pieces of a slice.
#pragma once

#include <vector>

#include "ribvault/exact/lattice.hpp"

namespace ribvault {

/// The connected pieces ("islands") of a region whose contours do not cross.
class Islands {
public:
    /// `region`: outer contours counter-clockwise, holes clockwise. Must outlive this object.
    explicit Islands(const Region& region);

    /// How many; 1 when the region is empty.
    std::size_t size() const { return outer_.empty() ? 1 : outer_.size(); }

    /// Number of the island whose outer contour is the innermost around p; 0 when there is none.
    std::size_t of(Point p) const;

private:
    struct Outer {
        const Contour* contour;
        Box box;
        double area;
    };
    std::vector<Outer> outer_;
};

}  // namespace ribvault
