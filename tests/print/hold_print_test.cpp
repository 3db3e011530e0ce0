// What is extruded rests on what is extruded below: gaps, patches, and the verdict.
#include "ribvault/print/hold_print.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "print/random_forest.hpp"
#include "ribvault/print/drop_tiny_steps.hpp"
#include "ribvault/print/printed_tracks.hpp"

using namespace ribvault;

namespace {

constexpr Unit mm = units_per_mm;

PlannedTrack track(TrackKind kind, bool closed, std::vector<Point> points) {
    return {{{kind, 40000, closed, std::move(points)}}, Entry::either_end, no_stop};
}

/// A square outline of 20 mm as one outer perimeter.
LayerPlan square_shell() {
    LayerPlan plan;
    plan.tracks.push_back(
        track(TrackKind::outer_perimeter, true, {{0, 0}, {20 * mm, 0}, {20 * mm, 20 * mm}, {0, 20 * mm}}));
    return plan;
}

/// A trunk that turns a corner at (10, 10) mm, where a branch goes straight on.
SupportForest trunk_and_branch() {
    SupportForest forest;
    const auto root = add_vertex(SupportVertex{{0, 10 * mm}, true}, forest),
               joint = add_vertex(SupportVertex{{10 * mm, 10 * mm}, false}, forest);
    const auto tip = add_vertex(SupportVertex{{10 * mm, 2 * mm}, false}, forest),
               end = add_vertex(SupportVertex{{14 * mm, 10 * mm}, false}, forest);
    add_edge(root, joint, forest), add_edge(joint, tip, forest), add_edge(joint, end, forest);
    return forest;
}

PrintedLayer print_of(std::vector<PlannedTrack> tracks) {
    LayerPlan plan;
    plan.tracks = std::move(tracks);
    return printed_layer(plan);
}

}  // namespace

TEST_CASE("a gap that lets nothing hang stays") {
    const PrintedLayer above = print_of({track(TrackKind::support, false, {{0, 10 * mm}, {9 * mm, 10 * mm}})});
    const HeldLayer held = hold_print(square_shell(), trunk_and_branch(), &above, {});
    CHECK(held.plan.gaps == 1);
    CHECK_FALSE(held.mended);
    CHECK(judge_print(above, *held.printed, {}).supported);
}

TEST_CASE("a gap over which a wall's side hangs is closed; with the paper's gaps the verdict names it") {
    // 0.2 mm beside the branch, so that it reaches 0.4 mm: (10.2, 10.4) is 0.447 mm from the trunk's corner and from
    // the branch's end.
    const PrintedLayer above =
        print_of({track(TrackKind::support, false, {{10 * mm + 5000, 10 * mm + 20000}, {12 * mm, 10 * mm + 20000}})});
    Settings settings;
    settings.gaps = Gaps::paper;
    const HeldLayer paper = hold_print(square_shell(), trunk_and_branch(), &above, settings);
    CHECK(paper.plan.gaps == 1);
    const PrintVerdict hangs = judge_print(above, *paper.printed, settings);
    CHECK_FALSE(hangs.supported);
    CHECK(hangs.place[0] == Approx(10.2).margin(0.7));

    settings.gaps = Gaps::proved;
    const HeldLayer proved = hold_print(square_shell(), trunk_and_branch(), &above, settings);
    CHECK(proved.mended);
    CHECK(proved.closed_gaps > 0);
    CHECK(proved.patches == 0);
    CHECK(proved.plan.gaps == 0);
    CHECK(judge_print(above, *proved.printed, settings).supported);
    settings.gaps = Gaps::none;
    CHECK(hold_print(square_shell(), trunk_and_branch(), &above, settings).plan.gaps == 0);
}

TEST_CASE("what hangs inside the outline gets patches, and they shrink from layer to layer") {
    PrintedLayer above = print_of({track(TrackKind::cover, false, {{5 * mm, 5 * mm}, {7 * mm, 5 * mm}})});
    SupportForest none;
    std::size_t layers = 0;
    for (bool patched = true; patched && layers < 60; ++layers) {
        const HeldLayer held = hold_print(square_shell(), none, &above, {});
        CHECK(judge_print(above, *held.printed, {}).supported);
        patched = held.patches > 0;
        for (const PlannedTrack& t : held.plan.tracks)
            for (Point p : t.paths.front().points) CHECK((p.x >= 0 && p.y >= 0 && p.x <= 20 * mm && p.y <= 20 * mm));
        above = *held.printed;
    }
    // 5 mm to the shell at 0.2 mm a layer.
    CHECK(layers > 20);
    CHECK(layers < 40);
}

TEST_CASE(
    "the root that a vanished tree leaves is printed only where something hangs without it, joined to what is there") {
    SupportForest dot;
    add_vertex(SupportVertex{{20000, 10 * mm}, true}, dot);
    const auto dots = [](const HeldLayer& held) {
        return std::count_if(held.plan.tracks.begin(), held.plan.tracks.end(),
                             [](const PlannedTrack& t) { return is_support(t.paths.front().kind); });
    };
    CHECK(dots(hold_print(square_shell(), dot, nullptr, {})) == 0);
    Settings paper;
    paper.gaps = Gaps::paper;
    CHECK(dots(hold_print(square_shell(), dot, nullptr, paper)) == 1);
    // A stub that reaches 0.45 mm from the outline's centre line; 0.4 mm of it are held up.
    const PrintedLayer above = print_of({track(TrackKind::support, false, {{0, 10 * mm}, {25000, 10 * mm}})});
    const HeldLayer held = hold_print(square_shell(), dot, &above, {});
    CHECK(judge_print(above, *held.printed, {}).supported);
    REQUIRE(dots(held) == 1);
    const ToolPath& path = held.plan.tracks.back().paths.front();
    CHECK(path.on_track);
    CHECK(path.points.front().x == 0);
    CHECK(length(path) < 8000);
    CHECK(length(path) > 5000);
}

TEST_CASE("what hangs outside the outline is measured, not patched") {
    const PrintedLayer above =
        print_of({track(TrackKind::outer_perimeter, false, {{-3 * mm, 5 * mm}, {-3 * mm, 9 * mm}})});
    const HeldLayer held = hold_print(square_shell(), {}, &above, {});
    CHECK(held.patches == 0);
    const PrintVerdict verdict = judge_print(above, *held.printed, {});
    CHECK(verdict.supported);
    CHECK(verdict.external_mm[0] <= 4);
    CHECK(verdict.external_mm[1] >= 4);
    CHECK(verdict.external_mm[1] == Approx(4));
}

TEST_CASE("a verdict does not believe what mending said: a track taken away afterwards is noticed") {
    const PrintedLayer above = print_of({track(TrackKind::support, false, {{0, 10 * mm}, {9 * mm, 10 * mm}})});
    const HeldLayer held = hold_print(square_shell(), trunk_and_branch(), &above, {});
    PrintedLayer less = *held.printed;
    std::erase_if(less.tracks, [](const PrintedTrack& t) { return t.feature == static_cast<int>(TrackKind::support); });
    const PrintVerdict verdict = judge_print(above, less, {});
    CHECK_FALSE(verdict.supported);
    CHECK(verdict.unsupported_mm[0] > 8);
}

TEST_CASE("steps below 5 um are left out, a path shorter than that is a dot, ends stay") {
    LayerPlan plan;
    plan.tracks.push_back(track(TrackKind::support, false, {{0, 0}, {100, 0}, {1000, 0}, {1200, 0}}));
    plan.tracks.push_back(track(TrackKind::support, false, {{0, 0}, {300, 0}}));
    plan.tracks.push_back(track(TrackKind::outer_perimeter, true, {{0, 0}, {mm, 0}, {mm, 100}, {mm, mm}, {0, 200}}));
    drop_tiny_steps(plan);
    CHECK(plan.tracks[0].paths[0].points == std::vector<Point>{{0, 0}, {1200, 0}});
    CHECK(plan.tracks[1].paths[0].points == std::vector<Point>{{0, 0}});
    CHECK(plan.tracks[2].paths[0].points == std::vector<Point>{{0, 0}, {mm, 0}, {mm, mm}});
    CHECK(plan.tracks[2].paths[0].closed);
}
