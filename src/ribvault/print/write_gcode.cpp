#include "ribvault/print/write_gcode.hpp"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string_view>
#include <utility>

#include "ribvault/error.hpp"
#include "ribvault/print/perimeter_rows.hpp"

namespace ribvault {
namespace {

void append_integer(std::string& text, std::int64_t value) {
    char digits[24];
    text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

/// A number of hundred-thousandths with as many decimals as it needs.
void append_decimal(std::string& text, std::int64_t value) {
    if (value < 0) text += '-', value = -value;
    append_integer(text, value / units_per_mm);
    std::int64_t fraction = value % units_per_mm;
    if (fraction == 0) return;
    char digits[6] = {'.', '0', '0', '0', '0', '0'};
    for (int i = 5; i > 0; --i, fraction /= 10) digits[i] = static_cast<char>('0' + fraction % 10);
    int count = 6;
    while (digits[count - 1] == '0') --count;
    text.append(digits, static_cast<std::size_t>(count));
}

std::int64_t hundred_thousandths(double value) { return std::llround(value * static_cast<double>(units_per_mm)); }

std::string_view type_name(TrackKind kind) {
    switch (kind) {
        case TrackKind::outer_perimeter: return "External perimeter";
        case TrackKind::inner_perimeter: return "Perimeter";
        case TrackKind::cover: return "Solid infill";
        case TrackKind::support: break;
    }
    return "Internal infill";
}

/// Filament's cross-section in mm².
double filament_area(const PrinterSettings& printer) {
    return std::numbers::pi / 4 * printer.filament_diameter * printer.filament_diameter;
}

/// One layer's text as it grows, and the printer's state at its end.
struct LayerWriter {
    const PrinterSettings& printer;
    const Unit height;
    LayerText out;
    std::int64_t feed_rate = -1;   ///< hundred-thousandths of mm/min, last written
    std::int64_t pushed = 0;       ///< E along tracks so far, hundred-thousandths of a mm
    double to_push = 0;            ///< the same, exact
    bool retracted = true;

    LayerWriter(const PrinterSettings& p, Unit h) : printer(p), height(h) {}

    void comment(std::string_view key, std::string_view value) { ((out.text += key) += value) += '\n'; }
    void length_comment(std::string_view key, Unit value) {
        out.text += key;
        append_decimal(out.text, value);
        out.text += '\n';
    }
    void feed(double mm_per_s) {
        const std::int64_t rate = hundred_thousandths(mm_per_s * 60);
        if (rate == feed_rate) return;
        feed_rate = rate;
        out.text += " F";
        append_decimal(out.text, rate);
    }
    void position(Point p) {
        out.text += " X";
        append_decimal(out.text, p.x);
        out.text += " Y";
        append_decimal(out.text, p.y);
    }
    void push_filament(double mm) {
        if (mm == 0) return;
        out.text += "G1 E";
        append_decimal(out.text, hundred_thousandths(mm));
        feed(printer.retraction_speed);
        out.text += '\n';
    }
    void retract() {
        if (retracted) return;
        push_filament(-printer.retraction);
        retracted = true;
        ++out.statistics.retractions;
    }
    void prime(bool with_surplus) {
        const double surplus = with_surplus ? printer.retraction * printer.prime_surplus : 0;
        push_filament(printer.retraction + surplus);
        out.statistics.prime_surplus += surplus;
        retracted = false;
    }
    void travel(Point to) {
        out.text += "G0";
        position(to);
        feed(printer.travel_speed);
        out.text += '\n';
        ++out.statistics.travels;
    }
    /// The filament to push so that all since the layer's start is right to the last decimal.
    std::int64_t next_push(double mm_of_filament) {
        to_push += mm_of_filament;
        const std::int64_t before = std::exchange(pushed, hundred_thousandths(to_push));
        return pushed - before;
    }
    /// The flow is that of a track at this speed.
    void dot(const ToolPath& path, double mm_per_s) {
        const double area = std::numbers::pi / 4 * to_mm(path.width) * to_mm(path.width);
        const double volume = area * to_mm(height);
        out.text += "G1 E";
        append_decimal(out.text, next_push(volume / filament_area(printer)));
        feed(mm_per_s * to_mm(path.width) * to_mm(height) / filament_area(printer));
        out.text += '\n';
        out.statistics.volume[static_cast<std::size_t>(path.kind)] += volume;
        out.statistics.filament += volume / filament_area(printer);
    }
    void track(const ToolPath& path, double mm_per_s) {
        const double volume_per_mm = to_mm(path.width) * to_mm(height);
        const double filament_per_unit = to_mm(1) * volume_per_mm / filament_area(printer);
        double sum = 0;
        const std::size_t count = path.points.size();
        for (std::size_t i = 1; i < count + (path.closed ? 1 : 0); ++i) {
            const Point to = path.points[i % count];
            const double step = length(to - path.points[i - 1]);
            sum += step;
            out.text += "G1";
            position(to);
            out.text += " E";
            append_decimal(out.text, next_push(step * filament_per_unit));
            feed(mm_per_s);
            out.text += '\n';
        }
        const auto kind = static_cast<std::size_t>(path.kind);
        const double mm = sum / static_cast<double>(units_per_mm);
        out.statistics.length[kind] += mm;
        out.statistics.volume[kind] += mm * volume_per_mm;
        out.statistics.filament += mm * volume_per_mm / filament_area(printer);
    }
};

void check_printer(const PrinterSettings& printer) {
    const auto need = [](bool good, const char* name, double value, const char* rule) {
        if (!good || !std::isfinite(value))
            throw Error(ErrorKind::usage, std::string(name) + " is " + std::to_string(value) + "; it must be " + rule);
    };
    need(printer.filament_diameter > 0, "filament diameter (mm)", printer.filament_diameter, "positive");
    need(printer.nozzle_temperature >= 0, "nozzle temperature (°C)", printer.nozzle_temperature, "0 or more");
    need(printer.bed_temperature >= 0, "bed temperature (°C)", printer.bed_temperature, "0 (not heated) or more");
    need(printer.print_speed > 0, "print speed (mm/s)", printer.print_speed, "positive");
    need(printer.support_speed > 0, "support speed (mm/s)", printer.support_speed, "positive");
    need(printer.first_layer_speed > 0, "first layer speed (mm/s)", printer.first_layer_speed, "positive");
    need(printer.travel_speed > 0, "travel speed (mm/s)", printer.travel_speed, "positive");
    need(printer.retraction >= 0, "retraction (mm)", printer.retraction, "0 (none) or more");
    need(printer.retraction_speed > 0, "retraction speed (mm/s)", printer.retraction_speed, "positive");
    need(printer.retract_over >= 0, "shortest travel that retracts (mm)", printer.retract_over, "0 or more");
    need(printer.prime_surplus >= 0, "prime surplus", printer.prime_surplus, "0 or more (a share of the retraction)");
    need(printer.surplus_clearance >= 0, "surplus clearance (mm)", printer.surplus_clearance, "0 or more");
}

}  // namespace

PrintStatistics& PrintStatistics::operator+=(const PrintStatistics& other) {
    for (std::size_t k = 0; k < track_kinds; ++k) length[k] += other.length[k], volume[k] += other.volume[k];
    filament += other.filament;
    prime_surplus += other.prime_surplus;
    travel += other.travel;
    travels += other.travels;
    retractions += other.retractions;
    return *this;
}

Unit top_of_layer(int layer, const Settings& settings) {
    return settings.first_layer_height + layer * settings.layer_height;
}

std::string gcode_header(const Settings& settings, const PrinterSettings& printer, int layer_count) {
    check_printer(printer);
    std::string text = "; generated by ribvault\n;FLAVOR:Marlin\n";
    const auto line = [&](std::string_view before, std::int64_t value, std::string_view after = {}) {
        text += before;
        append_decimal(text, value);
        (text += after) += '\n';
    };
    const auto whole = [](std::int64_t value) { return value * units_per_mm; };
    line(";LAYER_COUNT:", whole(layer_count));
    line("; layer_height = ", settings.layer_height);
    line("; first_layer_height = ", settings.first_layer_height);
    line("; nozzle_diameter = ", settings.nozzle);
    line("; filament_diameter = ", hundred_thousandths(printer.filament_diameter));
    line("; perimeters = ", whole(settings.perimeters));
    line("; top_solid_layers = ", whole(settings.top_layers));
    line("; bottom_solid_layers = ", whole(settings.bottom_layers));
    if (printer.bed_temperature > 0) line("M140 S", whole(printer.bed_temperature), " ; heat the bed");
    line("M104 S", whole(printer.nozzle_temperature), " ; heat the nozzle");
    if (printer.bed_temperature > 0) line("M190 S", whole(printer.bed_temperature), " ; wait for the bed");
    line("M109 S", whole(printer.nozzle_temperature), " ; wait for the nozzle");
    text += "G28 ; home\nG21 ; millimetres\nG90 ; absolute coordinates\nM83 ; relative extrusion\n";
    if (printer.retraction > 0) {
        line("G1 E-", hundred_thousandths(printer.retraction), "");
        text.pop_back();
        line(" F", hundred_thousandths(printer.retraction_speed * 60), " ; every layer starts retracted");
    }
    return text;
}

LayerText gcode_layer(const LayerPaths& layer, const Settings& settings, const PrinterSettings& printer) {
    const Unit height = layer.layer == 0 ? settings.first_layer_height : settings.layer_height;
    const Unit z = top_of_layer(layer.layer, settings);
    LayerWriter writer(printer, height);
    std::size_t points = 0;
    for (const ToolPath& path : layer.paths) points += path.points.size() + 2;
    writer.out.text.reserve(128 + 40 * points);

    writer.comment(";LAYER_CHANGE", "");
    writer.out.text += ";LAYER:";
    append_integer(writer.out.text, layer.layer);
    writer.out.text += '\n';
    writer.length_comment(";Z:", z);
    writer.length_comment(";HEIGHT:", height);
    writer.out.text += "G0 Z";
    append_decimal(writer.out.text, z);
    writer.feed(printer.travel_speed);
    writer.out.text += '\n';

    const PerimeterRows perimeters(layer, round_to_lattice(printer.surplus_clearance * units_per_mm));
    const ToolPath* previous = nullptr;
    for (const ToolPath& path : layer.paths) {
        const Point start = path.points.front();
        if (!previous) {
            writer.travel(start);
        } else if (end_of(*previous) != start) {
            const double mm = length(start - end_of(*previous)) / static_cast<double>(units_per_mm);
            if (mm > printer.retract_over) writer.retract();
            writer.travel(start);
            writer.out.statistics.travel += mm;
        }
        if (writer.retracted) writer.prime(path.kind == TrackKind::support && !perimeters.near(start));
        if (!previous || previous->kind != path.kind) writer.comment(";TYPE:", type_name(path.kind));
        if (!previous || previous->width != path.width) writer.length_comment(";WIDTH:", path.width);
        const bool support = path.kind == TrackKind::support;
        const double speed = layer.layer == 0 ? printer.first_layer_speed
                             : support        ? printer.support_speed
                                              : printer.print_speed;
        if (path.points.size() == 1)
            writer.dot(path, speed);
        else
            writer.track(path, speed);
        previous = &path;
    }
    writer.retract();
    return std::move(writer.out);
}

std::string gcode_footer() {
    return "; end of print\nM104 S0 ; nozzle off\nM140 S0 ; bed off\nG91\nG0 Z5 F600 ; off the print\nG90\n"
           "M84 ; motors off\n";
}

}  // namespace ribvault
