#include "ribvault/pipeline/generate.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <set>

#include "ribvault/error.hpp"
#include "ribvault/pipeline/verify_print.hpp"

using namespace ribvault;
namespace fs = std::filesystem;

namespace {

struct Folder {
    fs::path path;
    Folder() {
        std::string name = (fs::temp_directory_path() / "ribvault-generate-XXXXXX").string();
        path = mkdtemp(name.data());
    }
    ~Folder() { fs::remove_all(path); }
    fs::path file(const std::string& name, const std::string& content) const {
        std::ofstream(path / name, std::ios::binary) << content;
        return path / name;
    }
};

std::string read(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// OFF text of a solid of revolution about z with rings of given radii at given heights, closed above and below.
std::string revolution(const std::vector<std::pair<double, double>>& profile, int corners, double turn) {
    std::string vertices, faces;
    const int rings = static_cast<int>(profile.size());
    for (const auto& [radius, z] : profile)
        for (int k = 0; k < corners; ++k) {
            const double a = turn + 2 * M_PI * k / corners;
            vertices += std::to_string(radius * std::cos(a)) + ' ' + std::to_string(radius * std::sin(a)) + ' ' +
                        std::to_string(z) + '\n';
        }
    int count = 0;
    for (int i = 0; i + 1 < rings; ++i)
        for (int k = 0; k < corners; ++k, ++count) {
            const int a = i * corners + k, b = i * corners + (k + 1) % corners;
            faces += "4 " + std::to_string(a) + ' ' + std::to_string(b) + ' ' + std::to_string(b + corners) + ' ' +
                     std::to_string(a + corners) + '\n';
        }
    std::string floor = std::to_string(corners), roof = floor;
    for (int k = 0; k < corners; ++k) {
        floor += ' ' + std::to_string(corners - 1 - k);
        roof += ' ' + std::to_string((rings - 1) * corners + k);
    }
    return "OFF\n" + std::to_string(rings * corners) + ' ' + std::to_string(count + 2) + " 0\n" + vertices + faces +
           floor + '\n' + roof + '\n';
}

/// A random solid of the kind that needs supports: narrowing and widening rings, a flat or pointed roof.
std::string random_solid(std::mt19937_64& random) {
    const auto between = [&](double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(random); };
    std::vector<std::pair<double, double>> profile;
    double z = 0;
    for (int ring = 0; ring < 5; ++ring, z += between(0.8, 2.5)) profile.push_back({between(1.5, 6), z});
    return revolution(profile, 3 + static_cast<int>(random() % 12), between(0, 1));
}

Job job_for(const fs::path& model) {
    Job job;
    job.model = model;
    return job;
}

void check_refused(const Job& job, ErrorKind kind, const std::string& fragment) {
    try {
        generate(job);
        FAIL("not refused: " << fragment);
    } catch (const Error& e) {
        CHECK(e.kind() == kind);
        CHECK_THAT(e.what(), Catch::Contains(fragment));
    }
}

}  // namespace

TEST_CASE("the 20 mm cube is proved, its shell exact, its material near the paper's 1248 mm3") {
    Job job = job_for(RIBVAULT_CORPUS "/../../experiments/models/cube20.stl");
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        job.settings.seed = seed;
        const RunReport report = generate(job);
        CHECK(report.verdict.proved);
        CHECK(report.layers.size() == 100);
        CHECK(report.verdict.external_overhangs.empty());
        // 8000 - 98 layers of a 19.2 mm square; the cavity is 30 nm smaller on each side.
        CHECK(report.totals.shell_volume_mm3 == Approx(8000 - 98 * 19.2 * 19.2 * 0.2).epsilon(1e-4));
        CHECK(report.totals.material_mm3 > 1200);
        CHECK(report.totals.material_mm3 < 1300);
    }
}

TEST_CASE("without straightening the cube's supports are at least 1.4 times as long") {
    Job job = job_for(RIBVAULT_CORPUS "/../../experiments/models/cube20.stl");
    const double with = generate(job).totals.support_printed_length_mm;
    job.settings.straighten = false;
    const RunReport without = generate(job);
    CHECK(without.verdict.proved);
    CHECK(without.totals.support_printed_length_mm >= 1.4 * with);
}

TEST_CASE("random solids end proved under random settings") {
    const Folder folder;
    std::mt19937_64 random(20190614);
    int bounded = 0;  // runs whose lower bound says something
    for (int round = 0; round < 24; ++round) {
        Job job = job_for(folder.file("solid.off", random_solid(random)));
        job.settings.seed = random();
        job.settings.top_layers = static_cast<int>(random() % 3);
        job.settings.bottom_layers = static_cast<int>(random() % 3);
        job.settings.straighten = random() % 4 != 0;
        job.settings.branch_bonus = random() % 4 != 0;
        if (round % 3 == 1)
            job.settings.support_radius = 12000, job.settings.erosion_step = job.settings.straighten_step = 12000;
        if (round % 3 == 2)
            job.settings.support_radius = 30000, job.settings.erosion_step = job.settings.straighten_step = 30000;
        if (round % 4 == 3) job.settings.sampling_pitch = 4000;
        if (round % 5 == 4)
            job.settings.propagation = Propagation::shrink, job.settings.order = Order::doubling,
            job.settings.trim = true;
        if (round % 4 >= 2)
            job.settings.wall_lines = round % 4,
            job.settings.wall_lines_longer = job.settings.wall_lines_taller = 3 * units_per_mm;
        job.settings.length_bound = true;
        const RunReport report = generate(job);
        INFO("round " << round);
        CHECK(report.verdict.proved);
        for (const LayerReport& layer : report.layers) CHECK(layer.support_length_bound_mm <= layer.support_length_mm);
        bounded += report.totals.support_length_bound_mm > 0.05 * report.totals.support_length_mm;
        CHECK(report.verdict.layers_proved == static_cast<int>(report.layers.size()));
        CHECK(report.verdict.print_proved);
    }
    CHECK(bounded > 4);
}

TEST_CASE("same input, settings and seed give the same bytes for any number of threads") {
    const Folder folder;
    Job job = job_for(folder.file("solid.off", revolution({{4, 0}, {4, 6}}, 4, 0)));  // a flat roof: ties abound
    std::string gcode, walls, picture;
    for (const int threads : {1, 2, 4}) {
        job.threads = threads;
        job.gcode = folder.path / "a.gcode", job.mesh = folder.path / "a.3mf", job.svg = folder.path / "svg";
        generate(job);
        if (gcode.empty()) {
            gcode = read(*job.gcode), walls = read(*job.mesh), picture = read(*job.svg / "layer_00002.svg");
            CHECK_THAT(gcode, Catch::Contains(";LAYER:0") && Catch::Contains(";TYPE:"));
            CHECK(gcode.find(";LAYER:0") < gcode.find(";LAYER:1"));
            CHECK_FALSE(picture.empty());
        } else {
            CHECK(read(*job.gcode) == gcode);
            CHECK(read(*job.mesh) == walls);
            CHECK(read(*job.svg / "layer_00002.svg") == picture);
        }
    }
    job.settings.seed = 2;
    generate(job);
    CHECK(read(*job.gcode) != gcode);
}

TEST_CASE("an interrupted run leaves nothing behind and keeps what was there") {
    const Folder folder;
    std::mt19937_64 random(5);
    Job job = job_for(folder.file("solid.off", random_solid(random)));
    job.gcode = folder.file("a.gcode", "what the user had");
    job.report = folder.path / "a.json";
    int layers = 0;
    job.progress = [&](int done, int) { layers = done; };
    job.stop = [&] { return layers >= 3; };
    check_refused(job, ErrorKind::interrupted, "interrupted");
    CHECK(read(*job.gcode) == "what the user had");
    CHECK_FALSE(fs::exists(*job.report));
    CHECK(std::distance(fs::directory_iterator(folder.path), fs::directory_iterator{}) == 2);
}

TEST_CASE("the summary names the first five layers that are refuted, what may help, and paths of any length") {
    RunReport report;
    report.verdict.proved = false;
    for (int k = 0; k < 9; ++k) {
        report.layers.emplace_back();
        report.layers.back().layer = k;
        report.layers.back().verdict.supported = k == 3;
        report.layers.back().verdict.malformed = "no reason";
    }
    Job job;
    job.report = std::string(2000, 'r');
    const std::string text = summary(report, job);
    for (int k = 0; k < 9; ++k) {
        INFO(k);
        CHECK((text.find("  layer " + std::to_string(k) + ": no reason\n") != std::string::npos) == (k < 6 && k != 3));
    }
    CHECK(text.find("what may help: another --seed") != std::string::npos);
    report.settings.bed_only = true;
    CHECK(summary(report, job).find("what may help: no --bed-only; another --seed") != std::string::npos);
    CHECK(text.ends_with("report    " + job.report->string() + "\n"));
    CHECK(verdict_text(report, job).find("NOT PROVED") != std::string::npos);
}

TEST_CASE("what is printed over places too narrow to print begins in the air, and that is said") {
    // A wall of 20 mm that widens from 0.05 to 0.8 mm, standing on its edge, beside a wall as thick all the way up.
    const Folder folder;
    std::string text = "OFF\n16 12 0\n";
    for (const auto& [foot, roof, y] : {std::array{.025, .4, 0.}, {2., 2., 9.}})
        for (const auto& [z, half] : {std::pair("0", foot), std::pair("10", roof)})
            for (const auto& [x, side] :
                 {std::pair("0 ", -1), std::pair("20 ", -1), std::pair("20 ", 1), std::pair("0 ", 1)})
                text += x + std::to_string(y + side * half) + ' ' + z + '\n';
    for (const int k : {0, 8})
        for (const auto& face :
             {std::array{3, 2, 1, 0}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}) {
            text += '4';
            for (const int v : face) text += ' ' + std::to_string(k + v);
            text += '\n';
        }
    Job job = job_for(folder.file("wedge.off", text));
    job.gcode = folder.path / "wedge.gcode";
    const RunReport report = generate(job);
    CHECK(report.verdict.external_overhangs.empty());
    REQUIRE(report.verdict.layers_over_narrow_places.size() == 1);
    CHECK_THAT(verdict_text(report, job), Catch::Contains("but not over places too narrow to print"));
    CHECK_THAT(summary(report, job), Catch::Contains("begins in the air on 1 layer (the lowest is layer " +
                                                     std::to_string(report.verdict.layers_over_narrow_places[0])));
    VerifyJob judge;
    judge.gcode = *job.gcode;
    const PrintReport judged = verify_print(judge);
    CHECK_FALSE(judged.supported);
    for (const HangingLayer& layer : judged.layers)
        CHECK(layer.supported == (layer.layer != report.verdict.layers_over_narrow_places[0]));
}

TEST_CASE("bad input has its own error each") {
    const Folder folder;
    check_refused(job_for(folder.path / "missing.stl"), ErrorKind::unreadable, "missing.stl");
    check_refused(job_for(folder.file("empty.stl", "")), ErrorKind::unreadable, "empty");
    const std::string closed = revolution({{5, 0}, {5, 5}}, 4, 0);
    // Without one of its sides every slice is open; without its roof none is, and the solid is the same.
    std::string open = closed, roofless = closed.substr(0, closed.rfind("\n4 ") + 1);
    const std::size_t side = open.find("4 0 1 5 4\n");
    REQUIRE(side != std::string::npos);
    open.erase(side, 10);
    for (std::string* text : {&open, &roofless}) text->replace(text->find(" 6 0"), 4, " 5 0");
    check_refused(job_for(folder.file("open.off", open)), ErrorKind::bad_geometry,
                  "the mesh is open: 25 gaps wider than 0.05 mm");
    const RunReport whole = generate(job_for(folder.file("closed.off", closed)));
    CHECK(generate(job_for(folder.file("roofless.off", roofless))).totals.shell_volume_mm3 ==
          whole.totals.shell_volume_mm3);
    Job large = job_for(folder.file("large.off", closed));
    large.placement.scale = Rational(100);
    check_refused(large, ErrorKind::does_not_fit, "bed");
    Job nowhere = job_for(folder.file("solid.off", closed));
    nowhere.gcode = folder.path / "no" / "such" / "folder" / "a.gcode";
    check_refused(nowhere, ErrorKind::cannot_write, "a.gcode");
    if (fs::exists("/dev/full")) {
        Job full = job_for(folder.path / "solid.off");
        full.gcode = "/dev/full";
        check_refused(full, ErrorKind::cannot_write, "/dev/full");
    }
    Job settings = job_for(folder.path / "solid.off");
    settings.settings.support_radius = 0;
    check_refused(settings, ErrorKind::usage, "--support-radius");
}

TEST_CASE("the paper's models are proved, their shells as an independent library has them") {
    const std::string models = RIBVAULT_MODELS;
    if (models.empty()) {
        WARN("no models folder (RIBVAULT_MODELS): skipped");
        return;
    }
    struct Known {
        const char *file, *scale;
        char up;
        double shell[4];  // k = 0 .. 3, MODEL.md
    };
    const Known known[] = {{"low_poly_bunny.stl", "0.5", 'z', {2175.8, 2843.9, 3502.5, 4151.4}},
                           {"low_poly_moai.stl", "1/2.4", 'z', {2948.5, 3856.6, 4756.3, 5647.2}},
                           {"kitten.off", "0.54271", 'y', {1331.1, 1699.4, 2065.8, 2430.0}}};
    for (const Known& model : known)
        for (int k = 0; k < 4; ++k) {
            Job job = job_for(fs::path(models) / model.file);
            job.placement.scale = parse_rational(model.scale, "scale");
            job.placement.up = model.up;
            job.settings.top_layers = job.settings.bottom_layers = k;
            const RunReport report = generate(job);
            INFO(model.file << ", k = " << k);
            CHECK(report.verdict.proved);
            CHECK(report.totals.shell_volume_mm3 == Approx(model.shell[k]).epsilon(0.001));
        }
}

/// Ends of walls that are no root, in a layers file.
std::size_t tips_in(const fs::path& layers) {
    std::ifstream in(layers);
    std::string line;
    std::getline(in, line);
    std::size_t tips = 0;
    while (std::getline(in, line)) {
        const auto layer = nlohmann::json::parse(line);
        std::map<std::size_t, int> walls;
        for (const auto& edge : layer.at("edges"))
            for (const std::size_t v : edge) ++walls[v];
        for (const std::size_t root : layer.at("roots")) walls.erase(root);
        for (const auto& [v, count] : walls) tips += count == 1;
    }
    return tips;
}

TEST_CASE("of the ways to grow supports the run uses the one that costs least") {
    const Folder folder;
    std::mt19937_64 random(5);
    Job job;
    job.model = folder.file("solid.off", random_solid(random));
    job.threads = 2;
    job.settings.branch_bonus_length = 160000;
    const auto run = [&](const Job& like, QuarterBonus bonus, std::uint64_t seed) {
        Job one = like;
        one.settings.quarter_bonus = bonus, one.settings.seed = seed;
        one.layers = folder.path / "alone.jsonl";
        const RunReport report = generate(one);
        CHECK(report.candidates.empty());
        return report;
    };
    Job open = job;
    open.settings.choose_bonus = true, open.settings.tries = 2, open.settings.seed = 7;
    int steps = 0;
    open.choosing = [&](int done, int total) {
        CHECK(done == ++steps);
        CHECK(done <= total);
    };
    const RunReport chosen = generate(open);
    open.choosing = [](int, int) {};
    CHECK(steps == static_cast<int>(chosen.layers.size()));
    REQUIRE(chosen.candidates.size() == 6);
    std::set<double> lengths;
    std::set<std::pair<QuarterBonus, std::uint64_t>> ways;
    for (const Candidate& c : chosen.candidates) {
        ways.emplace(c.quarter_bonus, c.seed);
        CHECK(c.length_mm == Approx(run(job, c.quarter_bonus, c.seed).totals.support_length_mm));
        CHECK(c.tips == tips_in(folder.path / "alone.jsonl"));
        CHECK(c.tips > 0);
        CHECK(c.cost_mm == Approx(c.length_mm + 0.8 * static_cast<double>(c.tips)));
        CHECK(c.cost_mm >= chosen.candidates.front().cost_mm);
        lengths.insert(c.length_mm);
    }
    CHECK(lengths.size() > 2);
    CHECK(ways.size() == 6);
    // Under one wide roof the bonus counts a quarter in no narrow place: what is swept once counts for both ways.
    Job flat = job;
    flat.model = folder.file("flat.off", revolution({{4, 0}, {4, 6}}, 4, 0));
    flat.settings.choose_bonus = true;
    const RunReport roof = generate(flat);
    flat.settings.choose_bonus = false;
    REQUIRE(roof.candidates.size() == 3);
    std::map<QuarterBonus, double> costs;
    for (const Candidate& c : roof.candidates) {
        CHECK(c.length_mm == Approx(run(flat, c.quarter_bonus, c.seed).totals.support_length_mm));
        costs[c.quarter_bonus] = c.cost_mm;
    }
    CHECK(costs[QuarterBonus::narrow] == costs[QuarterBonus::nowhere]);
    CHECK(costs[QuarterBonus::narrow] != costs[QuarterBonus::everywhere]);
    Job none = open;
    none.settings.branch_bonus_length = 0, none.settings.tries = 1;
    CHECK(generate(none).candidates.empty());  // all three would be the same
    CHECK(chosen.settings.seed == chosen.candidates.front().seed);
    CHECK(chosen.settings.quarter_bonus == chosen.candidates.front().quarter_bonus);
    CHECK(chosen.totals.support_length_mm == Approx(chosen.candidates.front().length_mm));
    CHECK(chosen.verdict.proved);
    // What the sweep before the run has made is printed as the run alone would have made it: branches that end, what
    // hung, chains that could not move.
    const auto page = [&](Job one) {
        one.gcode = folder.path / "print.gcode", one.layers = folder.path / "layers.jsonl";
        generate(one);
        const auto text = [](const std::filesystem::path& file) {
            std::ifstream in(file);
            std::string line, all;
            for (bool body = file.extension() == ".gcode" ? false : true; std::getline(in, line);) {
                body = body || line.starts_with(";LAYER:");
                if (body && line.find("\"settings\"") == std::string::npos && !line.starts_with("; "))
                    all += line + '\n';
            }
            return all;
        };
        return text(*one.gcode) + text(*one.layers);
    };
    Job alone = job;
    alone.settings.quarter_bonus = chosen.settings.quarter_bonus, alone.settings.seed = chosen.settings.seed;
    const std::string printed = page(alone);
    CHECK(printed.size() > 100000);
    CHECK((page(open) == printed));
    open.settings.length_bound = true, alone.settings.length_bound = true;
    CHECK((page(open) == page(alone)));
}
