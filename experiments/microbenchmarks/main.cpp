// Usage: ribvault_microbenchmarks MODEL [--height MM] [--up AXIS] [options of Google Benchmark, such as
// --benchmark_filter=hold]
#include <benchmark/benchmark.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>

#include "ribvault/error.hpp"
#include "stages.hpp"

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    CLI::App app("Times each stage of a run on one model, and each stage of the predicates, on one thread");
    std::string file, height;
    ribvault::PlacementOptions placement;
    app.add_option("model", file, "STL, OBJ, OFF, PLY or 3MF")->required();
    app.add_option("--height", height, "mm");
    app.add_option("--up", placement.up, "the file's axis that points up");
    CLI11_PARSE(app, argc, argv);
    try {
        if (!height.empty()) placement.height_mm = ribvault::parse_rational(height, "--height");
        const SweptModel model = sweep_model(file, placement);
        if (model.layers.size() < 3)
            throw ribvault::Error(ribvault::ErrorKind::usage, file + ": fewer than three layers; nothing to time");
        benchmark::AddCustomContext("model", file);
        benchmark::AddCustomContext("layers", std::to_string(model.layers.size()));
        benchmark::AddCustomContext("vertices of all slices", std::to_string(model.vertices));
        register_stages(model);
        register_predicates();
        benchmark::RunSpecifiedBenchmarks();
    } catch (const ribvault::Error& error) {
        std::fprintf(stderr, "ribvault_microbenchmarks: %s\n", error.what());
        return 2;
    }
    return 0;
}
