// C_i, the empty inside of a slice, and what of it the shell cannot hold up (MODEL: sets).
#pragma once

#include <functional>
#include <optional>

#include "ribvault/settings.hpp"
#include "ribvault/slice/slice.hpp"

namespace ribvault {

/// Slice O_i eroded by p·d, placed on the lattice and never outside the true erosion.
///
/// Straight parts are moved inwards by p·d + 30 nm: rounding the slice's vertices moves its boundary by at most 7.1 nm,
/// rounding the offset's vertices by at most 7.1 nm, and Clipper's own arithmetic by less than one lattice unit. At
/// reflex corners the arc is replaced by tangents (a circumscribed polygon), which keeps more shell, never less.
Region erode_slice(const Slice& slice, const Settings& settings);

/// Intersection of regions on the lattice; crossing points are rounded to it (at most one unit from where they are).
Region intersect(const Region& a, const Region& b);

/// C_i with what the sweep needs to know about it.
struct Cavity {
    int layer = 0;
    Region region;  ///< C_i: the intersection of the eroded slices i - k .. i + k. From here on exact.
    /// Points of C_i farther than about ρ - slack from the shell: a superset of what the shell does not hold up.
    Region deep;
    /// C_i without 30 nm along its boundary: cracks between its contours stay open under Clipper's rounding.
    Region inner;
    bool outside = false;  ///< not C_i but what lies outside O_i within a frame (slice/outside.hpp)
    std::optional<Region> walls;  ///< where centre lines of walls may run, when that is not all of `region`
    bool on_bed = false;  ///< the object holds up no external support: these stand on each other, down to the bed
};
/// The region, pulled in by a few lattice units where its contours cross by a rounding until they do not.
Region uncross(Region region);
/// Crossing contours are uncrossed.
Cavity make_cavity(int layer, Region region, const Settings& settings);

/// The pieces of `hanging` (inside cavity.deep, outside above.inner) that are there not only because `deep` is taken
/// with the slack, each grown by what rounding may have taken away. A piece that looks like one, but of which `indeed`
/// (where given, of its box) says no, stays.
Region without_ties(const Region& hanging, const Cavity& cavity, const Cavity& above, const Settings& settings,
                    const std::function<bool(const Box&)>& indeed = nullptr);

/// Where layer i + 1's shell hangs over cavity i farther than ρ from B_i: a superset of (B_{i+1} ∩ C_i) \ (B_i)^{ρ↑}
/// that exceeds it by less than twice the slack. Slivers thinner than the slack whose boundary is within ρ of the shell
/// (exactly decided: a 45° slope recedes by exactly ρ) are left out.
Region overhang_over_cavity(const Cavity& cavity, const Slice& slice_above, const Cavity& above,
                            const Settings& settings);

}  // namespace ribvault
