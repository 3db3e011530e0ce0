// A printed layer as the verifier sees it: tracks with exact coordinates and their own widths, and nothing else. Light.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "ribvault/exact/millimetres.hpp"

namespace ribvault {

using PrintedPoint = std::array<Millimetres, 2>;
inline std::array<Rational, 2> rational(const PrintedPoint& p) { return {Rational(p[0]), Rational(p[1])}; }

/// A straight extrusion: the stadium of width `width` around the segment a-b, closed. mm, exact.
struct PrintedTrack {
    PrintedPoint a, b;      ///< ends of the centre line; a == b: a dot
    Millimetres width;      ///< > 0
    int feature = 0;        ///< index of a feature type, the reader's business
    std::int64_t line = 0;  ///< line of the file
    bool outline = false;   ///< a side of a closed loop that bounds the object (verify/outside_outline.hpp)
};

/// The extrusions of one height. The material of the layer is the union of their stadiums.
struct PrintedLayer {
    std::vector<PrintedTrack> tracks;
};

}  // namespace ribvault
