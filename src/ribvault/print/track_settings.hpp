// How shell and covers are laid out as tracks. Nothing here changes what is proved: cavities and supports.
#pragma once

#include "ribvault/exact/lattice.hpp"

namespace ribvault {

enum class CoverPattern {
    zigzag,      ///< straight lines in both directions, linked along the border wherever that is near
    monotonic,   ///< straight lines, each printed after all that lie before it: an even sheen
    concentric   ///< closed lines along the border
};

/// Where a closed outer perimeter begins and ends.
enum class Seam {
    aligned,  ///< at its rear, a little to the left (the point with the largest 5 y - 2 x), so that the seams of the
              ///< layers lie above each other
    corner,   ///< at its sharpest corner (the rearmost of those alike), where it shows least
    nearest   ///< where the nozzle travels least
};

/// Which strips of the shell between perimeters, covers and cavity, too narrow for a cover, get a track of their own.
enum class GapFill {
    all,
    needed,  ///< what can be seen, and what something printed above stands on (print/gap_strips.hpp)
    none
};

/// Lengths in lattice units.
struct TrackSettings {
    bool inner_first = false;        ///< perimeters from the inside out
    bool alternate = true;           ///< odd layers print their perimeters last: less travel between layers
    CoverPattern covers = CoverPattern::zigzag;
    Seam seam = Seam::aligned;
    bool thin_walls = true;          ///< a track of its own width where the slice is narrower than one track
    /// Slices and cavities are followed within this: 5 µm, far below what a printer resolves. A fifth less time and a
    /// third less G-code on a scanned bunny of 75 000 triangles, and strips on slopes lie more alike from layer to
    /// layer.
    Unit resolution = 500;
    GapFill fill_gaps = GapFill::needed;
    Unit first_layer_width = 0;      ///< of perimeters and covers on layer 0; at least d; 0: d
    int skirt_loops = 0;             ///< around everything on layer 0
    Unit skirt_distance = 300000;    ///< from the object, or its brim, to the skirt
    Unit brim_width = 0;             ///< around every island on layer 0, touching it

    /// Throws Error (usage) naming the first setting that cannot be. `nozzle`: d.
    void check(Unit nozzle) const;
    Unit width_on(int layer, Unit nozzle) const {
        return layer == 0 && first_layer_width > 0 ? first_layer_width : nozzle;
    }
};

}  // namespace ribvault
