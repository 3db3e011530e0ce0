// From the shell B_i to printed tracks: perimeters along the slice's boundary, covers as straight fill.
#pragma once

#include "ribvault/print/tool_path.hpp"
#include "ribvault/slice/slice.hpp"

namespace ribvault {

/// Appends the tracks of B_i = O_i \ C_i to a layer, perimeters first.
///
/// Perimeters: closed tracks of width d = `settings.nozzle` whose centre lines run at distance (j + 1/2) d inside O_i
/// (`slice.rounded`), j = 0 .. p - 1, the outermost first; corners are mitred up to twice the distance. A track starts
/// at its rearmost point (largest y, then smallest x), and tracks of equal j follow each other by nearest start.
///
/// Covers: what the perimeters and the cavity C_i (`cavity`) leave of O_i is filled with straight tracks of width d, d
/// apart, at 45° on even layers and at 135° on odd ones, linked where the way along the border is at most 2 d. Their
/// centre lines keep d / 2 from the border of this area, so that their material stays in it.
///
/// Places narrower than d (2 p d for all p perimeters together) have no room for a track and get none; neither are
/// tracks printed that are shorter than d / 2.
/// Postcondition: centre lines of perimeters and covers lie at least d / 2 inside O_i, but for two lattice units
/// (20 nm) of rounding; the same holds for covers and the complement of the cavity.
void append_shell_paths(const Slice& slice, const Region& cavity, const Settings& settings, LayerPaths& layer);

}  // namespace ribvault
