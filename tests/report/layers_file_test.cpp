// The layers file: written as its schema says, read back as it was, and refused with a reason when it is not whole.
#include "ribvault/report/layers_file.hpp"

#include <catch2/catch.hpp>
#include <fstream>

#include "report/json_schema.hpp"
#include "ribvault/error.hpp"
#include "ribvault/report/report_members.hpp"

using namespace ribvault;
using Json = nlohmann::json;
using Catch::Matchers::Contains;

namespace {

constexpr Unit mm = units_per_mm, um = mm / 1000;

/// Two tracks that meet at a root, in a wide tree, and a dot.
LayerShapes sample_shapes() {
    LayerShapes s;
    s.slice = {{{0, 0}, {20000 * um, 0}, {20000 * um, 10000 * um}, {-1 * um, 10000 * um}}};
    s.cavity = {{{400 * um, 400 * um}, {19600 * um, 400 * um}, {19600 * um, 9600 * um}}};
    s.vertices = {{{400 * um, 401 * um}, true},
                  {{1500 * um, 2000 * um}, false},
                  {{-123456 * um, 7 * um}, false},
                  {{3 * um, 3 * um}, true}};
    s.edges = {{0, 1}, {2, 0}};
    for (std::size_t v = 0; v < 3; ++v) s.vertices[v].wide = true;
    s.unsupported = {{{10 * um, 10 * um}, {20 * um, 10 * um}, {20 * um, 20 * um}}, {}};
    s.patches = {{{5 * um, 6 * um}, {7 * um, 8 * um}}, {{9 * um, 9 * um}, {9 * um, 9 * um}}};
    return s;
}

RunReport sample_report() {
    RunReport r;
    r.version = "1.2.3";
    r.input_path = "models/a <b>.stl";
    for (int k = 2; k >= 0; --k) {
        LayerReport l;
        l.layer = k, l.z_mm = 0.1 + 0.2 * k, l.support_length_mm = 1.0 / 3 * k, l.trees = k;
        l.verdict.layer = k, l.verdict.supported = true;
        r.layers.push_back(l);
    }
    r.layers[0].verdict.external = Unsupported{0.5, 0.75, {4, 5}, true, 0.3};
    sum_up(r);
    return r;
}

std::vector<std::string> sample_lines() {
    const RunReport report = sample_report();
    std::vector<std::string> lines{layers_header(report)};
    for (const LayerReport& layer : report.layers) lines.push_back(layers_line(layer, shapes_json(sample_shapes())));
    return lines;
}

/// What is said of a file of these lines; empty: it is read without complaint.
std::string complaint(const std::vector<std::string>& lines, bool last_end = true) {
    const test::ScratchFolder folder;
    std::string text;
    for (const std::string& line : lines) text += line + '\n';
    if (!last_end) text.pop_back();
    std::ofstream(folder / "a.layers", std::ios::binary) << text;
    try {
        LayersFile file(folder / "a.layers");
        LayersFile::Layer layer;
        while (file.next(layer)) {
        }
    } catch (const Error& error) {
        CHECK(error.kind() == ErrorKind::unreadable);
        CHECK_THAT(error.what(), Contains((folder / "a.layers").string()));
        return error.what();
    }
    return {};
}

std::string without(const std::string& line, const std::string& pointer) {
    return Json::parse(line).patch(Json::array({{{"op", "remove"}, {"path", pointer}}})).dump();
}

std::string with(const std::string& line, const std::string& pointer, const Json& value) {
    Json object = Json::parse(line);
    object[Json::json_pointer(pointer)] = value;
    return object.dump();
}

}  // namespace

TEST_CASE("every line of a layers file follows its schema") {
    for (const std::string& line : sample_lines())
        CHECK(test::violations(Json::parse(line), "layers-file.schema.json") == std::vector<std::string>{});
    CHECK_FALSE(
        test::violations(Json::parse(without(sample_lines()[0], "/totals")), "layers-file.schema.json").empty());
    CHECK_FALSE(test::violations(Json::parse(without(sample_lines()[1], "/roots")), "layers-file.schema.json").empty());
}

TEST_CASE("a layers file is read as it was written") {
    const test::ScratchFolder folder;
    const std::vector<std::string> lines = sample_lines();
    {
        std::ofstream out(folder / "a.layers", std::ios::binary);
        for (const std::string& line : lines) out << line << '\n';
    }
    LayersFile file(folder / "a.layers");
    CHECK(file.header() == lines[0]);
    CHECK(file.layer_count() == 3);
    LayersFile::Layer layer;
    const LayerShapes wanted = sample_shapes();
    const RunReport report = sample_report();
    for (std::size_t k = 0; k < 3; ++k) {
        REQUIRE(file.next(layer));
        CHECK(layer.numbers == layer_json(report.layers[k]));
        CHECK(shapes_json(layer.shapes) == shapes_json(wanted));
        CHECK(layer.shapes.slice == wanted.slice);
        CHECK(layer.shapes.edges == wanted.edges);
        for (std::size_t v = 0; v < wanted.vertices.size(); ++v) {
            CHECK(layer.shapes.vertices[v].at == wanted.vertices[v].at);
            CHECK(layer.shapes.vertices[v].root == wanted.vertices[v].root);
            CHECK(layer.shapes.vertices[v].wide == wanted.vertices[v].wide);
        }
    }
    CHECK_FALSE(file.next(layer));
}

TEST_CASE("shapes know which trees are wide") {
    SupportForest forest(4);
    forest[0] = {.at = {0, 0}, .root = true}, forest[1] = {.at = {mm, 0}};
    forest[2] = {.at = {0, mm}, .root = true, .wide = true}, forest[3] = {.at = {mm, mm}, .wide = true};
    add_edge(0, 1, forest), add_edge(2, 3, forest);
    const Json json = Json::parse("{" + shapes_json(shapes_of({}, {}, forest, {}, {})) + "}");
    CHECK(json["wide"] == Json{2, 3});
    CHECK(json["roots"] == Json{0, 2});
}

TEST_CASE("where no tree is wide nothing is said of it, and files that say nothing of it are read") {
    LayerShapes shapes = sample_shapes();
    const std::string packed = packed_shapes(shapes);
    for (SupportVertex& v : shapes.vertices) v.wide = false;
    CHECK_THAT(shapes_json(shapes), !Contains("wide"));
    const std::string narrow = packed_shapes(shapes);
    CHECK(packed == narrow + std::string("\3\0\2\2", 4));  // three vertices: 0, 1 more, 1 more
    std::vector<std::string> lines = sample_lines();
    lines[0] = without(lines[0], "/settings/wall_lines");
    for (std::size_t k = 1; k < lines.size(); ++k) lines[k] = without(lines[k], "/wide");
    for (std::size_t k = 1; k < lines.size(); ++k)
        CHECK(test::violations(Json::parse(lines[k]), "layers-file.schema.json") == std::vector<std::string>{});
    const test::ScratchFolder folder;
    {
        std::ofstream out(folder / "a.layers", std::ios::binary);
        for (const std::string& line : lines) out << line << '\n';
    }
    LayersFile file(folder / "a.layers");
    LayersFile::Layer layer;
    while (file.next(layer)) CHECK(packed_shapes(layer.shapes) == narrow);
}

TEST_CASE("shapes are rounded to the nearest micrometre, on both sides of zero") {
    Slice slice;
    slice.rounded = {{{49, -49}, {50, -50}, {149, -149}, {1234549, -1234551}}};
    const LayerShapes shapes = shapes_of(slice, {}, {}, {}, {});
    CHECK(shapes.slice == Region{{{0, 0}, {100, -100}, {100, -100}, {1234500, -1234600}}});
}

TEST_CASE("what was unsupported counts once where its contours overlap") {
    const Region overlapping{{{0, 0}, {20000, 0}, {20000, 20000}, {0, 20000}},
                             {{10000, 0}, {30000, 0}, {30000, 20000}, {10000, 20000}}};
    const LayerShapes shapes = shapes_of({}, {}, {}, overlapping, {});
    CHECK(shapes.unsupported.size() == 1);
    CHECK(signed_area(shapes.unsupported) == 30000.0 * 20000.0);
}

TEST_CASE("a layers file that is not whole is refused by name") {
    const std::vector<std::string> good = sample_lines();
    CHECK(complaint(good).empty());
    CHECK(complaint(good, false).empty());  // a last line without line end
    const auto changed = [&](std::size_t line, const std::string& text) {
        std::vector<std::string> lines = good;
        lines[line] = text;
        return complaint(lines);
    };
    CHECK_THAT(complaint({good[0], good[1], good[2]}), Contains("is cut off: it ends after 2 of 3 layers"));
    CHECK_THAT(complaint({good[0], good[1], good[2].substr(0, 300)}), Contains("line 3 is no JSON"));
    CHECK_THAT(complaint({good[0], good[1], good[3], good[2]}), Contains("line 3 has layer 2 where layer 1 should be"));
    CHECK_THAT(complaint({good[0], good[1], good[2], good[3], good[3]}),
               Contains("line 5 is one more than the 3 layers"));
    CHECK_THAT(changed(0, with(good[0], "/schema", "ribvault-layers/2")),
               Contains("is of schema ribvault-layers/2; expected a layers file, schema ribvault-layers/1"));
    CHECK_THAT(changed(0, with(good[0], "/schema", "ribvault-run/1")),
               Contains("ribvault-run/1") && Contains("--layers"));
    CHECK_THAT(changed(0, without(good[0], "/schema")), Contains("has no \"schema\""));
    CHECK_THAT(changed(0, "[]"), Contains("line 1 is no JSON object"));
    CHECK_THAT(changed(0, with(good[0], "/totals/layers", 0)), Contains("no layers"));
    CHECK_THAT(changed(0, with(good[0], "/totals/layers", -1)), Contains("\"totals.layers\": expected a whole number"));
    for (const char* field : {"/settings/nozzle_mm", "/verdict/proved", "/totals/material_mm3", "/input/path"}) {
        CHECK_THAT(changed(0, without(good[0], field)), Contains("line 1 has no \""));
        CHECK_THAT(changed(0, with(good[0], field, Json::object())), Contains("line 1 has no valid \""));
    }
    for (const char* field : {"/z_mm", "/verdict/supported", "/slice", "/cavity", "/vertices", "/roots", "/edges",
                              "/unsupported", "/patch_tracks"}) {
        CHECK_THAT(changed(2, without(good[2], field)), Contains("line 3 has no \""));
        CHECK_THAT(changed(2, with(good[2], field, "rubbish")), Contains("line 3 has no valid \""));
    }
    CHECK_THAT(changed(2, with(good[2], "/verdict/internal", Json::object())),
               Contains("has no \"verdict.internal.area_mm2.0\""));
    CHECK_THAT(changed(3, without(good[3], "/verdict/external/witness_mm")),
               Contains("has no \"verdict.external.witness_mm.0\""));
    CHECK_THAT(changed(2, with(good[2], "/print/place_mm", "here")), Contains("\"print.place_mm.0\""));
    CHECK_THAT(changed(2, with(good[2], "/edges/0/1", 4)), Contains("there is no vertex 4"));
    CHECK_THAT(changed(2, with(good[2], "/roots/0", -1)), Contains("there is no vertex -1"));
    CHECK_THAT(changed(2, with(good[2], "/wide/0", 4)), Contains("\"wide\": there is no vertex 4"));
    CHECK_THAT(changed(2, with(good[2], "/wide", "rubbish")),
               Contains("line 3 has no valid \"wide\": expected a list"));
    CHECK_THAT(changed(0, with(good[0], "/settings/wall_lines", "two")),
               Contains("has no valid \"settings.wall_lines\": expected a whole number"));
    CHECK_THAT(changed(2, with(good[2], "/slice/0/1/0", 1e300)), Contains("\"slice\""));
    CHECK_THAT(changed(2, with(good[2], "/slice/0/1", Json::array({1}))), Contains("\"slice\": expected pairs"));
    CHECK_THAT(complaint({}), Contains("is empty"));
    CHECK_THROWS_AS(LayersFile("no/such/file"), Error);
}

TEST_CASE("no value in any place of a layers file does more than have the file refused") {
    const std::vector<std::string> good = sample_lines();
    const Json values[] = {nullptr, true, -1, 1e300, "text", Json::array(), Json::object(), {{{1, 2}}}};
    int refused = 0;
    for (const std::size_t line : {std::size_t{0}, std::size_t{2}}) {
        const Json flat = Json::parse(good[line]).flatten();
        for (const auto& [pointer, old] : flat.items()) {
            std::string up = pointer;  // the value and all that it is in
            for (; !up.empty(); up.erase(up.rfind('/')))
                for (const Json& value : values) {
                    std::vector<std::string> lines = good;
                    lines[line] = with(good[line], up, value);
                    refused += complaint(lines).empty() ? 0 : 1;
                }
        }
    }
    CHECK(refused > 1000);
}
