// Paths that go by the tips of short branches.
#include "ribvault/print/bent_path.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace ribvault;

namespace {

constexpr Unit mm = units_per_mm;
constexpr double least = 0.1 * mm, most = 0.5 * mm;

PathCorners corners_of(std::vector<Point> at) {
    PathCorners corners{std::move(at), {0}};
    for (std::size_t k = 1; k < corners.at.size(); ++k)
        corners.along.push_back(corners.along.back() + length(corners.at[k] - corners.at[k - 1]));
    return corners;
}

std::vector<Point> path_by(const PathCorners& corners, const std::vector<SideBranches>& beside, double gap = 0) {
    return bent_path(corners, gap, bends_of(corners, gap, beside, least, most));
}

SideBranches branch(double along, Point tip, double reach) { return {along, {tip}, reach}; }
SideBranches own_track(double along) { return {along, {}, 0}; }

const PathCorners straight = corners_of({{0, 0}, {5 * mm, 0}, {10 * mm, 0}});

}  // namespace

TEST_CASE("a path goes to the tip of a short branch at 45 degrees and back") {
    CHECK(path_by(straight, {branch(5 * mm, {5 * mm, 30000}, 30000)}) ==
          std::vector<Point>{{0, 0}, {5 * mm - 30000, 0}, {5 * mm, 30000}, {5 * mm + 30000, 0}, {10 * mm, 0}});
}

TEST_CASE("a bend takes less track than a straight path and its branch") {
    const std::vector<Point> bent = path_by(straight, {branch(5 * mm, {5 * mm, 30000}, 30000)});
    double track = 0;
    for (std::size_t k = 1; k < bent.size(); ++k) track += length(bent[k] - bent[k - 1]);
    CHECK(track < 10 * mm + 30000);
}

TEST_CASE("a branch shorter than a quarter of a track's width has a bend of that much on either side") {
    CHECK(path_by(straight, {branch(5 * mm, {5 * mm, 200}, 200)}) ==
          std::vector<Point>{{0, 0}, {5 * mm - 10000, 0}, {5 * mm, 200}, {5 * mm + 10000, 0}, {10 * mm, 0}});
}

TEST_CASE("a path goes steeply to the tip of a long branch") {
    CHECK(path_by(straight, {branch(5 * mm, {5 * mm, 60000}, 60000)}) ==
          std::vector<Point>{{0, 0}, {5 * mm - 50000, 0}, {5 * mm, 60000}, {5 * mm + 50000, 0}, {10 * mm, 0}});
}

TEST_CASE("two branches at one place are taken along in the order of the path") {
    const SideBranches both{5 * mm, {{5 * mm + 5000, -20000}, {5 * mm - 5000, 20000}}, 20616};
    const std::vector<Point> path = path_by(straight, {both});
    REQUIRE(path.size() == 6);
    CHECK(path[2] == Point{5 * mm - 5000, 20000});
    CHECK(path[3] == Point{5 * mm + 5000, -20000});
}

TEST_CASE("neighbours share the way between them, and a path runs through the corner of a branch with its own track") {
    const SideBranches first = branch(5 * mm, {5 * mm, 30000}, 30000);
    const std::vector<Point> shared =
        path_by(straight, {first, branch(5 * mm + 40000, {5 * mm + 40000, 30000}, 30000)});
    CHECK(shared == std::vector<Point>{{0, 0},
                                       {5 * mm - 30000, 0},
                                       {5 * mm, 30000},
                                       {5 * mm + 20000, 0},
                                       {5 * mm + 40000, 30000},
                                       {5 * mm + 70000, 0},
                                       {10 * mm, 0}});
    const std::vector<Point> beside = path_by(straight, {first, own_track(5 * mm + 20000)});
    REQUIRE(beside.size() == 5);
    CHECK(beside[3] == Point{5 * mm + 20000, 0});
}

TEST_CASE("there is no bend without room for half of it") {
    const SideBranches at_middle = branch(5 * mm, {5 * mm, 30000}, 30000);
    const auto bends = [&](const std::vector<SideBranches>& beside, double gap = 0) {
        return bends_of(straight, gap, beside, least, most).size();
    };
    CHECK(bends({at_middle, own_track(5 * mm + 15000)}) == 1);
    CHECK(bends({at_middle, own_track(5 * mm + 14999)}) == 0);
    CHECK(bends({own_track(5 * mm - 14999), at_middle}) == 0);
    CHECK(bends({at_middle}, 5 * mm - 15000) == 1);
    CHECK(bends({at_middle}, 5 * mm - 14999) == 0);
    CHECK(bends({branch(10 * mm - 10000, {10 * mm - 10000, 30000}, 30000)}) == 0);
}

TEST_CASE("corners inside a bend are left out, and the path begins behind its gap") {
    const PathCorners angle = corners_of({{0, 0}, {5 * mm, 0}, {5 * mm, 10000}, {5 * mm, 5 * mm}});
    CHECK(path_by(angle, {branch(5 * mm, {5 * mm + 30000, 0}, 30000)}, 40000) ==
          std::vector<Point>{{40000, 0}, {5 * mm - 30000, 0}, {5 * mm + 30000, 0}, {5 * mm, 30000}, {5 * mm, 5 * mm}});
    CHECK(path_by(angle, {}, 0) == angle.at);
}
