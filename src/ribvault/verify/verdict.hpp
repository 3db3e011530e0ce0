// What the verifier says of one pair of layers. Light: reports and pictures read it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace ribvault {

/// How often each stage of the verifier's predicates decided. A decision is one candidate point, or one cell of the
/// subdivision settled as a whole; it counts for the highest stage that it needed (docs/verifier.md).
struct StageCounts {
    std::uint64_t interval = 0;  ///< machine arithmetic with certified bounds
    std::uint64_t rational = 0;  ///< exact rational arithmetic
    std::uint64_t algebraic = 0; ///< exact numbers with square roots
    StageCounts& operator+=(const StageCounts& o) {
        interval += o.interval, rational += o.rational, algebraic += o.algebraic;
        return *this;
    }
};

/// A region of the upper layer with no material within ρ below.
struct Unsupported {
    double area_lo = 0, area_hi = 0;         ///< mm², enclosure of the region's area
    std::array<double, 2> witness{0, 0};     ///< mm; a point of the region (binary floats, exactly this point)
    bool witness_certified = true;           ///< false when only an approximate place could be given
    double witness_distance = 0;             ///< mm to the nearest material below, rounded down
};

/// Equation (2) for the print: every point of what is extruded on layer i + 1, inside the outline of layer i, has
/// material extruded on layer i within ρ (verify/outside_outline.hpp).
struct PrintVerdict {
    bool supported = true;
    std::array<double, 2> unsupported_mm{
        0, 0};  ///< enclosure of the length of centre lines that violate (1) inside the outline
    std::array<double, 2> external_mm{0, 0};     ///< the same outside it
    bool external_hangs = false;                 ///< a centre line outside it violates (1), or a dot's centre does
    std::array<double, 2> place{0, 0};           ///< near something unsupported, mm
    StageCounts stages;
};

/// Equation (2) for layers i (upper) and i - 1 (below).
struct LayerVerdict {
    int layer = 0;                           ///< the upper layer, i
    bool supported = false;                  ///< proved: BS_i minus external overhangs lies within ρ of BS_{i-1}
    std::string malformed;  ///< why (2) has no meaning here (a cavity not inside its slice), which support breaks the
                            ///< removal gap, or empty
    std::optional<Unsupported> internal;     ///< refuted: what internal supports should have held up
    std::optional<Unsupported> external;     ///< farther than ρ from O_{i-1}: outside what internal supports can reach
    StageCounts stages;
};

}  // namespace ribvault
