#include "ribvault/print/gcode_header.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <sstream>
#include <utility>

#include "ribvault/error.hpp"
#include "ribvault/print/check_range.hpp"
#include "ribvault/print/gcode_text.hpp"
#include "ribvault/print/thumbnail.hpp"

namespace ribvault {
namespace {

/// What of G-code a printer acts upon: without comments, and without lines whose text is only shown. `{{` and `}}`
/// stand for braces and are left out.
std::string acted_upon(const std::string& gcode) {
    static constexpr const char* shown[] = {"M0", "M1", "M117", "M118", "M291", "RESPOND", "echo"};
    std::string acts;
    std::istringstream lines(gcode);
    for (std::string line; std::getline(lines, line);) {
        line.resize(std::min(line.find(';'), line.size()));
        std::string command;
        std::istringstream(line) >> command;
        if (std::find(std::begin(shown), std::end(shown), command) != std::end(shown)) continue;
        for (std::size_t k = 0; k < line.size(); ++k)
            if ((line[k] == '{' || line[k] == '}') && line[k + 1] == line[k])
                ++k;
            else
                acts += line[k];
        acts += '\n';
    }
    return acts;
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Whether a command or tool stands in what is acted upon as a word of its own.
bool names(const std::string& acts, const std::string& word) {
    const auto is_letter = [&](std::size_t k) {
        return k < acts.size() && std::isalnum(static_cast<unsigned char>(acts[k])) != 0;
    };
    for (std::size_t at = acts.find(word); at != std::string::npos; at = acts.find(word, at + 1))
        if ((at == 0 || !is_letter(at - 1)) && !is_letter(at + word.size())) return true;
    return false;
}

std::string support_temperature(const PrinterSettings& p) {
    return std::to_string(p.support_temperature > 0 ? p.support_temperature : p.nozzle_temperature);
}

/// "1h 2m 3s", as PrusaSlicer writes it.
std::string duration(double seconds) {
    const long s = std::lround(seconds);
    std::string text;
    if (s >= 86400) text += std::to_string(s / 86400) + "d ";
    if (s >= 3600) text += std::to_string(s / 3600 % 24) + "h ";
    if (s >= 60) text += std::to_string(s / 60 % 60) + "m ";
    return text + std::to_string(s % 60) + "s";
}

std::string value_of(const std::string& name, const Settings& s, const PrinterSettings& p, const PrintFacts& f) {
    const auto whole = [](double v) { return std::to_string(std::lround(v)); };
    if (name == "nozzle_temperature") return whole(p.nozzle_temperature);
    if (name == "bed_temperature") return whole(p.bed_temperature);
    if (name == "first_layer_temperature") return whole(p.nozzle_temperature_on(0));
    if (name == "first_layer_bed_temperature") return whole(p.bed_temperature_on(0));
    if (name == "support_temperature") return support_temperature(p);
    if (name == "support_extruder") return std::to_string(p.support_extruder);
    if (name == "layer_height") return decimal_text(to_mm(s.layer_height));
    if (name == "first_layer_height") return decimal_text(to_mm(s.first_layer_height));
    if (name == "nozzle_diameter") return decimal_text(to_mm(s.nozzle));
    if (name == "filament_diameter") return decimal_text(p.filament_diameter);
    if (name == "bed_x") return decimal_text(p.bed_x);
    if (name == "bed_y") return decimal_text(p.bed_y);
    if (name == "bed_z") return decimal_text(p.bed_z);
    const std::array<double, 2> corner = p.corner_of_bed();
    if (name == "bed_min_x") return decimal_text(corner[0]);
    if (name == "bed_min_y") return decimal_text(corner[1]);
    if (name == "bed_max_x") return decimal_text(corner[0] + p.bed_x);
    if (name == "bed_max_y") return decimal_text(corner[1] + p.bed_y);
    if (name == "park_z") return decimal_text(std::min(f.height_mm + 5, p.bed_z));
    if (name == "retraction") return decimal_text(p.retraction);
    if (name == "travel_speed") return decimal_text(p.travel_speed);
    if (name == "printer") return p.name;
    if (name == "layer_count") return whole(f.layers);
    if (name == "print_seconds") return whole(f.seconds);
    if (name == "print_time") return duration(f.seconds);
    if (name == "filament_mm") return decimal_text(f.filament_mm);
    if (name == "filament_mm3") return decimal_text(f.filament_mm * filament_area(p));
    const auto side = [&](double v) { return f.box.empty() ? std::string("0") : decimal_text(v); };
    if (name == "min_x") return side(to_mm(f.box.lo.x));
    if (name == "min_y") return side(to_mm(f.box.lo.y));
    if (name == "max_x") return side(to_mm(f.box.hi.x));
    if (name == "max_y") return side(to_mm(f.box.hi.y));
    if (name == "max_z") return decimal_text(f.height_mm);
    return {};
}

std::string limits_text(const PrinterSettings& p) {
    const MotionLimits& l = p.limits;
    const auto axes = [](const char* code, const std::array<double, 4>& v, double factor) {
        return std::string(code) + " X" + decimal_text(v[0] * factor) + " Y" + decimal_text(v[1] * factor) + " Z" +
               decimal_text(v[2] * factor) + " E" + decimal_text(v[3] * factor) + "\n";
    };
    switch (p.flavour) {
        case Flavour::klipper:
            return "SET_VELOCITY_LIMIT VELOCITY=" + decimal_text(l.speed[0]) +
                   " ACCEL=" + decimal_text(l.print_acceleration) +
                   " SQUARE_CORNER_VELOCITY=" + decimal_text(l.jerk[0]) + "\n";
        case Flavour::reprapfirmware:
            return axes("M201", l.acceleration, 1) + axes("M203", l.speed, 60) + axes("M566", l.jerk, 60) + "M204 P" +
                   decimal_text(l.print_acceleration) + " T" + decimal_text(l.travel_acceleration) + "\n";
        case Flavour::marlin: break;
    }
    return axes("M201", l.acceleration, 1) + axes("M203", l.speed, 1) + axes("M205", l.jerk, 1) + "M204 P" +
           decimal_text(l.print_acceleration) + " R" + decimal_text(l.retract_acceleration) + " T" +
           decimal_text(l.travel_acceleration) + "\n";
}

}  // namespace

std::string fill_placeholders(const std::string& text, const std::string& key, const Settings& settings,
                              const PrinterSettings& printer, const PrintFacts& facts) {
    std::string filled;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if ((c == '{' || c == '}') && i + 1 < text.size() && text[i + 1] == c) {
            filled += c, ++i;
            continue;
        }
        if (c == '}') throw Error(ErrorKind::usage, key + ": a '}' without '{'; write '}}' for a brace");
        if (c != '{') {
            filled += c;
            continue;
        }
        const std::size_t end = text.find('}', i);
        if (end == std::string::npos)
            throw Error(ErrorKind::usage, key + ": a '{' without '}'; write '{{' for a brace");
        const std::string name = text.substr(i + 1, end - i - 1), value = value_of(name, settings, printer, facts);
        if (value.empty())
            throw Error(ErrorKind::usage, key + ": nothing is known for the placeholder {" + name +
                                              "}; docs/printing.md lists those there are");
        filled += value;
        i = end;
    }
    if (!filled.empty() && filled.back() != '\n') filled += '\n';
    return filled;
}

void check_printer(const PrinterSettings& printer) {
    if (printer.bed_x == 0 && printer.bed_y == 0)
        throw Error(ErrorKind::usage,
                    "bed has no area, or no middle to print on; say with --bed X,Y,Z how large it is");
    check_range("bed's width (mm)", printer.bed_x, 1, to_mm(lattice_bound));
    check_range("bed's depth (mm)", printer.bed_y, 1, to_mm(lattice_bound));
    check_range("highest print (mm)", printer.bed_z, 1, to_mm(lattice_bound));
    for (const double corner : printer.bed_corner)
        check_range("bed's corner (mm)", corner, -to_mm(lattice_bound), to_mm(lattice_bound));
    const auto refuse = [](const std::string& message) { throw Error(ErrorKind::usage, message); };
    if (printer.round_bed && printer.bed_x != printer.bed_y)
        refuse("bed is " + decimal_text(printer.bed_x) + " x " + decimal_text(printer.bed_y) +
               " mm; a round bed is as wide as it is deep");
    if (printer.origin_at_centre && printer.bed_corner != std::array<double, 2>{})
        refuse("bed's corner is given and the origin is its middle; choose one of them");
    thumbnail_sizes(printer.thumbnails);
    check_range("filament diameter (mm)", printer.filament_diameter, 0.1, 20);
    check_range("nozzle temperature (°C)", printer.nozzle_temperature, 0, 1000);
    check_range("bed temperature (°C)", printer.bed_temperature, 0, 500);
    check_range("nozzle temperature of the first layer (°C)", printer.first_layer_temperature, 0, 1000);
    check_range("bed temperature of the first layer (°C)", printer.first_layer_bed_temperature, 0, 500);
    check_range("tool of external supports", printer.support_extruder, 0, 63);
    check_range("temperature of external supports (°C)", printer.support_temperature, 0, 1000);
    check_range("fan (percent)", printer.fan_percent, 0, 100);
    for (const auto& [name, speed] : {std::pair("print speed (mm/s)", printer.print_speed),
                                      {"support speed (mm/s)", printer.support_speed},
                                      {"first layer speed (mm/s)", printer.first_layer_speed},
                                      {"slowest print speed (mm/s)", printer.min_print_speed},
                                      {"travel speed (mm/s)", printer.travel_speed},
                                      {"retraction speed (mm/s)", printer.retraction_speed}})
        check_range(name, speed, 0.1, 10000);
    check_range("shortest time for a layer (s)", printer.min_layer_time, 0, 10000);
    check_range("retraction (mm)", printer.retraction, 0, 100);
    check_range("open air that retracts (mm)", printer.retract_over, 0, 1e6);
    check_range("longest detour (mm)", printer.longest_detour, 0, 1e6);
    check_range("prime surplus (share of the retraction)", printer.prime_surplus, 0, 10);
    check_range("surplus clearance (mm)", printer.surplus_clearance, 0, 1e6);
    for (std::size_t a = 0; a < 4; ++a) {
        check_range("highest speed of an axis (mm/s)", printer.limits.speed[a], 0.01, 1e5);
        check_range("acceleration of an axis (mm/s2)", printer.limits.acceleration[a], 0.1, 1e7);
        check_range("jerk of an axis (mm/s)", printer.limits.jerk[a], 1e-3, 1e5);
    }
    check_range("acceleration (mm/s2)", printer.limits.print_acceleration, 0.1, 1e7);
    check_range("retract acceleration (mm/s2)", printer.limits.retract_acceleration, 0.1, 1e7);
    check_range("travel acceleration (mm/s2)", printer.limits.travel_acceleration, 0.1, 1e7);
    fill_placeholders(printer.file_header, "file_header", {}, printer, {});
    fill_placeholders(printer.start_gcode, "start_gcode", {}, printer, {});
    fill_placeholders(printer.end_gcode, "end_gcode", {}, printer, {});
}

std::string gcode_header(const Settings& settings, const TrackSettings& tracks, const PrinterSettings& printer,
                         const PrintFacts& facts, const std::string& thumbnails) {
    check_printer(printer);
    std::string text = fill_placeholders(printer.file_header, "file_header", settings, printer, facts);
    text += "; generated by ribvault\n";
    text += printer.flavour == Flavour::reprapfirmware ? ";FLAVOR:RepRap\n" : ";FLAVOR:Marlin\n";
    if (facts.seconds > 0) text += ";TIME:" + std::to_string(std::lround(facts.seconds)) + "\n";
    text += ";LAYER_COUNT:" + std::to_string(facts.layers) + "\n";
    text += thumbnails;
    const auto comment = [&](const char* name, const std::string& value) {
        ((((text += "; ") += name) += " = ") += value) += '\n';
    };
    comment("printer", printer.name);
    comment("layer_height", decimal_text(to_mm(settings.layer_height)));
    comment("first_layer_height", decimal_text(to_mm(settings.first_layer_height)));
    comment("nozzle_diameter", decimal_text(to_mm(settings.nozzle)));
    comment("first_layer_extrusion_width", decimal_text(to_mm(tracks.width_on(0, settings.nozzle))));
    comment("infill_extrusion_width", decimal_text(to_mm(settings.support_width)));
    comment("filament_diameter", decimal_text(printer.filament_diameter));
    comment("perimeters", std::to_string(settings.perimeters));
    comment("top_solid_layers", std::to_string(settings.top_layers));
    comment("bottom_solid_layers", std::to_string(settings.bottom_layers));
    if (facts.filament_mm > 0) comment("filament used [mm]", decimal_text(std::round(facts.filament_mm * 100) / 100));
    if (facts.seconds > 0) comment("estimated printing time (normal mode)", duration(facts.seconds));

    const std::string start = acted_upon(printer.start_gcode);
    const bool heats_bed = !names(start, "M140") && !names(start, "M190") && !contains(start, "{bed_temperature}") &&
                           !contains(start, "{first_layer_bed_temperature}") && printer.bed_temperature_on(0) > 0;
    const bool heats_nozzle = !names(start, "M104") && !names(start, "M109") &&
                              !contains(start, "{nozzle_temperature}") && !contains(start, "{first_layer_temperature}");
    const std::string bed = std::to_string(printer.bed_temperature_on(0)),
                      nozzle = std::to_string(printer.nozzle_temperature_on(0));
    if (printer.flavour == Flavour::reprapfirmware) text += "T0\n";
    if (heats_bed) text += "M140 S" + bed + " ; heat the bed\n";
    if (heats_nozzle) text += "M104 S" + nozzle + " ; heat the nozzle\n";
    const std::string tool = "T" + std::to_string(printer.support_extruder),
                      heat_tool =
                          "M104 " + tool + " S" + support_temperature(printer) + " ; heat the nozzle of the supports\n",
                      wait_for_tool = "M109 " + tool + " S" + support_temperature(printer) + " ; wait for it\n";
    const bool uses_tool = printer.support_extruder > 0 && facts.support_tool;
    const bool heats_tool =
        uses_tool && (heats_nozzle || (!contains(start, "{support_temperature}") && !names(start, tool)));
    if (heats_tool && heats_nozzle) text += heat_tool;
    if (heats_bed) text += "M190 S" + bed + " ; wait for the bed\n";
    if (heats_nozzle) text += "M109 S" + nozzle + " ; wait for the nozzle\n";
    if (heats_tool && heats_nozzle) text += wait_for_tool;
    if (printer.write_limits) text += limits_text(printer);
    text += fill_placeholders(printer.start_gcode, "start_gcode", settings, printer, facts);
    if (heats_tool && !heats_nozzle) text += heat_tool + wait_for_tool;
    text += "G21 ; millimetres\nG90 ; absolute coordinates\nM83 ; relative extrusion\n";
    if (printer.retraction == 0) return text;
    const std::string retract =
        "G1 E-" + decimal_text(printer.retraction) + " F" + decimal_text(printer.retraction_speed * 60);
    if (uses_tool)  // as hot as the nozzle of the rest, by what is above or by start G-code
        text += tool + "\n" + retract + " ; so do the supports\nT0\n";
    text += retract + " ; the first layer starts retracted\n";
    return text;
}

std::string gcode_footer(const Settings& settings, const PrinterSettings& printer, const PrintFacts& facts) {
    std::string text = "; end of print\n";
    if (printer.fan_percent > 0) text += "M107 ; fan off\n";
    const std::string end = acted_upon(printer.end_gcode);
    const std::string tool = "T" + std::to_string(printer.support_extruder);
    if (!names(end, "M104")) text += "M104 S0 ; nozzle off\n";
    if (printer.support_extruder > 0 && facts.support_tool && !names(end, tool))
        text += "M104 " + tool + " S0 ; nozzle of the supports off\n";
    if (!names(end, "M140") && printer.bed_temperature_on(0) > 0) text += "M140 S0 ; bed off\n";
    text += fill_placeholders(printer.end_gcode, "end_gcode", settings, printer, facts);
    if (!names(end, "M84")) text += "M84 ; motors off\n";
    return text;
}

}  // namespace ribvault
