#include "ribvault/print/wide_walls.hpp"

#include <algorithm>

#include "ribvault/slice/lattice_clip.hpp"

namespace ribvault {
namespace {

namespace cl = ClipperLib;

constexpr double arc_tolerance = 100;  ///< lattice units

cl::Paths centre_lines(const SupportForest& forest) {
    cl::Paths lines;
    const auto at = [&](std::size_t v) { return cl::IntPoint(forest[v].at.x, forest[v].at.y); };
    for (auto [e, end] = edges(forest); e != end; ++e)
        if (forest[source(*e, forest)].wide) lines.push_back({at(source(*e, forest)), at(target(*e, forest))});
    for (auto [v, end] = vertices(forest); v != end; ++v)
        if (forest[*v].wide && out_degree(*v, forest) == 0) lines.push_back({at(*v)});
    return lines;
}

bool inside(const cl::IntPoint& p, const cl::Paths& region) {
    int winding = 0;
    for (const cl::Path& contour : region)
        if (cl::PointInPolygon(p, contour) != 0) winding += cl::Orientation(contour) ? 1 : -1;
    return winding > 0;
}

void append(const cl::Path& line, bool closed, Unit width, LayerPlan& plan) {
    ToolPath path{TrackKind::support, width, closed, {}};
    for (const cl::IntPoint& p : line) path.points.push_back({p.X, p.Y});
    if (2 * length(path) < static_cast<double>(width)) return;
    plan.tracks.push_back({{std::move(path)}, closed ? Entry::anywhere : Entry::either_end, no_stop});
}

/// What of an outline lies inside the cavity.
void append_outline(cl::Path outline, const cl::Paths& cavity, Unit width, LayerPlan& plan) {
    const auto outside = std::find_if(outline.begin(), outline.end(), [&](const cl::IntPoint& p) { return !inside(p, cavity); });
    const bool starts_outside = outside != outline.end();
    if (starts_outside) std::rotate(outline.begin(), outside, outline.end());
    cl::Path walk = outline;
    walk.push_back(outline.front());
    cl::Clipper clipper;
    clipper.AddPath(walk, cl::ptSubject, false);
    clipper.AddPaths(cavity, cl::ptClip, true);
    cl::PolyTree pieces;
    clipper.Execute(cl::ctIntersection, pieces, cl::pftNonZero, cl::pftNonZero);
    cl::Paths lines;
    cl::OpenPathsFromPolyTree(pieces, lines);
    const bool whole = !starts_outside && lines.size() == 1 && lines.front().size() >= walk.size();
    if (whole) return append(outline, true, width, plan);
    for (const cl::Path& line : lines) append(line, false, width, plan);
}

}  // namespace

void append_wide_walls(const SupportForest& forest, const Region& cavity, const Settings& settings, LayerPlan& plan) {
    if (settings.wall_lines < 2) return;
    const cl::Paths lines = centre_lines(forest);
    if (lines.empty()) return;
    const cl::Paths region = to_clipper(cavity);
    cl::ClipperOffset offsetter(2.0, arc_tolerance);
    offsetter.AddPaths(lines, cl::jtRound, cl::etOpenRound);
    for (int twice = settings.wall_lines - 1; twice > 0; twice -= 2) {
        cl::Paths outlines;
        offsetter.Execute(outlines, 0.5 * twice * static_cast<double>(settings.nozzle));
        for (cl::Path& outline : outlines) append_outline(std::move(outline), region, settings.nozzle, plan);
    }
}

}  // namespace ribvault
