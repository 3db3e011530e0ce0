#include "stages.hpp"

#include <benchmark/benchmark.h>

#include <functional>
#include <string>

#include "ribvault/mesh/read_mesh.hpp"
#include "ribvault/print/order_paths.hpp"
#include "ribvault/print/shell_paths.hpp"
#include "ribvault/print/write_gcode.hpp"
#include "ribvault/vault/next_layer.hpp"
#include "ribvault/verify/verify_layer.hpp"

using namespace ribvault;

namespace {

/// Seconds per layer and per vertex of all slices.
void count(benchmark::State& state, std::size_t layers, std::size_t vertices) {
    const auto inverse = benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert;
    state.counters["s/layer"] = benchmark::Counter(static_cast<double>(layers), inverse);
    state.counters["s/vertex"] = benchmark::Counter(static_cast<double>(vertices), inverse);
}

/// `work(k)` for the layers first .. last - 1.
void stage(const SweptModel& model, const std::string& name, std::size_t first, std::size_t last,
           std::function<void(std::size_t)> work) {
    std::size_t vertices = 0;
    for (std::size_t k = first; k < last; ++k) vertices += model.layers[k].vertices;
    benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
        for (auto _ : state)
            for (std::size_t k = first; k < last; ++k) work(k);
        count(state, last - first, vertices);
    })->Unit(benchmark::kMillisecond);
}

LayerGeometry geometry(const LayerMaterial& layer) {
    return {layer.slice->exact.get(), &layer.cavity->region, *layer.tracks};
}

void register_input(const SweptModel& model) {
    benchmark::RegisterBenchmark("read", [&model](benchmark::State& state) {
        for (auto _ : state) benchmark::DoNotOptimize(read_mesh(model.file));
        state.counters["s/triangle"] =
            benchmark::Counter(static_cast<double>(model.triangles),
                               benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    })->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark("sort into layers", [&model](benchmark::State& state) {
        for (auto _ : state) benchmark::DoNotOptimize(Slicer(model.mesh, model.placement, model.settings));
        state.counters["s/triangle"] =
            benchmark::Counter(static_cast<double>(model.triangles),
                               benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
    })->Unit(benchmark::kMillisecond);
}

}  // namespace

void register_stages(const SweptModel& model) {
    const std::size_t n = model.layers.size();
    const std::vector<Layer>& layers = model.layers;
    register_input(model);
    stage(model, "slice", 0, n,
          [&](std::size_t k) { benchmark::DoNotOptimize(model.slicer->slice(static_cast<int>(k))); });
    stage(model, "erode", 0, n, [&](std::size_t k) {
        benchmark::DoNotOptimize(erode_slice(*layers[k].swept.material.slice, model.settings));
    });
    stage(model, "cavity", 1, n - 1, [&](std::size_t k) {
        Region region = intersect(intersect(layers[k].eroded, layers[k + 1].eroded), layers[k - 1].eroded);
        benchmark::DoNotOptimize(make_cavity(static_cast<int>(k), std::move(region), model.settings));
    });
    stage(model, "overhang", 0, n - 1, [&](std::size_t k) {
        const LayerMaterial &own = layers[k].swept.material, &above = layers[k + 1].swept.material;
        benchmark::DoNotOptimize(overhang_over_cavity(*own.cavity, *above.slice, *above.cavity, model.settings));
    });
    stage(model, "sweep", 0, n - 1, [&](std::size_t k) {
        SupportForest above = layers[k + 1].swept.forest;
        benchmark::DoNotOptimize(
            next_layer(above, *layers[k].swept.material.cavity, layers[k].overhang, model.settings));
    });
    stage(model, "shell", 0, n, [&](std::size_t k) {
        LayerPlan plan;
        plan.layer = static_cast<int>(k);
        const LayerMaterial& own = layers[k].swept.material;
        append_shell_paths(*own.slice, own.cavity->region, model.settings, model.tracks, plan, covering_of(model, k));
        benchmark::DoNotOptimize(plan);
    });
    stage(model, "hold", 0, n - 1, [&](std::size_t k) {
        benchmark::DoNotOptimize(hold_print(layers[k].shell, layers[k].swept.forest,
                                            layers[k + 1].swept.held.printed.get(), model.settings));
    });
    stage(model, "prove geometry", 1, n, [&](std::size_t k) {
        benchmark::DoNotOptimize(verify_layer(static_cast<int>(k), geometry(layers[k].swept.material),
                                              geometry(layers[k - 1].swept.material), model.settings));
    });
    stage(model, "prove print", 1, n, [&](std::size_t k) {
        benchmark::DoNotOptimize(
            judge_print(*layers[k].swept.held.printed, *layers[k - 1].swept.held.printed, model.settings));
    });
    stage(model, "order paths", 0, n, [&](std::size_t k) {
        benchmark::DoNotOptimize(
            order_paths(layers[k].swept.held.plan, layers[k].swept.material.slice->rounded, model.tracks.alternate));
    });
    stage(model, "travels and text", 0, n, [&](std::size_t k) {
        const LayerMaterial& own = layers[k].swept.material;
        static const PrinterSettings printer;
        const LayerPaths paths = order_paths(layers[k].swept.held.plan, own.slice->rounded, model.tracks.alternate);
        benchmark::DoNotOptimize(
            gcode_layer(paths, TravelMap(own.slice->rounded, own.cavity->region, paths), model.settings, printer));
    });
}
