// Clipper on lattice regions: proposals for what is ours to place; nothing here decides.
#pragma once

#include <polyclipping/clipper.hpp>

#include "ribvault/exact/lattice.hpp"

namespace ribvault {

inline ClipperLib::Path to_clipper(const Contour& contour) {
    ClipperLib::Path path;
    path.reserve(contour.size());
    for (Point p : contour) path.emplace_back(p.x, p.y);
    return path;
}
inline ClipperLib::Paths to_clipper(const Region& region) {
    ClipperLib::Paths paths;
    paths.reserve(region.size());
    for (const Contour& c : region) paths.push_back(to_clipper(c));
    return paths;
}
inline Region from_clipper(const ClipperLib::Paths& paths) {
    Region region;
    region.reserve(paths.size());
    for (const ClipperLib::Path& path : paths) {
        Contour contour;
        contour.reserve(path.size());
        for (const ClipperLib::IntPoint& p : path) contour.push_back({p.X, p.Y});
        if (contour.size() >= 3) region.push_back(std::move(contour));
    }
    return region;
}

/// Boolean operation with the non-zero rule on both operands; the result as ClipperLib::Paths or PolyTree.
template <class Result>
Result clip_as(ClipperLib::ClipType operation, const Region& subject, const Region& clip) {
    ClipperLib::Clipper clipper;
    clipper.AddPaths(to_clipper(subject), ClipperLib::ptSubject, true);
    clipper.AddPaths(to_clipper(clip), ClipperLib::ptClip, true);
    Result result;
    clipper.Execute(operation, result, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
    return result;
}
inline Region clip(ClipperLib::ClipType operation, const Region& subject, const Region& clip) {
    return from_clipper(clip_as<ClipperLib::Paths>(operation, subject, clip));
}

/// The connected pieces of the result, each an outer contour followed by its holes.
inline std::vector<Region> clip_to_pieces(ClipperLib::ClipType operation, const Region& subject, const Region& clip) {
    const auto tree = clip_as<ClipperLib::PolyTree>(operation, subject, clip);
    std::vector<Region> pieces;
    for (const ClipperLib::PolyNode* node = tree.GetFirst(); node; node = node->GetNext()) {
        if (node->IsHole()) continue;
        ClipperLib::Paths paths{node->Contour};
        for (const ClipperLib::PolyNode* hole : node->Childs) paths.push_back(hole->Contour);
        pieces.push_back(from_clipper(paths));
    }
    return pieces;
}
inline std::vector<Region> connected_pieces(const Region& region) {
    return clip_to_pieces(ClipperLib::ctUnion, region, {});
}

/// Lattice units that rounding may take away: see erode_slice.
inline constexpr double clip_rounding = 3;

/// What lies within `distance` of open polylines (of points, where one has no length), round ends and corners made of
/// chords at most `arc_tolerance` units inside the arc.
inline Region offset_lines(const std::vector<Contour>& lines, double distance, double arc_tolerance) {
    ClipperLib::ClipperOffset offsetter(2.0, arc_tolerance);
    for (const Contour& line : lines)
        offsetter.AddPath(to_clipper(line), ClipperLib::jtRound, ClipperLib::etOpenRound);
    ClipperLib::Paths around;
    offsetter.Execute(around, distance);
    return from_clipper(around);
}
inline Region offset(const std::vector<Segment>& lines, double distance, double arc_tolerance) {
    std::vector<Contour> each;
    each.reserve(lines.size());
    for (const Segment& s : lines) each.push_back({s.a, s.b});
    return offset_lines(each, distance, arc_tolerance);
}

/// Region moved outwards (delta > 0) or inwards (delta < 0) by |delta| units. Mitres reach at most `mitre_limit` times
/// as far; corners that need more are cut.
inline Region offset(const Region& region, double delta, ClipperLib::JoinType join = ClipperLib::jtSquare,
                     double arc_tolerance = 25, double mitre_limit = 2) {
    ClipperLib::ClipperOffset offsetter(mitre_limit, arc_tolerance);
    offsetter.AddPaths(to_clipper(region), join, ClipperLib::etClosedPolygon);
    ClipperLib::Paths result;
    offsetter.Execute(result, delta);
    return from_clipper(result);
}

/// Dilation by a distance in lattice units, erosion by a negative one. Mitres keep at least this distance everywhere.
inline Region mitred(const Region& region, double distance) { return offset(region, distance, ClipperLib::jtMiter); }

}  // namespace ribvault
