#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>

#include "ribvault/error.hpp"
#include "ribvault/print/gcode_header.hpp"
#include "ribvault/print/import_prusaslicer.hpp"
#include "ribvault/print/printer_profile.hpp"

using namespace ribvault;

namespace {

const std::string temperatures = "nozzle_temperature = 200\nbed_temperature = 50\n";

std::string refusal(const std::string& text) {
    try {
        read_profile(text, "my.ini");
    } catch (const Error& error) {
        CHECK(error.kind() == ErrorKind::usage);
        return error.what();
    }
    return "accepted";
}

}  // namespace

TEST_CASE("a profile says what it says and leaves the rest") {
    const PrinterSettings p = read_profile(
        "# my printer\n[printer]\nname = Mine\nflavour = klipper\n" + temperatures +
            "bed = 110, 110, 100\nbed_corner = 3, -5.5\nretraction = 0.8\nmax_speed = 1,2,3,4\nround_bed = yes\n"
            "start_gcode = START_PRINT BED={bed_temperature}\nstart_gcode = G28\\nG1 Z5\n",
        "my.ini");
    CHECK(p.name == "Mine");
    CHECK(p.flavour == Flavour::klipper);
    CHECK(p.nozzle_temperature == 200);
    CHECK(p.bed_temperature == 50);
    CHECK(p.bed_y == 110);
    CHECK(p.corner_of_bed() == std::array<double, 2>{3, -5.5});
    CHECK(p.retraction == 0.8);
    CHECK(p.limits.speed == std::array<double, 4>{1, 2, 3, 4});
    CHECK(p.round_bed);
    CHECK(p.start_gcode == "START_PRINT BED={bed_temperature}\nG28\nG1 Z5\n");
    CHECK(p.travel_speed == PrinterSettings{}.travel_speed);
    const std::string header = gcode_header({}, {}, p, {});
    CHECK(header.find("START_PRINT BED=50\nG28\nG1 Z5\n") != std::string::npos);
    CHECK(header.find("M190") == std::string::npos);  // the start G-code heats the bed
    CHECK(header.find("M109 S200") != std::string::npos);
}

TEST_CASE("bad profiles are refused with the key and the line") {
    CHECK(refusal(temperatures + "retration = 3\n").find("my.ini:3: retration: no such key") == 0);
    CHECK(refusal("nozzle_temperature = hot\n").find("my.ini:1: nozzle_temperature: 'hot' is not a number") == 0);
    CHECK(refusal("bed_temperature = 60\nretraction = 3 mm\n").find("my.ini:2: retraction: '3 mm' is not a number") ==
          0);
    CHECK(refusal("bed_temperature = 60\n").find("my.ini:1: nozzle_temperature: missing") == 0);
    CHECK(refusal("nozzle_temperature = 200\n").find("bed_temperature: missing") != std::string::npos);
    CHECK(refusal(temperatures + "print_speed = -4\n").find("my.ini:3: print_speed:") == 0);
    CHECK(refusal(temperatures + "bed = 1,2\n").find("my.ini:3: bed:") == 0);
    CHECK(refusal(temperatures + "flavour = sailfish\n").find("my.ini:3: flavour: 'sailfish'") == 0);
    CHECK(refusal(temperatures + "bed_temperature = 60\n").find("my.ini:3: bed_temperature: given already on line 2") ==
          0);
    CHECK(refusal(temperatures + "start_gcode = G1 {speed}\n").find("my.ini:3: start_gcode:") == 0);
    CHECK(refusal(temperatures + "start_gcode = G1 {speed}\n").find("{speed}") != std::string::npos);
    CHECK(refusal(temperatures + "hello\n").find("my.ini:3: 'hello' is no setting") == 0);
    CHECK(refusal(temperatures + "[printer\n").find("my.ini:3:") == 0);
    CHECK(refusal(temperatures + "start_gcode = G1 {speed}\n").find("start_gcode: start_gcode") == std::string::npos);
    CHECK(refusal(temperatures + "bed = 200,-1,200\n").find("my.ini:3: bed: bed's depth") == 0);
    CHECK(refusal(temperatures + "bed = 200,200,1e300\n").find("my.ini:3: bed: highest print") == 0);
    CHECK(refusal(temperatures + "round_bed = yes\nbed = 150,140,100\n").find("my.ini:4: bed: bed is 150 x 140 mm;") ==
          0);
    CHECK(refusal(temperatures + "bed = 150,140,100\nround_bed = yes\n").find("my.ini:4: round_bed: bed is") == 0);
    CHECK(refusal(temperatures + "bed_corner = 5\n").find("my.ini:3: bed_corner: '5' are not 2 numbers") == 0);
    CHECK(refusal(temperatures + "bed_corner = 1e9,0\n").find("my.ini:3: bed_corner: bed's corner (mm) is") == 0);
    CHECK(refusal(temperatures + "origin_at_centre = yes\nbed_corner = 5,5\n").find("my.ini:4: bed_corner: bed's") ==
          0);
    CHECK(refusal(temperatures + "thumbnails = big\n").find("my.ini:3: thumbnails: 'big' is no size") == 0);
    CHECK(refusal(temperatures + "thumbnails = 4294967297x1\n").find("my.ini:3: thumbnails:") == 0);
    CHECK(refusal(temperatures + "name =\n").find("my.ini:3: name: the printer has no name") == 0);
    CHECK(refusal("").find("my.ini: nozzle_temperature: missing") == 0);
}

TEST_CASE("built-in profiles: the paper's printers") {
    CHECK(builtin_profiles().size() == 6);
    for (const BuiltinProfile& profile : builtin_profiles()) {
        const PrinterSettings p = builtin_profile(profile.name);
        PrintFacts facts;
        facts.layers = 5, facts.seconds = 100, facts.filament_mm = 1000;
        CHECK_NOTHROW(gcode_header({}, {}, p, facts));
        CHECK_NOTHROW(gcode_footer({}, p, facts));
    }
    CHECK(builtin_profile("cr-10").bed_x >= 273);  // Section 5.2: a print of 273 x 270 x 186 mm
    CHECK(builtin_profile("cr-10").bed_y >= 270);
    CHECK(builtin_profile("ultimaker3").filament_diameter == 2.85);
    CHECK(gcode_header({}, {}, builtin_profile("ultimaker3"), {}).find(";START_OF_HEADER\n") == 0);
    Settings wide;
    wide.nozzle = 80000;
    const std::string header = gcode_header(wide, {}, builtin_profile("ultimaker3"), {});
    CHECK(header.find("NOZZLE.DIAMETER:0.8\n") != std::string::npos);
    CHECK(header.find("NOZZLE.NAME:AA 0.8\n") != std::string::npos);
    CHECK(builtin_profile("microdelta").origin_at_centre);
    CHECK_THROWS_WITH(builtin_profile("replicator"), Catch::Contains("cr-10") && Catch::Contains("replicator"));
}

TEST_CASE("flavours write their own limits") {
    PrinterSettings p;
    p.write_limits = true;
    const auto header = [&](Flavour flavour) {
        p.flavour = flavour;
        return gcode_header({}, {}, p, {});
    };
    CHECK(header(Flavour::marlin).find("M205 X10") != std::string::npos);
    CHECK(header(Flavour::klipper).find("SET_VELOCITY_LIMIT") != std::string::npos);
    CHECK(header(Flavour::klipper).find("M205") == std::string::npos);
    CHECK(header(Flavour::reprapfirmware).find("M566 X600") != std::string::npos);
    CHECK(header(Flavour::reprapfirmware).find("M203 X30000") != std::string::npos);
    CHECK(header(Flavour::marlin).find("M203 X500") != std::string::npos);
}

TEST_CASE("a PrusaSlicer bundle: the presets it names, with what they inherit; the rest is named") {
    const std::string bundle =
        "[print:*common*]\nlayer_height = 0.3\nperimeters = 4\nfill_density = 20%\n"
        "[print:fine]\ninherits = *common*\nlayer_height = 0.15\nseam_position = random\n"
        "[print:other]\nlayer_height = 0.4\n"
        "[filament:PLA]\ntemperature = 215,210\nbed_temperature = 55\nfilament_diameter = 1.75\n"
        "[printer:box]\nnozzle_diameter = 0.6\nbed_shape = 0x0,200x0,200x180,0x180\nretract_length = 0.8\n"
        "start_gcode = M104 S[first_layer_temperature]\\nG28\nend_gcode = {if layer_z > 3}G1{endif}\n"
        "[presets]\nprint = fine\nfilament = PLA\nprinter = box\n";
    Settings s;
    TrackSettings t;
    PrinterSettings p;
    const std::string end = p.end_gcode;
    const ImportedConfig imported = import_prusaslicer(bundle, "b.ini", s, t, p);
    CHECK(s.layer_height == 15000);
    CHECK(s.perimeters == 4);
    CHECK(s.nozzle == 60000);
    CHECK(p.nozzle_temperature == 215);
    CHECK(p.bed_x == 200);
    CHECK(p.bed_y == 180);
    CHECK(p.retraction == 0.8);
    CHECK(p.start_gcode == "M104 S{first_layer_temperature}\nG28");
    CHECK(p.end_gcode == end);
    const auto ignored = [&](const std::string& key) {
        return std::any_of(imported.ignored.begin(), imported.ignored.end(),
                           [&](const std::string& i) { return i.find(key) == 0; });
    };
    CHECK(ignored("fill_density"));
    CHECK(ignored("seam_position ("));
    CHECK(ignored("end_gcode ("));
    CHECK_FALSE(ignored("layer_height"));
}

TEST_CASE("a profile's own start and end G-code take the place of the usual ones, line after line") {
    const PrinterSettings p = read_profile(
        "nozzle_temperature = 200\nbed_temperature = 50\nstart_gcode = G28\nstart_gcode = G29\nend_gcode = M81\n",
        "p.ini");
    CHECK(p.start_gcode == "G28\nG29\n");
    CHECK(p.end_gcode == "M81\n");
}

TEST_CASE("of a PrusaSlicer bundle that names no presets the last of each kind counts, none that is only inherited") {
    Settings s;
    TrackSettings t;
    PrinterSettings p;
    import_prusaslicer("[print:a]\nperimeters = 2\n[print:b]\nperimeters = 3\n[print:*common*]\nperimeters = 9\n",
                       "b.ini", s, t, p);
    CHECK(s.perimeters == 3);
    // A preset without a name is none.
    CHECK(import_prusaslicer("[print:a]\nperimeters = 2\n[presets]\nprint =\n", "b.ini", s, t, p).ignored.empty());
    CHECK(s.perimeters == 2);
    import_prusaslicer("max_print_height = 180\nstart_gcode = G0 Z[max_print_height]\n", "b.ini", s, t, p);
    CHECK(gcode_header({}, {}, p, {}).find("\nG0 Z180\n") != std::string::npos);
}

TEST_CASE("the header's printing time in days, hours, minutes and seconds, as PrusaSlicer writes it") {
    PrintFacts facts;
    const auto time = [&](double seconds) {
        facts.seconds = seconds;
        const std::string header = gcode_header({}, {}, {}, facts), key = "estimated printing time (normal mode) = ";
        const std::size_t at = header.find(key) + key.size();
        return header.substr(at, header.find('\n', at) - at);
    };
    CHECK(time(59.4) == "59s");
    CHECK(time(3600) == "1h 0m 0s");
    CHECK(time(2 * 86400 + 3 * 3600 + 4 * 60 + 5) == "2d 3h 4m 5s");
}

TEST_CASE("what a PrusaSlicer config says and cannot be, or names and does not have, is said") {
    Settings s;
    TrackSettings t;
    PrinterSettings p;
    for (const char* line : {"temperature = 1e300", "temperature = 4294967511", "perimeters = 4294967298",
                             "perimeters = 1.6", "skirts = 1e300"})
        CHECK_THROWS_WITH(import_prusaslicer(line, "c.ini", s, t, p),
                          Catch::Contains("c.ini:1: ") && Catch::Contains("is not a whole number"));
    const auto ignored = [&](const std::string& text) {
        std::string all;
        for (const std::string& key : import_prusaslicer(text, "c.ini", s, t, p).ignored) all += key + "; ";
        return all;
    };
    CHECK(ignored("[presets]\nprint = Nope\n[printer:P]\nnozzle_diameter = 0.4\n[print:A]\nperimeters = 3\n") ==
          "[print:Nope] (named, but not in the file); ");
    CHECK(ignored("[print:A]\ninherits = system\nperimeters = 3\n") ==
          "[print:system] (named, but not in the file); ");
    CHECK(ignored("nozzle_diameter = 0.4\nfirst_layer_extrusion_width = 0.9\n") ==
          "first_layer_extrusion_width (more than twice the nozzle); ");
    CHECK(ignored("nozzle_diameter = 0.4\ninfill_extrusion_width = 0.45\n") ==
          "infill_extrusion_width (more than the nozzle); ");
    CHECK(ignored("nozzle_diameter = 0.4\ninfill_extrusion_width = 0.19\n") ==
          "infill_extrusion_width (less than half the nozzle); ");
    CHECK(ignored("nozzle_diameter = 0.4\ninfill_extrusion_width = 0\n") ==
          "infill_extrusion_width (0: left to the slicer); ");
    CHECK(s.support_width == Settings{}.support_width);
    CHECK(ignored("nozzle_diameter = 0.6\ninfill_extrusion_width = 0.35\n").empty());
    CHECK(s.support_width == 35000);
    CHECK(ignored("perimeters = 2\nperimeter_speed = 0\nfirst_layer_height = 0\n") ==
          "first_layer_height (0: as the other layers); perimeter_speed (0: left to the slicer); ");
    const auto refused = [&](const std::string& text) -> std::string {
        try {
            import_prusaslicer(text, "c.ini", s, t, p);
        } catch (const Error& error) {
            return error.what();
        }
        return "taken";
    };
    CHECK(refused("colour = blue\n") == "c.ini: no setting that we know; is it a PrusaSlicer config or bundle?");
    CHECK(
        refused("[presets]\nprint = A\nprinter = B\n") ==
        "c.ini: no setting of it can be taken: [printer:B] (named, but not in the file), [print:A] (named, but not in "
        "the file)");
    CHECK(refused("bed_shape = 0x0,200x0,100x200\n") == "taken");  // in part
    CHECK(p.bed_x == Approx(200 / 3.0).margin(0.01));              // the square about (100, 100) under the sides
    import_prusaslicer("bed_shape = 0x0,200x0,200x100,100x100,100x200,0x200\n", "c.ini", s, t, p);
    CHECK_THROWS_WITH(check_printer(p), Catch::Contains("no middle to print on"));
    CHECK(ignored("machine_limits_usage = emit_to_gcode\ngcode_flavor = smoothie\nperimeters = 1\n") ==
          "gcode_flavor (we write for Marlin, Klipper and RepRapFirmware); machine_limits_usage (each flavour has its "
          "own words for limits); ");
    CHECK_FALSE(p.write_limits);
    CHECK(ignored("machine_limits_usage = emit_to_gcode\ngcode_flavor = klipper\n").empty());
    CHECK(p.write_limits);
    t.brim_width = 0;
    import_prusaslicer("brim_type = no_brim\nbrim_width = 5\nname = mine\n", "c.ini", s, t, p);
    CHECK(t.brim_width == 0);
    CHECK(p.name == "imported from PrusaSlicer");
    CHECK(
        import_prusaslicer("perimeters = 1\nthumbnails = 16x16/QOI, 640x480/PNG,220x124\n", "c.ini", s, t, p).ignored ==
        std::vector<std::string>{"thumbnails (no PNG: 16x16/QOI)"});
    CHECK(p.thumbnails == " 640x480/PNG,220x124");
    import_prusaslicer("brim_type = outer_only\nbrim_width = 5\n", "c.ini", s, t, p);
    CHECK(t.brim_width == 5 * units_per_mm);
}

TEST_CASE("PrusaSlicer's temperatures of the first layer, and its fan without cooling") {
    const auto imported = [](const std::string& text) {
        Settings s;
        TrackSettings t;
        PrinterSettings p;
        import_prusaslicer(text, "c.ini", s, t, p);
        return p;
    };
    const PrinterSettings p = imported(
        "temperature = 210\nbed_temperature = 60\nfirst_layer_temperature = 215\nfirst_layer_bed_temperature = 65\n"
        "start_gcode = M104 S[first_layer_temperature]\\nM190 S{first_layer_bed_temperature[0]}\\nM117 "
        "[temperature]\n");
    const std::string header = gcode_header({}, {}, p, {});
    CHECK(header.find("\nM104 S215\nM190 S65\nM117 210\n") != std::string::npos);
    CHECK(p.nozzle_temperature_on(1) == 210);
    CHECK(p.bed_temperature_on(1) == 60);

    const std::string fan = "max_fan_speed = 80\nmin_fan_speed = 30\nslowdown_below_layer_time = 9\n";
    CHECK(imported(fan + "cooling = 1\nfan_always_on = 0\n").fan_percent == 80);
    CHECK(imported(fan + "cooling = 0\nfan_always_on = 0\n").fan_percent == 0);
    CHECK(imported(fan + "cooling = 0\n").fan_percent == 0);
    CHECK(imported(fan + "cooling = 0\nfan_always_on = 1\n").fan_percent == 30);
    CHECK(imported("cooling = 0\nfan_always_on = 1\nmin_fan_speed = 30%\n").fan_percent == 35);
    CHECK(imported(fan + "cooling = 0\n").min_layer_time == 0);
    CHECK(imported(fan).min_layer_time == 9);
}

TEST_CASE("limits of 0 are PrusaSlicer's way to leave them open; what cannot be is named with its line") {
    Settings s;
    TrackSettings t;
    PrinterSettings p;
    const ImportedConfig open = import_prusaslicer(
        "perimeters = 2\nmachine_max_jerk_e = 0,0\nmachine_max_acceleration_travel = 0,0\n"
        "machine_max_feedrate_x = 0\nmachine_max_acceleration_y = 0\n",
        "c.ini", s, t, p);
    CHECK_NOTHROW(check_printer(p));
    CHECK(open.ignored.size() == 4);
    CHECK(open.doubts.empty());
    const ImportedConfig odd = import_prusaslicer(
        "nozzle_diameter = 0.3\nlayer_height = 0.2\ntravel_speed = 1e6\nskirts = 1000\ntemperature = 210\n", "c.ini", s,
        t, p);
    REQUIRE(odd.doubts.size() == 2);
    CHECK(odd.doubts[0].where == "c.ini:4: skirts");
    CHECK(odd.doubts[1].where == "c.ini:3: travel_speed");
    CHECK_THROWS_WITH(check_printer(p), odd.doubts[1].message);
}

TEST_CASE("beds of PrusaSlicer: where their corner is; discs; of other shapes a rectangle that lies on them") {
    const auto bed = [](const std::string& shape, std::vector<std::string>* ignored = nullptr) {
        Settings s;
        TrackSettings t;
        PrinterSettings p;
        const ImportedConfig imported = import_prusaslicer("perimeters = 1\nbed_shape = " + shape, "c.ini", s, t, p);
        if (ignored) *ignored = imported.ignored;
        CHECK_NOTHROW(check_printer(p));
        return p;
    };
    const auto polygon = [](int corners, double width, double depth, double x, double y) {
        std::string shape;
        char text[60];
        for (int k = 0; k < corners; ++k) {
            const double angle = (k + 0.5) * 2 * 3.14159265358979 / corners;
            std::snprintf(text, sizeof text, "%s%gx%g", k > 0 ? "," : "", x + width / 2 * std::cos(angle),
                          y + depth / 2 * std::sin(angle));
            shape += text;
        }
        return shape;
    };
    using Place = std::array<double, 2>;
    std::vector<std::string> ignored;
    PrinterSettings p = bed("3x3,228x3,228x228,3x228", &ignored);
    CHECK(p.corner_of_bed() == Place{3, 3});
    CHECK(Place{p.bed_x, p.bed_y} == Place{225, 225});
    CHECK(ignored.empty());
    p = bed("1.48x1.02,119.48x1.02,119.48x67.02,1.48x67.02", &ignored);
    CHECK(p.corner_of_bed() == Place{1.48, 1.02});
    CHECK(Place{p.bed_x, p.bed_y} == Place{118, 66});
    CHECK(ignored.empty());
    CHECK(bed("-33x-93,0x-93,0x93,-33x93").corner_of_bed() == Place{-33, -93});
    CHECK(bed("-107x-93,107x-93,107x93,-107x93").origin_at_centre);
    for (const double middle : {0.0, 100.0}) {
        p = bed(polygon(72, 180, 180, middle, middle), &ignored);
        CHECK(p.round_bed);
        CHECK(p.bed_x == 180);
        CHECK(p.corner_of_bed() == Place{middle - 90, middle - 90});
        CHECK(ignored.empty());
    }
    // A rounded rectangle, an ellipse: what is printed on lies on them.
    p = bed("10x0,240x0,247x3,250x10,250x90,247x97,240x100,10x100,3x97,0x90,0x10,3x3", &ignored);
    CHECK_FALSE(p.round_bed);
    REQUIRE(ignored.size() == 1);
    CHECK_THAT(ignored[0], Catch::StartsWith("bed_shape (in part: no rectangle and no disc; "));
    CHECK(p.bed_x == Approx(239.655).margin(0.01));
    CHECK(p.bed_y == Approx(95.862).margin(0.01));
    CHECK(p.corner_of_bed()[0] == Approx(5.172).margin(0.01));
    p = bed(polygon(60, 300, 200, 150, 100), &ignored);
    CHECK_FALSE(p.round_bed);
    CHECK(p.bed_x == Approx(300 / std::sqrt(2.0)).margin(1));
    CHECK(p.bed_x / p.bed_y == Approx(1.5).margin(0.01));
    // Without a middle to print on, or without area: refused, unless an option gives a bed.
    for (const char* shape : {"0x0,100x0,100x10,10x10,10x100,0x100", "0x0,100x0,50x0"}) {
        Settings s;
        TrackSettings t;
        const ImportedConfig imported =
            import_prusaslicer("layer_height = 0.1\nbed_shape = " + std::string(shape) + "\n", "c.ini", s, t, p);
        REQUIRE(imported.doubts.size() == 1);
        CHECK(imported.doubts[0].where == "c.ini:2: bed_shape");
        CHECK_THROWS_WITH(check_printer(p), Catch::Equals(imported.doubts[0].message));
    }
}

TEST_CASE("a flat PrusaSlicer config is taken whole; a bad number is refused with key and line") {
    Settings s;
    TrackSettings t;
    PrinterSettings p;
    import_prusaslicer("layer_height = 0.1\nbed_shape = -90x-90,90x-90,90x90,-90x90\n", "c.ini", s, t, p);
    CHECK(s.layer_height == 10000);
    CHECK(p.origin_at_centre);
    CHECK(p.bed_x == 180);
    CHECK_THROWS_WITH(import_prusaslicer("a = 1\ntemperature = warm\n", "c.ini", s, t, p),
                      Catch::Contains("c.ini:2: temperature: 'warm'"));
    for (const char* bed : {"0x0,nanx0,200x200,0x200", "0x0,infx0,200x200,0x200"})
        CHECK_THROWS_WITH(import_prusaslicer(std::string("bed_shape = ") + bed + "\n", "c.ini", s, t, p),
                          Catch::Contains("c.ini:1: bed_shape"));
    CHECK_THROWS_WITH(import_prusaslicer("layer_height = thin\n", "c.ini", s, t, p),
                      Catch::Contains("c.ini:1: layer_height"));
    CHECK_THROWS_WITH(import_prusaslicer("colour = red\n", "c.ini", s, t, p),
                      Catch::Contains("no setting that we know"));
}
