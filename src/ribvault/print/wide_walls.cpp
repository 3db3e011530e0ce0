#include "ribvault/print/wide_walls.hpp"

#include <algorithm>

#include "ribvault/exact/nearest_segment.hpp"
#include "ribvault/exact/point_location.hpp"
#include "ribvault/slice/lattice_clip.hpp"

namespace ribvault {
namespace {

namespace cl = ClipperLib;

constexpr double arc_tolerance = 100;  ///< lattice units

std::vector<Segment> wide_lines(const SupportForest& forest) {
    std::vector<Segment> lines;
    for (auto [e, end] = edges(forest); e != end; ++e)
        if (forest[source(*e, forest)].wide)
            lines.push_back({forest[source(*e, forest)].at, forest[target(*e, forest)].at});
    for (auto [v, end] = vertices(forest); v != end; ++v)
        if (forest[*v].wide && out_degree(*v, forest) == 0) lines.push_back({forest[*v].at, forest[*v].at});
    return lines;
}

void append(Contour line, bool closed, Unit width, LayerPlan& plan) {
    ToolPath path{TrackKind::support, width, closed, std::move(line)};
    if (2 * length(path) < static_cast<double>(width)) return;
    plan.tracks.push_back({{std::move(path)}, closed ? Entry::anywhere : Entry::either_end, no_stop});
}

/// What of an outline lies inside the cavity.
void append_outline(Contour outline, const Region& cavity, const PointLocation& location, Unit width, LayerPlan& plan) {
    const auto outside =
        std::find_if(outline.begin(), outline.end(), [&](Point p) { return location.locate(p) != Side::inside; });
    const bool starts_outside = outside != outline.end();
    if (starts_outside) std::rotate(outline.begin(), outside, outline.end());
    cl::Path walk = to_clipper(outline);
    walk.push_back(walk.front());
    cl::Clipper clipper;
    clipper.AddPath(walk, cl::ptSubject, false);
    clipper.AddPaths(to_clipper(cavity), cl::ptClip, true);
    cl::PolyTree pieces;
    clipper.Execute(cl::ctIntersection, pieces, cl::pftNonZero, cl::pftNonZero);
    cl::Paths lines;
    cl::OpenPathsFromPolyTree(pieces, lines);
    const bool whole = !starts_outside && lines.size() == 1 && lines.front().size() >= walk.size();
    if (whole) return append(std::move(outline), true, width, plan);
    for (const cl::Path& line : lines) {
        Contour points;
        for (const cl::IntPoint& p : line) points.push_back({p.X, p.Y});
        append(std::move(points), false, width, plan);
    }
}

}  // namespace

void append_wide_walls(const SupportForest& forest, const Region& cavity, const Settings& settings, LayerPlan& plan) {
    if (settings.wall_lines < 2) return;
    const std::vector<Segment> lines = wide_lines(forest);
    if (lines.empty()) return;
    const PointLocation location(edges_of(cavity), units_per_mm);
    for (int twice = settings.wall_lines - 1; twice > 0; twice -= 2)
        for (Contour& outline : offset(lines, 0.5 * twice * static_cast<double>(settings.nozzle), arc_tolerance))
            append_outline(std::move(outline), cavity, location, settings.nozzle, plan);
}

}  // namespace ribvault
