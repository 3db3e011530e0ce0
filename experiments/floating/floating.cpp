// ribvault_floating: the layers of a run before the exact verifier and before the same checks in doubles, as JSON.
//
// As generated, the supports keep a slack of 1 µm, and doubles have it easy. At the threshold they do not: for each
// layer whose supports matter, one end of one track below is moved back along its track to the last 10 nm at which
// equation (2) still holds, and to the first at which it does not; both are asked of both.
#include <CLI/CLI.hpp>
#include <iostream>
#include <mutex>
#include <nlohmann/json.hpp>

#include "ribvault/error.hpp"
#include "ribvault/mesh/place_mesh.hpp"
#include "ribvault/mesh/orient_mesh.hpp"
#include "ribvault/mesh/read_mesh.hpp"
#include "ribvault/pipeline/sweep_layers.hpp"
#include "ribvault/verify/verify_layer.hpp"

namespace ribvault {

LayerVerdict verify_layer_floating(int upper_layer, const LayerGeometry& upper, const LayerGeometry& lower,
                                   const Settings& settings);

namespace {

struct Tally {
    long layers = 0, refuted = 0, false_alarms = 0, missed = 0;                      // as generated
    long thresholds = 0, threshold_false_alarms = 0, threshold_missed = 0, errors = 0;  // 10 nm on either side
};

LayerGeometry geometry(const LayerMaterial& layer) {
    return {layer.slice->exact.get(), &layer.cavity->region, *layer.tracks};
}

/// Shortens the longest track below by `by` lattice units.
LayerGeometry shortened(LayerGeometry lower, std::size_t track, Unit by) {
    Segment& s = lower.tracks[track];
    const double whole = length(s), t = 1 - static_cast<double>(by) / whole;
    const Point d = s.b - s.a;
    s.b = {s.a.x + round_to_lattice(t * static_cast<double>(d.x)),
           s.a.y + round_to_lattice(t * static_cast<double>(d.y))};
    return lower;
}

void compare(int layer, const LayerGeometry& above, const LayerGeometry& below, const Settings& s, long& false_alarms,
             long& missed, long& errors, long* refuted = nullptr) {
    const LayerVerdict truth = verify_layer(layer, above, below, s);
    LayerVerdict believed;
    try {
        believed = verify_layer_floating(layer, above, below, s);
    } catch (const std::exception&) {
        ++errors;  // doubles may lead the algorithm where it must not come
        return;
    }
    const bool internal = truth.supported, external = truth.external.has_value();
    false_alarms += (internal && !believed.supported) || (!external && believed.external);
    missed += (!internal && believed.supported) || (external && !believed.external);
    if (refuted) *refuted += !internal;
}

void try_layer(int layer, const LayerGeometry& above, const LayerGeometry& below, const Settings& s, bool thresholds,
               Tally& tally) {
    ++tally.layers;
    compare(layer, above, below, s, tally.false_alarms, tally.missed, tally.errors, &tally.refuted);
    if (!thresholds || below.tracks.empty()) return;
    std::size_t longest = 0;
    for (std::size_t k = 1; k < below.tracks.size(); ++k)
        if (length(below.tracks[k]) > length(below.tracks[longest])) longest = k;
    Unit good = 0, bad = static_cast<Unit>(length(below.tracks[longest])) - 1;
    const auto holds = [&](Unit by) { return verify_layer(layer, above, shortened(below, longest, by), s).supported; };
    if (bad < 2 || !holds(good) || holds(bad)) return;
    while (bad - good > 1) (holds((good + bad) / 2) ? good : bad) = (good + bad) / 2;
    ++tally.thresholds;
    for (const Unit by : {good, bad})
        compare(layer, above, shortened(below, longest, by), s, tally.threshold_false_alarms, tally.threshold_missed,
                tally.errors);
}

nlohmann::ordered_json run(const std::string& model, const PlacementOptions& placing, int covers, int every) {
    Settings settings;
    settings.top_layers = settings.bottom_layers = covers;
    settings.check();
    Mesh mesh = read_mesh(model);
    const Placement placement = place(mesh, placing);
    orient_consistently(mesh);
    const Slicer slicer(mesh, placement, settings);
    Tally tally;
    std::mutex mutex;
    const auto finish = [&](const SweptLayer& swept, const LayerMaterial* below) {
        if (!below) return std::shared_ptr<void>();
        Tally one;
        try_layer(swept.material.layer, geometry(swept.material), geometry(*below), settings,
                  swept.material.layer % every == 0, one);
        const std::lock_guard lock(mutex);
        tally.layers += one.layers, tally.refuted += one.refuted, tally.false_alarms += one.false_alarms,
            tally.missed += one.missed;
        tally.thresholds += one.thresholds, tally.threshold_false_alarms += one.threshold_false_alarms;
        tally.threshold_missed += one.threshold_missed, tally.errors += one.errors;
        return std::shared_ptr<void>();
    };
    sweep_layers(
        slicer, settings, {}, 0, finish, [](const SweptLayer&, std::shared_ptr<void>) {}, [] { return false; });
    return {{"layers", tally.layers},
            {"refuted", tally.refuted},
            {"false_alarms", tally.false_alarms},
            {"missed", tally.missed},
            {"thresholds", tally.thresholds},
            {"threshold_false_alarms", tally.threshold_false_alarms},
            {"threshold_missed", tally.threshold_missed},
            {"errors", tally.errors}};
}

}  // namespace
}  // namespace ribvault

int main(int argc, char** argv) {
    CLI::App app{"The exact verifier and the same checks in doubles on the same layers"};
    std::string model, scale, height, up = "z";
    int covers = 1, every = 5;
    app.add_option("model", model)->required();
    app.add_option("--scale", scale), app.add_option("--height", height);
    app.add_option("--up", up)->check(CLI::IsMember({"x", "y", "z"}));
    app.add_option("--covers", covers, "at top and bottom"),
        app.add_option("--every", every, "thresholds on every n-th layer");
    CLI11_PARSE(app, argc, argv);
    try {
        ribvault::PlacementOptions placing;
        if (!scale.empty()) placing.scale = ribvault::parse_rational(scale, "--scale");
        if (!height.empty()) placing.height_mm = ribvault::parse_rational(height, "--height");
        placing.up = up[0];
        std::cout << ribvault::run(model, placing, covers, every).dump(1) << "\n";
    } catch (const ribvault::Error& e) {
        std::cerr << "ribvault_floating: " << e.what() << "\n";
        return static_cast<int>(e.kind());
    }
    return 0;
}
