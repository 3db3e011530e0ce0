// The tracks of one layer before they have an order, and what their order must respect.
#pragma once

#include "ribvault/print/short_tour.hpp"
#include "ribvault/print/tool_path.hpp"

namespace ribvault {

/// A track that is printed without a stop: one path, or, where the width varies, several that follow each other end to
/// end.
struct PlannedTrack {
    std::vector<ToolPath> paths;      ///< at least one; all of one stage (print/order_paths.hpp)
    Entry entry = Entry::fixed;       ///< where the nozzle may enter it
    std::size_t after = no_stop;  ///< the track of the plan, of the same stage and island, that must be printed earlier
};

/// What a track fills, about: length by width. Square lattice units.
inline double area_of(const PlannedTrack& track) {
    double area = 0;
    for (const ToolPath& path : track.paths) area += length(path) * static_cast<double>(path.width);
    return area;
}

/// All tracks of layer i. print/order_paths.hpp makes LayerPaths of it.
struct LayerPlan {
    int layer = 0;
    std::vector<PlannedTrack> tracks;
    /// Tracks of the shell that are printed only as far as something stands on them (print/gap_strips.hpp). Their area
    /// counts as unfilled.
    std::vector<PlannedTrack> spare;
    int gaps = 0;
    Unit gap_length = 0;
    int bends = 0;            ///< places where a support's path takes short branches along (print/bent_path.hpp)
    int thin_places = 0;      ///< places of the slice too narrow for any track
    double thin_area = 0;     ///< their area in square lattice units
    double unfilled_area = 0;  ///< of the shell inside the perimeters between all tracks, the same
};

/// The centre lines of all tracks of a kind.
inline std::vector<Segment> segments_of(const LayerPlan& plan, TrackKind kind) {
    std::vector<Segment> segments;
    for (const PlannedTrack& track : plan.tracks)
        for (const ToolPath& path : track.paths)
            if (path.kind == kind) append_segments(path, segments);
    return segments;
}

}  // namespace ribvault
