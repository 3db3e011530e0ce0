// What the printer does on one layer: tracks in the order in which they are printed.
#pragma once

#include <vector>

#include "ribvault/settings.hpp"
#include "ribvault/vault/support_forest.hpp"

namespace ribvault {

enum class TrackKind {
    outer_perimeter,
    inner_perimeter,
    cover,
    support,
    external_support,
    thin_wall,  ///< a part of the slice or of the shell narrower than one track, as a track of its own width
    skirt       ///< skirt and brim: beside the object, never among the paths of a layer
};

inline bool is_support(TrackKind kind) { return kind == TrackKind::support || kind == TrackKind::external_support; }

/// One continuous extrusion: centre line on the lattice, material is within width / 2 of it. A single point is a dot, a
/// disc extruded in place.
struct ToolPath {
    TrackKind kind = TrackKind::support;
    Unit width = 0;
    bool closed = false;  ///< the last point joins the first
    std::vector<Point> points;
    bool on_track = false;  ///< one of its ends lies on the centre line of another track: however short, it is no dot
};

/// Where the nozzle stands after printing a path with at least one point.
inline Point end_of(const ToolPath& path) { return path.closed ? path.points.front() : path.points.back(); }

/// Where paths rather begin: at the rear, a little to the left. On a flat back, which is seldom quite parallel to the
/// bed's edge, the rearmost point would jump from one corner to the other between layers.
inline bool more_to_the_rear(Point a, Point b) {
    const Unit far_a = 5 * a.y - 2 * a.x, far_b = 5 * b.y - 2 * b.x;
    return far_a != far_b ? far_a > far_b : a < b;
}

/// Length of a path's centre line in lattice units, the closing segment included.
inline double length(const ToolPath& path) {
    double sum = 0;
    for (std::size_t i = 1; i < path.points.size(); ++i) sum += length(path.points[i] - path.points[i - 1]);
    if (path.closed && path.points.size() > 1) sum += length(path.points.front() - path.points.back());
    return sum;
}

/// Appends a path's centre line segment by segment, the closing one included; a dot is a segment of no length.
inline void append_segments(const ToolPath& path, std::vector<Segment>& segments) {
    const std::vector<Point>& p = path.points;
    if (p.size() == 1) segments.push_back({p[0], p[0]});
    for (std::size_t i = 1; i < p.size(); ++i) segments.push_back({p[i - 1], p[i]});
    if (path.closed && p.size() > 1) segments.push_back({p.back(), p.front()});
}

/// The tracks of layer i in printing order: island by island perimeters, then what they enclose
/// (print/order_paths.hpp).
struct LayerPaths {
    int layer = 0;
    std::vector<ToolPath> paths;
    int gaps = 0;           ///< how many branches stop one track width short of their junction (Section 4.4)
    Unit gap_length = 0;    ///< what these gaps take from the supports' length, in lattice units
    int bends = 0;          ///< places where a support's path takes short branches along (print/bent_path.hpp)
    int thin_places = 0;    ///< places of the slice too narrow for any track: they are not printed
    double thin_area = 0;   ///< their area in square lattice units
    double unfilled_area = 0;  ///< of the shell inside the perimeters between all tracks, the same
};

}  // namespace ribvault
