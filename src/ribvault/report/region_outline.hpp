// The boundary of an unsupported region as SVG path data.
#pragma once

#include <string>

#include "ribvault/verify/verify_printed.hpp"

namespace ribvault {

/// Closed chains of lines and arcs, in mm, y downwards, rounded to 1 µm. Empty when the boundary was not traced.
std::string outline_data(const UnsupportedRegion& region, const PrintedLayer& upper, const PrintedLayer& lower);

}  // namespace ribvault
