#include <algorithm>
#include <cmath>
#include <numbers>

#include "print/gcode_text.hpp"
#include "ribvault/print/gcode_arcs.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

/// The ends of the only track.
void check_track(const std::string& text, const std::string& x0, const std::string& y0, const std::string& x1,
                 const std::string& y1) {
    const GcodePrint print = read(text);
    REQUIRE(print.layers.size() == 1);
    REQUIRE(print.layers[0].tracks.size() == 1);
    const GcodeLayer& l = print.layers[0];
    CHECK(x(l.points[0]) == decimal(x0));
    CHECK(y(l.points[0]) == decimal(y0));
    CHECK(x(l.points[1]) == decimal(x1));
    CHECK(y(l.points[1]) == decimal(y1));
}

}  // namespace

TEST_CASE("coordinates are the file's decimals exactly", "[gcode]") {
    check_track("G1 X0.1 Y.2 Z.2\nG1 X+10.123456789012345678 Y-3. E1\n", "0.1", "0.2", "10.123456789012345678", "-3");
}

TEST_CASE("G91 moves by what it says, G90 to where it says", "[gcode]") {
    check_track("G1 X1 Y1 Z.2\nG91\nG1 X.1\nG1 X.1 Y2 E1\n", "1.1", "1", "1.2", "3");
    check_track("G91\nG1 X1 Y1 Z.2\nG90\nG1 X.1 E1\n", "1", "1", "0.1", "1");
}

TEST_CASE("G92 moves the origin, not the nozzle", "[gcode]") {
    check_track("G1 X10 Y10 Z.2\nG92 X0 Y5\nG1 X1 Y5 E1\n", "10", "10", "11", "10");
    check_track("G1 X10 Y10 Z.2\nG92\nG1 X1 Y1 E1\n", "10", "10", "11", "11");
    check_track("G1 X10 Y10 Z.2\nG92 X0\nG92.1\nG1 X1 E1\n", "10", "10", "1", "10");
}

TEST_CASE("G28 homes the axes it names", "[gcode]") {
    check_track("G1 X10 Y10 Z.2\nG28 X\nG1 Y12 E1\n", "0", "10", "0", "12");
}

TEST_CASE("inches are 25.4 mm, exactly", "[gcode]") {
    check_track("G20\nG1 X1 Y0 Z.01\nG1 X1.001 Y.5 E1\nG21\nG1 X0\n", "25.4", "0", "25.4254", "12.7");
}

TEST_CASE("absolute E: only what it grows by is extruded", "[gcode]") {
    const GcodePrint print = read("M82\nG1 X0 Y0 Z.2\nG1 X10 E1\nG1 X20 E1\nG1 X30 E.5\nG1 X40 E1.5\n");
    REQUIRE(print.layers[0].tracks.size() == 2);
    CHECK(print.layers[0].tracks[0].line == 3);
    CHECK(print.layers[0].tracks[1].line == 6);
}

TEST_CASE("relative E: M83 holds through G91 and G90", "[gcode]") {
    const GcodePrint print = read("M83\nG91\nG1 Z.2\nG90\nG1 X10 E1\nG1 X20 E1\nG1 X30 E0\nG1 X40 E-1\n");
    CHECK(print.layers[0].tracks.size() == 2);
}

TEST_CASE("G91 makes E relative too", "[gcode]") {
    const GcodePrint print = read("G1 Z.2\nG91\nG1 X10 E1\nG1 X10 E1\n");
    CHECK(print.layers[0].tracks.size() == 2);
}

TEST_CASE("G92 E0 starts E anew", "[gcode]") {
    CHECK(read("G1 Z.2\nG1 X10 E5\nG92 E0\nG1 X20 E1\n").layers[0].tracks.size() == 2);
}

TEST_CASE("every tool has its own E and its own filament", "[gcode]") {
    const GcodePrint print = read(
        "; filament_diameter = 1.75,2.85\nM82\nG1 Z.2\nT0\nG1 X10 E1\nT1\nG1 X20 E1\nT0\nG1 X30 E2\nT1000\nG1 X40 "
        "E3\n");
    REQUIRE(print.layers[0].tracks.size() == 4);
    CHECK(width(track(print, 0, 1)) / width(track(print, 0, 0)) == Approx(2.85 * 2.85 / (1.75 * 1.75)).epsilon(0.01));
    CHECK(track(print, 0, 2).width == track(print, 0, 0).width);
    CHECK(track(print, 0, 3).width == track(print, 0, 0).width);
}

TEST_CASE("width from E is the rectangle's, to 1 um", "[gcode]") {
    // 0.4 * 0.2 * 10 mm3 of 1.75 mm filament
    const double e = 0.8 / (std::numbers::pi / 4 * 1.75 * 1.75);
    const std::string text = "G1 Z.2\nG1 X10 E" + std::to_string(e + 1e-6) + "\n";
    const GcodePrint usual = read(text);
    CHECK(track(usual, 0, 0).width == 400000000);
    GcodeOptions thick;
    thick.filament_diameter = 2.85;
    const GcodePrint print = read(text, thick);
    CHECK(width(track(print, 0, 0)) == Approx(0.4 * 2.85 * 2.85 / 1.75 / 1.75).margin(0.001));
    CHECK(print.widths_computed == 1);
}

TEST_CASE("volumetric E counts cubic millimetres", "[gcode]") {
    const auto width_of = [](const std::string& before) {
        const GcodePrint print = read(before + "G1 Z.2\nG1 X10 E.8001\n");
        return width(track(print, 0, 0));
    };
    CHECK(width_of("M200 D1.75\n") == Approx(0.4));
    CHECK(width_of("; use_volumetric_e = 1\n") == Approx(0.4));
    CHECK(width_of("M200 D1.75\nM200 D0\n") == Approx(0.962).margin(0.001));
    // Slic3r says so at the end, CuraEngine by the firmware that it writes for.
    CHECK(width(track(read("G1 Z.2\nG1 X10 E.8001\n; use_volumetric_e = 1\n"), 0, 0)) == Approx(0.4));
    CHECK(width_of(";FLAVOR:UltiGCode\n") == Approx(0.4));
    CHECK(width_of(";FLAVOR:Marlin(Volumetric)\n") == Approx(0.4));
    CHECK(width_of(";FLAVOR:Marlin\n") == Approx(0.962).margin(0.001));
}

TEST_CASE("short stretches share one flow", "[gcode]") {
    // E rounded to 5 places on stretches of 0.01 mm would scatter widths by a tenth.
    std::string text = "M83\nG1 Z.2\n";
    for (int k = 1; k <= 100; ++k)
        text += "G1 X" + std::to_string(0.01 * k) + " E" + (k % 3 == 0 ? "0.00034" : "0.00033") + "\n";
    const GcodePrint print = read(text);
    for (const GcodeTrack& t : print.layers[0].tracks) CHECK(width(t) == Approx(0.4).margin(0.003));
}

TEST_CASE("the end of a path that is too short for a flow of its own shares the one before", "[gcode]") {
    // 0.01 um further on, with the least E that can be written
    const GcodePrint print = read("M83\nG1 Z.2\nG1 X10 E.33260\nG1 X10.00001 E.00001\nG1 X0 Y5\nG1 X10 E.33260\n");
    REQUIRE(print.layers[0].tracks.size() == 3);
    for (const GcodeTrack& t : print.layers[0].tracks) CHECK(t.width == 400000000);
}

TEST_CASE("stretches that are not equally wide do not share a flow, however short", "[gcode]") {
    // 0.085 mm each, 0.30 to 0.48 mm wide, and back
    std::string text = "M83\nG1 Z.2\nG1 X0 Y0\n";
    const auto width_of = [](int k) { return 0.3 + 0.02 * (k < 10 ? k : 19 - k); };
    for (int k = 0; k < 20; ++k)
        text += "G1 X" + std::to_string(0.085 * (k + 1)).substr(0, 7) + " E" +
                std::to_string(0.085 * width_of(k) * 0.2 / (std::numbers::pi / 4 * 1.75 * 1.75)).substr(0, 7) + "\n";
    const GcodePrint print = read(text);
    REQUIRE(print.layers[0].tracks.size() == 20);
    for (int k = 0; k < 20; ++k) {
        const GcodeTrack& t = track(print, 0, static_cast<std::size_t>(k));
        CHECK(width(t) == Approx(width_of(k)).margin(1e-9));
        CHECK(t.width == t.width_below);
    }
}

TEST_CASE("a width has no more decimals than what E is rounded by needs", "[gcode]") {
    const auto width_of = [](const std::string& e) {
        return width(track(read("M83\nG1 Z.2\nG1 X.3 E" + e + "\nG1 X5\nG1 X9 E.12345\n"), 0, 0));
    };
    CHECK(width_of(".00998") == 0.4);  // 0.40008 +- 0.0004
    CHECK(width_of(".00997") == 0.4);
    CHECK(width_of(".01002") == Approx(0.402));
    CHECK(width_of(".00935") == Approx(0.375));
}

TEST_CASE("short stretches share a flow in inches as in mm", "[gcode]") {
    // 0.1 mm each, 0.4 mm wide, with E to five decimals of its unit: alone their widths would come out apart by a
    // third.
    for (const double unit : {1.0, 25.4}) {
        std::string text =
            std::string(unit == 1 ? "" : "G20\n") + "M83\nG1 Z" + std::to_string(0.2 / unit) + "\nG1 X0 Y0\n";
        const double flow = 0.02 * 0.4 * 0.2 / (std::numbers::pi / 4 * 1.75 * 1.75) / unit;
        double given = 0;
        for (int k = 1; k <= 100; ++k) {
            const double e = std::round((k * flow - given) * 1e5) / 1e5;
            given += e;
            text += "G1 X" + std::to_string(k * 0.02 / unit) + " E" + std::to_string(e).substr(0, 7) + "\n";
        }
        const GcodePrint print = read(text);
        REQUIRE(print.layers[0].tracks.size() == 100);
        double least = 1, most = 0;
        for (const GcodeTrack& t : print.layers[0].tracks)
            least = std::min(least, width(t)), most = std::max(most, width(t));
        CAPTURE(unit, least, most);
        CHECK(least > 0.37);
        CHECK(most < 0.43);
    }
}

TEST_CASE("a track with more filament than a nozzle lays is no wider than its disc, and holds up as three nozzles do",
          "[gcode]") {
    const double filament = std::numbers::pi / 4 * 1.75 * 1.75;
    const GcodePrint print = read("M83\nG1 Z.2\nG1 X10 E.3326\nG1 X20\nG1 X20.3 E2\nG1 X30\nG1 X40 E2\n");
    const GcodeTrack &usual = track(print, 0, 0), &blob = track(print, 0, 1), &purge = track(print, 0, 2);
    CHECK(usual.width == usual.width_below);
    CHECK(width(blob) == Approx(std::sqrt(4 / std::numbers::pi * 2 * filament / 0.2)).margin(0.001));
    CHECK(blob.width_below == 1200000000);
    CHECK(width(purge) == Approx(2 * filament / 0.2 / 10).margin(0.001));
    CHECK(purge.width_below == 1200000000);
    CHECK(print.too_wide.tracks == 2);
    CHECK(print.too_wide.line == 5);
    CHECK(print.too_wide.widest == 1200000000);
    GcodeOptions wide;
    wide.nozzle = 1.2;
    const std::string line = "M83\nG1 Z.4\nG1 X10 E4\n";
    CHECK(read(line).too_wide.tracks == 1);
    CHECK(read(line, wide).too_wide.tracks == 0);
    CHECK(read("; nozzle_diameter = 1.2\n" + line).too_wide.tracks == 0);
}

TEST_CASE("a stub with the filament of a dot is as wide as the dot", "[gcode]") {
    const double dot = std::numbers::pi / 4 * 0.4 * 0.4 * 0.2 / (std::numbers::pi / 4 * 1.75 * 1.75);
    for (const char* stub : {".09", ".01"}) {
        const GcodePrint print = read("M83\nG1 Z.2\nG1 X" + std::string(stub) + " E" + std::to_string(dot) + "\n");
        CHECK(track(print, 0, 0).width == 400000000);
        CHECK(track(print, 0, 0).width_below == 400000000);
        CHECK(print.too_wide.tracks == 0);
    }
}

TEST_CASE("a stub with filament by its length holds up as a dot does, on another track as it is", "[gcode]") {
    const std::string stub = "G1 X.02 E.00067\n", other = "G1 Y-1\nG1 X0 Y1 E.0665\n";
    const GcodePrint alone = read("M83\nG1 Z.2\n" + stub), joined = read("M83\nG1 Z.2\n" + stub + "G1 X0\n" + other);
    CHECK(width(track(alone, 0, 0)) == Approx(0.4).margin(0.01));
    CHECK(width(track(alone, 0, 0)) > 3 * 1e-9 * static_cast<double>(track(alone, 0, 0).width_below));
    CHECK(width(track(joined, 0, 0)) == Approx(0.4).margin(0.01));
    CHECK(track(joined, 0, 0).width_below == track(joined, 0, 0).width);
}

TEST_CASE("how words are written does not matter", "[gcode]") {
    check_track("g1x1y2z.2\nN12 G01 X 3 (aside) Y4 E1*71\n", "1", "2", "3", "4");
    check_track("%\nG1 X1 Y2 Z.2 ; go\r\nG1 X3 Y4 E1 ; X9 Y9\r\n", "1", "2", "3", "4");
}

TEST_CASE("commands that move nothing are passed over", "[gcode]") {
    check_track(
        "M117 X is 5, E too\nSTART_PRINT BED=60 X=1\nEXCLUDE_OBJECT_DEFINE NAME=a POLYGON=[[1,2],[3,4]]\nG4 "
        "P500\nG10\nG11\nG29\n"
        "M486 S0\nT?\nG1 X1 Y2 Z.2\nG1 X3 Y4 E1\n",
        "1", "2", "3", "4");
}

TEST_CASE("arcs become chords within the stated bound", "[gcode][arc]") {
    struct Case { const char* text; double cx, cy, radius, turn; };
    const double pi = std::numbers::pi;
    for (const Case& c :
         {Case{"G2 X0 Y10 I-10 J0 E1", 0, 0, 10, 1.5 * pi}, Case{"G3 X0 Y10 I-10 J0 E1", 0, 0, 10, 0.5 * pi},
          Case{"G3 X10 Y0 I-10 J0 E1", 0, 0, 10, 2 * pi}, Case{"G2 I-10 E1", 0, 0, 10, 2 * pi},
          Case{"G3 X0 Y10 R10 E1", 0, 0, 10, 0.5 * pi}, Case{"G2 X0 Y10 R-10 E1", 0, 0, 10, 1.5 * pi},
          Case{"G2 X0 Y10 R10 E1", 10, 10, 10, 0.5 * pi}, Case{"G3 X0 Y10 R-10 E1", 10, 10, 10, 1.5 * pi},
          Case{"G3 X-10 Y0 R10 E1", 0, 0, 10, pi}, Case{"G3 X-10 Y0.001 I-10 J0 E1", 0, 0, 10, pi}}) {
        INFO(c.text);
        const GcodePrint print = read(std::string("G1 X10 Y0 Z.2\n") + c.text + "\n");
        const GcodeLayer& l = print.layers[0];
        double sum = 0;
        for (const GcodeTrack& t : l.tracks) {
            CHECK(t.chord);
            sum += length(l, t);
            for (double s : {0.0, 0.25, 0.5, 1.0}) {
                const double px = (1 - s) * to_double(l.points[t.a].x) + s * to_double(l.points[t.b].x);
                const double py = (1 - s) * to_double(l.points[t.a].y) + s * to_double(l.points[t.b].y);
                CHECK(std::abs(std::hypot(px - c.cx, py - c.cy) - c.radius) < arc_bound_mm);
            }
        }
        CHECK(sum == Approx(c.radius * c.turn).epsilon(1e-4));
    }
}

TEST_CASE("chords keep the bound where the radius changes, and in the smallest circles", "[gcode][arc]") {
    struct Case {
        const char* text;
        double cx, r0, r1, turn;
    };  // counter-clockwise from the right of the centre
    const double small = 0.00089, turn = 0.15;
    char spiral[100];
    std::snprintf(spiral, sizeof spiral, "G3 X%.5f Y%.5f I-0.2 J0 E1", 9.8 + 0.299 * std::cos(turn),
                  0.299 * std::sin(turn));
    for (const Case& c : {Case{"G3 X10 Y0 I-0.00089 J0 E1", 10 - small, small, small, 2 * std::numbers::pi},
                          Case{spiral, 9.8, 0.2, 0.299, turn}}) {
        INFO(c.text);
        const GcodePrint print = read(std::string("G1 X10 Y0 Z.2\n") + c.text + "\n");
        const GcodeLayer& l = print.layers[0];
        REQUIRE_FALSE(l.tracks.empty());
        for (int k = 0; k <= 1000; ++k) {  // every place of the curve is near a chord
            const double angle = c.turn * k / 1000, r = c.r0 + (c.r1 - c.r0) * k / 1000;
            const double px = c.cx + r * std::cos(angle), py = r * std::sin(angle);
            double least = 1;
            for (const GcodeTrack& t : l.tracks) {
                const double ax = to_double(l.points[t.a].x), ay = to_double(l.points[t.a].y),
                             ux = to_double(l.points[t.b].x) - ax, uy = to_double(l.points[t.b].y) - ay;
                const double s = std::clamp(((px - ax) * ux + (py - ay) * uy) / (ux * ux + uy * uy), 0.0, 1.0);
                least = std::min(least, std::hypot(px - ax - s * ux, py - ay - s * uy));
            }
            REQUIRE(least < arc_bound_mm);
        }
    }
}

TEST_CASE("an arc ends exactly where the file says", "[gcode][arc]") {
    const GcodePrint print = read("G1 X10 Y0 Z.2\nG3 X0.00001 Y9.99999 I-10 J0 E1\n");
    CHECK(x(print.layers[0].points.back()) == decimal("0.00001"));
    CHECK(y(print.layers[0].points.back()) == decimal("9.99999"));
}

TEST_CASE("an arc's flow is that of its length", "[gcode][arc]") {
    const std::string e = std::to_string(std::numbers::pi * 10 * 0.08 / (std::numbers::pi / 4 * 1.75 * 1.75) + 1e-6);
    const GcodePrint print = read("G1 X10 Y0 Z.2\nG3 X-10 Y0 I-10 E" + e + "\n");
    for (const GcodeTrack& t : print.layers[0].tracks) CHECK(t.width == 400000000);
}

TEST_CASE("arcs in inches and relative coordinates", "[gcode][arc]") {
    const GcodePrint print = read("G20\nG1 X1 Y0 Z.01\nG91\nG3 X-1 Y1 I-1 J0 E1\n");
    for (const GcodePoint& p : print.layers[0].points)
        CHECK(std::hypot(to_double(p.x), to_double(p.y)) == Approx(25.4).margin(1e-8));
    CHECK(x(print.layers[0].points.back()) == 0);
}

TEST_CASE("filament at rest: dots in ribvault's files, priming elsewhere", "[gcode]") {
    const GcodePrint own = corpus("ribvault.gcode");
    REQUIRE(own.layers[1].tracks.size() == 3);
    CHECK(track(own, 1, 0).a == track(own, 1, 0).b);
    CHECK(x(own.layers[1].points[0]) == decimal("10.00001"));
    CHECK(track(own, 1, 0).width == 400000000);
    CHECK(read("M83\n;WIDTH:.4\nG1 X1 Z.2\nG1 E1\nG1 E1\nG1 X2 E1\n").layers[0].tracks.size() == 1);
}

TEST_CASE("tracks of one path are told from those after a travel", "[gcode]") {
    const GcodePrint print =
        read("M83\nG1 Z.2\nG1 X10 E1\n;TYPE:Overhang perimeter\nG1 X20 E1\nG1 X10\nG1 X20\nG1 X30 E1\n");
    // the first one was start G-code: a type came after it
    REQUIRE(print.layers[0].tracks.size() == 2);
    CHECK_FALSE(print.layers[0].tracks[1].continues);
    const GcodePrint path = read(
        "M83\nG1 Z.2\n;TYPE:Perimeter\nG1 X10 E1\n;TYPE:Overhang perimeter\nG1 X20 E1\nG1 X30\nG1 X20\nG1 X25 E1\n");
    CHECK(path.layers[0].tracks[1].continues);
    CHECK_FALSE(path.layers[0].tracks[2].continues);
}
