#include "ribvault/print/order_paths.hpp"

#include <catch2/catch.hpp>
#include <optional>
#include <random>

#include "print/geometry.hpp"
#include "print/random_forest.hpp"
#include "ribvault/print/islands.hpp"
#include "ribvault/print/shell_paths.hpp"
#include "ribvault/print/support_paths.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

constexpr Unit mm = units_per_mm;

Contour square(Unit x, Unit y, Unit side, bool hole = false) {
    Contour c{{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}};
    if (hole) std::reverse(c.begin(), c.end());
    return c;
}

/// Two islands 20 mm wide with a few straight walls in each, a little different on every layer.
LayerPaths two_islands(int layer, bool alternate, Region& outline) {
    std::mt19937_64 random(5);
    outline = {square(0, 0, 20 * mm), square(30 * mm, 0, 20 * mm)};
    Slice slice;
    slice.layer = layer;
    slice.rounded = outline;
    LayerPlan plan;
    plan.layer = layer;
    append_shell_paths(slice, {square(mm, mm, 18 * mm), square(31 * mm, mm, 18 * mm)}, {}, {}, plan);
    SupportForest forest(24);
    for (std::size_t i = 0; i < 12; ++i) {
        const Unit left = i < 6 ? mm : 31 * mm, y = (3 + 2 * static_cast<Unit>(i % 6)) * mm;
        forest[2 * i] = {{left, y}, true};
        forest[2 * i + 1] = {{left + std::uniform_int_distribution<Unit>(2 * mm, 15 * mm)(random) - 20000 * layer, y},
                             false};
        add_edge(2 * i, 2 * i + 1, forest);
    }
    append_support_paths(forest, {}, plan);
    return order_paths(std::move(plan), outline, alternate);
}

Point start_of(const LayerPaths& layer) { return layer.paths.front().points.front(); }
Point end_of_layer(const LayerPaths& layer) { return end_of(layer.paths.back()); }

}  // namespace

TEST_CASE("islands: holes belong to the outer contour around them, islands in holes are their own") {
    const Region region{square(0, 0, 20 * mm), square(5 * mm, 5 * mm, 10 * mm, true), square(8 * mm, 8 * mm, 4 * mm),
                        square(30 * mm, 0, mm)};
    const Islands islands(region);
    REQUIRE(islands.size() == 3);
    CHECK(islands.of({mm, mm}) != islands.of({9 * mm, 9 * mm}));
    CHECK(islands.of({mm, mm}) == islands.of({19 * mm, 19 * mm}));
    CHECK(islands.of({30 * mm + 5, 5}) != islands.of({9 * mm, 9 * mm}));
    CHECK(Islands({}).size() == 1);
}

TEST_CASE("what must come after a track of another island or stage does not wait for it") {
    const Region outline{square(0, 0, 20 * mm), square(30 * mm, 0, 20 * mm)};
    for (const bool shell_first : {true, false}) {
        LayerPlan plan;
        const auto add = [&](TrackKind kind, Unit x, std::size_t after) {
            plan.tracks.push_back(
                {{{kind, 40000, false, {{x, 5 * mm}, {x + mm, 5 * mm}}}}, Entry::either_end, after});
        };
        add(TrackKind::cover, 2 * mm, 5), add(TrackKind::cover, 5 * mm, 0), add(TrackKind::cover, 32 * mm, no_stop);
        add(TrackKind::cover, 35 * mm, 2), add(TrackKind::outer_perimeter, mm, no_stop);
        add(TrackKind::cover, 38 * mm, shell_first ? 4 : 1);
        const LayerPaths layer = order_paths(std::move(plan), outline);
        REQUIRE(layer.paths.size() == 6);
        const auto place = [&](Unit x) {
            return std::find_if(layer.paths.begin(), layer.paths.end(), [&](const ToolPath& path) {
                return std::min(path.points.front().x, path.points.back().x) == x;
            });
        };
        CHECK(place(2 * mm) < place(5 * mm));
        CHECK(place(32 * mm) < place(35 * mm));
    }
}

TEST_CASE("one island is finished before the next, perimeters before what they enclose, or last on odd layers") {
    for (const bool alternate : {false, true})
        for (const int number : {0, 1, 2, 3}) {
            Region outline;
            const LayerPaths layer = two_islands(number, alternate, outline);
            const Islands islands(outline);
            int changes = 0;
            const bool shell_last = alternate && number % 2 == 1;
            for (std::size_t i = 1; i < layer.paths.size(); ++i) {
                const bool same =
                    islands.of(layer.paths[i].points.front()) == islands.of(layer.paths[i - 1].points.front());
                changes += !same;
                if (!same) continue;
                const auto shell = [&](std::size_t k) {
                    return stage_of(layer.paths[k].kind) == PrintStage::perimeters;
                };
                CHECK((shell_last ? !(shell(i - 1) && !shell(i)) : !(!shell(i - 1) && shell(i))));
            }
            CHECK(changes == 1);
        }
}

TEST_CASE("external supports are the last of an even layer and the first of an odd one") {
    const Region outline{square(0, 0, 20 * mm), square(30 * mm, 0, 20 * mm)};
    for (const bool alternate : {false, true}) {
        std::optional<bool> ended;
        Point end{};
        for (int number = 0; number < 4; ++number) {
            LayerPlan plan;
            plan.layer = number;
            const auto add = [&](TrackKind kind, Unit x, Unit y) {
                plan.tracks.push_back({{{kind, 40000, false, {{x, y}, {x + mm, y}}}}, Entry::either_end, no_stop});
            };
            // Some of them stand between the islands, behind both and before them.
            for (const Unit x : {-5 * mm, 24 * mm, 26 * mm, 55 * mm})
                for (const Unit y : {-9 * mm, 10 * mm, 29 * mm}) add(TrackKind::external_support, x, y);
            for (const Unit x : {2 * mm, 32 * mm})
                add(TrackKind::outer_perimeter, x, mm), add(TrackKind::cover, x, 5 * mm);
            const LayerPaths layer = order_paths(std::move(plan), outline, alternate);
            REQUIRE(layer.paths.size() == 16);
            const auto outside = [&](std::size_t k) { return layer.paths[k].kind == TrackKind::external_support; };
            for (std::size_t k = 0; k < 16; ++k) CHECK(outside(k) == (number % 2 == 0 ? k >= 4 : k < 12));
            if (ended) CHECK(*ended == outside(0));
            if (ended && alternate) CHECK(length(start_of(layer) - end) < 5 * mm);
            ended = outside(15), end = end_of_layer(layer);
        }
    }
}

TEST_CASE("a layer starts near the end of the one below, on the island where that ended") {
    for (const bool alternate : {false, true}) {
        double farthest = 0;
        for (int number = 0; number < 6; ++number) {
            Region outline;
            const LayerPaths below = two_islands(number, alternate, outline),
                             above = two_islands(number + 1, alternate, outline);
            const Islands islands(outline);
            CHECK(islands.of(end_of_layer(below)) == islands.of(start_of(above)));
            farthest = std::max(farthest, length(start_of(above) - end_of_layer(below)));
        }
        CHECK(farthest < (alternate ? 5 * mm : 15 * mm));
    }
}

TEST_CASE("perimeters that may begin anywhere begin where the layer below has ended") {
    std::optional<Point> end;
    for (int number = 0; number < 8; ++number) {
        LayerPlan plan;
        plan.layer = number;
        plan.tracks.push_back(
            {{{TrackKind::outer_perimeter, 40000, true, square(20000, 20000, 1960000)}}, Entry::anywhere, no_stop});
        // Walls from every corner; on each layer another one begins nearest to the perimeter.
        for (int corner = 0; corner < 4; ++corner) {
            const Unit far = mm + (2 * number + corner) % 4 * 10000;
            const Unit x = corner < 2 ? far : 20 * mm - far, y = corner % 2 == 0 ? far : 20 * mm - far;
            const Unit middle = corner % 2 == 0 ? 9 * mm : 11 * mm;
            plan.tracks.push_back(
                {{{TrackKind::support, 40000, false, {{x, y}, {x, middle}}}}, Entry::either_end, no_stop});
        }
        const LayerPaths layer = order_paths(std::move(plan), {square(0, 0, 20 * mm)}, true);
        INFO("layer " << number);
        if (end) CHECK(length(start_of(layer) - *end) < 3 * mm);
        end = end_of_layer(layer);
    }
}

TEST_CASE("seams stay where they are; tracks that may not be turned keep their direction; none is lost") {
    std::mt19937_64 random(3);
    for (int number = 0; number < 8; ++number) {
        Slice slice;
        slice.layer = number;
        slice.rounded = {square(-21 * mm, -21 * mm, 42 * mm)};
        LayerPlan plan;
        plan.layer = number;
        append_shell_paths(slice, {square(-20 * mm, -20 * mm, 40 * mm)}, {}, {}, plan);
        append_support_paths(random_forest(random, 4, 25, mm, 4 * mm, 0.3), {}, plan);
        const LayerPlan planned = plan;
        const LayerPaths layer = order_paths(std::move(plan), slice.rounded, true);
        REQUIRE(layer.paths.size() == planned.tracks.size());
        std::vector<std::size_t> position(planned.tracks.size());
        for (std::size_t t = 0; t < planned.tracks.size(); ++t) {
            const PlannedTrack& track = planned.tracks[t];
            const auto found = std::find_if(layer.paths.begin(), layer.paths.end(), [&](const ToolPath& p) {
                std::vector<Point> back(p.points.rbegin(), p.points.rend());
                return p.points == track.paths[0].points ||
                       (track.entry == Entry::either_end && back == track.paths[0].points);
            });
            REQUIRE(found != layer.paths.end());
            position[t] = static_cast<std::size_t>(found - layer.paths.begin());
        }
        for (std::size_t t = 0; t < planned.tracks.size(); ++t)
            if (planned.tracks[t].after != no_stop) CHECK(position[planned.tracks[t].after] < position[t]);
    }
}
