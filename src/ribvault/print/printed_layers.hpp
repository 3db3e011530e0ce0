// Layers as read, as the verifier wants them.
#pragma once

#include <vector>

#include "ribvault/print/gcode_print.hpp"
#include "ribvault/verify/printed_layer.hpp"

namespace ribvault {

/// An entry of print.layers, to be held up: one track for each of its tracks, in their order. A chord is as much wider
/// as its arc may lie beside it (arc_bound_mm), so that it contains the arc's material.
PrintedLayer layer_above(const GcodePrint& print, std::size_t entry);

/// The material directly below it: all tracks of its `below`, whatever feature they belong to. A chord is as much
/// narrower. `outline` is set as outline_tracks says.
PrintedLayer material_below(const GcodePrint& print, std::size_t entry);

/// An entry as what holds others up; chords are as much narrower.
PrintedLayer layer_below(const GcodePrint& print, std::size_t entry);

/// Per track of the entry: 1 when it is part of a closed loop of outer perimeter (GcodeFeature::outer_wall), which
/// bounds the object: tracks that follow each other without a travel and end exactly where they began.
std::vector<char> outline_tracks(const std::vector<GcodeFeature>& features, const GcodeLayer& layer);

/// Whether outline_tracks bounds all that it should.
struct OutlineState {
    bool loops = false;      ///< there are some
    bool left_open = false;  ///< a path of outer perimeter ends within its width of where it begins but not there, as
                             ///< some slicers leave loops open at the seam
    bool whole() const { return loops && !left_open; }
    OutlineState& operator+=(const OutlineState& more) {
        loops = loops || more.loops, left_open = left_open || more.left_open;
        return *this;
    }
};
OutlineState outline_state(const std::vector<GcodeFeature>& features, const GcodeLayer& layer);

/// Per track of the entry: 1 when it goes on where the track before it ended, without a travel.
std::vector<char> continued_tracks(const GcodeLayer& layer);

}  // namespace ribvault
