// Patches are printed with the tracks they touch, and what was there stays.
#include "ribvault/print/lay_patches.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "print/geometry.hpp"
#include "ribvault/print/drop_tiny_steps.hpp"

using namespace ribvault;

namespace {

constexpr Unit mm = units_per_mm, d = 40000;

PlannedTrack track(TrackKind kind, std::vector<Point> points, Entry entry = Entry::either_end, bool closed = false) {
    return {{{kind, d, closed, std::move(points)}}, entry, no_stop};
}
LayerPlan plan_of(std::vector<PlannedTrack> tracks) {
    LayerPlan plan;
    plan.tracks = std::move(tracks);
    return plan;
}
Patch dot(Unit x, Unit y, TrackKind kind = TrackKind::support) { return {{{x, y}, {x, y}}, kind}; }
Unit lay(LayerPlan& plan, const std::vector<Patch>& patches) {
    const PlanTracks on(plan);
    return lay_patches(patches, on, plan, d);
}
using Points = std::vector<Point>;

}  // namespace

TEST_CASE("a wall whose tip is near goes on to the dot") {
    LayerPlan plan = plan_of({track(TrackKind::support, {{0, 0}, {mm, 0}}, Entry::fixed)});
    CHECK(lay(plan, {dot(mm + 8000, 6000)}) == 10000);
    REQUIRE(plan.tracks.size() == 1);
    CHECK(plan.tracks[0].paths[0].points == Points{{0, 0}, {mm, 0}, {mm + 8000, 6000}});
}

TEST_CASE("only a track that may be entered at either end begins at a dot") {
    LayerPlan fixed = plan_of({track(TrackKind::support, {{0, 0}, {mm, 0}}, Entry::fixed)}),
              free = plan_of({track(TrackKind::support, {{0, 0}, {mm, 0}})});
    lay(fixed, {dot(-10000, 0)}), lay(free, {dot(-10000, 0)});
    CHECK(fixed.tracks[0].paths[0].points.front() == Point{0, 0});
    CHECK(free.tracks[0].paths[0].points == Points{{-10000, 0}, {0, 0}, {mm, 0}});
}

TEST_CASE("beside a support a spur, wherever else the track is changed") {
    LayerPlan plan = plan_of({track(TrackKind::support, {{0, 0}, {mm, 0}, {2 * mm, 0}})});
    const Unit added = lay(plan, {dot(150000, 10000), dot(50000, -9000), dot(20000, 8000), dot(-9000, 0),
                                  dot(2 * mm + 9000, 0), dot(mm, 7000)});
    CHECK(added == 2 * (10000 + 9000 + 8000 + 7000) + 9000 + 9000);
    REQUIRE(plan.tracks.size() == 1);
    CHECK(plan.tracks[0].paths[0].points == Points{{-9000, 0},
                                                   {0, 0},
                                                   {20000, 0},
                                                   {20000, 8000},
                                                   {20000, 0},
                                                   {50000, 0},
                                                   {50000, -9000},
                                                   {50000, 0},
                                                   {mm, 0},
                                                   {mm, 7000},
                                                   {mm, 0},
                                                   {150000, 0},
                                                   {150000, 10000},
                                                   {150000, 0},
                                                   {2 * mm, 0},
                                                   {2 * mm + 9000, 0}});
}

TEST_CASE("beside a perimeter a short track, far from everything a dot") {
    LayerPlan plan = plan_of(
        {track(TrackKind::outer_perimeter, {{0, 0}, {5 * mm, 0}, {5 * mm, 5 * mm}, {0, 5 * mm}}, Entry::fixed, true)});
    CHECK(lay(plan, {dot(2 * mm, 20000), dot(2 * mm, 2 * mm), {{{mm, mm}, {mm, 150000}}, TrackKind::support}}) ==
          20000 + 50000);
    REQUIRE(plan.tracks.size() == 4);
    CHECK(plan.tracks[0].paths[0].points.size() == 4);
    CHECK(plan.tracks[1].paths[0].points == Points{{2 * mm, 0}, {2 * mm, 20000}});
    CHECK(plan.tracks[2].paths[0].points == Points{{2 * mm, 2 * mm}});
    CHECK(plan.tracks[3].paths[0].points == Points{{mm, mm}, {mm, 150000}});
}

TEST_CASE("what leads to a dot goes on to the next one") {
    LayerPlan plan = plan_of(
        {track(TrackKind::outer_perimeter, {{0, 0}, {5 * mm, 0}, {5 * mm, 5 * mm}, {0, 5 * mm}}, Entry::fixed, true)});
    CHECK(lay(plan, {dot(2 * mm, 2 * mm), dot(2 * mm, 2 * mm + 10000), dot(2 * mm, 2 * mm), dot(2 * mm, 25000),
                     dot(2 * mm, 50000)}) == 10000 + 25000 + 25000);
    REQUIRE(plan.tracks.size() == 3);
    CHECK(plan.tracks[1].paths[0].points == Points{{2 * mm, 2 * mm}, {2 * mm, 2 * mm + 10000}});
    CHECK_FALSE(plan.tracks[1].paths[0].on_track);
    CHECK(plan.tracks[2].paths[0].points == Points{{2 * mm, 0}, {2 * mm, 25000}, {2 * mm, 50000}});
    CHECK(plan.tracks[2].paths[0].on_track);
}

TEST_CASE(
    "a track prolonged to a dot, or a spur, goes on to the next one; from the middle of a way a track of its own leads "
    "there") {
    LayerPlan plan = plan_of({track(TrackKind::support, {{0, 0}, {mm, 0}})});
    CHECK(lay(plan, {dot(mm + 10000, 0), dot(mm + 20000, 3000), dot(-10000, 0), dot(-20000, 0), dot(50000, 10000),
                     dot(50000, 13000), dot(mm + 5000, 5000)}) ==
          round_to_lattice(10000 + std::hypot(10000, 3000) + 20000 + 2 * 13000 + 5000));
    REQUIRE(plan.tracks.size() == 2);
    CHECK(plan.tracks[0].paths[0].points == Points{{-20000, 0},
                                                   {-10000, 0},
                                                   {0, 0},
                                                   {50000, 0},
                                                   {50000, 10000},
                                                   {50000, 13000},
                                                   {50000, 10000},
                                                   {50000, 0},
                                                   {mm, 0},
                                                   {mm + 10000, 0},
                                                   {mm + 20000, 3000}});
    CHECK(plan.tracks[1].paths[0].points == Points{{mm + 5000, 0}, {mm + 5000, 5000}});
    CHECK(plan.tracks[1].paths[0].on_track);
}

TEST_CASE("a dot stays one where the way to it leads where tracks must not run") {
    LayerPlan plan = plan_of({track(TrackKind::support, {{0, 0}, {mm, 0}})});
    const PlanTracks on(plan);
    const auto left_of_tip = [](TrackKind, const Segment& way) { return std::max(way.a.x, way.b.x) <= mm; };
    CHECK(lay_patches({dot(mm / 2, 9000), dot(mm + 10000, 0)}, on, plan, d, left_of_tip) == 2 * 9000);
    REQUIRE(plan.tracks.size() == 2);
    CHECK(plan.tracks[0].paths[0].points == Points{{0, 0}, {mm / 2, 0}, {mm / 2, 9000}, {mm / 2, 0}, {mm, 0}});
    CHECK(plan.tracks[1].paths[0].points == Points{{mm + 10000, 0}});
}

TEST_CASE("a dot on a track needs nothing, one just beside it a step; on a narrower strip it stays a dot") {
    const auto of_width = [](Unit width) {
        LayerPlan plan = plan_of({track(TrackKind::thin_wall, {{0, 0}, {mm, 0}})});
        plan.tracks[0].paths[0].width = width;
        return plan;
    };
    LayerPlan wide = of_width(d), narrow = of_width(d / 2), beside = of_width(d), beside_narrow = of_width(d / 2);
    CHECK(lay(wide, {dot(mm / 2, 0)}) == 0);
    CHECK(wide.tracks.size() == 1);
    CHECK(lay(narrow, {dot(mm / 2, 0)}) == 0);
    REQUIRE(narrow.tracks.size() == 2);
    CHECK(narrow.tracks[1].paths[0].points == Points{{mm / 2, 0}});
    CHECK(lay(beside, {dot(mm / 2, 100)}) == 505);
    REQUIRE(beside.tracks.size() == 2);
    CHECK(beside.tracks[1].paths[0].points == Points{{mm / 2, 0}, {mm / 2, 505}});
    CHECK(beside.tracks[1].paths[0].on_track);
    lay(beside_narrow, {dot(mm / 2, 10000)});
    REQUIRE(beside_narrow.tracks.size() == 2);
    CHECK_FALSE(beside_narrow.tracks[1].paths[0].on_track);  // its end at the strip is wider than the strip
}

TEST_CASE("a strip of another width goes on at the width of a patch; external supports stay apart") {
    LayerPlan plan = plan_of({track(TrackKind::thin_wall, {{0, 0}, {mm, 0}})});
    plan.tracks[0].paths[0].width = 30000;
    lay(plan, {dot(mm + 10000, 0), dot(-10000, 0), dot(mm / 2, 5000, TrackKind::external_support)});
    REQUIRE(plan.tracks.size() == 2);
    REQUIRE(plan.tracks[0].paths.size() == 3);
    CHECK(plan.tracks[0].paths[0].points == Points{{-10000, 0}, {0, 0}});
    CHECK(plan.tracks[0].paths[0].width == d);
    CHECK(plan.tracks[0].paths[1].width == 30000);
    CHECK(plan.tracks[0].paths[2].points == Points{{mm, 0}, {mm + 10000, 0}});
    CHECK(plan.tracks[1].paths[0].points == Points{{mm / 2, 5000}});
    CHECK(plan.tracks[1].paths[0].kind == TrackKind::external_support);
}

TEST_CASE("whatever the patches, they and all that was there are printed") {
    std::mt19937 random(7);
    const auto between = [&](Unit low, Unit high) { return std::uniform_int_distribution<Unit>(low, high)(random); };
    for (int trial = 0; trial < 200; ++trial) {
        LayerPlan plan;
        for (int t = 0; t < 4; ++t) {
            Points points{{between(0, 2 * mm), between(0, 2 * mm)}};
            for (int k = 0; k < 3; ++k) points.push_back(points.back() + Point{between(600, mm), between(600, mm)});
            plan.tracks.push_back(track(t == 0 ? TrackKind::cover : TrackKind::support, points,
                                        t % 2 ? Entry::fixed : Entry::either_end));
        }
        const LayerPlan before = plan;
        std::vector<Patch> patches;
        for (int k = 0; k < 40; ++k) patches.push_back(dot(between(0, 3 * mm), between(0, 3 * mm)));
        const Unit added = lay(plan, patches);
        double total = 0, had = 0;
        for (const PlannedTrack& t : before.tracks) had += length(t.paths.front());
        for (const PlannedTrack& t : plan.tracks)
            for (std::size_t p = 0; p < t.paths.size(); ++p) {
                const Points& points = t.paths[p].points;
                if (p > 0) CHECK(points.front() == t.paths[p - 1].points.back());
                for (std::size_t k = 1; k < points.size(); ++k)
                    CHECK(length(points[k] - points[k - 1]) >= static_cast<double>(shortest_step));
                total += length(t.paths[p]);
            }
        CHECK(total - had == Approx(static_cast<double>(added)).margin(200));
        // A dot lies on the centre line of a track as wide as it is, up to the lattice.
        for (const Patch& patch : patches) {
            double nearest = HUGE_VAL;
            for (const PlannedTrack& t : plan.tracks)
                for (const ToolPath& path : t.paths) {
                    std::vector<Segment> steps;
                    append_segments(path, steps);
                    if (path.width >= d)
                        for (const Segment& step : steps)
                            nearest = std::min(nearest, test::distance(patch.segment.a, step));
                }
            CHECK(nearest <= 1);
        }
        for (std::size_t t = 0; t < before.tracks.size(); ++t) {
            Points all;
            for (const ToolPath& path : plan.tracks[t].paths)
                all.insert(all.end(), path.points.begin(), path.points.end());
            auto at = all.begin();
            for (const Point p : before.tracks[t].paths.front().points) {
                at = std::find(at, all.end(), p);
                REQUIRE(at != all.end());
            }
            if (before.tracks[t].entry == Entry::fixed)
                CHECK(all.front() == before.tracks[t].paths.front().points.front());
        }
    }
}
