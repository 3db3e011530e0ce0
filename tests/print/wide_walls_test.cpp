// Walls with several tracks side by side.
#include "ribvault/print/wide_walls.hpp"

#include <catch2/catch.hpp>

#include "ribvault/exact/nearest_segment.hpp"
#include "ribvault/print/support_paths.hpp"
#include "ribvault/vault/wall_stability.hpp"

using namespace ribvault;

namespace {

constexpr Unit mm = units_per_mm;
const Region cavity{{{0, 0}, {30 * mm, 0}, {30 * mm, 20 * mm}, {0, 20 * mm}}};

/// A wall of 10 mm from the left side of the cavity, with a branch of 5 mm in its middle.
SupportForest tree(bool wide) {
    SupportForest forest;
    const auto root = add_vertex({.at = {0, 10 * mm}, .root = true, .wide = wide}, forest);
    const auto joint = add_vertex({.at = {5 * mm, 10 * mm}, .wide = wide}, forest),
               tip = add_vertex({.at = {10 * mm, 10 * mm}, .wide = wide}, forest);
    const auto branch = add_vertex({.at = {5 * mm, 15 * mm}, .wide = wide}, forest);
    add_edge(root, joint, forest), add_edge(joint, tip, forest), add_edge(joint, branch, forest);
    return forest;
}

std::vector<ToolPath> printed(const SupportForest& forest, int lines) {
    Settings settings;
    settings.wall_lines = lines;
    LayerPlan plan;
    append_wide_walls(forest, cavity, settings, plan);
    append_support_paths(forest, settings, plan);
    std::vector<ToolPath> paths;
    for (const PlannedTrack& track : plan.tracks) paths.insert(paths.end(), track.paths.begin(), track.paths.end());
    return paths;
}

}  // namespace

TEST_CASE("two lines are one path around the tree, half a width from it, from shell to shell") {
    const std::vector<ToolPath> paths = printed(tree(true), 2);
    REQUIRE(paths.size() == 1);
    CHECK_FALSE(paths[0].closed);
    CHECK(paths[0].points.front().x == 0);
    CHECK(paths[0].points.back().x == 0);
    const NearestSegment walls({{{0, 10 * mm}, {10 * mm, 10 * mm}}, {{5 * mm, 10 * mm}, {5 * mm, 15 * mm}}});
    const std::vector<Point>& points = paths[0].points;
    for (std::size_t k = 1; k < points.size(); ++k)
        for (const Point p : {points[k], part_way(points[k - 1], points[k], 0.5)})
            CHECK(std::sqrt(walls.nearest(p).distance.value()) == Approx(20000).margin(1001));
    // Both sides of 15 mm of wall, two half circles less the corners at the joint.
    CHECK(length(paths[0]) / mm == Approx(30).margin(1.5));
}

TEST_CASE("three lines are the tree and a path around it, four are two paths around it") {
    CHECK(printed(tree(true), 3).size() == 3);  // trunk, branch, one around
    CHECK(printed(tree(true), 4).size() == 2);
}

TEST_CASE("side by side the tracks are as wide as pictures draw the wall") {
    for (const int lines : {1, 2, 3, 4, 5})
        for (const bool wide : {false, true}) {
            const SupportForest forest = tree(wide);
            const NearestSegment walls({{{0, 10 * mm}, {10 * mm, 10 * mm}}, {{5 * mm, 10 * mm}, {5 * mm, 15 * mm}}});
            double farthest = 0;
            for (const ToolPath& path : printed(forest, lines))
                for (const Point p : path.points)
                    farthest = std::max(
                        farthest, std::sqrt(walls.nearest(p).distance.value()) + 0.5 * static_cast<double>(path.width));
            Settings settings;
            settings.wall_lines = lines;
            CHECK(farthest == Approx(0.5 * static_cast<double>(wall_width(forest[0], settings))).margin(1001));
        }
}

TEST_CASE("a tree that is not wide has one line, whatever the others have") {
    CHECK(printed(tree(false), 2).size() == printed(tree(false), 1).size());
    CHECK(printed(tree(true), 1).size() == 2);
}

TEST_CASE("a wide dot away from the shell is a ring") {
    SupportForest forest;
    add_vertex({.at = {15 * mm, 10 * mm}, .root = true, .wide = true}, forest);
    const std::vector<ToolPath> paths = printed(forest, 2);
    REQUIRE(paths.size() == 1);
    CHECK(paths[0].closed);
}
