// The report: what it sums up, its schema, and that equal runs give equal text.
#include "ribvault/report/run_report.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>

#include "report/json_schema.hpp"

using namespace ribvault;
using Json = nlohmann::json;

namespace {

std::vector<std::string> violations(const Json& report) { return test::violations(report, "run-report.schema.json"); }

LayerReport layer(int number, bool supported) {
    LayerReport l;
    l.layer = number;
    l.z_mm = 0.2 * number + 0.1;
    l.shell_area_mm2 = 10, l.shell_volume_mm3 = 2, l.support_length_mm = 7, l.support_printed_length_mm = 6.5;
    l.support_volume_mm3 = 0.52, l.gaps = 3, l.perimeter_length_mm = 80, l.cover_length_mm = 1.5, l.filament_mm = 3.25;
    l.trees = 4;
    l.verdict.layer = number;
    l.verdict.supported = supported;
    l.verdict.stages = {100, 10, 1};
    return l;
}

RunReport sample() {
    RunReport r;
    r.version = "1.2.3";
    r.input_path = "models/a b.stl";
    r.input.triangles = 12, r.input.vertices = 8, r.input.size_mm = {20, 20, 20}, r.input.volume_mm3 = 8000;
    r.placement.sign = {1, -1, 1}, r.placement.axis = {2, 0, 1};
    r.placement.scale = Rational(1, 3);
    r.layers = {layer(2, false), layer(1, true), layer(0, true)};
    r.layers[0].verdict.internal = Unsupported{1e-13, 3e-13, {1.0 / 3, 2}, true, 0.20000000000000004};
    r.layers[1].verdict.external = Unsupported{0.5, 0.75, {4, 5}, false, 0.3};
    r.layers[0].verdict.malformed = "cavity crosses its slice";
    r.layers[2].closings = {{0, 1.5, 2.5, 0.01}};
    r.machine = {2, 1.5, 123.4, {{"slice", 0.5}, {"sweep", 0.7}}};
    sum_up(r);
    return r;
}

}  // namespace

TEST_CASE("totals and verdict are the sums over the layers, and layers are put in order") {
    const RunReport r = sample();
    for (int i = 0; i < 3; ++i) CHECK(r.layers[static_cast<std::size_t>(i)].layer == i);
    CHECK(r.totals.material_mm3 == Approx(3 * (2 + 0.52)));
    CHECK(r.totals.support_length_mm == Approx(21));
    CHECK(r.totals.filament_mm == Approx(9.75));
    CHECK(r.totals.gaps == 9);
    CHECK(r.totals.closings == 1);
    CHECK_FALSE(r.verdict.proved);
    CHECK(r.verdict.layers_proved == 2);
    CHECK(r.verdict.layers_refuted == std::vector<int>{2});
    REQUIRE(r.verdict.external_overhangs.size() == 1);
    CHECK(r.verdict.external_overhangs[0].layer == 1);
    CHECK(r.verdict.stages.rational == 30);
}

TEST_CASE("prints over narrow places are those that overhang where the slice does not, without external supports") {
    RunReport r = sample();
    for (LayerReport& layer : r.layers) layer.print.external_hangs = true, layer.verdict.external.reset();
    r.layers[1].print.external_hangs = false;
    r.layers[2].verdict.external.emplace();
    sum_up(r);
    CHECK(r.verdict.layers_over_narrow_places == std::vector<int>{0});
    r.settings.support = Support::both;
    sum_up(r);
    CHECK(r.verdict.layers_over_narrow_places.empty());
}

TEST_CASE("external overhangs do not refute, a missing layer proves nothing") {
    RunReport r = sample();
    r.layers[2].verdict = r.layers[1].verdict;
    sum_up(r);
    CHECK(r.verdict.proved);
    CHECK(r.verdict.external_overhangs.size() == 2);
    r.layers.clear();
    sum_up(r);
    CHECK_FALSE(r.verdict.proved);
    CHECK(r.totals.material_mm3 == 0);
}

TEST_CASE("the report follows its JSON Schema") {
    for (const bool with_layers : {true, false}) {
        RunReport r = sample();
        if (!with_layers) r.layers.clear(), sum_up(r);
        CHECK(violations(Json::parse(to_json(r))) == std::vector<std::string>{});
    }
}

TEST_CASE("the check against the schema finds what does not follow it") {
    const Json good = Json::parse(to_json(sample()));
    const std::vector<std::string> patches = {
        R"([{"op":"remove","path":"/settings/seed"}])",
        R"([{"op":"add","path":"/layers/1/colour","value":"red"}])",
        R"([{"op":"replace","path":"/schema","value":"ribvault-run/0"}])",
        R"([{"op":"replace","path":"/layers/2/verdict/internal/witness_mm","value":[1]}])",
        R"([{"op":"replace","path":"/layers/0/trees","value":1.5}])",
        R"([{"op":"replace","path":"/machine/seconds","value":null}])"};
    for (const std::string& patch : patches) {
        INFO(patch);
        CHECK_FALSE(violations(good.patch(Json::parse(patch))).empty());
    }
}

TEST_CASE("every field of the schema is described in docs/report-schema.md") {
    const std::string description = test::page("report-schema.md");
    int fields = 0;
    const std::function<void(const Json&)> walk = [&](const Json& schema) {
        if (!schema.is_structured()) return;
        if (schema.is_object() && schema.contains("properties"))
            for (const auto& [name, property] : schema["properties"].items()) {
                INFO(name);
                CHECK(description.find("| `" + name + "` |") != std::string::npos);
                ++fields;
            }
        for (const Json& part : schema) walk(part);
    };
    walk(test::read_schema("run-report.schema.json"));
    CHECK(fields > 80);
}

TEST_CASE("the text is the same for the same run; only 'machine' knows time, threads and memory") {
    const RunReport r = sample();
    RunReport other = sample();
    other.machine = {64, 99, 1, {{"verify", 3}}};
    const auto without_machine = [](const std::string& text) { return text.substr(0, text.find("\"machine\"")); };
    CHECK(to_json(r) == to_json(sample()));
    CHECK(to_json(r) != to_json(other));
    CHECK(without_machine(to_json(r)) == without_machine(to_json(other)));
}

TEST_CASE("lengths read as written, bounds and witnesses survive to the last bit") {
    const std::string text = to_json(sample());
    CHECK_THAT(text, Catch::Contains("\"layer_height_mm\":0.2,") && Catch::Contains("\"slack_mm\":0.001,") &&
                         Catch::Contains("\"axes\":[\"+z\",\"-x\",\"+y\"]") && Catch::Contains("\"scale\":\"1/3\""));
    const Json u = Json::parse(text)["layers"][2]["verdict"]["internal"];
    CHECK(u["witness_mm"][0].get<double>() == 1.0 / 3);
    CHECK(u["witness_distance_mm"].get<double>() == 0.20000000000000004);
    CHECK(u["area_mm2"][0].get<double>() == 1e-13);
    CHECK(Json::parse(text)["layers"][2]["verdict"]["malformed"] == "cavity crosses its slice");
}

TEST_CASE("one line a layer") {
    RunReport r = sample();
    const auto lines = [](const std::string& text) { return std::count(text.begin(), text.end(), '\n'); };
    const auto before = lines(to_json(r));
    for (int i = 3; i < 50; ++i) r.layers.push_back(layer(i, true));
    CHECK(lines(to_json(r)) == before + 47);
}

TEST_CASE("odd file names and numbers still give JSON") {
    RunReport r = sample();
    r.input_path = "bad\xff\"name\"\n.stl";
    r.layers[0].shell_area_mm2 = std::numeric_limits<double>::quiet_NaN();
    r.layers[0].cover_length_mm = -1e-9;
    const Json json = Json::parse(to_json(r));
    CHECK(json["input"]["path"] == "bad\xEF\xBF\xBD\"name\"\n.stl");
    CHECK(json["layers"][0]["shell_area_mm2"].is_null());
    CHECK_FALSE(std::signbit(json["layers"][0]["cover_length_mm"].get<double>()));
}

TEST_CASE("peak memory is that of a process") {
    CHECK(peak_memory_mb() > 1);
    CHECK(peak_memory_mb() < 1e6);
}
