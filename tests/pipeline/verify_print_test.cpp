#include "ribvault/pipeline/verify_print.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "mesh/solids.hpp"
#include "report/scratch_folder.hpp"
#include "ribvault/error.hpp"
#include "ribvault/pipeline/generate.hpp"
#include "ribvault/print/read_gcode.hpp"

using namespace ribvault;
using namespace ribvault::test;
using Catch::Matchers::Contains;

namespace {

VerifyJob job_on(const std::string& name) {
    VerifyJob job;
    job.gcode = std::filesystem::path(RIBVAULT_CORPUS) / "gcode" / "verify" / name;
    return job;
}

std::string usage_error(const VerifyJob& job) {
    try {
        verify_print(job);
    } catch (const Error& e) {
        CHECK(e.kind() == ErrorKind::usage);
        return e.what();
    }
    return "no error";
}

const HangingFeature& feature(const PrintReport& r, const std::string& name) {
    for (const HangingFeature& f : r.features)
        if (f.name == name) return f;
    FAIL("no feature " << name);
    return r.features.front();
}

/// G-code of a print as `generate` writes it.
std::filesystem::path cube(const ScratchFolder& folder) {
    Job job;
    job.model = folder / "cube.stl";
    std::ofstream stl(job.model);
    const double s = 8;
    const double v[8][3] = {{0, 0, 0}, {s, 0, 0}, {s, s, 0}, {0, s, 0}, {0, 0, s}, {s, 0, s}, {s, s, s}, {0, s, s}};
    const int t[12][3] = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                          {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
    stl << "solid cube\n";
    for (const auto& f : t) {
        stl << "facet normal 0 0 0\nouter loop\n";
        for (int k : f) stl << "vertex " << v[k][0] << ' ' << v[k][1] << ' ' << v[k][2] << '\n';
        stl << "endloop\nendfacet\n";
    }
    stl << "endsolid\n";
    stl.close();
    job.gcode = folder / "cube.gcode";
    generate(job);
    return *job.gcode;
}

}  // namespace

TEST_CASE("a cantilever hangs where it leaves what is below by more than rho", "[verify-print]") {
    const PrintReport r = verify_print(job_on("cantilever.gcode"));
    CHECK_FALSE(r.supported);
    CHECK(r.support_radius_exact == "1/5");
    CHECK(r.nozzle_source == "file");
    const HangingFeature& f = feature(r, "Perimeter");
    CHECK(f.length_mm == Approx(30));
    CHECK(f.unsupported_mm.lo <= Approx(9.6).margin(1e-9));  // 20 - 10 - width / 2 - rho
    CHECK(f.unsupported_mm.hi >= Approx(9.6).margin(1e-9));
    CHECK(f.unsupported_mm.hi - f.unsupported_mm.lo < 1e-6);
    CHECK(f.worst_mm.lo <= 9.8 + 1e-9);
    CHECK(f.worst_mm.hi >= 9.8 - 1e-9);
    CHECK(f.worst_layer == 1);
    CHECK(f.worst_line == 13);
    CHECK(feature(r, "Support material").unsupported_mm.hi == 0);
    CHECK(r.layers[0].on_bed);
    CHECK(r.layers[0].supported);
    REQUIRE(r.layers[1].regions.size() == 1);
    // the stadium's end beyond the circle of 0.4 mm about (10, 0)
    CHECK(r.layers[1].regions[0].area_mm2.hi > 9.6 * 0.4);
    CHECK(r.layers[1].regions[0].lines == std::vector<std::int64_t>{13});
}

TEST_CASE("the report has a region's boundary when asked for, exactly", "[verify-print]") {
    VerifyJob job = job_on("cantilever.gcode");
    const auto region_of = [](const PrintReport& report) {
        return nlohmann::json::parse(to_json(report))["layers"][1]["regions"][0];
    };
    CHECK_FALSE(region_of(verify_print(job)).contains("boundary"));
    job.boundaries = true;
    const nlohmann::json region = region_of(verify_print(job)), boundary = region["boundary"];
    REQUIRE(boundary["components"].size() == 1);
    const nlohmann::json component = boundary["components"][0];
    REQUIRE(component["loops"].size() == 1);
    CHECK(component["area_mm2"][0] >= region["area_mm2"][0]);
    // the track's two sides and its end, and the end of the track below, dilated: run through the other way round
    REQUIRE(component["loops"][0].size() == 4);
    int turns[3] = {0, 0, 0};
    for (const nlohmann::json& piece : component["loops"][0]) {
        const int turn = piece[3].get<int>();
        ++turns[turn + 1];
        const nlohmann::json curve = boundary["curves"][piece[0].get<std::size_t>()];
        CHECK(curve["kind"] == (turn == 0 ? "line" : "circle"));
        CHECK(curve["of"] == (turn < 0 ? "below" : "above"));
        CHECK(curve["radius_mm"] == (turn < 0 ? "2/5" : "1/5"));
        if (turn >= 0) CHECK(curve["line"] == 13);
    }
    CHECK((turns[0] == 1 && turns[1] == 2 && turns[2] == 1));
}

TEST_CASE("rho as given, by overlap, by nozzle", "[verify-print]") {
    VerifyJob job = job_on("cantilever.gcode");
    job.support_radius = Rational(98, 10);
    CHECK_FALSE(verify_print(job).supported);  // the rounded end is 10 mm away
    job.support_radius = Rational(10);
    CHECK(verify_print(job).supported);
    job.support_radius.reset();
    job.overlap = Rational(1, 4);
    CHECK(verify_print(job).support_radius_exact == "3/10");
    job.overlap.reset();
    job.nozzle = Rational(3, 5);
    CHECK(verify_print(job).support_radius_exact == "3/10");
}

TEST_CASE("the file's nozzle is taken as it is written, to the last decimal", "[verify-print]") {
    const ScratchFolder folder;
    std::string text = contents(job_on("wall.gcode").gcode);
    const std::string nozzle = "nozzle_diameter = 0.4";
    text.replace(text.find(nozzle), nozzle.size(), "nozzle_diameter = 0.6,0.399999999999999998");
    VerifyJob job;
    job.gcode = folder / "wall.gcode";
    std::ofstream(job.gcode) << text;
    const PrintReport r = verify_print(job);
    CHECK(r.support_radius_exact == "199999999999999999/1000000000000000000");
    CHECK_FALSE(r.supported);  // each layer is shifted by 0.2 mm
}

TEST_CASE("exactly rho is held up", "[verify-print]") {
    CHECK(verify_print(job_on("wall.gcode")).supported);
    VerifyJob job = job_on("wall.gcode");
    job.support_radius = Rational(199999, 1000000);
    CHECK_FALSE(verify_print(job).supported);
}

TEST_CASE("bridges count as supported when they are allowed, and are listed apart", "[verify-print]") {
    VerifyJob job = job_on("bridge.gcode");
    const PrintReport strict = verify_print(job);
    CHECK_FALSE(strict.supported);
    CHECK(strict.unsupported_mm.hi == Approx(5.2));
    job.longest_bridge = Rational(53, 10);
    const PrintReport lenient = verify_print(job);
    CHECK(lenient.supported);
    CHECK(lenient.unsupported_mm.hi == 0);
    CHECK(lenient.bridged_mm.hi == Approx(5.2));
    CHECK(feature(lenient, "Bridge infill").bridged_mm.hi == Approx(5.2));
    REQUIRE(lenient.layers[1].bridges.size() == 1);
    CHECK_THAT(summary(lenient, job), Contains("but for the bridges"));
    job.longest_bridge = Rational(5);
    CHECK_FALSE(verify_print(job).supported);
    job = job_on("cantilever.gcode");
    job.longest_bridge = Rational(100);
    CHECK_FALSE(verify_print(job).supported);
}

TEST_CASE("features are chosen by name or kind", "[verify-print]") {
    VerifyJob job = job_on("cantilever.gcode");
    job.features = {"support MATERIAL"};
    CHECK(verify_print(job).supported);
    CHECK_FALSE(feature(verify_print(job), "Perimeter").judged);
    job.features = {"perimeter"};
    CHECK_FALSE(verify_print(job).supported);
    job.features.clear();
    job.ignored_features = {"support"};
    CHECK_FALSE(verify_print(job).supported);
    job.ignored_features = {"perimeter"};
    CHECK(verify_print(job).supported);
    job.features = {"perimeter"};
    CHECK_THAT(usage_error(job), Contains("leave nothing to judge"));
    job.features.clear();
    job.ignored_features = {"bridges"};
    CHECK_THAT(usage_error(job), Contains("'bridges'") && Contains("'Perimeter', 'Support material'"));
    job.ignored_features.clear();
    job.features = {"untyped"};  // of which there is nothing
    CHECK_THAT(usage_error(job), Contains("'untyped'") && Contains("'Perimeter', 'Support material'"));
}

TEST_CASE("inside an outline: a wall of which a part is named an overhang is one all the same", "[verify-print]") {
    const ScratchFolder folder;
    for (const char* last_side : {"Outer wall", "Overhang wall"}) {
        std::string text = "; generated by OrcaSlicer 2.0\nM83\n";
        for (const char* z : {"0.2", "0.4"}) {
            text += std::string("G1 Z") + z +
                    " F600\n;TYPE:Outer wall\n;WIDTH:0.4\n;HEIGHT:0.2\nG1 X0 Y0\nG1 X20 E1\n"
                    "G1 Y20 E1\nG1 X0 E1\n;TYPE:" +
                    last_side + "\nG1 Y0 E1\n";
        }
        text += ";TYPE:Sparse infill\nG1 X5 Y5\nG1 X15 Y15 E1\n";
        VerifyJob job;
        job.gcode = folder / "wall.gcode", job.inside = true;
        std::ofstream(job.gcode) << text;
        INFO(last_side);
        CHECK_FALSE(verify_print(job).supported);
        job.features = {"perimeter"};
        CHECK(verify_print(job).supported);
    }
}

TEST_CASE("inside an outline: where a loop is left open, or there is none, that is said", "[verify-print]") {
    const ScratchFolder folder;
    const auto judged = [&](const std::string& last_side, std::vector<std::string>& warnings) {
        const auto loop = [](const std::string& side) {
            return "\nG1 X0 Y0\nG1 X20 E1\nG1 Y20 E1\nG1 X0 E1\n" + side + "\n";
        };
        VerifyJob job;
        job.gcode = folder / "loop.gcode", job.inside = true;
        job.warn = [&](const std::string& text) {
            if (text.find("outer perimeter") != std::string::npos) warnings.push_back(text);
        };
        std::ofstream(job.gcode)
            << "; generated by PrusaSlicer\nM83\n;HEIGHT:0.2\n;WIDTH:0.4\n;TYPE:External perimeter\nG1 Z.2"
            << loop("G1 Y0 E1") << "G1 Z.4" << loop(last_side) << "G1 Z.6" << loop("G1 Y0 E1")
            << ";TYPE:Internal infill\nG1 X5 Y5\nG1 X15 E1\n";
        return verify_print(job);
    };
    std::vector<std::string> warnings;
    // Entries of one layer, as infill of another height is one, have one outline.
    const PrintReport two_heights = judged(
        "G1 Y0 E1\n;TYPE:Internal infill\n;HEIGHT:0.4\nG1 X2 Y2\nG1 X4 E1\n"
        ";TYPE:External perimeter\n;HEIGHT:0.2",
        warnings);
    CHECK(two_heights.layers.size() == 4);
    CHECK(two_heights.layers_without_outline.empty());
    PrintReport closed = judged("G1 Y0 E1", warnings);
    CHECK_FALSE(closed.supported);
    CHECK(closed.layers_without_outline.empty());
    CHECK(warnings.empty());
    const char* open_beside_a_loop = "G1 Y.01 E1\nG1 X30 Y0\nG1 X35 E1\nG1 Y5 E1\nG1 X30 Y0 E1";
    for (const char* last_side : {"G1 Y.01 E1", open_beside_a_loop, ";TYPE:Thin wall\nG1 Y0 E1", ""}) {
        warnings.clear();
        const PrintReport open = judged(last_side, warnings);
        CHECK(open.supported);  // nothing over it is judged
        CHECK(open.layers_without_outline == std::vector<int>{1});
        REQUIRE(warnings.size() == 1);
        CHECK_THAT(warnings[0], Contains("on 1 layer (the lowest is layer 1)"));
    }
}

TEST_CASE("gaps count outside the outline below, not inside it", "[verify-print]") {
    const ScratchFolder folder;
    const std::string loop = ";TYPE:External perimeter\nG1 X0 Y0\nG1 X20 E1\nG1 Y20 E1\nG1 X0 E1\nG1 Y0 E1\n",
                      fill = ";TYPE:Internal infill\nG1 X2 Y5\nG1 X18 E1\n",
                      below = "; generated by PrusaSlicer\nM83\n;HEIGHT:0.2\n;WIDTH:0.4\nG1 Z.2\n" + loop + fill +
                              "G1 Z.4\n" + loop;
    const auto supported = [&](const std::string& above, int layers) {
        VerifyJob job;
        job.gcode = folder / "gap.gcode";
        job.support_gap = Rational(1, 2), job.support_gap_layers = layers;
        std::ofstream(job.gcode) << below + above;
        return verify_print(job).supported;
    };
    const auto fill_at = [](const char* y) { return std::string("G1 X2 Y") + y + "\nG1 X18 E1\n"; };
    CHECK(supported(fill_at("5.1"), 0));
    CHECK_FALSE(supported(fill_at("5.5"), 0));
    CHECK(supported(fill_at("-.5"), 0));
    CHECK_FALSE(supported(fill_at("-1.5"), 0));
    // Over two layers: what lies two farther down holds up what is outside only.
    const std::string more = "G1 Z.6\n" + loop;
    CHECK_FALSE(supported(more + fill_at("5"), 1));
    CHECK(supported(fill_at("-.6") + more + fill_at("-1.1"), 1));
}

TEST_CASE("small regions pass with --min-area", "[verify-print]") {
    VerifyJob job = job_on("cantilever.gcode");
    job.min_area = 5;
    const PrintReport r = verify_print(job);
    CHECK(r.supported);
    CHECK(r.layers[1].regions[0].ignored);
    CHECK_THAT(summary(r, job), Contains("--min-area"));
    job.min_area = 3;
    CHECK_FALSE(verify_print(job).supported);
}

TEST_CASE("settings that cannot be", "[verify-print]") {
    VerifyJob job = job_on("wall.gcode");
    job.support_radius = Rational(0);
    CHECK_THAT(usage_error(job), Contains("--support-radius is 0"));
    job = job_on("wall.gcode");
    job.overlap = Rational(1);
    CHECK_THAT(usage_error(job), Contains("--overlap is 1"));
    job = job_on("wall.gcode");
    job.min_area = -1;
    CHECK_THAT(usage_error(job), Contains("--min-area"));
    job = job_on("wall.gcode");
    job.layer_height = Rational(1, 10000);
    CHECK_THAT(usage_error(job), Contains("--layer-height is 1/10000"));
    job = job_on("wall.gcode");
    job.infill_layers = 0;
    CHECK_THAT(usage_error(job), Contains("--infill-layers is 0"));
}

TEST_CASE("outputs: the same for any number of threads", "[verify-print]") {
    const ScratchFolder folder;
    const std::filesystem::path gcode = cube(folder);
    std::vector<std::string> reports, pages, pictures;
    for (const int threads : {1, 2, 5}) {
        VerifyJob job;
        job.gcode = gcode;
        job.threads = threads;
        job.overlap = Rational(3, 4);  // more than the print was made for
        job.report = folder / "report.json", job.html = folder / "page.html",
        job.svg = folder / ("svg" + std::to_string(threads));
        const PrintReport r = verify_print(job);
        const std::string json = contents(*job.report);
        reports.push_back(json.substr(0, json.find("\"machine\"")));
        pages.push_back(contents(*job.html));
        std::string all;
        std::set<std::filesystem::path> names;
        for (const auto& entry : std::filesystem::directory_iterator(*job.svg)) names.insert(entry.path());
        for (const auto& name : names) all += name.filename().string() + contents(name);
        pictures.push_back(all);
        const auto parsed = nlohmann::json::parse(json);
        const std::size_t hang = parsed["verdict"]["layers_unsupported"].size();
        CHECK(hang > 0);
        CHECK(names.size() == std::min<std::size_t>(12, hang));
        CHECK(parsed["schema"] == "ribvault-verify/1");
        CHECK(parsed["layers"].size() == r.layers.size());
        CHECK(parsed["verdict"]["supported"] == r.supported);
        double sum = 0;
        for (const auto& f : parsed["features"]) sum += f["unsupported_mm"][1].get<double>();
        CHECK(sum == Approx(parsed["totals"]["unsupported_mm"][1].get<double>()));
    }
    CHECK(reports[0] == reports[1]);
    CHECK(reports[0] == reports[2]);
    CHECK(pages[0] == pages[1]);
    CHECK(pages[0] == pages[2]);
    CHECK(pictures[0] == pictures[1]);
    CHECK(pictures[0] == pictures[2]);
    CHECK_FALSE(pages[0].empty());
    CHECK(pages[0].find("default-src 'none'") != std::string::npos);  // nothing from elsewhere
    for (const char* mark : {"@STYLE@", "@RUNS@", "@SCRIPT@"}) CHECK(pages[0].find(mark) == std::string::npos);
}

TEST_CASE("what a file calls its features cannot end the page's script", "[verify-print]") {
    const ScratchFolder folder;
    VerifyJob job;
    job.gcode = folder / "a.gcode";
    std::ofstream(job.gcode) << "M83\n;TYPE:</script><b>\n;WIDTH:.4\nG1 Z.2\nG1 X10 E1\nG1 Z.4\nG1 X30 E1\nM84\n";
    job.html = folder / "page.html", job.svg = folder / "svg";
    verify_print(job);
    const std::string page = contents(*job.html);
    CHECK(page.find("</script><b>") == std::string::npos);
    CHECK(page.find("\\u003c/script>") != std::string::npos);
    CHECK(contents(*job.svg / "layer_00001.svg").find("script") == std::string::npos);
}

TEST_CASE("shells and covers of ribvault's own prints hold; only junction gaps open slivers", "[verify-print]") {
    const ScratchFolder folder;
    VerifyJob job;
    job.gcode = cube(folder);
    job.ignored_features = {"infill"};
    const PrintReport r = verify_print(job);
    for (const HangingFeature& f : r.features)
        if (f.judged) CHECK(f.unsupported_mm.hi == 0);
}

TEST_CASE("filament pushed in one place makes no track that holds up the next layer far around", "[verify-print]") {
    const ScratchFolder folder;
    VerifyJob job;
    job.gcode = folder / "blob.gcode";
    std::ofstream(job.gcode) << "M83\nG0 X0 Y0 Z0.2\nG1 X0.3 E2\nG0 X0 Y1\nG1 X10 E0.33\n"
                                "G0 X0 Y30 Z0.4\nG1 X20 E0.66\nM84\n";
    std::string warned;
    job.warn = [&](const std::string& text) { warned += text; };
    const PrintReport r = verify_print(job);
    CHECK_FALSE(r.supported);
    CHECK(r.unsupported_mm.lo == Approx(20));
    CHECK_THAT(warned, Contains("1 track (the first is on line 3)") && Contains("1.20 mm"));
    // What is pushed must itself be held up.
    std::ofstream(job.gcode) << "M83\nG0 X0 Z0.2\nG1 X10 E0.33\nG0 X5 Z0.4\nG1 X5.3 E2\nM84\n";
    CHECK_FALSE(verify_print(job).supported);
}

TEST_CASE("a print of ours without its comments is read as wide as it was written", "[verify-print]") {
    const ScratchFolder folder;
    const std::filesystem::path gcode = cube(folder), bare = folder / "bare.gcode";
    std::istringstream lines(contents(gcode));
    std::ofstream out(bare);
    for (std::string line; std::getline(lines, line);) out << line.substr(0, line.find(';')) << '\n';
    out.close();
    std::map<std::uint32_t, GcodeTrack> written;  // by line
    for (const GcodeLayer& layer : read_gcode(gcode).layers)
        for (const GcodeTrack& t : layer.tracks) written[t.line] = t;
    const GcodePrint print = read_gcode(bare);
    CHECK(print.widths_written == 0);
    CHECK(print.too_wide.tracks == 0);
    std::size_t tracks = 0, exactly = 0;
    for (const GcodeLayer& layer : print.layers)
        for (const GcodeTrack& t : layer.tracks) {
            CHECK(static_cast<double>(std::abs(t.width - written[t.line].width)) * 1e-9 < 0.01);
            CHECK(t.width_below == t.width);
            ++tracks, exactly += t.width == written[t.line].width;
        }
    CHECK(written.size() - tracks < 10);  // dots
    CHECK(static_cast<double>(exactly) > 0.99 * static_cast<double>(tracks));
    VerifyJob job;
    job.gcode = bare;
    CHECK(verify_print(job).unsupported_mm.hi < 1);
}

TEST_CASE("a cut file is judged up to the cut, with a warning", "[verify-print]") {
    const ScratchFolder folder;
    const std::string whole = contents(job_on("cantilever.gcode").gcode);
    VerifyJob job;
    job.gcode = folder / "cut.gcode";
    std::ofstream(job.gcode) << whole.substr(0, whole.find("X20") + 2);
    std::string warned;
    job.warn = [&](const std::string& text) { warned += text; };
    const PrintReport r = verify_print(job);
    CHECK_THAT(warned, Contains("middle of line 13"));
    CHECK_THAT(summary(r, job), Contains("cut off"));
    CHECK(r.supported);
    CHECK(r.layer_count == 1);
}

TEST_CASE("nothing is written when the file cannot be read or the run is interrupted", "[verify-print]") {
    const ScratchFolder folder;
    VerifyJob job = job_on("none.gcode");
    job.report = folder / "report.json", job.html = folder / "page.html";
    CHECK_THROWS_AS(verify_print(job), Error);
    job = job_on("wall.gcode");
    job.report = folder / "report.json", job.html = folder / "page.html";
    job.stop = [] { return true; };
    CHECK_THROWS_AS(verify_print(job), Error);
    CHECK(folder.names().empty());
}

TEST_CASE("a box that floats over another hangs, however the layers between are left out") {
    const ScratchFolder folder;
    Job job;
    job.model = folder / "floating.stl";
    std::ofstream(job.model, std::ios::binary) << binary_stl(box({0, 0, 0}, {10, 10, 1}) + box({0, 0, 3}, {10, 10, 4}));
    job.gcode = folder / "floating.gcode";
    generate(job);
    VerifyJob verify;
    verify.gcode = *job.gcode;
    const PrintReport report = verify_print(verify);
    CHECK_FALSE(report.supported);
    CHECK(report.layers_unsupported == 1);
}
