// External supports from mesh to proof: nothing overhangs, islands in mid-air included; the gap; what the supports are
// for.
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <random>

#include "mesh/solids.hpp"
#include "report/scratch_folder.hpp"
#include "ribvault/exact/nearest_segment.hpp"
#include "ribvault/exact/point_location.hpp"
#include "ribvault/pipeline/check_bed.hpp"
#include "ribvault/pipeline/generate.hpp"
#include "ribvault/pipeline/prove_layer.hpp"
#include "ribvault/pipeline/sweep_layers.hpp"
#include "ribvault/pipeline/verify_print.hpp"
#include "ribvault/verify/gap_check.hpp"
#include "ribvault/verify/verify_layer.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

/// A table on one leg, and under its top a hook: a bar in the air that meets the top only higher up.
std::vector<Triangle> table_with_hook() {
    return box({0, 0, 0}, {3, 3, 8}) + box({-4, -4, 8}, {7, 7, 9}) + box({5, 5, 4}, {6, 6, 8}) +
           box({-3, 5, 4}, {6, 6, 5});
}
/// A column of n sides that widens over its middle part, twisted by an angle on the way.
std::vector<Triangle> funnel(int n, double twist, std::array<double, 4> radii = {2, 2, 10, 10},
                             std::array<double, 4> heights = {0, 3, 5.5, 6.5}) {
    const auto corner = [&](std::size_t ring, int k) {
        const double angle = 2 * M_PI * (k % n) / n + (ring > 1 ? twist : 0);
        return Corner{radii[ring] * std::cos(angle), radii[ring] * std::sin(angle), heights[ring]};
    };
    std::vector<Triangle> triangles;
    for (int k = 0; k < n; ++k) {
        for (std::size_t ring = 0; ring < 3; ++ring) {
            triangles.push_back({corner(ring, k), corner(ring, k + 1), corner(ring + 1, k + 1)});
            triangles.push_back({corner(ring, k), corner(ring + 1, k + 1), corner(ring + 1, k)});
        }
        triangles.push_back({Corner{0, 0, 0}, corner(0, k + 1), corner(0, k)});
        triangles.push_back({Corner{0, 0, heights[3]}, corner(3, k), corner(3, k + 1)});
    }
    return triangles;
}
/// Random blocks on and over each other, all above a foot.
std::vector<Triangle> random_blocks(std::mt19937_64& random) {
    const auto between = [&](double lo, double hi) {
        return std::round(std::uniform_real_distribution<double>(lo, hi)(random) * 64) / 64;
    };
    std::vector<Triangle> all = box({0, 0, 0}, {between(2, 5), between(2, 5), 6});
    for (int k = 0; k < 5; ++k) {
        const double x = between(-5, 5), y = between(-5, 5), z = between(1, 6);
        all = all + box({x, y, z}, {x + between(0.5, 5), y + between(0.5, 5), z + between(0.3, 3)});
    }
    return all;
}

RunReport run(const std::vector<Triangle>& solid, const Settings& settings) {
    const ScratchFolder folder;
    Job job;
    job.model = folder / "solid.stl";
    job.settings = settings;
    std::ofstream(job.model, std::ios::binary) << binary_stl(solid);
    return generate(job);
}
Settings with(Support support, Unit gap = 0) {
    Settings settings;
    settings.support = support, settings.support_gap = gap;
    return settings;
}

}  // namespace

TEST_CASE("without external supports a table overhangs, with them it is proved, geometry and print") {
    const RunReport without = run(table_with_hook(), with(Support::internal));
    CHECK(without.verdict.proved);
    CHECK(without.verdict.external_overhangs.size() == 2);  // the hook's bar and the top
    CHECK(without.totals.external_support_volume_mm3 == 0);
    for (const Support support : {Support::external, Support::both}) {
        const RunReport report = run(table_with_hook(), with(support));
        CHECK(report.verdict.proved);
        CHECK(report.verdict.print_proved);
        CHECK(report.verdict.external_overhangs.empty());
        CHECK(report.verdict.print_external_mm.hi == 0);
        CHECK(report.totals.external_support_volume_mm3 > 10);
        // 121 mm2 of top less the leg, 8 mm over the bed: a block under it has 900 mm3.
        CHECK(report.totals.external_support_volume_mm3 < 150);
        CHECK((report.totals.support_volume_mm3 > 0) == (support == Support::both));
        if (support == Support::external)
            CHECK(report.totals.shell_volume_mm3 == Approx(report.input.volume_mm3).epsilon(0.1));
    }
}

TEST_CASE("random blocks in the air end proved with external supports, with and without a removal gap") {
    std::mt19937_64 random(20191127);
    for (int round = 0; round < 16; ++round) {
        Settings settings = with(round % 2 == 0 ? Support::both : Support::external,
                                 std::array<Unit, 4>{0, 0, 10000, 30000}[static_cast<std::size_t>(round) % 4]);
        settings.seed = random();
        settings.top_layers = static_cast<int>(random() % 3);
        settings.bottom_layers = static_cast<int>(random() % 3);
        settings.pillars = round % 4 < 2;
        if (round % 3 == 1) settings.support_radius = 12000, settings.erosion_step = settings.straighten_step = 12000;
        if (round % 5 == 4)
            settings.propagation = Propagation::shrink, settings.order = Order::doubling, settings.trim = true;
        const RunReport report = run(random_blocks(random), settings);
        INFO("round " << round);
        CHECK(report.verdict.proved);
        CHECK(report.verdict.print_proved);
        CHECK(report.totals.external_support_volume_mm3 > 0);
        if (settings.support_gap == 0) CHECK(report.verdict.external_overhangs.empty());
    }
}

TEST_CASE("inside the object supports that stand off let nothing hang: what is proved with them is supported without") {
    const std::vector<Triangle> solid = box({0, 0, 0}, {12, 12, 8}) + box({10, 2, 5}, {18, 9, 8});
    for (int round = 0; round < 8; ++round) {
        Settings settings = with(Support::both, round % 2 == 0 ? 20000 : 0);
        settings.support_radius = settings.erosion_step = settings.straighten_step = round < 4 ? 20000 : 8000;
        settings.support_gap_layers = round % 4 == 1 ? 1 : 0;
        settings.bed_only = round % 4 >= 2;
        if (round % 3 == 2) settings.propagation = Propagation::shrink, settings.order = Order::doubling;
        const ScratchFolder folder;
        Job job;
        job.model = folder / "solid.stl", job.gcode = folder / "out.gcode", job.settings = settings;
        std::ofstream(job.model, std::ios::binary) << binary_stl(solid);
        const RunReport report = generate(job);
        INFO("round " << round);
        CHECK(report.verdict.print_proved);
        CHECK(report.totals.support_volume_mm3 > 5);
        VerifyJob check;
        check.gcode = *job.gcode, check.inside = true;
        check.support_radius = Rational(settings.support_radius, units_per_mm);
        CHECK(verify_print(check).supported);
        // The same with what lies outside, as far as the gaps go.
        check.inside = false;
        check.support_gap = Rational(settings.support_gap, units_per_mm);
        check.support_gap_layers = settings.support_gap_layers, check.bed_only = settings.bed_only;
        CHECK(verify_print(check).supported);
    }
}

TEST_CASE(
    "no support track comes nearer to the object than the gap, and without the supports every layer they hold is "
    "refuted") {
    Mesh mesh = weld(table_with_hook());
    const Settings settings = with(Support::external, 20000);
    const Placement placement = place(mesh, {});
    const Slicer slicer(mesh, placement, settings);
    const OutsideRoom room(slicer, support_frame(mesh, placement, settings), settings, 1, [] { return false; });
    std::vector<LayerMaterial> layers(static_cast<std::size_t>(slicer.layer_count()));
    sweep_layers(
        slicer, settings, {}, 1, [](const SweptLayer&, const LayerMaterial*) { return std::shared_ptr<void>(); },
        [&](const SweptLayer& layer, std::shared_ptr<void>) {
            layers[static_cast<std::size_t>(layer.material.layer)] = layer.material;
        },
        [] { return false; }, &room);
    int held = 0;
    for (std::size_t i = 0; i + 1 < layers.size(); ++i) {
        const auto geometry = [&](std::size_t k) {
            return LayerGeometry{layers[k].slice->exact.get(), &layers[k].cavity->region, *layers[k].tracks};
        };
        CHECK_FALSE(find_too_near(*layers[i].slice->exact, *layers[i].tracks, 40000));
        CHECK(verify_layer(static_cast<int>(i) + 1, geometry(i + 1), geometry(i), settings).supported);
        if (layers[i + 1].tracks->empty() && layers[i].tracks->empty()) continue;
        LayerGeometry bare = geometry(i);
        bare.tracks.clear();
        CHECK_FALSE(verify_layer(static_cast<int>(i) + 1, geometry(i + 1), bare, settings).supported);
        ++held;
    }
    CHECK(held >= 38);  // down from the top at 8 mm
}

TEST_CASE("crevices narrower than the gap are named, and do not pass for held up") {
    // A roof over a slot of 1 mm between two walls: with a gap of 0.6 mm no track fits between them.
    const std::vector<Triangle> slot =
        box({0, 0, 0}, {2, 8, 4}) + box({3, 0, 0}, {5, 8, 4}) + box({0, 0, 4}, {5, 8, 5});
    const RunReport report = run(slot, with(Support::external, 60000));
    REQUIRE(report.verdict.external_overhangs.size() == 1);
    CHECK(report.verdict.external_overhangs[0].layer == 20);
    const auto& place = report.layers[20].verdict.external;
    REQUIRE(place);
    CHECK(place->witness_certified);
    CHECK(report.verdict.proved);  // within g + r of the object
    const RunReport filled = run(slot, with(Support::external));
    CHECK(filled.verdict.external_overhangs.empty());
    CHECK(filled.verdict.proved);
}

namespace {

/// All layers of a sweep, from the bed up.
struct Swept {
    Mesh mesh;
    Placement placement;
    Slicer slicer;
    std::optional<OutsideRoom> room;
    std::vector<SweptLayer> layers;

    Swept(const std::vector<Triangle>& solid, const Settings& settings)
        : mesh(weld(solid)),
          placement(place(mesh, {})),
          slicer(mesh, placement, settings),
          layers(static_cast<std::size_t>(slicer.layer_count())) {
        room.emplace(slicer, support_frame(mesh, placement, settings), settings, 1, [] { return false; });
        sweep_layers(
            slicer, settings, {}, 1, [](const SweptLayer&, const LayerMaterial*) { return std::shared_ptr<void>(); },
            [&](const SweptLayer& layer, std::shared_ptr<void>) {
                layers[static_cast<std::size_t>(layer.material.layer)] = layer;
            },
            [] { return false; }, &*room);
    }
};

/// A column on a foot that reaches as far as the roof over it: what holds up the roof stands on the foot, or slants
/// past it. `foot`: half its side.
std::vector<Triangle> column_on_foot(double foot) {
    return box({-foot, -foot, 0}, {foot, foot, 1}) + box({-1, -1, 1}, {1, 1, 8}) + box({-4, -4, 8}, {4, 4, 9});
}

}  // namespace

TEST_CASE(
    "what is refuted across a removal gap is named by a place farther from the object than the gap and half a track") {
    const Settings settings = with(Support::external, 30000);
    const Swept swept(column_on_foot(0.5), settings);
    const LayerMaterial &upper = swept.layers[40].material, &lower = swept.layers[39].material;
    CHECK(prove_layer(upper, lower, settings).supported);
    LayerMaterial bare = lower;
    bare.tracks = bare.external = std::make_shared<const std::vector<Segment>>();
    const LayerVerdict verdict = prove_layer(upper, bare, settings);
    CHECK_FALSE(verdict.supported);
    REQUIRE(verdict.external);
    // The column is 2 mm wide and stands in the middle of the bed.
    const auto beyond = [](double x) { return std::max(std::abs(x - 125) - 1, 0.0); };
    CHECK(std::hypot(beyond(verdict.external->witness[0]), beyond(verdict.external->witness[1])) > 0.5);
    const double reached = (2 * 1 + 2 * 0.5) * (2 * 1 + 2 * 0.5) - (4 - M_PI) * 0.25;
    CHECK(verdict.external->area_hi == Approx(64 - reached).epsilon(0.02));
}

TEST_CASE("supports on the bed alone stand on no part of the object, and slant past what is in their way") {
    for (const Unit gap : {0, 30000}) {
        Settings settings = with(Support::external, gap);
        const RunReport on_foot = run(column_on_foot(5), settings);
        CHECK(on_foot.verdict.proved);
        settings.bed_only = true;
        // From the middle of the roof to beside the foot: 5 mm and the gap, over 7 mm of height.
        const Swept swept(column_on_foot(5), settings);
        double on_bed = 0;
        for (const Segment& s : *swept.layers[0].material.external) on_bed += length(s);
        CHECK(on_bed > 0);
        for (std::size_t i = 1; i < swept.layers.size(); ++i) {
            INFO("gap " << gap << ", layer " << i);
            const LayerMaterial &upper = swept.layers[i].material, &lower = swept.layers[i - 1].material;
            CHECK(prove_layer(upper, lower, settings).supported);
            LayerMaterial bare = lower;
            bare.external = std::make_shared<const std::vector<Segment>>();
            if (!upper.external->empty())
                CHECK_FALSE(prove_layer(upper, bare, settings).supported);  // though the object is still there
        }
        const RunReport report = run(column_on_foot(5), settings);
        CHECK(report.verdict.proved);
        CHECK(report.verdict.print_proved);
    }
}

TEST_CASE("a roof from which no way leads to the bed is refuted and named when supports may stand on the bed only") {
    Settings settings = with(Support::external);
    settings.bed_only = true;
    // 14 mm to the side, over 7 mm of height: too far for 0.2 mm a layer.
    const RunReport report = run(column_on_foot(14), settings);
    CHECK_FALSE(report.verdict.proved);
    REQUIRE_FALSE(report.verdict.layers_refuted.empty());
    CHECK(report.verdict.layers_refuted.back() == 40);
    const auto& place = report.layers[40].verdict.external;
    REQUIRE(place);
    CHECK(std::max(std::abs(place->witness[0] - 125), std::abs(place->witness[1] - 125)) < 4.01);
    settings.bed_only = false;
    CHECK(run(column_on_foot(14), settings).verdict.proved);
}

TEST_CASE("ways to the bed: every point of one is within rho of one on the layer below") {
    std::mt19937_64 random(5);
    for (int round = 0; round < 4; ++round) {
        Settings settings = with(Support::external, round % 2 == 0 ? 0 : 20000);
        settings.bed_only = true, settings.support_gap_layers = round / 2;
        Mesh mesh = weld(random_blocks(random));
        const Placement placement = place(mesh, {});
        const Slicer slicer(mesh, placement, settings);
        const OutsideRoom room(slicer, support_frame(mesh, placement, settings), settings, 2, [] { return false; });
        const auto ways = [&](int layer) {
            const Cavity outside = room.of(std::make_shared<const Slice>(slicer.slice(layer)), {});
            REQUIRE(outside.walls);
            CHECK(outside.on_bed);
            return *outside.walls;
        };
        std::size_t looked = 0;
        for (int i = 1; i < slicer.layer_count(); ++i) {
            const NearestSegment below(edges_of(ways(i - 1)));
            const PointLocation location(below.segments(), units_per_mm);
            for (const Segment& e : edges_of(ways(i))) {
                const Point middle{(e.a.x + e.b.x) / 2, (e.a.y + e.b.y) / 2};
                for (const Point p : {e.a, middle}) {
                    ++looked;
                    const bool inside = location.locate(p) != Side::outside;
                    CHECK((inside || compare_distance(p, below.segments()[below.nearest(p).index],
                                                      settings.support_radius) <= 0));
                }
            }
        }
        CHECK(looked > 400);
    }
}

TEST_CASE("over a gap of layers nothing stands right under the object, and what hangs is proved through the gap") {
    for (const int gap : {1, 3}) {
        Settings settings = with(Support::external, 10000);
        settings.support_gap_layers = gap;
        const Swept swept(table_with_hook(), settings);
        std::size_t through = 0;
        for (std::size_t k = 0; k < swept.layers.size(); ++k) {
            const SweptLayer& layer = swept.layers[k];
            INFO("gap " << gap << ", layer " << k);
            for (std::size_t j = k; j <= std::min(k + static_cast<std::size_t>(gap), swept.layers.size() - 1); ++j)
                CHECK_FALSE(find_too_near(*swept.layers[j].material.slice->exact, *layer.material.external, 30000));
            if (k > 0) CHECK(prove_layer(layer.material, swept.layers[k - 1].material, settings).supported);
            for (const OverGap& over : layer.over_gap) {
                CHECK(over.over_bed == (over.upper.layer <= gap));
                if (over.over_bed) continue;
                CHECK(over.upper.layer - layer.material.layer == gap + 1);
                CHECK(over.gap.size() == static_cast<std::size_t>(gap));
                CHECK(prove_over_gap(over, layer.material, settings).supported);
                REQUIRE(over.print.hanging);
                const auto part = std::find_if(layer.held.parts.begin(), layer.held.parts.end(),
                                               [](const PrintPart& p) { return p.over_gap; });
                CHECK((part == layer.held.parts.end()) == over.print.hanging->tracks.empty());
                if (part != layer.held.parts.end()) CHECK(part->judgement.verdict().supported);
                LayerMaterial bare = layer.material;
                bare.external = std::make_shared<const std::vector<Segment>>();
                through += !prove_over_gap(over, bare, settings).supported;
            }
        }
        CHECK(through == 2);  // the hook's bar and the top
        const RunReport report = run(table_with_hook(), settings);
        CHECK(report.verdict.proved);
        CHECK(report.verdict.print_proved);
    }
}

TEST_CASE(
    "the supports under the gap hold up what a printed slice's rounded corners leave, so the perimeter is not printed "
    "twice") {
    for (const auto& [sides, twist] : {std::pair(3, 0.0), {4, 0.0}, {5, 0.25}, {12, 0.0}, {12, 0.3}, {24, 0.2}})
        for (const int gap : {1, 3}) {
            Settings settings = with(Support::external, 20000);
            settings.support_gap_layers = gap;
            INFO(sides << " sides, " << gap << " layers");
            const RunReport report = run(funnel(sides, twist), settings);
            CHECK(report.verdict.proved);
            CHECK(report.verdict.print_proved);
            CHECK(report.totals.external_support_volume_mm3 > 100);
            if (sides == 3) continue;           // tips of 60 degrees are too thin for a track: they get patches
            CHECK(report.totals.patches < 40);  // hundreds where corners get their own
            CHECK(report.verdict.layers_with_patches_in_gap.empty());
        }
}

TEST_CASE(
    "a support under a gap holds up the rim at a sharp corner, though it cannot come within rho of the centre line") {
    for (const auto& [sides, gap] : {std::pair(3, 3), {4, 1}, {5, 1}, {5, 3}}) {
        Settings settings = with(Support::external, 0);
        settings.support_gap_layers = gap;
        INFO(sides << " sides, " << gap << " layers");
        const RunReport report = run(funnel(sides, 0, {1.5, 1.5, 4.5, 4.5}, {0, 1, 3.5, 4.3}), settings);
        CHECK(report.verdict.proved);
        CHECK(report.verdict.print_proved);
    }
}

TEST_CASE(
    "a blade too thin for a track is printed where it holds something up, and where that leaves less than the gap is "
    "told") {
    const auto table_on_blade = [](double width) {
        return box({-4, -4, 0}, {4, 4, 1}) + box({-width / 2, -3, 1}, {width / 2, 3, 5}) + box({-4, -4, 5}, {4, 4, 6});
    };
    const RunReport thin = run(table_on_blade(0.1), with(Support::external, 30000)),
                    wide = run(table_on_blade(0.3), with(Support::external, 30000));
    for (const RunReport* report : {&thin, &wide}) {
        CHECK(report->verdict.proved);
        CHECK(report->verdict.print_proved);
    }
    CHECK(thin.verdict.layers_with_patches_in_gap.size() == 20);  // all of its height
    CHECK(thin.layers[10].patch_in_gap);
    CHECK(wide.verdict.layers_with_patches_in_gap.empty());
    Settings on_bed = with(Support::external, 0);
    on_bed.bed_only = true;
    CHECK(run(table_on_blade(0.1), on_bed).verdict.layers_with_patches_in_gap.empty());  // there is no gap
}

TEST_CASE("random blocks on supports from the bed, and through gaps of layers, are proved or say what is not") {
    std::mt19937_64 random(20261128);
    int proved = 0;
    for (int round = 0; round < 16; ++round) {
        Settings settings = with(round % 4 < 2 ? Support::external : Support::both,
                                 std::array<Unit, 3>{0, 10000, 30000}[static_cast<std::size_t>(round) % 3]);
        settings.bed_only = round % 2 == 0;
        settings.support_gap_layers = std::array<int, 3>{1, 0, 2}[static_cast<std::size_t>(round / 2) % 3];
        if (round % 5 == 4)
            settings.propagation = Propagation::shrink, settings.order = Order::doubling, settings.trim = true;
        const RunReport report = run(random_blocks(random), settings);
        INFO("round " << round);
        if (!settings.bed_only) CHECK(report.verdict.proved);
        if (report.verdict.proved) CHECK(report.verdict.print_proved);
        proved += report.verdict.proved;
    }
    CHECK(proved >= 10);
}

TEST_CASE("pillars in a cavity: a roof of low slope takes less, and is proved with both strategies") {
    // Figure 25, left: the box's top leans by 8 degrees.
    std::vector<Triangle> slab = box({0, 0, 0}, {24, 16, 8});
    for (Triangle& t : slab)
        for (Corner& corner : t)
            if (corner[2] > 0 && corner[0] > 0) corner[2] = 11.375;
    for (const bool thrifty : {false, true}) {
        Settings settings;
        if (thrifty) settings.propagation = Propagation::shrink, settings.order = Order::doubling, settings.trim = true;
        const RunReport walls = run(slab, settings);
        settings.pillars = true;
        const RunReport pillars = run(slab, settings);
        CHECK(pillars.verdict.proved);
        CHECK(pillars.verdict.print_proved);
        CHECK(pillars.totals.support_volume_mm3 < (thrifty ? 0.7 : 0.9) * walls.totals.support_volume_mm3);
        CHECK(pillars.totals.support_volume_mm3 > 0);
    }
}

TEST_CASE(
    "the cube's roof stands on leaning trees: less than CuraEngine's lightning fill and iterative carving, proved") {
    // 217 mm³ of tracks as wide, not all of them supported (CuraEngine 4.13), and 954 mm³ in all (Table 2).
    Settings settings;
    settings.propagation = Propagation::shrink, settings.order = Order::doubling, settings.trim = true;
    settings.choose_bonus = true;
    const double walls = run(box({0, 0, 0}, {20, 20, 20}), settings).totals.support_volume_mm3;
    settings.pillars = true;
    const RunReport millimetre = run(box({0, 0, 0}, {20, 20, 20}), settings);
    CHECK(millimetre.verdict.proved);
    CHECK(millimetre.verdict.print_proved);
    CHECK(millimetre.totals.support_volume_mm3 < 0.85 * walls);
    settings.leaning_length = settings.nozzle;
    const RunReport least = run(box({0, 0, 0}, {20, 20, 20}), settings);
    CHECK(least.verdict.proved);
    CHECK(least.verdict.print_proved);
    CHECK(least.totals.support_volume_mm3 < 217);
    CHECK(least.totals.material_mm3 < 954);
    // A dot that reached a little beyond what the shell holds up in a corner had itself below it, down to the floor.
    int patches_alone = 0;
    for (const LayerReport& layer : least.layers) patches_alone += layer.patches > 0 && layer.trees == 0;
    CHECK(patches_alone <= 2);
}

TEST_CASE("random blocks with pillars in their cavities and outside are proved") {
    std::mt19937_64 random(2511);
    for (int round = 0; round < 8; ++round) {
        Settings settings = with(round % 2 == 0 ? Support::internal : Support::both);
        settings.seed = random(), settings.pillars = true;
        settings.top_layers = settings.bottom_layers = round % 3;
        if (round % 4 > 1)
            settings.propagation = Propagation::shrink, settings.order = Order::doubling, settings.trim = true;
        const RunReport report = run(random_blocks(random) + box({-9, -9, 0}, {9, 9, 3}), settings);
        INFO("round " << round);
        CHECK(report.verdict.proved);
        CHECK(report.verdict.print_proved);
    }
}

TEST_CASE(
    "a leaning block that recedes by exactly rho needs no support, one that recedes by 20 pm more gets them, and is "
    "proved") {
    for (const float shift : {10.0f, std::nextafter(10.0f, 11.0f)}) {
        std::vector<Triangle> block = box({0, 0, 0}, {4, 3, 10});
        for (Triangle& t : block)
            for (Corner& corner : t)
                if (corner[2] > 0) corner[0] += shift;
        const RunReport report = run(block, with(Support::external));
        INFO("shifted by " << shift);
        CHECK(report.verdict.proved);
        CHECK(report.verdict.print_proved);
        CHECK((report.totals.external_support_volume_mm3 > 0) == (shift > 10));
    }
}

TEST_CASE("through a gap of layers an empty cavity holds up nothing") {
    // A box without covers at its top, open there, a neck one layer high, and a floor that hangs over the opening.
    Settings settings = with(Support::both);
    settings.top_layers = 0, settings.support_gap_layers = 1, settings.gaps = Gaps::paper;
    const RunReport report =
        run(box({0, 0, 0}, {20, 20, 2}) + box({8, 8, 2}, {12, 12, 2.2}) + box({0, 0, 2.2}, {20, 20, 3.2}), settings);
    CHECK_FALSE(report.verdict.proved);
    CHECK(report.verdict.layers_refuted == std::vector<int>{11});
}
