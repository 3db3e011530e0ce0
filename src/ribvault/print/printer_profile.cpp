#include "ribvault/print/printer_profile.hpp"

#include <algorithm>
#include <functional>
#include <map>

#include "ribvault/error.hpp"
#include "ribvault/print/gcode_header.hpp"
#include "ribvault/print/ini.hpp"

namespace ribvault {
namespace {

bool yes_or_no(const std::string& text) {
    if (text == "yes" || text == "true" || text == "1") return true;
    if (text == "no" || text == "false" || text == "0") return false;
    throw Error(ErrorKind::usage, "'" + text + "' is neither yes nor no");
}

using Setter = std::function<void(PrinterSettings&, const std::string&)>;

Setter decimal(double PrinterSettings::*member) {
    return [member](PrinterSettings& p, const std::string& v) { p.*member = number_in(v); };
}
Setter integer(int PrinterSettings::*member) {
    return [member](PrinterSettings& p, const std::string& v) { p.*member = whole_number_in(v); };
}
Setter flag(bool PrinterSettings::*member) {
    return [member](PrinterSettings& p, const std::string& v) { p.*member = yes_or_no(v); };
}
Setter line_of(std::string PrinterSettings::*member) {
    return [member](PrinterSettings& p, const std::string& v) { p.*member += unescaped(v) + "\n"; };
}
Setter axes(std::array<double, 4> MotionLimits::*member) {
    return [member](PrinterSettings& p, const std::string& v) {
        const std::vector<double> values = numbers_in(v, 4, "500,500,12,120 (x, y, z, filament)");
        std::copy(values.begin(), values.end(), (p.limits.*member).begin());
    };
}
Setter acceleration(double MotionLimits::*member) {
    return [member](PrinterSettings& p, const std::string& v) { p.limits.*member = number_in(v); };
}

const std::map<std::string, Setter>& keys() {
    using P = PrinterSettings;
    static const std::map<std::string, Setter> all{
        {"name",
         [](P& p, const std::string& v) {
             if (v.empty()) throw Error(ErrorKind::usage, "the printer has no name");
             p.name = v;
         }},
        {"flavour",
         [](P& p, const std::string& v) {
             if (v == "marlin")
                 p.flavour = Flavour::marlin;
             else if (v == "klipper")
                 p.flavour = Flavour::klipper;
             else if (v == "reprapfirmware")
                 p.flavour = Flavour::reprapfirmware;
             else
                 throw Error(ErrorKind::usage, "'" + v + "' is none of marlin, klipper, reprapfirmware");
         }},
        {"bed",
         [](P& p, const std::string& v) {
             const std::vector<double> size = numbers_in(v, 3, "250,210,200");
             p.bed_x = size[0], p.bed_y = size[1], p.bed_z = size[2];
         }},
        {"bed_corner",
         [](P& p, const std::string& v) {
             const std::vector<double> corner = numbers_in(v, 2, "3,-5");
             p.bed_corner = {corner[0], corner[1]};
         }},
        {"round_bed", flag(&P::round_bed)},
        {"origin_at_centre", flag(&P::origin_at_centre)},
        {"filament_diameter", decimal(&P::filament_diameter)},
        {"nozzle_temperature", integer(&P::nozzle_temperature)},
        {"bed_temperature", integer(&P::bed_temperature)},
        {"first_layer_temperature", integer(&P::first_layer_temperature)},
        {"first_layer_bed_temperature", integer(&P::first_layer_bed_temperature)},
        {"support_extruder", integer(&P::support_extruder)},
        {"support_temperature", integer(&P::support_temperature)},
        {"fan_percent", decimal(&P::fan_percent)},
        {"print_speed", decimal(&P::print_speed)},
        {"support_speed", decimal(&P::support_speed)},
        {"first_layer_speed", decimal(&P::first_layer_speed)},
        {"min_layer_time", decimal(&P::min_layer_time)},
        {"min_print_speed", decimal(&P::min_print_speed)},
        {"travel_speed", decimal(&P::travel_speed)},
        {"retraction", decimal(&P::retraction)},
        {"retraction_speed", decimal(&P::retraction_speed)},
        {"retract_over", decimal(&P::retract_over)},
        {"longest_detour", decimal(&P::longest_detour)},
        {"prime_surplus", decimal(&P::prime_surplus)},
        {"surplus_clearance", decimal(&P::surplus_clearance)},
        {"max_speed", axes(&MotionLimits::speed)},
        {"max_acceleration", axes(&MotionLimits::acceleration)},
        {"jerk", axes(&MotionLimits::jerk)},
        {"print_acceleration", acceleration(&MotionLimits::print_acceleration)},
        {"retract_acceleration", acceleration(&MotionLimits::retract_acceleration)},
        {"travel_acceleration", acceleration(&MotionLimits::travel_acceleration)},
        {"write_limits", flag(&P::write_limits)},
        {"file_header", line_of(&P::file_header)},
        {"start_gcode", line_of(&P::start_gcode)},
        {"end_gcode", line_of(&P::end_gcode)},
        {"thumbnails", [](P& p, const std::string& v) { p.thumbnails = v; }},
    };
    return all;
}

}  // namespace

PrinterSettings read_profile(std::string_view text, const std::string& name) {
    PrinterSettings printer;
    std::map<std::string, int> seen;
    int last = 0;
    for (const IniEntry& entry : read_ini(text, name)) {
        const auto refuse = [&](const std::string& why) {
            throw Error(ErrorKind::usage, name + ":" + std::to_string(entry.line) + ": " + entry.key + ": " + why);
        };
        const auto key = keys().find(entry.key);
        if (key == keys().end()) refuse("no such key in a printer profile; docs/printing.md lists them");
        const bool lines = entry.key == "start_gcode" || entry.key == "end_gcode" || entry.key == "file_header";
        const auto [first, is_new] = seen.try_emplace(entry.key, entry.line);
        if (!is_new && !lines) refuse("given already on line " + std::to_string(first->second));
        if (is_new && entry.key == "start_gcode") printer.start_gcode.clear();
        if (is_new && entry.key == "end_gcode") printer.end_gcode.clear();
        try {
            key->second(printer, entry.value);
            check_printer(printer);
        } catch (const Error& error) {
            const std::string why = error.what(), prefix = entry.key + ": ";
            refuse(why.starts_with(prefix) ? why.substr(prefix.size()) : why);
        }
        last = entry.line;
    }
    for (const char* key : {"nozzle_temperature", "bed_temperature"})
        if (!seen.contains(key))
            throw Error(ErrorKind::usage, name + ":" + (last > 0 ? std::to_string(last) + ": " : " ") + key +
                                              ": missing up to the end of the profile; add '" + key +
                                              " = ...' (degrees C)");
    return printer;
}

PrinterSettings builtin_profile(std::string_view name) {
    std::string names;
    for (const BuiltinProfile& profile : builtin_profiles()) {
        if (profile.name == name) return read_profile(profile.text, std::string(name));
        (names += names.empty() ? "" : ", ") += profile.name;
    }
    throw Error(ErrorKind::usage,
                "--printer: there is no built-in profile '" + std::string(name) + "'; there are " + names);
}

}  // namespace ribvault
