#include <array>
#include <map>
#include <numbers>

#include "print/gcode_text.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

std::set<std::string> heights_of_layers(const GcodePrint& print) {
    std::set<std::string> all;
    for (const GcodeLayer& l : print.layers) all.insert(to_rational(l.z).get_str());
    return all;
}

}  // namespace

TEST_CASE("layers come from extrusions, not from comments", "[gcode]") {
    const GcodePrint print = read(";LAYER:0\nM83\nG1 Z.2\nG1 X10 E1\n;LAYER:1\nG1 X20 E1\nG1 Z.4\nG1 X0 E1\n");
    CHECK(print.layer_count == 2);
    CHECK(print.layers[0].tracks.size() == 2);
}

TEST_CASE("a Z-hop is no layer", "[gcode]") {
    const GcodePrint print = read(
        "M83\nG1 Z.2\nG1 X10 E1\nG1 E-1\nG1 Z.6\nG1 X0 Y5\nG1 Z.2\nG1 E1\nG1 X10 E1\nG1 X11 Y9 Z1.5\nG1 Z.4\nG1 X0 "
        "E1\n");
    CHECK(heights_of_layers(print) == std::set<std::string>{"1/5", "2/5"});
}

TEST_CASE("heights follow the layers where no comment says them", "[gcode]") {
    const GcodePrint print = read("M83\nG1 Z.3\nG1 X10 E1\nG1 Z.4\nG1 X0 E1\nG1 Z.65\nG1 X10 E1\n");
    REQUIRE(print.layers.size() == 3);
    CHECK(height(print.layers[0]) == Approx(0.3));
    CHECK(height(print.layers[1]) == Approx(0.1));
    CHECK(height(print.layers[2]) == Approx(0.25));
    CHECK(print.layers[0].on_bed);
    CHECK(print.layers[2].below == std::vector<std::size_t>{1});
}

TEST_CASE("the lowest layer is as high as it lies over the bed, whatever the usual height", "[gcode]") {
    const std::string moves = "M83\nG1 Z.3\nG1 X10 E1\nG1 Z.4\nG1 X0 E1\n";
    const GcodePrint cura =
        read(";FLAVOR:Marlin\n;Layer height: 0.1\n;Generated with Cura_SteamEngine 4.13.0\n" + moves);
    CHECK(height(cura.layers[0]) == Approx(0.3));
    CHECK(cura.layers[0].tracks[0].width == read(moves).layers[0].tracks[0].width);
    CHECK(height(read(moves + "; first_layer_height = 0.2\n").layers[0]) == Approx(0.2));
    // Nothing on a bed is that high.
    const std::string floats = "; layer_height = 0.2\nM83\nG1 Z.8\nG1 X10 E1\nG1 Z1\nG1 X0 E1\n";
    CHECK(height(read(floats).layers[0]) == Approx(0.2));
    const std::string high = "M83\nG1 Z5\nG1 X10 E1\nG1 Z5.1\nG1 X0 E1\n";
    CHECK(height(read(high + "; layer_height = 0.1\n").layers[0]) == Approx(0.1));
    // What is given counts where the file does not tell.
    GcodeOptions given;
    given.layer_height = 0.25;
    CHECK(height(read(high, given).layers[0]) == Approx(0.25));
    CHECK(height(read(floats, given).layers[0]) == Approx(0.2));
}

TEST_CASE("tops that differ by rounding are one layer", "[gcode]") {
    const GcodePrint print =
        read("M83\nG1 Z.2\nG1 X10 E1\nG1 Z.4\nG1 X0 E1\nG1 X50\nG1 Z.201\nG1 X60 E1\nG1 Z.405\nG1 X50 E1\n");
    REQUIRE(print.layers.size() == 2);
    CHECK(heights_of_layers(print) == std::set<std::string>{"1/5", "2/5"});
    for (const GcodeLayer& layer : print.layers) {
        REQUIRE(layer.tracks.size() == 2);
        const GcodeTrack& track = layer.tracks[1];
        CHECK(to_double(layer.points[track.a].x + layer.points[track.b].x) == 110);
    }
    CHECK(read("M83\nG1 Z.2\nG1 X10 E1\nG1 Z.206\nG1 X0 E1\n").layers.size() == 2);
    // Heights tell which of two tops that are nearly alike something lies on.
    const GcodePrint said =
        read(";TYPE:a\n;HEIGHT:0.2\nM83\nG1 Z.2\nG1 X10 E1\nG1 Z.204\nG1 X0 E1\nG1 Z.404\nG1 X10 E1\n");
    REQUIRE(said.layers.size() == 3);
    CHECK(said.layers[2].below == std::vector<std::size_t>{0, 1});
}

TEST_CASE("layers of things that have layers of their own are counted where the file says no heights", "[gcode]") {
    // Rings of 20 mm, and lines across them: by height, as a slicer prints all objects together.
    std::multimap<int, std::string> levels;  // by um
    const auto ring = [&](int um, int x, int size) {
        const std::string left = std::to_string(x), right = std::to_string(x + size), back = std::to_string(size);
        levels.emplace(um, "G1 X" + left + " Y0\nG1 X" + right + " E1\nG1 Y" + back + " E1\nG1 X" + left +
                               " E1\nG1 Y0 E1\n" + (um / 100 % 2 != 0 ? "G1 X" + right + " Y" + back + " E1\n" : ""));
    };
    const auto tower = [&](int x, int first, int height, int count, int size = 20) {
        for (int k = 0; k < count; ++k) ring(first + k * height, x, size);
    };
    const auto counted = [&](const std::string& before = "M83\n") {
        std::string text = before;
        for (const auto& [um, tracks] : levels) text += "G1 Z" + std::to_string(um / 1000.0) + "\n" + tracks;
        levels.clear();
        return read(text).interleaved_layers;
    };
    tower(0, 200, 200, 12), tower(50, 300, 300, 8);
    CHECK(counted() > 2);
    tower(0, 200, 200, 12), tower(50, 300, 300, 8);
    CHECK(counted("M83\n;TYPE:a\n;HEIGHT:0.2\n") == 0);
    tower(0, 200, 200, 12), tower(50, 250, 250, 9);
    CHECK(counted() > 2);
    tower(0, 200, 200, 12), tower(50, 300, 200, 12);  // all distances are 0.1 mm
    CHECK(counted() > 2);
    tower(0, 200, 200, 8), tower(50, 1030, 200, 4);  // floats at first
    CHECK(counted() > 2);
    tower(0, 200, 200, 12), tower(-10, 300, 300, 8, 40);  // round about the other, as supports are
    CHECK(counted() > 2);

    tower(0, 200, 200, 12), tower(50, 200, 200, 12);
    CHECK(counted() == 0);
    tower(0, 350, 200, 12);
    CHECK(counted() == 0);
    for (int um = 0, k = 0; k < 40; ++k) ring(um += std::array{70, 300, 100, 150, 50, 200}[k % 6], 0, 20);
    CHECK(counted() == 0);
    for (int k = 0; k < 12; ++k) ring(200 + 200 * k, 3 * k, 20);  // leans
    CHECK(counted() == 0);
    // Shelves over supports that end a layer under them.
    tower(0, 200, 200, 30, 8);
    for (int shelf = 1; shelf <= 4; ++shelf)
        tower(20, 1400 * shelf, 200, 1, 40), tower(20, 1400 * shelf - 400, 200, 1, 40);
    CHECK(counted() <= 2);
}

TEST_CASE("what floats farther up than a layer can be high has air below it, whatever height the file says",
          "[gcode]") {
    std::string low = "M83\n";
    for (int k = 1; k <= 5; ++k) low += "G1 Z" + std::to_string(0.2 * k) + "\nG1 X10 E1\nG1 X0\n";
    const auto floating = [&](const std::string& before, const std::string& says, double z) {
        return read(before + low + says + "G1 Z" + std::to_string(z) + "\nG1 X10 E1\n");
    };
    for (const std::string says : {"", ";HEIGHT:2.2\n"}) {
        const GcodePrint slab = floating("; layer_height = 0.2\n", says, 3.2);
        CHECK(height(slab.layers.back()) == Approx(0.2));
        CHECK(slab.layers.back().below.empty());
        CHECK(slab.layers.back().air_layers == 10);
        CHECK(slab.layers_over_air == 1);
    }
    CHECK(floating("", "", 1.6).layers.back().below.empty());  // the usual distance is 0.2
    CHECK(floating("; nozzle_diameter = 0.8\n", "", 1.9).layers.back().below.size() == 1);
    CHECK(floating("", "", 1.4).layers_over_air == 0);
    // Infill of several layers at once says its height, and layers lie between.
    const GcodePrint combined = read(
        "; layer_height = 0.1\nM83\n;HEIGHT:0.1\nG1 Z.1\nG1 X10 E1\nG1 Z.2\nG1 X0 E1\nG1 "
        "Z.3\nG1 X10 E1\nG1 Z.4\nG1 X0 E1\n;HEIGHT:0.3\nG1 X10 E1\n");
    CHECK(height(combined.layers.back()) == Approx(0.3));
    CHECK(combined.layers_over_air == 0);
}

TEST_CASE("ironing is part of its layer, however little it adds", "[gcode]") {
    const GcodePrint print = read(
        ";TYPE:Top solid infill\n;WIDTH:0.4\n;HEIGHT:0.2\nM83\nG1 Z.2\nG1 X10 E1\nG1 Z.4\nG1 X0 E1\n;TYPE:Ironing\n"
        ";HEIGHT:0.0075\nG1 X10 E.1\n");
    REQUIRE(print.layers.size() == 2);
    CHECK(print.layers[1].tracks.size() == 2);
    CHECK(height(print.layers[1]) == Approx(0.2));
}

TEST_CASE("a vase climbs from the first move over a layer on", "[gcode]") {
    std::string vase = "M83\nG1 Z.2\n";
    for (int k = 0; k <= 400; ++k) {
        const double angle = k * std::numbers::pi / 100, z = 0.2 + 0.2 * std::max(0, k - 200) / 200;
        vase += "G1 X" + std::to_string(10 * std::cos(angle)) + " Y" + std::to_string(10 * std::sin(angle)) + " Z" +
                std::to_string(z) + " E1\n";
    }
    const GcodePrint print = read(vase);
    REQUIRE(print.layers.size() == 2);
    CHECK(print.layers[0].tracks.size() == 201);
    CHECK(print.layers[1].tracks.size() == 200);
}

TEST_CASE("a climb of less than slicers round stays in its layer", "[gcode]") {
    const std::string start = "M83\nG1 Z.2\nG1 X10 E1\nG1 Z.4\nG1 X0 E1\n";
    CHECK(read(start + "G1 X10 Z.4001 E1\n").layer_count == 2);
    CHECK(read(start + "G1 X10 Z.41 E1\n").layer_count == 3);
}

TEST_CASE("variable layer height by comments", "[gcode]") {
    const GcodePrint print = corpus("prusa_slicer.gcode");
    REQUIRE(print.layers.size() == 2);
    CHECK(height(print.layers[1]) == Approx(0.15));
    CHECK(print.layers[1].below == std::vector<std::size_t>{0});
}

TEST_CASE("a bridge is part of its layer, whatever height its thread has", "[gcode]") {
    const GcodePrint print = corpus("prusa_slicer.gcode");
    CHECK(name(print, track(print, 1, 1)) == "Bridge infill");
    CHECK(length(print, "Bridge infill") == Approx(10));
}

TEST_CASE("heights that differ by rounding are one height", "[gcode]") {
    const GcodePrint print = read(
        ";TYPE:a\nM83\n;HEIGHT:0.2\nG1 Z.2\nG1 X10 E1\n;HEIGHT:0.200001\nG1 X20 E1\n;HEIGHT:0.199999\nG1 X30 E1\n");
    REQUIRE(print.layers.size() == 1);
    CHECK(print.layers[0].height == 200000000);
}

TEST_CASE("objects printed one after the other share layers", "[gcode]") {
    const GcodePrint print =
        read("M83\nG1 Z.2\nG1 X10 E1\nG1 Z.4\nG1 X0 E1\nG1 Z5\nG1 X50\nG1 Z.2\nG1 X60 E1\nG1 Z.4\nG1 X50 E1\n");
    REQUIRE(print.layers.size() == 2);
    CHECK(print.layers[0].tracks.size() == 2);
    CHECK(print.layers[1].tracks.size() == 2);
}

TEST_CASE("infill of two layers' height rests on what ends at its bottom", "[gcode]") {
    const GcodePrint print = read(
        "M83\n;TYPE:p\n;HEIGHT:0.2\nG1 Z.2\nG1 X10 E1\nG1 Z.4\nG1 X0 E1\nG1 Z.6\nG1 X10 E1\nG1 Z.8\nG1 X0 "
        "E1\n;HEIGHT:0.4\nG1 X5 E1\n;HEIGHT:.2\nG1 Z1\nG1 X0 E1\n");
    REQUIRE(print.layers.size() == 6);
    CHECK(print.layer_count == 5);
    CHECK(print.layers[3].below == std::vector<std::size_t>{2});
    CHECK(height(print.layers[4]) == Approx(0.4));
    CHECK(print.layers[4].layer == print.layers[3].layer);
    CHECK(print.layers[4].below == std::vector<std::size_t>{1});
    CHECK(print.layers[5].below == std::vector<std::size_t>{3, 4});
}

TEST_CASE("supports at heights of their own hold up what they reach", "[gcode]") {
    const GcodePrint print = read(
        "M83\n;TYPE:p\n;HEIGHT:0.2\nG1 Z.2\nG1 X10 E1\n;TYPE:Support\nG1 Z.3\nG1 X0 E1\n;TYPE:p\nG1 Z.4\nG1 X10 E1\n");
    REQUIRE(print.layers.size() == 3);
    CHECK(print.layers[1].below ==
          std::vector<std::size_t>{0});  // from 0.1 to 0.3: its bottom lies within the first layer
    CHECK(print.layers[2].below == std::vector<std::size_t>{0, 1});
}

TEST_CASE("under layers of air nothing is directly below; what is next farther down is known", "[gcode]") {
    const GcodePrint print =
        read("M83\n;TYPE:p\n;HEIGHT:0.2\nG1 Z.2\nG1 X10 E1\nG1 Z.4\nG1 X0 E1\nG1 Z1.2\nG1 X10 E1\nG1 Z1.4\nG1 X0 E1\n");
    REQUIRE(print.layers.size() == 4);
    CHECK(print.layers[2].below.empty());
    CHECK_FALSE(print.layers[2].on_bed);
    CHECK(print.layers[2].under_air == std::vector<std::size_t>{1});
    CHECK(print.layers[2].air_layers == 3);
    CHECK(print.layers[3].below == std::vector<std::size_t>{2});
    CHECK(print.layers[3].air_layers == 0);
}

TEST_CASE("over a gap the nearest layer below counts", "[gcode]") {
    const GcodePrint print =
        read("M83\n;TYPE:raft\n;HEIGHT:0.3\nG1 Z.3\nG1 X10 E1\n;TYPE:p\n;HEIGHT:0.2\nG1 Z.65\nG1 X0 E1\n");
    REQUIRE(print.layers.size() == 2);
    CHECK_FALSE(print.layers[1].on_bed);
    CHECK(print.layers[1].below == std::vector<std::size_t>{0});
}

TEST_CASE("an offset of all heights leaves the first layer on the bed", "[gcode]") {
    const GcodePrint print = read("M83\n;TYPE:p\n;HEIGHT:0.2\nG1 Z.25\nG1 X10 E1\nG1 Z.45\nG1 X0 E1\n");
    CHECK(print.layers[0].on_bed);
    CHECK_FALSE(print.layers[1].on_bed);
}

TEST_CASE("a spiral vase has one layer a turn, not one a move", "[gcode]") {
    std::string text = "M83\n;TYPE:External perimeter\n;HEIGHT:0.2\n;WIDTH:0.4\n";
    for (const char* z : {".2", ".4"})
        text += std::string("G1 X0 Y0 Z") + z + "\nG1 X10 E1\nG1 Y10 E1\nG1 X0 E1\nG1 Y0 E1\n";
    const int turns = 10;
    const char* corners[] = {"X10 Y0", "X10 Y10", "X0 Y10", "X0 Y0"};
    for (int k = 1; k <= 4 * turns; ++k) {
        text += std::string("G1 ") + corners[(k - 1) % 4] + " Z" + std::to_string(0.4 + 0.05 * k) + " E1\n";
        if (k % 4 == 2) text += "G1 X5 Y10.001 E.5\n";  // too short for z to grow: still the spiral
    }
    const GcodePrint print = read(text);
    CHECK(print.layer_count == 2 + turns);
    for (int k = 2; k < 2 + turns; ++k) {
        const GcodeLayer& l = print.layers.at(static_cast<std::size_t>(k));
        CHECK(l.tracks.size() == 5);
        CHECK(to_double(l.z) == Approx(0.2 * (k + 1)));
        CHECK(l.below == std::vector<std::size_t>{static_cast<std::size_t>(k - 1)});
    }
}

TEST_CASE("a vase that ends level less than a layer over its last turn: what is over that turn is one layer",
          "[gcode]") {
    // As CuraEngine ends them.
    const auto vase = [](const std::string& header) {
        std::string text = header + "M83\nG1 X0 Y0 Z.2\nG1 X10 E.3326\nG1 Y10 E.3326\nG1 X0 E.3326\nG1 Y0 E.3326\n";
        const char* corners[] = {"X10 Y0", "X10 Y10", "X0 Y10", "X0 Y0"};
        for (int k = 1; k <= 12; ++k)
            text += std::string("G1 ") + corners[(k - 1) % 4] + " Z" +
                    std::to_string(k <= 8 ? 0.2 + 0.05 * k : 0.6 + 0.025 * (k - 8)) + " E.3326\n";
        for (int k = 0; k < 3; ++k)
            text += std::string("G1 ") + corners[k] + " E" + std::to_string(0.3 - 0.1 * k) + "\n";
        return read(text);
    };
    for (const char* header : {"", "; layer_height = 0.2\n"}) {
        INFO(header);
        const GcodePrint print = vase(header);
        REQUIRE(print.layer_count == 4);
        REQUIRE(print.layers.size() == 4);
        for (std::size_t k = 1; k < 3; ++k) {
            CHECK(to_double(print.layers[k].z) == Approx(0.2 * static_cast<double>(k + 1)));
            CHECK(print.layers[k].tracks.size() == 4);
            CHECK(print.layers[k].tracks[0].width == print.layers[0].tracks[0].width);
        }
        const GcodeLayer& end = print.layers[3];
        CHECK(to_double(end.z) == Approx(0.7));
        CHECK(height(end) == Approx(0.1));
        CHECK(end.tracks.size() == 7);
        CHECK(end.below == std::vector<std::size_t>{2});
        // 0.4 mm at 0.2: between 0.2 and 0.1 mm thick at first.
        CHECK(end.tracks[3].width == Approx(4e8 * 0.2 / 0.15).epsilon(0.01));
    }
}

TEST_CASE("the first layer over a raft is pressed down by the second", "[gcode]") {
    const auto print = [](const char* first, const char* second, const char* third, const std::string& filler = "") {
        return read(
            std::string(";Layer height: 0.2\nM83\n;LAYER:-2\nG1 Z.3\nG1 X10 E1\n;LAYER:-1\nG1 Z.5\nG1 X0 E1\n") +
            filler + ";LAYER:0\nG1 Z" + first + "\nG1 X10 E1\n;LAYER:1\nG1 Z" + second + "\nG1 X0 E1\n;LAYER:2\nG1 Z" +
            third + "\nG1 X10 E1\n");
    };
    // The second is lower than the first, or a little higher.
    for (const auto& [second, third] : {std::pair(".98", "1.18"), std::pair("1.08", "1.28")}) {
        INFO(second);
        const GcodePrint raft = print("1", second, third);
        REQUIRE(raft.layers.size() == 5);
        const double top = std::stod(second) - 0.2;
        CHECK(to_double(raft.layers[2].z) == Approx(top));
        CHECK(height(raft.layers[2]) == Approx(top - 0.5));
        CHECK(raft.layers[2].below == std::vector<std::size_t>{1});
        CHECK(height(raft.layers[3]) == Approx(0.2));
        CHECK(raft.layers[3].below == std::vector<std::size_t>{2});
        CHECK(raft.layers_over_air == 0);
    }
    // What supports print at the height to which it is pressed is beside it.
    const GcodePrint beside = print("1", ".98", "1.18", ";LAYER:-1\nG1 Z.78\nG1 X20 E1\nG1 X0\n");
    REQUIRE(beside.layers.size() == 5);
    CHECK(beside.layers[2].tracks.size() == 2);
    // Not by as much as this, and not where no raft is.
    CHECK(heights_of_layers(print("1.09", ".98", "1.18")).contains("109/100"));
    CHECK(heights_of_layers(read(";Layer height: 0.2\nM83\n;LAYER:0\nG1 Z.3\nG1 X10 E1\n;LAYER:1\nG1 Z.38\nG1 X0 E1\n"))
              .contains("3/10"));
}

TEST_CASE("lines printed on the bed before the lowest layer are part of it", "[gcode]") {
    const std::string object = "G1 Z.2\nG1 X0 E1\nG1 Z.4\nG1 X10 E1\nG1 Z.6\nG1 X0 E1\n";
    for (const char* purge : {".28", ".3", ".35"}) {
        INFO(purge);
        const GcodePrint print = read(std::string("M83\nG1 Z") + purge + "\nG1 X10 E1\n" + object);
        REQUIRE(print.layers.size() == 3);
        CHECK(print.layers[0].on_bed);
        CHECK(print.layers[0].tracks.size() == 2);
        CHECK(height(print.layers[1]) == Approx(0.2));
        CHECK(print.layers[1].below == std::vector<std::size_t>{0});
    }
    // What is printed so high up is not on the bed, nor is it after the lowest layer.
    CHECK(read("M83\nG1 Z2\nG1 X10 E1\n" + object).layers.size() == 4);
    CHECK(read("M83\nG1 X10\n" + object + "G1 Z.28\nG1 X10 E1\n").layers.size() == 4);
    // Nor are lines at two heights, nor a height at which a layer of the object lies as well.
    CHECK(read("M83\nG1 Z.28\nG1 X10 E1\nG1 Z.34\nG1 X5 E1\n" + object).layers.size() == 5);
    CHECK(read("M83\nG1 Z.3\nG1 X10 E1\nG1 Z.2\nG1 X0 E1\nG1 Z.3\nG1 X10 E1\nG1 Z.5\nG1 X0 E1\n").layers.size() == 3);
}

TEST_CASE("infill of unsaid height that most layers leave out is told of, and as thick as the option says", "[gcode]") {
    const auto text_of = [](int layers) {
        std::string text = ";FLAVOR:Marlin\n;Layer height: 0.2\n;Generated with Cura_SteamEngine 4.13.0\nM83\n";
        for (int k = 1; k <= layers; ++k) {
            text += ";TYPE:WALL-OUTER\nG1 Z" + std::to_string(0.2 * k) + "\nG1 X10 E1\nG1 X5 E1\n";
            text += k % 2 == 0 ? ";TYPE:FILL\nG1 X0 E1\n" : ";TYPE:FILL\nG1 X4.5 E.1\n";  // bits in those between
        }
        return text;
    };
    CHECK(read(text_of(6)).sparse_infill.apart == 1);  // three layers tell nothing
    const std::string text = text_of(8);
    const GcodePrint thin = read(text);
    CHECK(thin.sparse_infill.feature == "FILL");
    CHECK(thin.sparse_infill.apart == 2);
    CHECK(thin.layers.size() == 8);
    GcodeOptions options;
    options.infill_layers = 2;
    const GcodePrint thick = read_gcode(text, "text", options);
    CHECK(thick.sparse_infill.apart == 1);
    REQUIRE(thick.layers.size() == 16);
    const GcodeLayer& infill = thick.layers[7];
    CHECK(height(infill) == Approx(0.4));
    CHECK(infill.below == std::vector<std::size_t>{2, 3, 5});
    CHECK(infill.tracks[0].width == Approx(static_cast<double>(thin.layers[3].tracks.back().width) / 2).epsilon(1e-3));
}

TEST_CASE("a seam that ramps up belongs to the layer it climbs to", "[gcode]") {
    const GcodePrint print = read(
        "M83\n;TYPE:Outer wall\n;HEIGHT:0.2\nG1 Z.2\nG1 X10 E1\nG1 Z.2\nG1 X0 Y0\nG1 X1 Z.3 E1\nG1 X2 Z.4 E1\nG1 X10 "
        "E1\nG1 X10 Y9 E1\n");
    CHECK(print.layer_count == 2);
    CHECK(print.layers[1].tracks.size() == 4);
}

TEST_CASE("start G-code is set aside", "[gcode]") {
    SECTION("before the first layer comment") {
        const GcodePrint print = corpus("cura.gcode");  // a purge line at 0.3 mm, the first layer at 0.2
        CHECK(heights_of_layers(print) == std::set<std::string>{"1/5", "2/5"});
        CHECK(print.set_aside_mm == Approx(180));
    }
    SECTION("by its type") {
        CHECK(corpus("prusa_slicer.gcode").set_aside_mm == Approx(100 + std::hypot(30, 22)));
        CHECK(corpus("bambu_studio.gcode").set_aside_mm == Approx(240));
    }
    SECTION("a file without comments has none") { CHECK(read("M83\nG1 Z.2\nG1 X10 E1\n").set_aside_mm == 0); }
}
