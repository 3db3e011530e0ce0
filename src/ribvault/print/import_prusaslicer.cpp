#include "ribvault/print/import_prusaslicer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "ribvault/error.hpp"
#include "ribvault/exact/rational.hpp"
#include "ribvault/print/gcode_header.hpp"
#include "ribvault/print/gcode_text.hpp"
#include "ribvault/print/ini.hpp"

namespace ribvault {
namespace {

/// The value cannot be taken, for this reason.
struct Ignored {
    std::string why;
};

/// PrusaSlicer writes one value per extruder; the first counts.
std::string first_of(const std::string& list) {
    std::string first = list.substr(0, list.find_first_of(",;"));
    first.erase(first.find_last_not_of(' ') + 1);
    return first;
}

/// The first value, which must be no percentage.
std::string plain(const std::string& list) {
    std::string text = first_of(list);
    if (text.find('%') != std::string::npos) throw Ignored{"a percentage"};
    return text;
}

double number(const std::string& list) { return number_in(plain(list)); }
int whole(const std::string& list) { return whole_number_in(plain(list)); }
Unit length_in(const std::string& list) { return parse_length(plain(list), "length"); }

using Place = std::array<double, 2>;  // mm

std::vector<Place> corners_in(const std::string& shape) {
    std::vector<Place> corners;
    std::istringstream list(shape);
    for (std::string corner; std::getline(list, corner, ',');) {
        const std::size_t x = corner.find('x');
        if (x == std::string::npos) throw Error(ErrorKind::usage, "'" + corner + "' is no corner");
        corners.push_back({number(corner.substr(0, x)), number(corner.substr(x + 1))});
    }
    return corners;
}

/// How much of the box around a bed, shrunk towards its middle, lies on the bed; 0: not even its middle does.
double share_on_bed(const std::vector<Place>& corners, Place middle, Place half) {
    double share = 1;
    bool inside = false;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        Place a = corners[k], b = corners[(k + 1) % corners.size()];
        for (std::size_t c = 0; c < 2; ++c) a[c] = (a[c] - middle[c]) / half[c], b[c] = (b[c] - middle[c]) / half[c];
        if ((a[1] > 0) != (b[1] > 0) && (b[0] - a[0]) * -a[1] / (b[1] - a[1]) + a[0] > 0) inside = !inside;
        // Along an edge max(|x|, |y|) is least at an end, or where x, y, x - y or x + y vanishes.
        const double dx = b[0] - a[0], dy = b[1] - a[1];
        for (const double t : {0.0, 1.0, -a[0] / dx, -a[1] / dy, (a[1] - a[0]) / (dx - dy), -(a[0] + a[1]) / (dx + dy)})
            if (t >= 0 && t <= 1) share = std::min(share, std::max(std::fabs(a[0] + t * dx), std::fabs(a[1] + t * dy)));
    }
    constexpr double rounding = 1e-9;  // of a rectangle's own corners
    return !inside ? 0 : share > 1 - rounding ? 1 : share;
}

/// A rectangle, a disc as a polygon of many corners, or a rectangle that lies on a bed of another shape.
/// A bed without area or middle: refused unless an option gives one.
void no_bed(PrinterSettings& printer) { printer.bed_x = printer.bed_y = 0; }

void take_bed(PrinterSettings& printer, const std::string& shape) {
    const std::vector<Place> corners = corners_in(shape);
    if (corners.empty()) throw Ignored{"empty"};
    Place lo{INFINITY, INFINITY}, hi{-INFINITY, -INFINITY}, middle, half;
    for (const Place& corner : corners)
        for (std::size_t c = 0; c < 2; ++c) lo[c] = std::min(lo[c], corner[c]), hi[c] = std::max(hi[c], corner[c]);
    for (std::size_t c = 0; c < 2; ++c) {
        if (!(hi[c] > lo[c])) return no_bed(printer);
        middle[c] = (lo[c] + hi[c]) / 2, half[c] = (hi[c] - lo[c]) / 2;
    }
    double nearest = INFINITY, farthest = 0;
    for (const Place& corner : corners) {
        const double radius = std::hypot(corner[0] - middle[0], corner[1] - middle[1]);
        nearest = std::min(nearest, radius), farthest = std::max(farthest, radius);
    }
    constexpr double rounding = 0.01;  // mm, of a disc's corners
    const bool disc = corners.size() > 8 && farthest - nearest < rounding;
    const double share = disc ? 1 : share_on_bed(corners, middle, half);
    if (share == 0) return no_bed(printer);
    const auto rounded = [](double v, double steps_per_mm) { return std::round(v * steps_per_mm) / steps_per_mm; };
    Place size{hi[0] - lo[0], hi[1] - lo[1]};
    for (std::size_t c = 0; c < 2; ++c) {
        if (disc) size[c] = 2 * nearest;
        if (share < 1) size[c] = std::floor(size[c] * share / rounding) * rounding;
        const double steps_per_mm = disc ? 1 / rounding : units_per_mm;
        size[c] = rounded(size[c], steps_per_mm);
        if (disc || share < 1) lo[c] = rounded(middle[c] - size[c] / 2, steps_per_mm);
    }
    printer.bed_x = size[0], printer.bed_y = size[1], printer.round_bed = disc;
    printer.origin_at_centre = std::fabs(middle[0]) < rounding && std::fabs(middle[1]) < rounding;
    printer.bed_corner = printer.origin_at_centre ? Place{} : lo;
    if (share < 1)
        throw Ignored{"in part: no rectangle and no disc; printed on is what lies in its middle, " +
                      decimal_text(printer.bed_x) + " x " + decimal_text(printer.bed_y) + " mm"};
}

/// PrusaSlicer's placeholders as ours; nothing when the text uses others, or expressions.
std::optional<std::string> translated(std::string text) {
    static const std::vector<std::pair<const char*, const char*>> names{
        {"first_layer_temperature", "first_layer_temperature"},
        {"first_layer_bed_temperature", "first_layer_bed_temperature"},
        {"temperature", "nozzle_temperature"},
        {"bed_temperature", "bed_temperature"},
        {"layer_height", "layer_height"},
        {"first_layer_height", "first_layer_height"},
        {"nozzle_diameter", "nozzle_diameter"},
        {"filament_diameter", "filament_diameter"},
        {"retract_length", "retraction"},
        {"max_print_height", "bed_z"},
        {"travel_speed", "travel_speed"},
        {"total_layer_count", "layer_count"}};
    for (const auto& [theirs, ours] : names)
        for (const char* index : {"", "[0]", "_0", "[initial_extruder]", "[initial_tool]"})
            for (const auto& [open, close] : {std::pair("[", "]"), std::pair("{", "}")}) {
                const std::string from = std::string(open) + theirs + index + close,
                                  to = std::string("\x01") + ours + "\x02";
                for (std::size_t at; (at = text.find(from)) != std::string::npos;) text.replace(at, from.size(), to);
            }
    if (text.find_first_of("[]{}") != std::string::npos) return std::nullopt;
    std::replace(text.begin(), text.end(), '\x01', '{');
    std::replace(text.begin(), text.end(), '\x02', '}');
    return text;
}

/// PrusaSlicer 2.7 names a format after each size: 16x16/QOI, 640x480/PNG.
void take_thumbnails(std::string& thumbnails, const std::string& value) {
    std::istringstream sizes(value);
    std::string kept, left_out;
    for (std::string size; std::getline(sizes, size, ',');) {
        std::string& list = size.find('/') == std::string::npos || size.ends_with("/PNG") ? kept : left_out;
        (list += list.empty() ? "" : ",") += size;
    }
    thumbnails = kept;
    if (!left_out.empty()) throw Ignored{"no PNG: " + left_out};
}

void take_gcode(std::string& target, const std::string& value) {
    std::optional<std::string> text = translated(unescaped(value));
    if (!text) throw Ignored{"it has placeholders or expressions that we do not know"};
    target = *text;
}

struct Target {
    Settings& s;
    TrackSettings& t;
    PrinterSettings& p;
};
using Field = std::function<void(Target, const std::string&)>;

Field printer_number(double PrinterSettings::*member) {
    return [member](Target to, const std::string& v) { to.p.*member = number(v); };
}
/// Of what 0 leaves open.
double more_than_0(const std::string& v) {
    const double value = number(v);
    if (value == 0) throw Ignored{"0: left to the slicer"};
    return value;
}
Field speed(double PrinterSettings::*member) {
    return [member](Target to, const std::string& v) { to.p.*member = more_than_0(v); };
}
Field temperature(int PrinterSettings::*member) {
    return [member](Target to, const std::string& v) { to.p.*member = whole(v); };
}
Field count(int Settings::*member) {
    return [member](Target to, const std::string& v) { to.s.*member = whole(v); };
}

const std::map<std::string, Field>& fields() {
    using P = PrinterSettings;
    static const std::map<std::string, Field> all = [] {
        std::map<std::string, Field> f{
            {"layer_height", [](Target to, const std::string& v) { to.s.layer_height = length_in(v); }},
            {"first_layer_height",
             [](Target to, const std::string& v) {
                 const Unit height = length_in(v);
                 if (height == 0) throw Ignored{"0: as the other layers"};
                 to.s.first_layer_height = height;
             }},
            {"nozzle_diameter", [](Target to, const std::string& v) { to.s.nozzle = length_in(v); }},
            {"perimeters", count(&Settings::perimeters)},
            {"top_solid_layers", count(&Settings::top_layers)},
            {"bottom_solid_layers", count(&Settings::bottom_layers)},
            {"external_perimeters_first", [](Target to, const std::string& v) { to.t.inner_first = number(v) == 0; }},
            {"thin_walls", [](Target to, const std::string& v) { to.t.thin_walls = number(v) != 0; }},
            {"skirts", [](Target to, const std::string& v) { to.t.skirt_loops = whole(v); }},
            {"skirt_distance", [](Target to, const std::string& v) { to.t.skirt_distance = length_in(v); }},
            {"brim_width", [](Target to, const std::string& v) { to.t.brim_width = length_in(v); }},
            {"brim_type",
             [](Target, const std::string& v) {
                 if (v != "no_brim" && v != "outer_only") throw Ignored{"brims lie around the outside here"};
             }},
            {"first_layer_extrusion_width",
             [](Target to, const std::string& v) {
                 const Unit width = length_in(v);
                 if (width != 0 && width < to.s.nozzle) throw Ignored{"narrower than the nozzle"};
                 if (width > 2 * to.s.nozzle) throw Ignored{"more than twice the nozzle"};
                 to.t.first_layer_width = width;
             }},
            {"infill_extrusion_width",
             [](Target to, const std::string& v) {
                 const Unit width = length_in(v);
                 if (width == 0) throw Ignored{"0: left to the slicer"};
                 if (2 * width < to.s.nozzle) throw Ignored{"less than half the nozzle"};
                 if (width > to.s.nozzle) throw Ignored{"more than the nozzle"};
                 to.s.support_width = width;
             }},
            {"seam_position",
             [](Target to, const std::string& v) {
                 if (v == "aligned" || v == "rear")
                     to.t.seam = Seam::aligned;
                 else if (v == "nearest")
                     to.t.seam = Seam::nearest;
                 else
                     throw Ignored{"seams are aligned, at a corner or nearest here"};
             }},
            {"top_fill_pattern",
             [](Target to, const std::string& v) {
                 if (v == "rectilinear" || v == "alignedrectilinear")
                     to.t.covers = CoverPattern::zigzag;
                 else if (v == "monotonic" || v == "monotoniclines")
                     to.t.covers = CoverPattern::monotonic;
                 else if (v == "concentric")
                     to.t.covers = CoverPattern::concentric;
                 else
                     throw Ignored{"covers are rectilinear, monotonic or concentric here"};
             }},
            {"bed_shape", [](Target to, const std::string& v) { take_bed(to.p, v); }},
            {"max_print_height", printer_number(&P::bed_z)},
            {"gcode_flavor",
             [](Target to, const std::string& v) {
                 if (v == "marlin" || v == "marlin2" || v == "reprap")
                     to.p.flavour = Flavour::marlin;
                 else if (v == "klipper")
                     to.p.flavour = Flavour::klipper;
                 else if (v == "reprapfirmware")
                     to.p.flavour = Flavour::reprapfirmware;
                 else
                     throw Ignored{"we write for Marlin, Klipper and RepRapFirmware"};
             }},
            {"filament_diameter", printer_number(&P::filament_diameter)},
            {"temperature", temperature(&P::nozzle_temperature)},
            {"bed_temperature", temperature(&P::bed_temperature)},
            {"first_layer_temperature", temperature(&P::first_layer_temperature)},
            {"first_layer_bed_temperature", temperature(&P::first_layer_bed_temperature)},
            {"max_fan_speed", printer_number(&P::fan_percent)},
            {"perimeter_speed", speed(&P::print_speed)},
            {"infill_speed", speed(&P::support_speed)},
            {"first_layer_speed", speed(&P::first_layer_speed)},
            {"slowdown_below_layer_time", printer_number(&P::min_layer_time)},
            {"min_print_speed", speed(&P::min_print_speed)},
            {"cooling", [](Target, const std::string& v) { whole(v); }},  // with what depends on it, below
            {"fan_always_on", [](Target, const std::string& v) { whole(v); }},
            {"min_fan_speed", [](Target, const std::string& v) { number(v); }},
            {"travel_speed", speed(&P::travel_speed)},
            {"retract_length", printer_number(&P::retraction)},
            {"retract_speed", printer_number(&P::retraction_speed)},
            {"thumbnails", [](Target to, const std::string& v) { take_thumbnails(to.p.thumbnails, v); }},
            {"start_gcode", [](Target to, const std::string& v) { take_gcode(to.p.start_gcode, v); }},
            {"end_gcode", [](Target to, const std::string& v) { take_gcode(to.p.end_gcode, v); }},
            {"machine_limits_usage", [](Target to, const std::string& v) { to.p.write_limits = v == "emit_to_gcode"; }},
            {"machine_max_acceleration_extruding",
             [](Target to, const std::string& v) { to.p.limits.print_acceleration = more_than_0(v); }},
            {"machine_max_acceleration_retracting",
             [](Target to, const std::string& v) { to.p.limits.retract_acceleration = more_than_0(v); }},
            {"machine_max_acceleration_travel",
             [](Target to, const std::string& v) { to.p.limits.travel_acceleration = more_than_0(v); }}};
        for (std::size_t a = 0; a < 4; ++a) {
            const std::string axis(1, "xyze"[a]);
            f["machine_max_feedrate_" + axis] = [a](Target to, const std::string& v) {
                to.p.limits.speed[a] = more_than_0(v);
            };
            f["machine_max_acceleration_" + axis] = [a](Target to, const std::string& v) {
                to.p.limits.acceleration[a] = more_than_0(v);
            };
            f["machine_max_jerk_" + axis] = [a](Target to, const std::string& v) {
                to.p.limits.jerk[a] = more_than_0(v);
            };
        }
        return f;
    }();
    return all;
}

/// What of a config or bundle counts, and which presets it names that it does not have: a bundle has the user's own
/// presets, not PrusaSlicer's.
struct Chosen {
    std::vector<IniEntry> entries;
    std::vector<std::string> missing;
};

/// Appends the entries of a section after those it inherits.
void append_inherited(const std::vector<IniEntry>& all, const std::string& section, std::set<std::string>& visited,
                      Chosen& chosen) {
    if (!visited.insert(section).second) return;
    if (std::none_of(all.begin(), all.end(), [&](const IniEntry& e) { return e.section == section; }))
        chosen.missing.push_back(section);
    const std::string kind = section.substr(0, section.find(':') + 1);
    for (const IniEntry& e : all) {
        if (e.section != section || e.key != "inherits") continue;
        std::istringstream parents(e.value);
        for (std::string parent; std::getline(parents, parent, ';');) {
            parent.erase(0, parent.find_first_not_of(' '));
            parent.erase(parent.find_last_not_of(' ') + 1);
            if (!parent.empty()) append_inherited(all, kind + parent, visited, chosen);
        }
    }
    for (const IniEntry& e : all)
        if (e.section == section && e.key != "inherits") chosen.entries.push_back(e);
}

Chosen chosen_entries(const std::vector<IniEntry>& all) {
    Chosen chosen;
    for (const IniEntry& e : all)
        if (e.section.empty()) chosen.entries.push_back(e);
    for (const std::string kind : {"printer", "filament", "print"}) {
        std::string section;
        for (const IniEntry& e : all)
            if (e.section.rfind(kind + ":", 0) == 0 && e.section.find('*') == std::string::npos)
                section = e.section;
        for (const IniEntry& e : all)
            if (e.section == "presets" && e.key == kind && !e.value.empty()) section = kind + ":" + e.value;
        std::set<std::string> visited;
        if (!section.empty()) append_inherited(all, section, visited, chosen);
    }
    return chosen;
}

void refuse_if_nothing_is_taken(const ImportedConfig& imported, const std::string& name) {
    if (!imported.taken.empty()) return;
    std::string known;  // what is ignored for a reason
    for (const std::string& key : imported.ignored) {
        if (key.find(" (in part") != std::string::npos) return;
        if (key.ends_with(')')) (known += known.empty() ? "" : ", ") += key;
    }
    throw Error(ErrorKind::usage,
                name + (known.empty() ? ": no setting that we know; is it a PrusaSlicer config or bundle?"
                                      : ": no setting of it can be taken: " + known));
}

}  // namespace

ImportedConfig import_prusaslicer(std::string_view text, const std::string& name, Settings& settings,
                                  TrackSettings& tracks, PrinterSettings& printer) {
    std::map<std::string, IniEntry> last;  // a later entry replaces what was inherited
    Chosen chosen = chosen_entries(read_ini(text, name));
    for (IniEntry& e : chosen.entries) last[e.key] = std::move(e);
    ImportedConfig imported;
    for (const std::string& section : chosen.missing)
        imported.ignored.push_back("[" + section + "] (named, but not in the file)");
    // What the check says of a value alone, beside what fits the nozzle.
    const auto doubt = [&](const Field& field, const std::string& value) -> std::string {
        Settings s;
        TrackSettings t;
        PrinterSettings p;
        s.nozzle = s.support_width = settings.nozzle,
        s.support_radius = s.erosion_step = s.straighten_step = s.nozzle / 2;
        s.branch_bonus_length = 2 * s.nozzle, s.pillar_length = 10 * s.nozzle, s.sampling_pitch = s.nozzle / 4;
        try {
            field({s, t, p}, value);
        } catch (const Ignored&) {  // in part: the rest is taken
        }
        try {
            s.check(), t.check(s.nozzle), check_printer(p);
        } catch (const Error& error) {
            return error.what();
        }
        return {};
    };
    const auto take = [&](const std::string& key, const IniEntry& entry) {
        const auto field = fields().find(key);
        if (field == fields().end()) {
            imported.ignored.push_back(key);
            return;
        }
        try {
            field->second({settings, tracks, printer}, entry.value);
            imported.taken.push_back(key);
        } catch (const Ignored& ignored) {
            imported.ignored.push_back(key + " (" + ignored.why + ")");
        } catch (const Error& error) {
            throw Error(ErrorKind::usage, name + ":" + std::to_string(entry.line) + ": " + key + ": " + error.what());
        }
        if (const std::string message = doubt(field->second, entry.value); !message.empty())
            imported.doubts.push_back({message, name + ":" + std::to_string(entry.line) + ": " + key});
    };
    if (const auto nozzle = last.find("nozzle_diameter"); nozzle != last.end())
        take(nozzle->first, nozzle->second);  // others depend on it
    for (const auto& [key, entry] : last)
        if (key != "nozzle_diameter") take(key, entry);
    if (const auto brim = last.find("brim_type"); brim != last.end() && brim->second.value == "no_brim")
        tracks.brim_width = 0;
    const auto value_of = [&](const std::string& key, double otherwise) {
        const bool taken = std::find(imported.taken.begin(), imported.taken.end(), key) != imported.taken.end();
        return taken ? number(last.at(key).value) : otherwise;
    };
    if (value_of("cooling", 1) == 0) {  // PrusaSlicer's defaults where the config does not say
        printer.min_layer_time = 0;
        printer.fan_percent = value_of("fan_always_on", 0) == 0 ? 0 : value_of("min_fan_speed", 35);
    } else {
        for (const char* key : {"fan_always_on", "min_fan_speed"})
            if (std::erase(imported.taken, key) > 0)
                imported.ignored.push_back(std::string(key) + " (the fan runs as max_fan_speed says)");
    }
    if (const auto ignored = std::find_if(imported.ignored.begin(), imported.ignored.end(),
                                          [](const std::string& key) { return key.starts_with("gcode_flavor"); });
        ignored != imported.ignored.end() && printer.write_limits) {
        printer.write_limits = false;
        std::erase(imported.taken, "machine_limits_usage");
        imported.ignored.push_back("machine_limits_usage (each flavour has its own words for limits)");
    }
    refuse_if_nothing_is_taken(imported, name);
    printer.name = "imported from PrusaSlicer";
    return imported;
}

}  // namespace ribvault
