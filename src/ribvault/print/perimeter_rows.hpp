// Which points lie close to a perimeter, answered fast: for the prime surplus of Section 5.1.
#pragma once

#include "ribvault/print/segment_rows.hpp"
#include "ribvault/print/tool_path.hpp"

namespace ribvault {

/// The perimeters and thin walls of a layer: what is seen from outside.
class PerimeterRows {
public:
    /// `clearance` in lattice units, 0 or more. Keeps no reference to the layer.
    PerimeterRows(const LayerPaths& layer, Unit clearance);

    /// Whether the centre line of one passes within the clearance of p.
    bool near(Point p) const;

private:
    Unit clearance_;
    SegmentRows rows_;
};

}  // namespace ribvault
