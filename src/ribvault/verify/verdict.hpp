// What the verifier says of one pair of layers. Light: reports and pictures read it.
#pragma once

#include <array>
#include <cmath>
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

/// Bounds of sums: below and above a + b for a, b >= 0, and a + b where one of them is 0.
inline double sum_down(double a, double b) { return a == 0 || b == 0 ? a + b : std::nextafter(a + b, 0.0); }
inline double sum_up(double a, double b) { return a == 0 || b == 0 ? a + b : std::nextafter(a + b, HUGE_VAL); }

/// A number >= 0 known to lie between two bounds.
struct Enclosure {
    double lo = 0, hi = 0;
    double middle() const { return (lo + hi) / 2; }
    Enclosure& operator+=(const Enclosure& o) {
        lo = sum_down(lo, o.lo), hi = sum_up(hi, o.hi);
        return *this;
    }
    friend bool operator==(const Enclosure&, const Enclosure&) = default;
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
    Enclosure unsupported_mm;                    ///< of the length of centre lines that violate (1) inside the outline
    Enclosure external_mm;                       ///< the same outside it
    bool external_hangs = false;                 ///< a centre line outside it violates (1), or a dot's centre does
    std::array<double, 2> place{0, 0};           ///< near something unsupported, mm
    StageCounts stages;
};

/// Equation (2) for layers i (upper) and i - 1 (below).
struct LayerVerdict {
    int layer = 0;                           ///< the upper layer, i
    bool supported = false;  ///< proved, of what supports can hold up: without external ones all but external
                             ///< overhangs, with such all (verify/verify_layer.hpp)
    std::string malformed;  ///< why (2) has no meaning here (a cavity not inside its slice), which support breaks the
                            ///< removal gap, or empty
    std::optional<Unsupported> internal;  ///< refuted: what supports should have held up
    std::optional<Unsupported> external;  ///< farther than ρ from O_{i-1} where no external supports are asked for
    StageCounts stages;
};

}  // namespace ribvault
