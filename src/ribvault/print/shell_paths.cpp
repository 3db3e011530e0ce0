#include "ribvault/print/shell_paths.hpp"

#include <algorithm>
#include <polyclipping/clipper.hpp>

#include "ribvault/print/cover_lines.hpp"
#include "ribvault/print/nearest_order.hpp"

namespace ribvault {
namespace {

namespace cl = ClipperLib;

constexpr double miter_limit = 2;

cl::Paths to_clipper(const Region& region) {
    cl::Paths paths(region.size());
    for (std::size_t i = 0; i < region.size(); ++i)
        for (Point p : region[i]) paths[i].emplace_back(p.x, p.y);
    return paths;
}

Contour from_clipper(const cl::Path& path) {
    Contour contour;
    contour.reserve(path.size());
    for (const cl::IntPoint& p : path) contour.push_back({p.X, p.Y});
    return contour;
}

/// Dilation by a distance in lattice units, erosion by a negative one. Mitres keep at least this distance everywhere.
cl::Paths offset(const cl::Paths& paths, double distance) {
    cl::ClipperOffset offset(miter_limit);
    offset.AddPaths(paths, cl::jtMiter, cl::etClosedPolygon);
    cl::Paths result;
    offset.Execute(result, distance);
    return result;
}

void append_in_nearest_order(std::vector<ToolPath> paths, LayerPaths& layer) {
    std::vector<PathEnds> ends;
    for (const ToolPath& path : paths) ends.push_back({path.points.front(), end_of(path)});
    for (std::size_t i : nearest_order(ends, nozzle_after(layer))) layer.paths.push_back(std::move(paths[i]));
}

void append_perimeters(const cl::Paths& outline, const Settings& settings, LayerPaths& layer) {
    const double width = static_cast<double>(settings.nozzle);
    for (int j = 0; j < settings.perimeters; ++j) {
        std::vector<ToolPath> paths;
        for (const cl::Path& line : offset(outline, -(j + 0.5) * width)) {
            ToolPath path{j == 0 ? TrackKind::outer_perimeter : TrackKind::inner_perimeter, settings.nozzle, true,
                          from_clipper(line)};
            if (2 * length(path) < width) continue;
            const auto rear = std::max_element(path.points.begin(), path.points.end(), [](Point a, Point b) {
                return a.y != b.y ? a.y < b.y : a.x > b.x;
            });
            std::rotate(path.points.begin(), rear, path.points.end());
            paths.push_back(std::move(path));
        }
        append_in_nearest_order(std::move(paths), layer);
    }
}

/// Where centre lines of covers may run, as connected areas with their holes. Eroding O_i \ C_i is eroding O_i and
/// dilating C_i, and keeps Clipper away from the nearly coincident borders of the two.
std::vector<Region> cover_areas(const cl::Paths& outline, const Region& cavity, const Settings& settings) {
    const double width = static_cast<double>(settings.nozzle);
    cl::Clipper clipper;
    clipper.AddPaths(offset(outline, -(settings.perimeters + 0.5) * width), cl::ptSubject, true);
    clipper.AddPaths(offset(to_clipper(cavity), width / 2), cl::ptClip, true);
    cl::PolyTree tree;
    clipper.Execute(cl::ctDifference, tree, cl::pftNonZero, cl::pftNonZero);
    std::vector<Region> areas;
    for (const cl::PolyNode* node = tree.GetFirst(); node; node = node->GetNext()) {
        if (node->IsHole()) continue;
        Region area{from_clipper(node->Contour)};
        for (const cl::PolyNode* hole : node->Childs) area.push_back(from_clipper(hole->Contour));
        areas.push_back(std::move(area));
    }
    return areas;
}

}  // namespace

void append_shell_paths(const Slice& slice, const Region& cavity, const Settings& settings, LayerPaths& layer) {
    const cl::Paths outline = to_clipper(slice.rounded);
    append_perimeters(outline, settings, layer);
    std::vector<ToolPath> covers;
    for (const Region& area : cover_areas(outline, cavity, settings))
        for (Contour& line : cover_lines(area, settings.nozzle, slice.layer % 2 != 0)) {
            ToolPath path{TrackKind::cover, settings.nozzle, false, std::move(line)};
            if (2 * length(path) >= static_cast<double>(settings.nozzle)) covers.push_back(std::move(path));
        }
    append_in_nearest_order(std::move(covers), layer);
}

}  // namespace ribvault
