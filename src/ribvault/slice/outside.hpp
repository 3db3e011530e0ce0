// Where external supports may stand: what lies outside a slice, as a cavity like any other (Section 6).
#pragma once

#include "ribvault/slice/cavity.hpp"

namespace ribvault {

/// What lies outside O_i within `frame`, a box that the object does not reach, as the sweep needs it. Its region
/// overlaps the true slice by 30 nm, more than all roundings together, so a root on its boundary is in the slice;
/// `deep` is what the object does not hold up. Where walls must keep off the object, `walls` is for the caller to set.
Cavity make_outside(const Slice& slice, const Box& frame, const Settings& settings);

/// What centre lines that keep a removal gap off all these slices have left of `frame`: it lies farther than g + r from
/// the true slices, arcs at their corners circumscribed, and at most 4 um farther.
Region off_the_object(const std::vector<std::shared_ptr<const Slice>>& slices, const Box& frame,
                      const Settings& settings);

/// Where the shell of layer i + 1 hangs over `outside`, what lies outside O_i, farther than ρ from B_i: what
/// overhang_over_cavity is for cavities. `outside_above` lies outside O_{i+1}; `cavity_above` is C_{i+1}. The slices
/// are rounded there; what seems to recede by exactly ρ is held against the exact ones where they are given (nullptr:
/// it is believed).
Region overhang_outside(const Cavity& outside, const Cavity& outside_above, const Cavity& cavity_above,
                        const Settings& settings, const Slice* slice = nullptr, const Slice* slice_above = nullptr);

}  // namespace ribvault
