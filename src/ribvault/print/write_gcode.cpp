#include "ribvault/print/write_gcode.hpp"

#include <algorithm>
#include <utility>

#include "ribvault/print/gcode_text.hpp"
#include "ribvault/print/perimeter_rows.hpp"

namespace ribvault {
namespace {

/// The length of track that takes as much filament, and at the same flow as long, as a path on its own: its own, but of
/// a dot, a disc, that of π w / 4. A stub shorter than a quarter of its width is a dot, a little drawn out, unless it
/// begins on another track.
double length_by_filament(const ToolPath& path) {
    const double l = length(path), width = static_cast<double>(path.width);
    return !path.on_track && 4 * l < width ? std::numbers::pi / 4 * width : l;
}

std::string_view type_name(TrackKind kind) {
    switch (kind) {
        case TrackKind::outer_perimeter: return "External perimeter";
        case TrackKind::inner_perimeter: return "Perimeter";
        case TrackKind::cover: return "Solid infill";
        case TrackKind::thin_wall: return "Gap fill";
        case TrackKind::skirt: return "Skirt/Brim";
        case TrackKind::external_support: return "Support material";
        case TrackKind::support: break;
    }
    return "Internal infill";
}

/// Text as it grows, and what the printer has done.
struct Writer {
    const PrinterSettings& printer;
    std::string text;
    PrintStatistics statistics;
    std::vector<Move> moves;
    std::int64_t feed_rate = -1;  ///< hundred-thousandths of mm/min, last written
    std::int64_t pushed = 0;      ///< E along tracks so far, hundred-thousandths of a mm
    double to_push = 0;           ///< the same, exact

    explicit Writer(const PrinterSettings& p) : printer(p) {}

    void feed(double mm_per_s) {
        const std::int64_t rate = hundred_thousandths(mm_per_s * 60);
        if (rate == feed_rate) return;
        feed_rate = rate;
        text += " F";
        append_decimal(text, rate);
    }
    void position(Point p) {
        text += " X";
        append_decimal(text, p.x);
        text += " Y";
        append_decimal(text, p.y);
    }
    void moved(Point step, double dz, double de, double mm_per_s) {
        moves.push_back({{to_mm(step.x), to_mm(step.y), dz, de}, mm_per_s});
    }
    void push_filament(double mm) {
        if (mm == 0) return;
        text += "G1 E";
        append_decimal(text, hundred_thousandths(mm));
        feed(printer.retraction_speed);
        text += '\n';
        moved({}, 0, mm, printer.retraction_speed);
    }
    void retract() {
        push_filament(-printer.retraction);
        statistics.retractions += printer.retraction > 0;
    }
    void prime(bool with_surplus) {
        const double surplus = with_surplus ? printer.retraction * printer.prime_surplus : 0;
        push_filament(printer.retraction + surplus);
        statistics.prime_surplus += surplus;
    }
    void change_tool(int to) {
        text += 'T';
        append_integer(text, to);
        text += '\n';
        feed_rate = -1;
    }
    void rise(Unit to, Unit by) {
        text += "G0 Z";
        append_decimal(text, to);
        feed(printer.travel_speed);
        text += '\n';
        moved({}, to_mm(by), 0, printer.travel_speed);
    }
    void travel(Point from, const Travel& way) {
        for (Point to : way.via) {
            text += "G0";
            position(to);
            feed(printer.travel_speed);
            text += '\n';
            moved(to - from, 0, 0, printer.travel_speed);
            from = to;
        }
        ++statistics.travels;
        statistics.detours += way.via.size() > 1;
        statistics.travel += way.length / static_cast<double>(units_per_mm);
        statistics.open_air += way.open_air / static_cast<double>(units_per_mm);
    }
    /// The filament to push so that all since the layer's start is right to the last decimal. At least that decimal:
    /// a move that pushes nothing is none that extrudes. Later ones push less for it.
    std::int64_t next_push(double mm_of_filament) {
        to_push += mm_of_filament;
        const std::int64_t push = std::max<std::int64_t>(1, hundred_thousandths(to_push) - pushed);
        pushed += push;
        return push;
    }
    /// The flow is that of a track at this speed.
    void dot(const ToolPath& path, Unit height, double mm_per_s) {
        const double area = std::numbers::pi / 4 * to_mm(path.width) * to_mm(path.width);
        const double volume = area * to_mm(height),
                     flow = mm_per_s * to_mm(path.width) * to_mm(height) / filament_area(printer);
        text += "G1 E";
        append_decimal(text, next_push(volume / filament_area(printer)));
        feed(flow);
        text += '\n';
        moved({}, 0, volume / filament_area(printer), flow);
        statistics.volume[static_cast<std::size_t>(path.kind)] += volume;
        statistics.filament += volume / filament_area(printer);
    }
    void track(const ToolPath& path, Unit height, double mm_per_s, bool joined) {
        double volume_per_mm = to_mm(path.width) * to_mm(height);
        if (!joined) {
            const double more = length_by_filament(path) / length(path);
            volume_per_mm *= more, mm_per_s /= more;
        }
        const double filament_per_unit = to_mm(1) * volume_per_mm / filament_area(printer);
        double sum = 0;
        const std::size_t count = path.points.size();
        for (std::size_t i = 1; i < count + (path.closed ? 1 : 0); ++i) {
            const Point to = path.points[i % count], way = to - path.points[i - 1];
            const double step = length(way);
            sum += step;
            text += "G1";
            position(to);
            text += " E";
            append_decimal(text, next_push(step * filament_per_unit));
            feed(mm_per_s);
            text += '\n';
            moved(way, 0, step * filament_per_unit, mm_per_s);
        }
        const auto kind = static_cast<std::size_t>(path.kind);
        const double mm = sum / static_cast<double>(units_per_mm);
        statistics.length[kind] += mm;
        statistics.volume[kind] += mm * volume_per_mm;
        statistics.filament += mm * volume_per_mm / filament_area(printer);
    }
};

double longest_detour(const PrinterSettings& printer) {
    return printer.longest_detour * static_cast<double>(units_per_mm);
}

bool touch(TrackEnd a, TrackEnd b) { return 2 * length(b.at - a.at) <= static_cast<double>(a.width + b.width); }

bool must_retract(const Travel& way, TrackEnd from, TrackEnd to, const PrinterSettings& printer) {
    if (from.tool != to.tool) return true;
    if (touch(from, to)) return false;
    return way.leaves_island || way.open_air > printer.retract_over * static_cast<double>(units_per_mm);
}

/// `share`: of the speed that the printer's settings say.
double speed_of(const ToolPath& path, int layer, const PrinterSettings& printer, double share) {
    const double speed = layer == 0              ? printer.first_layer_speed
                         : is_support(path.kind) ? printer.support_speed
                                                 : printer.print_speed;
    return std::max(share * speed, std::min(speed, printer.min_print_speed));
}

int tool_of(const ToolPath& path, const PrinterSettings& printer) {
    return path.kind == TrackKind::external_support ? printer.support_extruder : 0;
}

/// gcode_layer with tracks at a share of their speeds.
LayerText layer_at(double share, const LayerPaths& layer, const TravelMap& map, const Settings& settings,
                   const PrinterSettings& printer, const std::vector<ToolPath>& beside) {
    const Unit height = settings.height_of(layer.layer);
    LayerText out;
    out.layer = layer.layer;
    out.heading = ";LAYER_CHANGE\n;LAYER:";
    append_integer(out.heading, layer.layer);
    out.heading += "\n;Z:";
    append_decimal(out.heading, settings.top_of(layer.layer));
    out.heading += "\n;HEIGHT:";
    append_decimal(out.heading, height);
    out.heading += '\n';

    Writer writer(printer);
    std::size_t points = 0;
    for (const ToolPath& path : layer.paths) points += path.points.size() + 2;
    writer.text.reserve(128 + 40 * points);
    const PerimeterRows perimeters(layer, round_to_lattice(printer.surplus_clearance * units_per_mm));
    const auto with_surplus = [&](const ToolPath& path) {
        return is_support(path.kind) && !perimeters.near(path.points.front());
    };
    const ToolPath* previous = nullptr;
    // `next` is printed after `path`, if anything is.
    const auto print = [&](const ToolPath& path, const ToolPath* next) {
        const bool joined =
            (previous && end_of(*previous) == path.points.front()) || (next && next->points.front() == end_of(path));
        const TrackEnd start{path.points.front(), path.width, tool_of(path, printer)};
        if (!previous) {
            out.first = start, out.surplus = with_surplus(path);
        } else if (const TrackEnd end{end_of(*previous), previous->width, tool_of(*previous, printer)};
                   end.at != start.at || end.tool != start.tool) {
            Travel way = map.travel(end.at, start.at, longest_detour(printer));
            // Between skirt and object, and along them, nothing keeps the nozzle inside.
            if (path.kind == TrackKind::skirt || previous->kind == TrackKind::skirt)
                way = {{start.at}, length(start.at - end.at), true, 0};
            const bool retracts = must_retract(way, end, start, printer);
            if (retracts) writer.retract();
            if (end.tool != start.tool) writer.change_tool(start.tool);
            writer.travel(end.at, way);
            if (retracts) writer.prime(with_surplus(path));
        }
        if (!previous || previous->kind != path.kind) ((writer.text += ";TYPE:") += type_name(path.kind)) += '\n';
        if (!previous || previous->width != path.width) {
            writer.text += ";WIDTH:";
            append_decimal(writer.text, path.width);
            writer.text += '\n';
        }
        const double speed = speed_of(path, layer.layer, printer, share);
        if (path.points.size() == 1)
            writer.dot(path, height, speed);
        else
            writer.track(path, height, speed, joined);
        previous = &path;
    };
    for (const ToolPath& path : beside) print(path, nullptr);
    for (std::size_t i = 0; i < layer.paths.size(); ++i)
        print(layer.paths[i], i + 1 < layer.paths.size() ? &layer.paths[i + 1] : nullptr);
    if (previous) out.last = TrackEnd{end_of(*previous), previous->width, tool_of(*previous, printer)};
    out.body = std::move(writer.text);
    out.statistics = writer.statistics;
    out.statistics.seconds = motion_seconds(writer.moves, printer.limits);
    return out;
}

/// Seconds that a layer's tracks take at a share of their speeds, without acceleration.
double cruising_seconds(double share, const LayerPaths& layer, const std::vector<ToolPath>& beside,
                        const PrinterSettings& printer) {
    double seconds = 0;
    for (const std::vector<ToolPath>* paths : {&beside, &layer.paths})
        for (const ToolPath& path : *paths) {
            seconds += length_by_filament(path) / units_per_mm / speed_of(path, layer.layer, printer, share);
        }
    return seconds;
}

/// The share of their speeds at which a layer's tracks take so long without acceleration; 0: none, they are as slow as
/// they may be before.
double share_that_takes(double seconds, const LayerPaths& layer, const std::vector<ToolPath>& beside,
                        const PrinterSettings& printer) {
    double slow = 0, fast = 1;
    if (cruising_seconds(slow, layer, beside, printer) <= seconds) return slow;
    for (int step = 0; step < 40; ++step) {
        const double share = (slow + fast) / 2;
        (cruising_seconds(share, layer, beside, printer) > seconds ? slow : fast) = share;
    }
    return fast;
}

/// From the first layer's temperatures to those of the layers above it.
std::string temperatures_of_the_rest(const PrinterSettings& printer) {
    std::string text;
    const auto set = [&](const char* command, int temperature) {
        text += command;
        append_integer(text, temperature);
        text += " ; as from the second layer on\n";
    };
    if (printer.nozzle_temperature_on(0) != printer.nozzle_temperature)
        set(printer.support_extruder > 0 ? "M104 T0 S" : "M104 S", printer.nozzle_temperature);
    if (printer.bed_temperature_on(0) != printer.bed_temperature) set("M140 S", printer.bed_temperature);
    return text;
}

}  // namespace

PrintStatistics& PrintStatistics::operator+=(const PrintStatistics& other) {
    for (std::size_t k = 0; k < track_kinds; ++k) length[k] += other.length[k], volume[k] += other.volume[k];
    filament += other.filament;
    prime_surplus += other.prime_surplus;
    travel += other.travel;
    open_air += other.open_air;
    seconds += other.seconds;
    travels += other.travels;
    retractions += other.retractions;
    detours += other.detours;
    return *this;
}

LayerText gcode_layer(const LayerPaths& layer, const TravelMap& map, const Settings& settings,
                      const PrinterSettings& printer, const std::vector<ToolPath>& beside) {
    LayerText text = layer_at(1, layer, map, settings, printer, beside);
    if (layer.paths.empty()) return text;
    // The slower, the less of the time is acceleration, which no share of the speeds tells: a few rounds settle it.
    double share = 1;
    for (int round = 0; round < 8 && share > 0; ++round) {
        const double missing = printer.min_layer_time - text.statistics.seconds;
        if (missing <= 0.01 * printer.min_layer_time) break;
        share = share_that_takes(cruising_seconds(share, layer, beside, printer) + missing, layer, beside, printer);
        text = layer_at(share, layer, map, settings, printer, beside);
    }
    return text;
}

std::string gcode_joint(const LayerText* below, const LayerText& layer, const TravelMap& map, const Settings& settings,
                        const PrinterSettings& printer, PrintStatistics& statistics) {
    Writer writer(printer);
    const bool knows_start = below && below->last;
    bool retracted = !knows_start;
    Travel way;
    if (layer.first) {
        way = {{layer.first->at}, 0, false, 0};
        if (knows_start) way = map.travel(below->last->at, layer.first->at, longest_detour(printer));
    }
    if (knows_start && (!layer.first || must_retract(way, *below->last, *layer.first, printer)))
        writer.retract(), retracted = true;
    writer.text += layer.heading;
    if (layer.layer == 1 && printer.fan_percent > 0) {
        writer.text += "M106 S";
        append_integer(writer.text, std::lround(printer.fan_percent * 2.55));
        writer.text += " ; fan\n";
    }
    if (layer.layer == 1) writer.text += temperatures_of_the_rest(printer);
    writer.rise(settings.top_of(layer.layer), settings.height_of(layer.layer));
    if (layer.first) {
        // After the header the tool is T0; after a layer without tracks it may be either.
        const int tool = knows_start ? below->last->tool : 0;
        if (layer.first->tool != tool || (below && !knows_start && printer.support_extruder > 0))
            writer.change_tool(layer.first->tool);
        if (!knows_start || below->last->at != layer.first->at || below->last->tool != layer.first->tool)
            writer.travel(knows_start ? below->last->at : layer.first->at, way);
        if (retracted) writer.prime(layer.surplus);
    }
    writer.statistics.seconds = motion_seconds(writer.moves, printer.limits);
    statistics += writer.statistics;
    return std::move(writer.text);
}

std::string gcode_end_of_layers(const LayerText& top, const PrinterSettings& printer, PrintStatistics& statistics) {
    Writer writer(printer);
    if (top.last) writer.retract();
    writer.statistics.seconds = motion_seconds(writer.moves, printer.limits);
    statistics += writer.statistics;
    return std::move(writer.text);
}

}  // namespace ribvault
