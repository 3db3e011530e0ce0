// What is extruded rests on what is extruded below: gaps, patches, and the verdict.
#include "ribvault/print/hold_print.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "print/random_forest.hpp"
#include "ribvault/print/drop_tiny_steps.hpp"
#include "ribvault/print/gap_strips.hpp"
#include "ribvault/print/printed_tracks.hpp"
#include "ribvault/print/wide_walls.hpp"
#include "ribvault/vault/erode_supports.hpp"
#include "ribvault/vault/wall_stability.hpp"

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
    CHECK(judge_print(above, *held.printed, {}).supported);
}

/// A straight trunk, and beside its middle a branch of 0.3 mm on its first layer.
SupportForest trunk_and_stub() {
    SupportForest forest;
    const auto root = add_vertex(SupportVertex{{0, 10 * mm}, true}, forest),
               joint = add_vertex(SupportVertex{{10 * mm, 10 * mm}, false}, forest);
    const auto end = add_vertex(SupportVertex{{14 * mm, 10 * mm}, false}, forest),
               tip = add_vertex(SupportVertex{{10 * mm, 10 * mm + 30000}, false}, forest);
    add_edge(root, joint, forest), add_edge(joint, end, forest), add_edge(joint, tip, SupportEdge{true}, forest);
    return forest;
}
int support_tracks(const HeldLayer& held) {
    return static_cast<int>(std::count_if(held.plan.tracks.begin(), held.plan.tracks.end(), [](const PlannedTrack& t) {
        return t.paths.front().kind == TrackKind::support;
    }));
}

TEST_CASE("a short branch needs no track of its own: the path beside it bends to its tip") {
    const auto held = [&](Gaps gaps, const SupportForest& forest) {
        Settings settings;
        settings.gaps = gaps;
        return hold_print(square_shell(), forest, nullptr, settings);
    };
    CHECK(held(Gaps::proved, trunk_and_stub()).plan.bends == 1);
    CHECK(support_tracks(held(Gaps::proved, trunk_and_stub())) == 1);
    CHECK(support_tracks(held(Gaps::paper, trunk_and_stub())) == 2);
    CHECK(support_tracks(held(Gaps::none, trunk_and_stub())) == 2);
    SupportForest outside = trunk_and_stub(), wide = trunk_and_stub();
    for (std::size_t v = 0; v < num_vertices(outside); ++v) outside[v].outside = true, wide[v].wide = true;
    CHECK(support_tracks(held(Gaps::proved, outside)) == 0);
    CHECK(held(Gaps::proved, outside).plan.bends == 0);
    CHECK(held(Gaps::proved, wide).plan.bends == 0);
}

TEST_CASE("what would hang because a path bends gets a patch") {
    // 0.18 mm on the other side of the trunk: its rim is 0.38 mm from the trunk and 0.47 mm from the bend.
    const PrintedLayer above =
        print_of({track(TrackKind::support, false, {{0, 10 * mm - 18000}, {14 * mm, 10 * mm - 18000}})});
    const HeldLayer held = hold_print(square_shell(), trunk_and_stub(), &above, {});
    CHECK(held.plan.bends == 1);
    CHECK(held.patches > 0);
    CHECK(judge_print(above, *held.printed, {}).supported);
    Settings straight;
    straight.gaps = Gaps::none;
    CHECK(hold_print(square_shell(), trunk_and_stub(), &above, straight).patches == 0);

    // On the branch's side nothing hangs.
    const PrintedLayer beside =
        print_of({track(TrackKind::support, false, {{0, 10 * mm + 10000}, {14 * mm, 10 * mm + 10000}})});
    const HeldLayer bent = hold_print(square_shell(), trunk_and_stub(), &beside, {});
    CHECK(bent.plan.bends == 1);
    CHECK(bent.patches == 0);
    CHECK(judge_print(beside, *bent.printed, {}).supported);
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
    CHECK(proved.closed_gaps > 0);
    CHECK(proved.patches == 0);
    CHECK(proved.plan.gaps == 0);
    CHECK(judge_print(above, *proved.printed, settings).supported);
    settings.gaps = Gaps::none;
    CHECK(hold_print(square_shell(), trunk_and_branch(), &above, settings).plan.gaps == 0);
}

TEST_CASE("a wall with tracks side by side is eroded like one of one track, and needs no patches down to its foot") {
    for (const int lines : {1, 2, 3}) {
        Settings settings;
        settings.wall_lines = lines;
        settings.wall_lines_longer = 2 * mm;
        SupportForest forest;
        const auto root = add_vertex({.at = {0, 10 * mm}, .root = true}, forest),
                   bend = add_vertex({.at = {mm, 10 * mm + 777}}, forest);
        add_edge(root, bend, forest);
        add_edge(bend, add_vertex({.at = {3 * mm, 11 * mm + 333}}, forest), forest);
        PrintedLayer above;
        int wide_layers = 0, patches = 0;
        for (; num_edges(forest) > 0; forest = erode_supports(forest, settings.support_radius).forest) {
            mark_wide_trees(forest, settings);
            wide_layers += wide_trees(forest);
            LayerPlan shell = square_shell();
            const SupportForest walls = tapered_trees(forest, settings);
            append_wide_walls(walls, {{{0, 0}, {20 * mm, 0}, {20 * mm, 20 * mm}, {0, 20 * mm}}}, settings, shell);
            const HeldLayer held = hold_print(std::move(shell), walls, &above, settings);
            CHECK(judge_print(above, *held.printed, settings).supported);
            patches += held.patches;
            above = *held.printed;
        }
        CAPTURE(lines);
        CHECK(wide_layers == (lines == 1 ? 0 : lines == 2 ? 16 : 15));  // 3.38 mm by 0.2 mm, but for (lines - 1) d / 2
        // Where one line follows on three, their sides hang.
        if (lines < 3)
            CHECK(patches == 0);
        else
            CHECK(patches < 10);
    }
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

TEST_CASE("one dot holds up all the steps of a spur") {
    // From the perimeter 0.5 mm into the air, in steps of 20 um.
    std::vector<Point> steps;
    for (Unit x = 0; x <= mm / 2; x += 2000) steps.push_back({x, 10 * mm + (x / 2000) % 2 * 300});
    const PrintedLayer above = print_of({track(TrackKind::support, false, steps)});
    const HeldLayer held = hold_print(square_shell(), {}, &above, {});
    CHECK(judge_print(above, *held.printed, {}).supported);
    CHECK(held.patches == 1);
}

TEST_CASE("spare strips are printed where something stands on them, and nowhere else") {
    LayerPlan shell = square_shell();
    PlannedTrack strip = track(TrackKind::thin_wall, false, {{35000, mm}, {35000, 19 * mm}});
    strip.paths.front().width = 30000;
    shell.spare.push_back(strip);
    shell.unfilled_area = 18.0 * mm * 30000;
    const auto strips = [](const HeldLayer& held) {
        std::vector<ToolPath> found;
        for (const PlannedTrack& t : held.plan.tracks)
            for (const ToolPath& path : t.paths)
                if (path.kind == TrackKind::thin_wall) found.push_back(path);
        return found;
    };
    CHECK(strips(hold_print(shell, {}, nullptr, {})).empty());
    // A perimeter 0.2 mm farther in: what the perimeter below holds up.
    PrintedLayer above = print_of({track(TrackKind::outer_perimeter, false, {{20000, 3 * mm}, {20000, 17 * mm}})});
    HeldLayer held = hold_print(shell, {}, &above, {});
    CHECK(judge_print(above, *held.printed, {}).supported);
    CHECK(strips(held).empty());
    // 0.3 mm farther in, in two places 4 mm apart.
    above = print_of({track(TrackKind::outer_perimeter, false, {{30000, 3 * mm}, {30000, 5 * mm}}),
                      track(TrackKind::outer_perimeter, false, {{30000, 9 * mm}, {30000, 17 * mm}})});
    held = hold_print(shell, {}, &above, {});
    CHECK(judge_print(above, *held.printed, {}).supported);
    CHECK(held.patches == 0);
    std::vector<ToolPath> found = strips(held);
    REQUIRE(found.size() == 2);
    double along = 0;
    for (const ToolPath& path : found) along += length(path);
    CHECK(along >= 10.0 * mm);
    CHECK(along <= 10.0 * mm + 4 * (55000 + 40000));  // at each end a reach and a piece
    CHECK(held.plan.unfilled_area == Approx((18.0 * mm - along) * 30000));
    CHECK(held.patches == 0);
    // 1 mm apart: one track, which costs less time than a travel.
    above = print_of({track(TrackKind::outer_perimeter, false, {{30000, 3 * mm}, {30000, 5 * mm}}),
                      track(TrackKind::outer_perimeter, false, {{30000, 6 * mm}, {30000, 9 * mm}})});
    held = hold_print(shell, {}, &above, {});
    CHECK(judge_print(above, *held.printed, {}).supported);
    CHECK(strips(held).size() == 1);
}

TEST_CASE("a strip is printed under what its material reaches, up to a unit") {
    // 0.3 mm wide: what hangs and may be held up from 0.2 mm away is so from 0.35 mm beside its centre line.
    for (const Unit aside : {35000, 35001}) {
        LayerPlan plan;
        plan.spare.push_back(track(TrackKind::thin_wall, false, {{0, 0}, {0, 10 * mm}}));
        plan.spare.front().paths.front().width = 30000;
        const Point hanging{aside, 5 * mm};
        CHECK(print_strips_under({{{hanging, hanging}, 20000}}, 40000, plan) == (aside == 35000));
        CHECK(plan.tracks.size() == (aside == 35000 ? 1u : 0u));
    }
}

TEST_CASE("only walls in cavities reach over a strip") {
    for (const bool outside : {false, true}) {
        SupportForest forest;
        add_edge(add_vertex(SupportVertex{.at = {55000, 10 * mm}, .root = true, .outside = outside}, forest),
                 add_vertex(SupportVertex{.at = {5 * mm, 10 * mm}, .outside = outside}, forest), forest);
        reach_over_strips(square_shell(), 40000, forest);
        CHECK(num_vertices(forest) == (outside ? 2u : 3u));
    }
}

TEST_CASE("a wall goes on through a strip in which nothing is printed until it overlaps the perimeter") {
    const auto wall_from = [](Unit x, LayerPlan shell = square_shell()) {
        SupportForest forest;
        const auto root = add_vertex(SupportVertex{{x, 10 * mm}, true}, forest),
                   tip = add_vertex(SupportVertex{{5 * mm, 10 * mm}, false}, forest);
        add_edge(root, tip, forest);
        const HeldLayer held = hold_print(std::move(shell), forest, nullptr, {});
        const std::vector<Segment> walls = segments_of(held.plan, TrackKind::support);
        double least = HUGE_VAL;
        for (const Segment& wall : walls)
            least = std::min({least, static_cast<double>(wall.a.x), static_cast<double>(wall.b.x)});
        return least;
    };
    CHECK(wall_from(20000) == 20000);  // at the perimeter's edge: it overlaps it by a radius
    CHECK(wall_from(30000) == 30000);
    CHECK(wall_from(38000) == 30000);
    CHECK(wall_from(55000) == 30000);
    CHECK(wall_from(2 * mm) == 2 * mm);  // not a strip
    // The lines beside a wall of several are no shell.
    LayerPlan beside = square_shell();
    beside.tracks.push_back(track(TrackKind::support, false, {{55000, 10 * mm + 40000}, {5 * mm, 10 * mm + 40000}}));
    CHECK(wall_from(55000, beside) == 30000);
}

TEST_CASE("what hangs outside the outline is measured, not patched") {
    const PrintedLayer above =
        print_of({track(TrackKind::outer_perimeter, false, {{-3 * mm, 5 * mm}, {-3 * mm, 9 * mm}})});
    const HeldLayer held = hold_print(square_shell(), {}, &above, {});
    CHECK(held.patches == 0);
    const PrintVerdict verdict = judge_print(above, *held.printed, {});
    CHECK(verdict.supported);
    CHECK(verdict.external_mm.lo <= 4);
    CHECK(verdict.external_mm.hi >= 4);
    CHECK(verdict.external_mm.hi == Approx(4));
}

TEST_CASE("a verdict does not believe what mending said: a track taken away afterwards is noticed") {
    const PrintedLayer above = print_of({track(TrackKind::support, false, {{0, 10 * mm}, {9 * mm, 10 * mm}})});
    const HeldLayer held = hold_print(square_shell(), trunk_and_branch(), &above, {});
    PrintedLayer less = *held.printed;
    std::erase_if(less.tracks, [](const PrintedTrack& t) { return t.feature == static_cast<int>(TrackKind::support); });
    const PrintVerdict verdict = judge_print(above, less, {});
    CHECK_FALSE(verdict.supported);
    CHECK(verdict.unsupported_mm.lo > 8);
}

TEST_CASE("steps below 5 um are left out, a path shorter than that is a dot, ends stay") {
    LayerPlan plan;
    plan.tracks.push_back(track(TrackKind::support, false, {{0, 0}, {100, 0}, {1000, 0}, {1200, 0}}));
    plan.tracks.push_back(track(TrackKind::support, false, {{0, mm}, {300, mm}}));
    plan.tracks.push_back(track(TrackKind::outer_perimeter, true, {{0, 0}, {mm, 0}, {mm, 100}, {mm, mm}, {0, 200}}));
    // A corner beside the removal gap: cut by 3 um it would stand in it.
    const std::vector<Point> corner{{0, 0}, {mm, 0}, {mm + 300, 300}, {mm + 300, 300}, {mm + 300, mm}};
    plan.tracks.push_back(track(TrackKind::external_support, false, corner));
    plan.tracks.push_back(track(TrackKind::external_support, false, {{0, mm}, {300, mm}}));
    drop_tiny_steps(plan);
    CHECK(plan.tracks[3].paths[0].points == std::vector<Point>{corner[0], corner[1], corner[2], corner[4]});
    CHECK(plan.tracks[4].paths[0].points == std::vector<Point>{{0, mm}});
    CHECK(plan.tracks[0].paths[0].points == std::vector<Point>{{0, 0}, {1200, 0}});
    CHECK(plan.tracks[1].paths[0].points == std::vector<Point>{{0, mm}});
    CHECK(plan.tracks[2].paths[0].points == std::vector<Point>{{0, 0}, {mm, 0}, {mm, mm}});
    CHECK(plan.tracks[2].paths[0].closed);
}

TEST_CASE("a support that is but a dot is not printed where a track of its kind runs") {
    const auto support = [](TrackKind kind, std::vector<Point> points, std::size_t after = no_stop) {
        PlannedTrack t = track(kind, false, std::move(points));
        t.after = after;
        return t;
    };
    LayerPlan plan;
    plan.tracks.push_back(support(TrackKind::support, {{1000, 200}, {1200, 200}}));  // 2 um beside the next
    plan.tracks.push_back(support(TrackKind::support, {{0, 0}, {mm, 0}}, 0));        // waits for it
    plan.tracks.push_back(support(TrackKind::support, {{1000, 600}}));               // 6 um beside
    plan.tracks.push_back(support(TrackKind::support, {{1000, 700}, {1000, 900}}));  // 1 um from the dot before
    plan.tracks.push_back(support(TrackKind::external_support, {{1000, 0}}));        // stands on other things
    plan.tracks.push_back(support(TrackKind::support, {{mm, 0}, {mm, mm}}, 3));
    drop_tiny_steps(plan);
    REQUIRE(plan.tracks.size() == 4);
    CHECK(plan.tracks[0].paths[0].points.size() == 2);
    CHECK(plan.tracks[0].after == no_stop);
    CHECK(plan.tracks[1].paths[0].points == std::vector<Point>{{1000, 600}});
    CHECK(plan.tracks[2].paths[0].kind == TrackKind::external_support);
    CHECK(plan.tracks[3].after == no_stop);
}
