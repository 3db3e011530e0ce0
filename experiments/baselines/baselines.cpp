// ribvault_baselines: other ways to make a print light, as JSON on the standard output. Options as in `ribvault
// generate`.
#include <CLI/CLI.hpp>
#include <array>
#include <bit>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "carve.hpp"
#include "ribvault/error.hpp"
#include "ribvault/exact/rational.hpp"
#include "standard_infill.hpp"

namespace {

using namespace ribvault;
using namespace ribvault::baselines;
using Json = nlohmann::ordered_json;

struct Options {
    std::string model, output, scale, height, up = "z", layer_height = "0.2", nozzle = "0.4", bed = "250,250,250";
    int perimeters = 1, top_layers = 1, bottom_layers = 1;
    double density = 0.15;
    std::string pattern = "grid";
    bool no_judge = false;

    Settings settings() const {
        Settings s;
        s.layer_height = s.first_layer_height = parse_length(layer_height, "--layer-height");
        s.nozzle = parse_length(nozzle, "--nozzle");
        s.support_radius = s.erosion_step = s.straighten_step = s.nozzle / 2;
        s.sampling_pitch = s.nozzle / 4;
        s.perimeters = perimeters, s.top_layers = top_layers, s.bottom_layers = bottom_layers;
        s.check();
        return s;
    }
    PlacementOptions placement() const {
        PlacementOptions p;
        if (!scale.empty()) p.scale = parse_rational(scale, "--scale");
        if (!height.empty()) p.height_mm = parse_rational(height, "--height");
        p.up = up[0];
        if (std::sscanf(bed.c_str(), "%lf,%lf,%lf", &p.bed_x, &p.bed_y, &p.bed_z) != 3)
            throw Error(ErrorKind::usage, "--bed: write for example --bed 250,210,200");
        return p;
    }
};

Json facts_json(const MeshFacts& facts) {
    return {{"triangles", facts.triangles},
            {"size_mm", facts.size_mm},
            {"volume_mm3", facts.volume_mm3},
            {"closed", facts.closed()}};
}

Json judgement_json(const Judgement& j) {
    return {{"layers", j.layers},
            {"layers_refuted", j.refuted},
            {"layers_malformed", j.malformed},
            {"layers_external", j.external},
            {"unsupported_area_mm2", {j.area_lo_mm2, j.area_hi_mm2}},
            {"worst_distance_mm", j.worst_distance_mm},
            {"stages",
             {{"interval", j.stages.interval}, {"rational", j.stages.rational}, {"algebraic", j.stages.algebraic}}}};
}

/// The placed mesh as binary STL, for programs that read nothing else.
void write_stl(const std::string& file, const Mesh& mesh, const Placement& placement) {
    std::ofstream out(file, std::ios::binary);
    const std::array<char, 80> header{};
    const auto count = static_cast<std::uint32_t>(mesh.triangles.cols());
    out.write(header.data(), header.size());
    out.write(reinterpret_cast<const char*>(&count), 4);
    for (Eigen::Index t = 0; t < mesh.triangles.cols(); ++t) {
        std::array<float, 12> facet{};
        for (int corner = 0; corner < 3; ++corner)
            for (std::size_t k = 0; k < 3; ++k) {
                const double c = mesh.vertices(placement.axis[k], mesh.triangles(corner, t)) * placement.sign[k];
                facet[3 + 3 * static_cast<std::size_t>(corner) + k] =
                    static_cast<float>(c * placement.scale.get_d() + placement.offset[k].get_d());
            }
        out.write(reinterpret_cast<const char*>(facet.data()), sizeof facet);
        out.write("\0", 2);
    }
    out.flush();
    if (!out) throw Error(ErrorKind::cannot_write, file + ": cannot be written");
}

Json run(const std::string& method, const Options& o) {
    const auto start = std::chrono::steady_clock::now();
    const Settings settings = o.settings();
    Mesh mesh;
    MeshFacts facts;
    const Placement placement = read_placed(o.model, o.placement(), mesh, facts);
    Json result = {{"method", method}, {"mesh", facts_json(facts)}, {"scale", placement.scale.get_d()}};
    if (method == "measure") return result;
    if (method == "place") return write_stl(o.output, mesh, placement), result;

    const bool support_free = method == "hollow";
    const Stack stack = slice_all(mesh, placement, settings, settings.perimeters * (support_free ? 2 : 1));
    Hollowed hollowed;
    if (method == "infill") {
        hollowed =
            standard_infill(stack, o.pattern == "grid" ? Pattern::grid : Pattern::honeycomb, o.density, settings);
        result["infill_length_mm"] = track_length_mm(hollowed);
    } else {
        CarvingRules rules;
        rules.wall = settings.nozzle * (support_free ? 2 : 1);
        rules.columns = support_free;
        Carving carving = carve(stack, rules, settings);
        result["rounds"] = carving.rounds, result["tears"] = carving.tears, result["bridges"] = carving.bridges;
        result["bridge_mm"] = carving.bridge_mm, result["longest_bridge_mm"] = carving.longest_bridge_mm;
        hollowed = std::move(carving.hollowed);
    }
    result["full_mm3"] = stack.volume_mm3;
    result["material_mm3"] = material_mm3(stack, hollowed, settings);
    result["track_mm3"] = hollowed.track_volume_mm3;
    result["layers"] = stack.slices.size();
    result["method_seconds"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (!o.no_judge) result["judgement"] = judgement_json(judge(stack, hollowed, settings));
    return result;
}

}  // namespace

int main(int argc, char** argv) {
    Options o;
    CLI::App app{"Other ways to make a print light, judged by ribvault's verifier"};
    app.require_subcommand(1);
    const std::pair<const char*, const char*> methods[] = {
        {"measure", "size and volume of a placed model"}, {"place", "a placed model as STL"},
        {"carve", "iterative carving"}, {"hollow", "support-free hollowing"}, {"infill", "standard infill"}};
    for (const auto& [name, help] : methods) {
        CLI::App* command = app.add_subcommand(name, help);
        command->add_option("model", o.model)->required();
        command->add_option("-o", o.output, "place: STL to write");
        command->add_option("--scale", o.scale), command->add_option("--height", o.height),
            command->add_option("--bed", o.bed);
        command->add_option("--up", o.up)->check(CLI::IsMember({"x", "y", "z"}));
        command->add_option("--layer-height", o.layer_height), command->add_option("--nozzle", o.nozzle);
        command->add_option("--perimeters", o.perimeters), command->add_option("--top-layers", o.top_layers);
        command->add_option("--bottom-layers", o.bottom_layers);
        command->add_option("--density", o.density)->check(CLI::Range(0.001, 1.0));
        command->add_option("--pattern", o.pattern)->check(CLI::IsMember({"grid", "honeycomb"}));
        command->add_flag("--no-judge", o.no_judge, "leave out the proof");
    }
    CLI11_PARSE(app, argc, argv);
    try {
        std::cout << run(app.get_subcommands().front()->get_name(), o).dump(1) << "\n";
    } catch (const Error& e) {
        std::cerr << "ribvault_baselines: " << e.what() << "\n";
        return static_cast<int>(e.kind());
    }
    return 0;
}
