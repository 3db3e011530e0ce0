#include "ribvault/print/wide_walls.hpp"

#include <algorithm>
#include <cmath>

#include "ribvault/exact/nearest_segment.hpp"
#include "ribvault/exact/point_location.hpp"
#include "ribvault/slice/lattice_clip.hpp"

namespace ribvault {
namespace {

namespace cl = ClipperLib;

constexpr double arc_tolerance = 1000;  ///< lattice units; more corners than firmware keeps up with otherwise

/// A disc as a polygon, counter-clockwise. Its corners lie in the same directions on all layers: what is around a wall
/// that is drawn back lies within what is around the wall above, by no more and no less than the walls do.
Contour disc(double radius) {
    const int corners = 4 * static_cast<int>(std::ceil(M_PI / 4 / std::acos(1 - arc_tolerance / radius)));
    Contour contour;
    for (int k = 0; k < corners; ++k) {
        const double angle = 2 * M_PI * k / corners;
        contour.push_back({round_to_lattice(radius * std::cos(angle)), round_to_lattice(radius * std::sin(angle))});
    }
    return contour;
}

/// What a convex polygon covers on its way along a segment.
Contour swept(const Contour& polygon, const Segment& along) {
    const Point way = along.b - along.a;
    const auto is_ahead = [&](std::size_t k) {  // the side from corner k to the next faces forwards
        const Point side = polygon[(k + 1) % polygon.size()] - polygon[k];
        return side.y * way.x - side.x * way.y > 0;
    };
    Contour hull;
    bool ahead = is_ahead(polygon.size() - 1);
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        hull.push_back(polygon[k] + (ahead ? along.b : along.a));
        const bool next = is_ahead(k);
        if (next != ahead) hull.push_back(polygon[k] + (next ? along.b : along.a));
        ahead = next;
    }
    return hull;
}

/// The outlines of what lies around the lines.
Region around(const std::vector<Segment>& lines, double distance) {
    const Contour polygon = disc(distance);
    Region each;
    for (const Segment& line : lines) each.push_back(swept(polygon, line));
    return clip(cl::ctUnion, each, {});
}

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
        for (Contour& outline : around(lines, 0.5 * twice * static_cast<double>(settings.support_width)))
            append_outline(std::move(outline), cavity, location, settings.support_width, plan);
}

}  // namespace ribvault
