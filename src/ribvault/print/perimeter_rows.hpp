// Which points lie close to a perimeter, answered fast: for the prime surplus of Section 5.1.
#pragma once

#include <vector>

#include "ribvault/print/tool_path.hpp"

namespace ribvault {

/// The perimeters of a layer, their segments sorted into horizontal rows.
class PerimeterRows {
public:
    /// `clearance` in lattice units, 0 or more. Keeps no reference to the layer.
    PerimeterRows(const LayerPaths& layer, Unit clearance);

    /// Whether a perimeter's centre line passes within the clearance of p.
    bool near(Point p) const;

private:
    Unit clearance_;
    Unit bottom_ = 0;      ///< y of the lowest row's lower side
    Unit row_height_ = 1;
    std::vector<std::vector<Segment>> rows_;  ///< segments that come within the clearance of a row
};

}  // namespace ribvault
