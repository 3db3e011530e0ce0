// Patches beside a removal gap, and on the bed alone.
#include "ribvault/print/gap_patches.hpp"

#include <catch2/catch.hpp>

#include "ribvault/print/hold_print.hpp"
#include "ribvault/print/printed_tracks.hpp"

using namespace ribvault;

namespace {

constexpr Unit mm = units_per_mm;

Contour rectangle(Unit x0, Unit y0, Unit x1, Unit y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }

/// All of a frame of 40 mm around what is left of x = 0, where the object is; walls may run from `clear` on.
Cavity right_of_object(Unit clear) {
    Cavity beside;
    beside.outside = beside.on_bed = true;
    beside.region = {rectangle(0, -20 * mm, 40 * mm, 20 * mm)};
    beside.walls = Region{rectangle(clear, -20 * mm, 40 * mm, 20 * mm)};
    return beside;
}

Settings on_bed_alone() {
    Settings settings;
    settings.support = Support::both;
    settings.bed_only = true;
    return settings;
}

PlannedTrack support(std::vector<Point> points) {
    return {{{TrackKind::external_support, 40000, false, std::move(points)}}, Entry::either_end, no_stop};
}

PrintedLayer print_of(std::vector<PlannedTrack> tracks) {
    LayerPlan plan;
    plan.tracks = std::move(tracks);
    return printed_layer(plan);
}

}  // namespace

TEST_CASE("what hangs where no support may stand costs no look at every point of it") {
    const Settings settings = on_bed_alone();
    const Cavity beside = right_of_object(5 * mm);
    const LayerPlan plan;
    const PlanTracks tracks(plan);
    std::vector<Patch> patches;
    GapPatches gap(beside, nullptr, plan, tracks, patches, settings);
    // Tracks of 36 mm just out of reach: minutes, were each of their samples looked at by itself.
    for (Unit x = 0; x < 20; ++x) {
        const Segment line{{4 * mm + x * mm / 50, -18 * mm}, {4 * mm + x * mm / 50, 18 * mm}};
        CHECK_FALSE(gap.add_under_rim({{line, 40000}, 0, 36.0 * mm}, {}));
    }
    CHECK(patches.empty());
    // Its right side is in reach.
    CHECK(gap.add_under_rim({{{{5 * mm - 50000, 0}, {5 * mm - 50000, mm}}, 40000}, 0, 1.0 * mm}, {}));
    for (const Patch& patch : patches) CHECK(patch.segment.a.x > 5 * mm);
}

TEST_CASE("on the bed alone a dot goes to the next support layer by layer, not down to the bed") {
    const Settings settings = on_bed_alone();
    const Cavity beside = right_of_object(0);
    LayerPlan bare;
    bare.layer = 40;
    // The object is nearer to the dot than the support, but nothing may stand on it.
    bare.tracks.push_back(
        {{{TrackKind::outer_perimeter, 40000, true, {{-9 * mm, -mm}, {-20000, -mm}, {-20000, mm}, {-9 * mm, mm}}}},
         Entry::anywhere,
         no_stop});
    SupportForest wall;
    add_edge(add_vertex(SupportVertex{.at = {4 * mm, 0}, .root = true, .free = true, .outside = true}, wall),
             add_vertex(SupportVertex{.at = {8 * mm, 0}, .outside = true}, wall), wall);
    PrintedLayer above = print_of({support({{mm, 0}})});
    Unit x = mm;
    for (int layer = 40; layer > 20; --layer) {
        bare.layer = layer;
        const HeldLayer held = hold_print(bare, wall, &above, settings, &beside);
        for (const PrintPart& part : held.parts) CHECK(part.judgement.verdict().supported);
        above.tracks.clear();
        bool dot = false;
        for (const PrintedTrack& t : held.printed->tracks)
            if (is_external_support(t)) above.tracks.push_back(t);
        for (const Segment& patch : held.patch_tracks) {
            CHECK(patch.a.x > x);
            x = patch.a.x, dot = true;
        }
        if (!dot) break;
    }
    CHECK(x > 3 * mm);
    CHECK(above.tracks.size() == 1);
}

TEST_CASE("a patch of the object keeps its centre line in the slice, around a notch and along a hollow edge") {
    Settings settings;
    settings.support = Support::external;
    settings.support_gap = 20000;
    // The object, left of x = 0, has a notch of 0.3 x 0.3 mm at its edge.
    Cavity beside = right_of_object(40000);
    beside.on_bed = false;
    beside.region = {{{0, -20 * mm},
                      {40 * mm, -20 * mm},
                      {40 * mm, 20 * mm},
                      {0, 20 * mm},
                      {0, 15000},
                      {-30000, 15000},
                      {-30000, -15000},
                      {0, -15000}}};
    const LayerPlan plan;
    const PlanTracks tracks(plan);
    std::vector<Patch> patches;
    GapPatches gap(beside, nullptr, plan, tracks, patches, settings);
    CHECK(gap.add({{5000, -mm}, {5000, mm}}, true));
    CHECK(patches.size() > 4);
    for (const Patch& patch : patches) {
        REQUIRE(patch.kind == TrackKind::support);
        CHECK(gap.runs_in_object(patch.segment));
    }
    CHECK_FALSE(gap.runs_in_object({{0, -20000}, {0, 20000}}));
    CHECK_FALSE(gap.runs_in_object({{-10000, 0}, {0, 30000}}));
    CHECK(gap.runs_in_object({{0, 20000}, {0, 60000}}));
}

TEST_CASE("on the bed alone walls keep their gaps at junctions but where something hangs without") {
    const Settings settings = on_bed_alone();
    const Cavity beside = right_of_object(0);
    SupportForest walls;
    const auto add = [&](Point p, bool root) {
        return add_vertex(SupportVertex{.at = p, .root = root, .free = root, .outside = true}, walls);
    };
    const auto root = add({2 * mm, 0}, true), joint = add({4 * mm, 0}, false);
    for (const Point end : {Point{7 * mm, 0}, Point{4 * mm, 6 * mm}}) add_edge(joint, add(end, false), walls);
    add_edge(root, joint, walls);
    const PrintedLayer none = print_of({support({{3 * mm, 0}, {4 * mm, 0}})});
    HeldLayer held = hold_print({}, walls, &none, settings, &beside);
    CHECK(held.plan.gaps == 1);
    CHECK(held.closed_gaps == 0);
    const PrintedLayer over_gap = print_of({support({{4 * mm + 20000, -20000}, {6 * mm, -20000}})});
    held = hold_print({}, walls, &over_gap, settings, &beside);
    CHECK(held.plan.gaps == 0);
    for (const PrintPart& part : held.parts) CHECK(part.judgement.verdict().supported);
}
