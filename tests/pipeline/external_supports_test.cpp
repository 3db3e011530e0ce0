// External supports from mesh to proof: nothing overhangs, islands in mid-air included; the gap; what the supports are for.
#include <catch2/catch.hpp>
#include <fstream>
#include <random>

#include "mesh/solids.hpp"
#include "report/scratch_folder.hpp"
#include "ribvault/pipeline/generate.hpp"
#include "ribvault/pipeline/check_bed.hpp"
#include "ribvault/pipeline/sweep_layers.hpp"
#include "ribvault/verify/gap_check.hpp"
#include "ribvault/verify/verify_layer.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

/// A table on one leg, and under its top a hook: a bar in the air that meets the top only higher up.
std::vector<Triangle> table_with_hook() {
    return box({0, 0, 0}, {3, 3, 8}) + box({-4, -4, 8}, {7, 7, 9}) + box({5, 5, 4}, {6, 6, 8}) + box({-3, 5, 4}, {6, 6, 5});
}
/// Random blocks on and over each other, all above a foot.
std::vector<Triangle> random_blocks(std::mt19937_64& random) {
    const auto between = [&](double lo, double hi) { return std::round(std::uniform_real_distribution<double>(lo, hi)(random) * 64) / 64; };
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
        CHECK(report.verdict.print_external_mm[1] == 0);
        CHECK(report.totals.external_support_volume_mm3 > 10);
        // 121 mm2 of top less the leg, 8 mm over the bed: a block under it has 900 mm3.
        CHECK(report.totals.external_support_volume_mm3 < 150);
        CHECK((report.totals.support_volume_mm3 > 0) == (support == Support::both));
        if (support == Support::external) CHECK(report.totals.shell_volume_mm3 == Approx(report.input.volume_mm3).epsilon(0.1));
    }
}

TEST_CASE("random blocks in the air end proved with external supports, with and without a removal gap") {
    std::mt19937_64 random(20191127);
    for (int round = 0; round < 16; ++round) {
        Settings settings = with(round % 2 == 0 ? Support::both : Support::external, std::array<Unit, 4>{0, 0, 10000, 30000}[static_cast<std::size_t>(round) % 4]);
        settings.seed = random();
        settings.top_layers = static_cast<int>(random() % 3);
        settings.bottom_layers = static_cast<int>(random() % 3);
        settings.pillars = round % 4 < 2;
        if (round % 3 == 1) settings.support_radius = 12000, settings.erosion_step = settings.straighten_step = 12000;
        if (round % 5 == 4) settings.propagation = Propagation::shrink, settings.order = Order::doubling, settings.trim = true;
        const RunReport report = run(random_blocks(random), settings);
        INFO("round " << round);
        CHECK(report.verdict.proved);
        CHECK(report.verdict.print_proved);
        CHECK(report.totals.external_support_volume_mm3 > 0);
        if (settings.support_gap == 0) CHECK(report.verdict.external_overhangs.empty());
    }
}

TEST_CASE("no support track comes nearer to the object than the gap, and without the supports every layer they hold is refuted") {
    Mesh mesh = weld(table_with_hook());
    const Settings settings = with(Support::external, 20000);
    const Placement placement = place(mesh, {});
    const Slicer slicer(mesh, placement, settings);
    std::vector<LayerMaterial> layers(static_cast<std::size_t>(slicer.layer_count()));
    sweep_layers(slicer, settings, {}, 1, [](const SweptLayer&, const LayerMaterial*) { return std::shared_ptr<void>(); },
                 [&](const SweptLayer& layer, std::shared_ptr<void>) { layers[static_cast<std::size_t>(layer.material.layer)] = layer.material; },
                 [] { return false; }, support_frame(mesh, placement, settings));
    int held = 0;
    for (std::size_t i = 0; i + 1 < layers.size(); ++i) {
        const auto geometry = [&](std::size_t k) { return LayerGeometry{layers[k].slice->exact.get(), &layers[k].cavity->region, *layers[k].tracks}; };
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
    const std::vector<Triangle> slot = box({0, 0, 0}, {2, 8, 4}) + box({3, 0, 0}, {5, 8, 4}) + box({0, 0, 4}, {5, 8, 5});
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
