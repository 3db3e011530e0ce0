// Pictures of layers: shell, tracks with their true width, and what the supports are made of.
#pragma once

#include <string>

#include "ribvault/settings.hpp"
#include "ribvault/slice/slice.hpp"
#include "ribvault/vault/support_forest.hpp"

namespace ribvault {

/// One layer drawn, with what its caption says.
struct LayerDrawing {
    int layer = 0;
    double z_mm = 0;               ///< z_i, the plane of the slice
    double support_length_mm = 0;  ///< centre lines
    int roots = 0;                 ///< with a track
    int junctions = 0;             ///< valence 3 or more, roots among them
    int tips = 0;                  ///< valence 1, no root
    int dots = 0;                  ///< isolated vertices
    bool overhang = false;         ///< what overhangs outside is drawn
    Box box;                       ///< what the drawing covers, lattice units, y upwards
    std::string marks;             ///< SVG elements, in mm, y downwards (the bed's y is negated)
};

/// Draws layer i. The shell B_i (slice without cavity) is grey; every wall of S_i has the width in which it is printed
/// (wall_width), with round ends and the wall's centre line, on which no track runs where there is an even number of
/// them. What several tracks side by side make up ends with the cavity, as these tracks do. Roots are blue squares,
/// junctions (valence 3 or more) orange discs, tips black triangles, dots (isolated vertices) purple diamonds. A root
/// that is a junction has both marks. `unsupported`, what of layer i + 1 had no support before S_i grew, is translucent
/// vermilion; it may be empty. Marks differ in shape, and the colours are told apart without red and green (Okabe and
/// Ito's palette). With `below`, the slice of layer i - 1, what of this one lies farther than ρ from it is green: it
/// overhangs outside. Precondition: the cavity lies inside the slice. Coordinates are rounded to 1 µm.
LayerDrawing draw_layer(const Slice& slice, const Region& cavity, const SupportForest& forest,
                        const Region& unsupported, const Settings& settings, const Slice* below = nullptr);

/// One layer as an SVG file with a scale bar, a legend and a caption; one unit is one mm.
std::string layer_svg(const LayerDrawing& drawing);
std::string layer_svg(const Slice& slice, const Region& cavity, const SupportForest& forest, const Region& unsupported,
                      const Settings& settings, const Slice* below = nullptr);

}  // namespace ribvault
