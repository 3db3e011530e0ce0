#include "print/gcode_text.hpp"

#include <fstream>

#include "report/scratch_folder.hpp"

using namespace ribvault;
using namespace ribvault::test;
using Catch::Matchers::Contains;

namespace {
const std::string good = "M83\nG1 Z.2\nG1 X10 E1\n";
}

TEST_CASE("malformed lines: which line, and what was expected", "[gcode][errors]") {
    CHECK_THAT(complaint(good + "G1 X1 Yabc E1\n"),
               Contains("test.gcode, line 4") && Contains("'abc") && Contains("number of Y"));
    CHECK_THAT(complaint(good + "G1 X\n"),
               Contains("line 4") && Contains("the line ends where the number of X should"));
    CHECK_THAT(complaint(good + "\n\nG1 X1,5 E1\n"), Contains("line 6") && Contains("',5 E1'") && Contains("letter"));
    CHECK_THAT(complaint(good + "G1 X1 X2 E1\n"), Contains("line 4") && Contains("X stands there twice"));
    CHECK_THAT(complaint(good + "G1 Xnan E1\n"), Contains("line 4") && Contains("number of X"));
    CHECK_THAT(complaint(good + "G1 X99999999 E1\n"), Contains("line 4") && Contains("10000000 or more"));
    CHECK_THAT(complaint(good + "G1 X.1234567890123456789 E1\n"),
               Contains("line 4") && Contains("more than 18 decimals"));
    CHECK_THAT(complaint(good + "G1 X20000 E1\n"), Contains("line 4") && Contains("more than 10 m from the origin"));
    CHECK_THAT(complaint(good + "G0 X20000\nG1 X1 E1\n"), Contains("line 5") && Contains("more than 10 m"));
    CHECK_THAT(complaint(good + "G1 X1 {temperature}\n"), Contains("line 4") && Contains("'{temperature}'"));
    for (const char* bare : {"X20 E1\n", "x 20 e1\n", "F1200 X20 E1\n", "N7 X20Y5 E1*12\n"})
        CHECK_THAT(complaint(good + bare), Contains("line 4") && Contains("expected G0 to G3"));
    for (const char* two :
         {"G90 G1 X20 E1\n", "N7 G53 G1 X20 E1*12\n", "G1 Y10 G1 X20 E1\n", "G1 X20 E1 G91\n", "G1 X20 E1 G20\n",
          "G1 X20 E1 G21\n", "M83 G1 X20 E1\n", "T0 G1 X20 E1\n", "G92 E0 G1 X20\n", "M82 G90\n",
          "M204 S800 G1 X20 E1\n", "M400 G1 X20 E1\n", "G4 P1 G1 X20 E1\n"})
        CHECK_THAT(complaint(good + two), Contains("line 4") && Contains("a second command"));
    for (const char* hidden :
         {"\xC2\xA0G1 X20 E1\n", "\fG1 X20 E1\n", ":G1 X20 E1\n", "\"G1 X20 E1\n", "/ G1 X20 E1\n"})
        CHECK_THAT(complaint(good + hidden), Contains("line 4") && Contains("does not begin the line"));
    CHECK_THAT(complaint(good + "(a; b) G1 X20 E1\n"), Contains("line 4") && Contains("a semicolon in a remark"));
    CHECK(read(good + "N 12 G1 X20 E1\n").layers[0].tracks.size() == 2);
    CHECK(read(good + "G 1 X20 E1\n").layers[0].tracks.size() == 2);
    for (const char* harmless :
         {"EXCLUDE_OBJECT NAME=a\n", "M117 G1 X20\n", "G90 ; G1\n", "(a; b) what\n", "%\n", "_START G=1\n",
          "Z_TILT_ADJUST\n", "G29 G1\n", "E0_HEATER_OFF\n", "Z2_OFFSET\n", "T0 M6\n", "G1 F1200 M106\n"}) {
        const GcodePrint print = read(good + harmless + "G1 Y5 E1\n");
        REQUIRE(print.layers.size() == 1);
        REQUIRE(print.layers[0].tracks.size() == 2);
        CHECK(to_double(print.layers[0].points[print.layers[0].tracks[1].a].x) == 10);
    }
    CHECK_THAT(complaint(good + "G92 E-\n"), Contains("line 4") && Contains("number of E"));
    CHECK_THAT(complaint(good + std::string(200, ' ') + "\nG1 X1 \x01\x02 E1\n"),
               Contains("line 5") && Contains("'?? E1'"));
}

TEST_CASE("arcs that cannot be", "[gcode][errors]") {
    CHECK_THAT(complaint(good + "G2 X20 E1\n"), Contains("line 4") && Contains("expected I and J, or R"));
    CHECK_THAT(complaint(good + "G2 X20 Y0 I3 J0 E1\n"),
               Contains("line 4") && Contains("3.000 mm and 7.000 mm from its centre"));
    CHECK_THAT(complaint(good + "G2 X20 Y0 R3 E1\n"), Contains("line 4") && Contains("expected at least half"));
    CHECK_THAT(complaint(good + "G2 X20 Y0 R0 E1\n"), Contains("line 4") && Contains("radius 0"));
    CHECK_THAT(complaint(good + "G2 R5 E1\n"), Contains("line 4") && Contains("expected I and J"));
    CHECK_THAT(complaint(good + "G18\nG2 X20 I5 E1\n"), Contains("line 5") && Contains("G17"));
    CHECK_THAT(complaint(good + "G2 X20 I100000 E1\n"), Contains("line 4") && Contains("10 m"));
    CHECK_THAT(complaint(good + "G5 X20 I1 J1 E1\n"), Contains("line 4") && Contains("G5"));
}

TEST_CASE("what is no G-code: one clear error", "[gcode][errors]") {
    CHECK_THAT(complaint(""), Contains("the file is empty"));
    CHECK_THAT(complaint("\n\n\n"), Contains("holds no move"));
    CHECK_THAT(complaint("Once upon a time\nthere was a printer.\n"), Contains("it is not G-code"));
    CHECK_THAT(complaint("G1 X1\nG1 X2\n"), Contains("never extrudes"));
    CHECK_THAT(complaint("M83\nG1 X1 E1\n;TYPE:Custom\nG1 X2 E1\n"), Contains("nothing but start and custom"));
    CHECK_THAT(complaint(good + std::string(200, ' ') + std::string("G1 X1\0 E1\n", 10)), Contains("zero bytes"));
    CHECK_THAT(complaint(std::string("GCDE\1\0\0\0", 8)), Contains("binary G-code"));
    CHECK_THAT(complaint("\n{\"schema\": \"ribvault-layers/1\"}\n"), Contains("JSON") && Contains("ribvault page"));
    CHECK_THAT(complaint("PK\3\4rest"), Contains("ZIP archive"));
    std::string rubbish;
    for (int k = 0; k < 5000; ++k) rubbish += static_cast<char>(1 + (k * 7919) % 255);
    CHECK_THAT(complaint(rubbish), Contains("not G-code"));
    CHECK_THAT(complaint(std::string(3000000, 'x')), Contains("line of more than 1 MB"));
}

TEST_CASE("files that cannot be read", "[gcode][errors]") {
    const ScratchFolder folder;
    const auto message = [](const std::filesystem::path& file) {
        try {
            read_gcode(file);
        } catch (const Error& e) {
            CHECK(e.kind() == ErrorKind::unreadable);
            return std::string(e.what());
        }
        return std::string();
    };
    CHECK_THAT(message(folder / "none.gcode"), Contains("there is no such file"));
    CHECK_THAT(message(folder.path()), Contains("is a folder"));
    std::ofstream(folder / "empty.gcode");
    CHECK_THAT(message(folder / "empty.gcode"), Contains("the file is empty"));
}

TEST_CASE("a truncated file is read up to the cut and said to be cut", "[gcode][errors]") {
    const std::string whole = contents(std::filesystem::path(RIBVAULT_CORPUS) / "gcode" / "prusa_slicer.gcode");
    const std::size_t infill = whole.find("G1 X30 Y12 E.6\n;TYPE:Bridge");
    REQUIRE(infill != std::string::npos);
    SECTION("in the middle of a number") {
        const GcodePrint print = read(whole.substr(0, infill + 5));
        CHECK_THAT(print.cut, Contains("in the middle of line 37"));
        CHECK(length(print, "External perimeter") == Approx(30));
        CHECK(length(print, "Internal infill") == 0);
    }
    SECTION("between lines") {
        const GcodePrint print = read(whole.substr(0, infill));
        CHECK_THAT(print.cut, Contains("settings that PrusaSlicer writes"));
    }
    SECTION("anywhere") {
        for (std::size_t n = whole.find("G1 X30 Y10"); n < whole.size() - 120; ++n) {
            INFO(n);
            try {
                const GcodePrint print = read(whole.substr(0, n));
                CHECK_FALSE((print.cut.empty() && whole.substr(0, n).find("filament used") == std::string::npos));
            } catch (const Error& e) {
                CHECK_THAT(e.what(), Contains("nothing but start"));  // before the first extrusion of the print
            }
        }
    }
    SECTION("ribvault's own, by its layers") {
        const std::string own = contents(std::filesystem::path(RIBVAULT_CORPUS) / "gcode" / "ribvault.gcode");
        CHECK_THAT(read(own.substr(0, own.find(";LAYER:1"))).cut, Contains("announces 2 layers and names 1"));
        CHECK_THAT(read(own.substr(0, own.find("; end of print"))).cut, Contains("end of print"));
    }
}

TEST_CASE("block borders do not matter", "[gcode][errors]") {
    // lines of every length across the reader's blocks
    std::string text = "M83\nG1 Z.2\n";
    std::size_t moves = 0;
    while (text.size() < 1500000) {
        text += "G1 X" + std::to_string(moves % 100) + " Y" + std::to_string(moves % 7) + " E1 ;" +
                std::string(moves % 91, 'c') + "\n";
        ++moves;
    }
    const ScratchFolder folder;
    std::ofstream(folder / "long.gcode", std::ios::binary) << text;
    CHECK(length(read_gcode(folder / "long.gcode").layers[0]) == Approx(length(read(text).layers[0])));
    CHECK(read_gcode(folder / "long.gcode").layers[0].tracks.size() == moves - (moves > 0 ? 1 : 0));
}
