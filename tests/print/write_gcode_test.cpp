#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <optional>
#include <sstream>

#include "print/geometry.hpp"
#include "print/random_forest.hpp"
#include "ribvault/error.hpp"
#include "ribvault/print/gcode_header.hpp"
#include "ribvault/print/order_paths.hpp"
#include "ribvault/print/support_paths.hpp"
#include "ribvault/print/write_gcode.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

constexpr Unit mm = units_per_mm;

/// What a reader that knows nothing of the writer makes of a text.
struct Parsed {
    struct Track {
        std::string type;
        Unit width;
        std::vector<Point> points;
        double filament;
        double feed_rate;
        double primed;  // pushed since the track before, retractions negative
    };
    std::vector<Track> tracks;
    std::vector<double> pushes;  // E without motion
    std::optional<Unit> z, height;
    std::optional<int> layer;
    int travels = 0;
    double last_feed_rate = 0;
};

Unit decimal(const std::string& text) {
    const std::size_t dot = text.find('.');
    std::string digits = text.substr(0, dot), fraction = dot == std::string::npos ? "" : text.substr(dot + 1);
    REQUIRE(fraction.size() <= 5);
    if (dot != std::string::npos) REQUIRE(fraction.back() != '0');
    fraction.resize(5, '0');
    return std::stoll(digits + fraction);
}

Parsed parse(const std::string& text) {
    Parsed result;
    std::istringstream lines(text);
    std::string line, type;
    Unit width = 0;
    Point at{};
    bool in_track = false, retracted = true;
    double primed = 0;
    while (std::getline(lines, line)) {
        const auto after = [&](const char* key) { return line.substr(std::string(key).size()); };
        if (line.rfind(";LAYER:", 0) == 0) result.layer = std::stoi(after(";LAYER:"));
        if (line.rfind(";Z:", 0) == 0) result.z = decimal(after(";Z:"));
        if (line.rfind(";HEIGHT:", 0) == 0) result.height = decimal(after(";HEIGHT:"));
        if (line.rfind(";TYPE:", 0) == 0) type = after(";TYPE:"), in_track = false;
        if (line.rfind(";WIDTH:", 0) == 0) width = decimal(after(";WIDTH:"));
        if (line.empty() || line[0] != 'G') continue;
        std::istringstream words(line);
        std::string word, command;
        words >> command;
        std::optional<Unit> x, y, e;
        while (words >> word && word[0] != ';') {
            if (word[0] == 'X') x = decimal(word.substr(1));
            if (word[0] == 'Y') y = decimal(word.substr(1));
            if (word[0] == 'E') e = decimal(word.substr(1));
            if (word[0] == 'F') result.last_feed_rate = std::stod(word.substr(1));
        }
        if (x && y && e) {
            if (!in_track) {
                result.tracks.push_back({type, width, {at}, 0, result.last_feed_rate, primed});
                primed = 0;
            }
            in_track = true;
            at = {*x, *y};
            result.tracks.back().points.push_back(at);
            result.tracks.back().filament += to_mm(*e);
        } else if (x && y) {
            REQUIRE(command == "G0");
            at = {*x, *y}, in_track = false, ++result.travels;
        } else if (e && *e > 0 && !retracted) {
            result.tracks.push_back({type, width, {at}, to_mm(*e), result.last_feed_rate, primed});
            primed = 0, in_track = false;
        } else if (e) {
            retracted = *e < 0;
            result.pushes.push_back(to_mm(*e)), primed += to_mm(*e), in_track = false;
        }
    }
    return result;
}

LayerPaths layer_of(std::vector<ToolPath> paths, int layer = 3) {
    LayerPaths all;
    all.layer = layer;
    all.paths = std::move(paths);
    return all;
}

ToolPath path_of(TrackKind kind, std::vector<Point> points, bool closed = false) {
    return {kind, 40000, closed, std::move(points)};
}

/// Retracts over more than 5 mm of open air.
PrinterSettings eager_printer() {
    PrinterSettings printer;
    printer.retract_over = 5;
    return printer;
}

/// A layer alone: joined to nothing below, retracted at its end, all travels over open air.
struct Whole {
    std::string text;
    PrintStatistics statistics;
};
Whole whole_layer(const LayerPaths& layer, const Settings& settings, const PrinterSettings& printer) {
    LayerText written = gcode_layer(layer, {}, settings, printer);
    const std::string joint = gcode_joint(nullptr, written, {}, settings, printer, written.statistics);
    const std::string end = gcode_end_of_layers(written, printer, written.statistics);
    return {joint + written.body + end, written.statistics};
}

void append_forest(const SupportForest& forest, LayerPaths& layer) {
    LayerPlan plan;
    append_support_paths(forest, {}, plan);
    for (ToolPath& path : order_paths(std::move(plan), {}).paths) layer.paths.push_back(std::move(path));
}

std::vector<Point> points_travelled(const ToolPath& path) {
    std::vector<Point> points = path.points;
    if (path.closed) points.push_back(path.points.front());
    return points;
}

}  // namespace

TEST_CASE("what is written reads back as the same paths on the lattice, and E is volume over filament area") {
    std::mt19937_64 random(5);
    for (int round = 0; round < 20; ++round) {
        LayerPaths layer =
            layer_of({path_of(TrackKind::outer_perimeter, {{-1, -20 * mm}, {20 * mm, 5}, {-123456, 99999}}, true),
                      path_of(TrackKind::inner_perimeter, {{7, 70}, {700, 7000}, {70001, 10}}, true),
                      path_of(TrackKind::cover, {{-5 * mm, 0}, {5 * mm + 10, 10 * mm + 10}})},
                     round);
        const Settings settings;
        const PrinterSettings printer;
        append_forest(random_forest(random, 5, 30, 1, 3 * mm, 0.1), layer);
        layer.paths.insert(layer.paths.begin() + 10, path_of(TrackKind::support, {{-7 * mm, 12345}}));
        // A path that begins where the one before has ended reads as its continuation.
        for (std::size_t i = layer.paths.size(); i-- > 1;) {
            ToolPath &path = layer.paths[i], &before = layer.paths[i - 1];
            if (before.kind != path.kind || before.points.size() < 2 || end_of(before) != path.points.front()) continue;
            before.points.insert(before.points.end(), path.points.begin() + 1, path.points.end());
            layer.paths.erase(layer.paths.begin() + static_cast<std::ptrdiff_t>(i));
        }
        const Whole written = whole_layer(layer, settings, printer);
        const Parsed read = parse(written.text);
        REQUIRE(read.tracks.size() == layer.paths.size());
        const double filament_per_mm = 0.4 * 0.2 / (std::numbers::pi / 4 * 1.75 * 1.75);
        double total = 0, expected = 0;
        for (std::size_t i = 0; i < layer.paths.size(); ++i) {
            const ToolPath& path = layer.paths[i];
            CHECK(read.tracks[i].points == points_travelled(path));
            CHECK(read.tracks[i].width == path.width);
            // A dot of width w is a disc; as much material as a track of length π w / 4. So is a stub shorter than w
            // / 4 that does not begin on another track.
            const bool dot = !path.on_track && 4 * length(path) < static_cast<double>(path.width);
            const double mm_of_track = dot ? std::numbers::pi * 0.1 : length(path) / mm;
            CHECK(std::abs(read.tracks[i].filament - mm_of_track * filament_per_mm) < 1.1e-5);
            total += read.tracks[i].filament;
            expected += mm_of_track * filament_per_mm;
        }
        CHECK(std::abs(total - expected) < 1e-5);
        CHECK(written.statistics.filament == Approx(expected));
        double volume = 0;
        for (double v : written.statistics.volume) volume += v;
        CHECK(volume == Approx(expected * std::numbers::pi / 4 * 1.75 * 1.75));
        CHECK(read.travels == written.statistics.travels);
        CHECK(read.layer == round);
    }
}

TEST_CASE("a stub on its own gets a dot's filament, one that is joined to a track its length's") {
    const auto filament_of_second = [](std::vector<ToolPath> paths) {
        return parse(whole_layer(layer_of(std::move(paths)), {}, {}).text).tracks.at(1).filament;
    };
    const ToolPath first = path_of(TrackKind::cover, {{0, 0}, {5 * mm, 0}}),
                   next = path_of(TrackKind::cover, {{6 * mm, 5000}, {9 * mm, 0}});
    const ToolPath alone = path_of(TrackKind::support, {{6 * mm, 0}, {6 * mm, 5000}}),
                   after = path_of(TrackKind::support, {{5 * mm, 0}, {5 * mm, 5000}});
    ToolPath on_track = alone;
    on_track.on_track = true;
    const double filament_per_mm = 0.4 * 0.2 / (std::numbers::pi / 4 * 1.75 * 1.75),
                 dot = std::numbers::pi * 0.1 * filament_per_mm, stub = 0.05 * filament_per_mm;
    CHECK(filament_of_second({first, alone, first}) == Approx(dot).margin(1e-5));
    CHECK(filament_of_second({first, alone, next}) == Approx(stub).margin(1e-5));
    CHECK(filament_of_second({first, after, first}) == Approx(stub).margin(1e-5));
    CHECK(filament_of_second({first, on_track, first}) == Approx(stub).margin(1e-5));
}

TEST_CASE("a stub that gets a dot's filament gets it at the flow of a track, and takes the time of it") {
    PrinterSettings printer;
    printer.min_layer_time = 0;
    const ToolPath first = path_of(TrackKind::cover, {{0, 0}, {5 * mm, 0}});
    for (const Unit stub : {500, 2000, 9999}) {
        const auto layer = [&](std::vector<Point> points) {
            return whole_layer(layer_of({first, path_of(TrackKind::support, std::move(points)), first}), {}, printer);
        };
        const Whole with_stub = layer({{6 * mm, 0}, {6 * mm, stub}}), with_dot = layer({{6 * mm, 0}});
        const Parsed::Track track = parse(with_stub.text).tracks.at(1);
        const double seconds = to_mm(stub) / (track.feed_rate / 60),
                     flow = track.filament * std::numbers::pi / 4 * 1.75 * 1.75 / seconds;
        CHECK(flow == Approx(60 * 0.4 * 0.2).epsilon(0.01));
        const double dot_flow = parse(with_dot.text).tracks.at(1).feed_rate / 60 * std::numbers::pi / 4 * 1.75 * 1.75;
        CHECK(dot_flow == Approx(60 * 0.4 * 0.2).epsilon(0.01));
        CHECK(with_stub.statistics.seconds == Approx(with_dot.statistics.seconds).margin(0.02));
    }
}

TEST_CASE("every move along a track pushes filament, and what one pushes too much the next ones do not") {
    Settings settings;
    settings.layer_height = settings.first_layer_height = 2000, settings.nozzle = 10000;
    PrinterSettings printer;
    printer.filament_diameter = 2.85;
    ToolPath fine = path_of(TrackKind::support, {{0, 0}});
    fine.width = 10000;
    for (int k = 1; k <= 20; ++k) fine.points.push_back({500 * k, 0});
    fine.points.push_back({5 * mm, 0});
    const std::string text = whole_layer(layer_of({fine}), settings, printer).text;
    CHECK(text.find(" E0\n") == std::string::npos);
    CHECK(text.find(" E0 ") == std::string::npos);
    const Parsed read = parse(text);
    REQUIRE(read.tracks.size() == 1);
    CHECK(read.tracks[0].points.size() == fine.points.size());
    CHECK(read.tracks[0].filament == Approx(5 * 0.1 * 0.02 / (std::numbers::pi / 4 * 2.85 * 2.85)).margin(1.1e-5));
}

TEST_CASE("types, widths, heights and statistics by kind") {
    Settings settings;
    settings.first_layer_height = 30000;
    const auto line = [](TrackKind kind, Unit y) { return path_of(kind, {{0, y}, {10 * mm, y}}); };
    std::vector<ToolPath> paths{path_of(TrackKind::outer_perimeter, {{0, 0}, {3 * mm, 0}, {3 * mm, 4 * mm}}, true),
                                line(TrackKind::inner_perimeter, mm), line(TrackKind::cover, 2 * mm),
                                line(TrackKind::support, 3 * mm)};
    const Whole first = whole_layer(layer_of(paths, 0), settings, {}),
                    sixth = whole_layer(layer_of(paths, 5), settings, {});
    const Parsed read = parse(sixth.text), bottom = parse(first.text);
    REQUIRE(read.tracks.size() == 4);
    CHECK(read.tracks[0].type == "External perimeter");
    CHECK(read.tracks[1].type == "Perimeter");
    CHECK(read.tracks[2].type == "Solid infill");
    CHECK(read.tracks[3].type == "Internal infill");
    CHECK(bottom.z == 30000);
    CHECK(bottom.height == 30000);
    CHECK(read.z == 130000);
    CHECK(read.height == 20000);
    CHECK(sixth.statistics.length[0] == Approx(12));
    CHECK(sixth.statistics.volume[3] == Approx(0.8));
    CHECK(first.statistics.volume[3] == Approx(1.2));
    PrintStatistics sum = first.statistics;
    sum += sixth.statistics;
    CHECK(sum.length[1] == Approx(20));
    CHECK(sum.filament == Approx(first.statistics.filament + sixth.statistics.filament));
    CHECK(sum.travels == first.statistics.travels + sixth.statistics.travels);
}

TEST_CASE("speeds: supports, the rest, the first layer") {
    const auto paths = [] {
        return std::vector<ToolPath>{path_of(TrackKind::cover, {{0, 0}, {mm, 0}}),
                                     path_of(TrackKind::support, {{0, mm}, {mm, mm}})};
    };
    PrinterSettings printer;
    printer.min_layer_time = 0;
    const Parsed upper = parse(whole_layer(layer_of(paths(), 1), {}, printer).text);
    REQUIRE(upper.tracks.size() == 2);
    CHECK(upper.tracks[0].feed_rate == 2400);
    CHECK(upper.tracks[1].feed_rate == 3600);
    const Parsed bottom = parse(whole_layer(layer_of(paths(), 0), {}, printer).text);
    CHECK(bottom.tracks[0].feed_rate == 1200);
    CHECK(bottom.tracks[1].feed_rate == 1200);
}

TEST_CASE("a layer that would set too little is printed slower, but not slower than it may be") {
    const auto square = [](Unit side) {
        ToolPath path = path_of(TrackKind::outer_perimeter, {{0, 0}, {side, 0}, {side, side}, {0, side}});
        path.closed = true;
        return std::vector<ToolPath>{path};
    };
    PrinterSettings plain, slow;
    plain.min_layer_time = 0, slow.min_layer_time = 5, slow.min_print_speed = 10;
    const auto at = [&](Unit side, const PrinterSettings& printer) {
        return gcode_layer(layer_of(square(side), 1), {}, {}, printer);
    };
    // 80 mm at 40 mm/s: 2 s; so in 5 s at about 16 mm/s.
    const LayerText fast = at(20 * mm, plain), slower = at(20 * mm, slow);
    CHECK(parse(fast.body).tracks[0].feed_rate == 2400);
    CHECK(parse(slower.body).tracks[0].feed_rate == Approx(960).margin(60));
    CHECK(slower.statistics.seconds == Approx(5).margin(0.05));
    CHECK(slower.statistics.filament == fast.statistics.filament);
    const LayerText tip = at(mm, slow);
    CHECK(parse(tip.body).tracks[0].feed_rate == 600);
    CHECK(tip.statistics.seconds < 1);
    CHECK(at(60 * mm, slow).body == at(60 * mm, plain).body);  // 6 s as it is
    slow.min_layer_time = 60, slow.min_print_speed = 0.5;
    CHECK(at(20 * mm, slow).statistics.seconds == Approx(60).epsilon(0.011));
    // Most of it is as slow as it may be before the rest is slow enough.
    slow.min_layer_time = 10, slow.min_print_speed = 15, slow.support_speed = 200;
    std::vector<ToolPath> mixed = square(20 * mm);
    mixed[0].points.resize(2), mixed[0].closed = false;
    for (Unit y = 1; y <= 14; ++y) mixed.push_back(path_of(TrackKind::support, {{0, y * 10000}, {10 * mm, y * 10000}}));
    CHECK(gcode_layer(layer_of(mixed, 1), {}, {}, slow).statistics.seconds == Approx(10).epsilon(0.011));
    slow.support_speed = PrinterSettings{}.support_speed;
    slow.min_layer_time = 5;
    slow.min_print_speed = 100;                                // nothing gets faster
    CHECK(at(20 * mm, slow).body == fast.body);
}

TEST_CASE("a first layer with a skirt takes the least time, the skirt's share of it included") {
    PrinterSettings printer;
    printer.min_layer_time = 60, printer.min_print_speed = 1, printer.first_layer_speed = 20;
    const LayerPaths layer = layer_of({path_of(TrackKind::cover, {{0, 0}, {20 * mm, 0}})}, 0);
    const std::vector<ToolPath> skirt{{TrackKind::skirt, 40000, false, {{0, mm}, {200 * mm, mm}}}};
    CHECK(gcode_layer(layer, {}, {}, printer, skirt).statistics.seconds == Approx(60).epsilon(0.011));
}

TEST_CASE("what was printed adds up, every number of it") {
    PrintStatistics one;
    double n = 0;
    for (std::size_t k = 0; k < track_kinds; ++k) one.length[k] = ++n, one.volume[k] = ++n;
    for (double* number : {&one.filament, &one.prime_surplus, &one.travel, &one.open_air, &one.seconds}) *number = ++n;
    one.travels = 101, one.retractions = 102, one.detours = 103;
    PrintStatistics sum = one;
    sum += one;
    for (std::size_t k = 0; k < track_kinds; ++k) {
        CHECK(sum.length[k] == 2 * one.length[k]);
        CHECK(sum.volume[k] == 2 * one.volume[k]);
    }
    CHECK(sum.filament == 2 * one.filament);
    CHECK(sum.prime_surplus == 2 * one.prime_surplus);
    CHECK(sum.travel == 2 * one.travel);
    CHECK(sum.open_air == 2 * one.open_air);
    CHECK(sum.seconds == 2 * one.seconds);
    CHECK(sum.travels == 202);
    CHECK(sum.retractions == 204);
    CHECK(sum.detours == 206);
}

TEST_CASE("a travel around a slit is a detour, one straight through the island is none") {
    // A U of 30 mm with a slit 10 mm wide, and tracks on both sides of the slit.
    const Region u{{{0, 0},
                    {30 * mm, 0},
                    {30 * mm, 30 * mm},
                    {20 * mm, 30 * mm},
                    {20 * mm, 10 * mm},
                    {10 * mm, 10 * mm},
                    {10 * mm, 30 * mm},
                    {0, 30 * mm}}};
    const auto statistics = [&](Unit y) {
        const Contour perimeter{{20000, 20000},
                                {30 * mm - 20000, 20000},
                                {30 * mm - 20000, 30 * mm - 20000},
                                {20 * mm + 20000, 30 * mm - 20000},
                                {20 * mm + 20000, 10 * mm - 20000},
                                {10 * mm - 20000, 10 * mm - 20000},
                                {10 * mm - 20000, 30 * mm - 20000},
                                {20000, 30 * mm - 20000}};
        const LayerPaths layer = layer_of({{TrackKind::outer_perimeter, 40000, true, perimeter},
                                           path_of(TrackKind::cover, {{mm, 2 * mm}, {9 * mm, y}}),
                                           path_of(TrackKind::cover, {{21 * mm, y}, {29 * mm, 2 * mm}})});
        PrinterSettings printer;
        printer.longest_detour = 10;
        return gcode_layer(layer, TravelMap(u, {}, layer), {}, printer).statistics;
    };
    const PrintStatistics around = statistics(13 * mm), straight = statistics(5 * mm);
    CHECK(around.travels == 2);
    CHECK(around.detours == 1);
    CHECK(straight.travels == 2);
    CHECK(straight.detours == 0);
}

TEST_CASE("a layer begins and ends retracted; only long travels retract between") {
    const auto two = [](Unit apart) {
        return layer_of(
            {path_of(TrackKind::cover, {{0, 0}, {mm, 0}}), path_of(TrackKind::cover, {{mm + apart, 0}, {19 * mm, 0}})});
    };
    const Whole near = whole_layer(two(500000), {}, eager_printer()),
                far = whole_layer(two(500001), {}, eager_printer());
    CHECK(parse(near.text).pushes == std::vector<double>{3, -3});
    CHECK(parse(far.text).pushes == std::vector<double>{3, -3, 3, -3});
    CHECK(near.statistics.retractions == 1);
    CHECK(far.statistics.retractions == 2);
    CHECK(near.statistics.travel == Approx(5));
    PrinterSettings direct;
    direct.retraction = 0;
    CHECK(parse(whole_layer(two(7 * mm), {}, direct).text).pushes.empty());
}

TEST_CASE("prime surplus before supports, but not near perimeters and not without a retraction") {
    const ToolPath perimeter =
        path_of(TrackKind::outer_perimeter, {{0, 0}, {20 * mm, 0}, {20 * mm, 20 * mm}, {0, 20 * mm}}, true);
    const auto pushes = [&](std::vector<Point> support, Point then) {
        return whole_layer(layer_of({perimeter, path_of(TrackKind::support, support),
                                     path_of(TrackKind::support, {then, then + Point{mm, mm}})}),
                           {}, eager_printer());
    };
    const Whole far = pushes({{10 * mm, 10 * mm}, {12 * mm, 10 * mm}}, {12 * mm, 11 * mm});
    CHECK(parse(far.text).pushes == std::vector<double>{3, -3, 3.15, -3});
    CHECK(far.statistics.prime_surplus == Approx(0.15));
    const Whole near = pushes({{19 * mm, 10 * mm}, {12 * mm, 10 * mm}}, {12 * mm, 11 * mm});
    CHECK(parse(near.text).pushes == std::vector<double>{3, -3, 3, -3});
    CHECK(near.statistics.prime_surplus == 0);
    const Whole edge = pushes({{19 * mm - 1, 10 * mm}, {12 * mm, 10 * mm}}, {9 * mm, mm + 1});
    CHECK(parse(edge.text).pushes == std::vector<double>{3, -3, 3.15, -3, 3.15, -3});
}

TEST_CASE("whether a surplus is due agrees with the plain distance to all perimeters") {
    std::mt19937_64 random(17);
    std::uniform_int_distribution<Unit> place(-15 * mm, 15 * mm);
    LayerPaths layer = layer_of({path_of(TrackKind::outer_perimeter, {{0, 0}}, true)});
    layer.paths[0].points.clear();
    for (int i = 0; i < 300; ++i)
        layer.paths[0].points.push_back({round_to_lattice(8e5 * std::cos(i * 0.021) + 2e5 * std::cos(i * 0.3)),
                                         round_to_lattice(8e5 * std::sin(i * 0.021) + 2e5 * std::sin(i * 0.3))});
    for (int i = 0; i < 500; ++i) {
        const Point start{place(random), place(random)};
        layer.paths.push_back(path_of(TrackKind::support, {start, start + Point{mm, 0}}));
    }
    const Parsed read = parse(whole_layer(layer, {}, eager_printer()).text);
    REQUIRE(read.tracks.size() == layer.paths.size());
    int with = 0, without = 0;
    for (std::size_t i = 1; i < layer.paths.size(); ++i) {
        double nearest = INFINITY;
        for (const Segment& s : segments(layer.paths[0]))
            nearest = std::min(nearest, distance(layer.paths[i].points[0], s));
        if (length(layer.paths[i].points[0] - end_of(layer.paths[i - 1])) <= 500000) continue;
        CHECK(read.tracks[i].primed == Approx(nearest <= mm ? 0 : 0.15).margin(1e-9));
        ++(nearest <= mm ? without : with);
    }
    CHECK(with > 50);
    CHECK(without > 50);
}

TEST_CASE("a layer's text does not depend on what was written before") {
    std::mt19937_64 random(23);
    LayerPaths a = layer_of({}, 1), b = layer_of({}, 2);
    append_forest(random_forest(random, 3, 20, 1000, mm, 0), a);
    append_forest(random_forest(random, 3, 20, 1000, mm, 0), b);
    const std::string alone = whole_layer(b, {}, {}).text;
    whole_layer(a, {}, {});
    CHECK(whole_layer(b, {}, {}).text == alone);
    CHECK(parse(alone).tracks.front().points.front() == b.paths.front().points.front());
}

TEST_CASE("an empty layer moves to its height and nothing else") {
    const Whole empty = whole_layer(layer_of({}, 4), {}, {});
    CHECK(empty.text == ";LAYER_CHANGE\n;LAYER:4\n;Z:1\n;HEIGHT:0.2\nG0 Z1 F9000\n");
    CHECK(empty.statistics.travels == 0);
    CHECK(empty.statistics.retractions == 0);
}

TEST_CASE("the header heats, homes, sets relative extrusion and leaves the filament retracted") {
    PrinterSettings printer;
    PrintFacts facts;
    facts.layers = 100;
    const std::string header = gcode_header({}, {}, printer, facts);
    for (const char* part : {"; generated by ribvault\n", ";LAYER_COUNT:100\n", "M190 S60", "M109 S205", "G28", "G90",
                             "M83", "; layer_height = 0.2\n"})
        CHECK(header.find(part) != std::string::npos);
    CHECK(parse(header).pushes == std::vector<double>{-3});
    printer.bed_temperature = 0;
    CHECK(gcode_header({}, {}, printer, facts).find("M190") == std::string::npos);
    CHECK(gcode_footer({}, printer, facts).find("M104 S0") != std::string::npos);
}

TEST_CASE("start G-code that heats itself leaves the supports' tool to the header, unless it names that tool") {
    Settings settings;
    settings.support = Support::both;
    PrinterSettings printer;
    printer.support_extruder = 1, printer.support_temperature = 225;
    printer.start_gcode = "M109 S205\n", printer.end_gcode = "M104 S0\n";
    const auto count = [](const std::string& text, const std::string& part) {
        int times = 0;
        for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++times;
        return times;
    };
    PrintFacts facts;
    facts.support_tool = true;
    const std::string header = gcode_header(settings, {}, printer, facts, "");
    CHECK(header.find("M109 T1 S225") > header.find("M109 S205"));
    CHECK(count(header, "M109 T1 S225") == 1);
    CHECK(count(header, "so do the supports") == 1);
    CHECK(count(gcode_footer(settings, printer, facts), "M104 T1 S0") == 1);
    // Nothing is printed with it.
    CHECK(count(gcode_header(settings, {}, printer, {}, ""), "T1") == 0);
    CHECK(count(gcode_footer(settings, printer, {}), "T1") == 0);
    printer.start_gcode += "M109 T{support_extruder} S{support_temperature}\n";
    const std::string own = gcode_header(settings, {}, printer, facts, "");
    CHECK(count(own, "M109 T1 S225") == 1);
    CHECK(count(own, "M104 T1") == 0);
    CHECK(count(own, "so do the supports") == 1);  // what the first change to it primes
    for (const char* other : {"M109 S205 T10\n", "START1 TEMP=205 M109\n", "M109 S205 ; T1 comes later\n"}) {
        printer.start_gcode = other;
        CHECK(count(gcode_header(settings, {}, printer, facts, ""), "M109 T1 S225") == 1);
    }
}

TEST_CASE("what start and end G-code only say heats nothing and turns nothing off") {
    PrinterSettings printer;
    for (const char* said : {"; printed at {nozzle_temperature} C, bed {bed_temperature}; M104 M140\nG28\n",
                             "G28 ; M109 S{nozzle_temperature} and M190 S{bed_temperature} come before\n",
                             "M117 {nozzle_temperature} C, bed {bed_temperature} C\n", "  M118 M104 M140\n",
                             "M291 P\"M109 to {nozzle_temperature}, M190 to {bed_temperature}\"\n",
                             "G28 ; {{nozzle_temperature}}\nSET A={{nozzle_temperature}} B={{bed_temperature}}\n"}) {
        printer.start_gcode = said;
        const std::string header = gcode_header({}, {}, printer, {});
        INFO(said);
        CHECK(header.find("\nM109 S205 ; wait") != std::string::npos);
        CHECK(header.find("\nM190 S60 ; wait") != std::string::npos);
        printer.end_gcode = "M117 M104 M84 M140\n; M104 M84 M140\n";
        const std::string footer = gcode_footer({}, printer, {});
        for (const char* off : {"\nM104 S0", "\nM140 S0", "\nM84 ;"}) CHECK(footer.find(off) != std::string::npos);
    }
    for (const char* heats : {"START_PRINT T={nozzle_temperature} BED={bed_temperature} ; go\n",
                              "M140 S{bed_temperature}\nM104 S{nozzle_temperature}\n"}) {
        printer.start_gcode = heats;
        const std::string header = gcode_header({}, {}, printer, {});
        CHECK(header.find("; wait") == std::string::npos);
    }
}

TEST_CASE("printer settings that cannot be are named") {
    const auto refused = [](auto change, const char* name) {
        PrinterSettings printer;
        change(printer);
        try {
            check_printer(printer);
            FAIL("accepted: " << name);
        } catch (const Error& error) {
            CHECK(error.kind() == ErrorKind::usage);
            CHECK_THAT(error.what(), Catch::Contains(name));
        }
    };
    refused([](PrinterSettings& p) { p.filament_diameter = 0; }, "filament diameter");
    refused([](PrinterSettings& p) { p.print_speed = -1; }, "print speed");
    refused([](PrinterSettings& p) { p.travel_speed = NAN; }, "travel speed");
    refused([](PrinterSettings& p) { p.retraction = -1; }, "retraction");
    refused([](PrinterSettings& p) { p.prime_surplus = INFINITY; }, "prime surplus");
}

TEST_CASE("a travel retracts for open air under it and for leaving the island, not between tracks that touch") {
    const auto ring = [](Unit lo, Unit hi, bool hole) {
        Contour c{{lo, lo}, {hi, lo}, {hi, hi}, {lo, hi}};
        if (hole) std::reverse(c.begin(), c.end());
        return c;
    };
    const Region outline{ring(0, 40 * mm, false)}, cavity{ring(10 * mm, 30 * mm, false)};
    const auto retractions = [&](Point from, Point to) {
        const LayerPaths layer = layer_of({path_of(TrackKind::support, {from - Point{0, mm}, from}),
                                           path_of(TrackKind::support, {to, to + Point{0, mm}})});
        return gcode_layer(layer, TravelMap(outline, cavity, layer), {}, eager_printer()).statistics.retractions;
    };
    CHECK(retractions({2 * mm, 2 * mm}, {2 * mm, 35 * mm}) == 0);           // over the shell, however far
    CHECK(retractions({9 * mm, 20 * mm}, {15 * mm, 20 * mm}) == 0);         // 5 mm of open air
    CHECK(retractions({9 * mm, 20 * mm}, {15 * mm + 100, 20 * mm}) == 1);   // more
    CHECK(retractions({2 * mm, 2 * mm}, {45 * mm, 2 * mm}) == 1);           // out of the slice
    CHECK(retractions({9 * mm, 20 * mm}, {31 * mm, 20 * mm}) == 1);
    PrinterSettings eager;
    eager.retract_over = 0;
    const auto touching = [&](Unit apart) {
        const LayerPaths layer =
            layer_of({path_of(TrackKind::support, {{20 * mm, 15 * mm}, {20 * mm, 20 * mm}}),
                      path_of(TrackKind::support, {{20 * mm + apart, 20 * mm}, {25 * mm, 20 * mm}})});
        return gcode_layer(layer, TravelMap(outline, cavity, layer), {}, eager).statistics.retractions;
    };
    CHECK(touching(40000) == 0);
    CHECK(touching(40001) == 1);
}

TEST_CASE("layers are joined without a retraction where the way is short or inside, retracted otherwise") {
    const Region outline{{{0, 0}, {40 * mm, 0}, {40 * mm, 40 * mm}, {0, 40 * mm}}},
        cavity{{{mm, mm}, {39 * mm, mm}, {39 * mm, 39 * mm}, {mm, 39 * mm}}};
    const auto layer_at = [&](int number, Point from, Point to) {
        return layer_of({path_of(TrackKind::support, {from, to})}, number);
    };
    const LayerPaths below = layer_at(4, {5 * mm, 5 * mm}, {20 * mm, 20 * mm});
    const auto joint = [&](Point start) {
        const LayerPaths above = layer_at(5, start, {5 * mm, 5 * mm});
        const TravelMap map(outline, cavity, above);
        const LayerText lower = gcode_layer(below, TravelMap(outline, cavity, below), {}, eager_printer()),
                        upper = gcode_layer(above, map, {}, eager_printer());
        PrintStatistics sum;
        const std::string text = gcode_joint(&lower, upper, map, {}, eager_printer(), sum);
        CHECK(sum.travels == 1);
        CHECK(sum.travel == Approx(length(start - Point{20 * mm, 20 * mm}) / mm));
        CHECK(parse(text).travels == 1);
        return std::pair(sum.retractions, parse(text).pushes);
    };
    CHECK(joint({20 * mm, 23 * mm}) == std::pair(0, std::vector<double>{}));
    CHECK(joint({20 * mm, 30 * mm}) == std::pair(1, std::vector<double>{-3, 3.15}));
    CHECK(joint({45 * mm, 20 * mm}).first == 1);
}

TEST_CASE("tracks that touch at their ends: no retraction even where the way leaves the island, none of no length") {
    // Two islands 0.1 mm apart, a track at the edge of each.
    const Region outline{{{0, 0}, {10 * mm, 0}, {10 * mm, 10 * mm}, {0, 10 * mm}},
                         {{10 * mm + 10000, 0}, {20 * mm, 0}, {20 * mm, 10 * mm}, {10 * mm + 10000, 10 * mm}}};
    const auto ends = [&](Unit apart, int number) {
        return layer_of({path_of(TrackKind::cover, {{5 * mm, 5 * mm}, {10 * mm - 10000, 5 * mm}}),
                         path_of(TrackKind::cover, {{10 * mm - 10000 + apart, 5 * mm}, {15 * mm, 5 * mm}})},
                        number);
    };
    const auto retractions = [&](Unit apart) {
        const LayerPaths layer = ends(apart, 3);
        const TravelMap map(outline, {}, layer);
        CHECK(map.travel({10 * mm - 10000, 5 * mm}, {10 * mm - 10000 + apart, 5 * mm}, 0).leaves_island);
        return gcode_layer(layer, map, {}, {}).statistics.retractions;
    };
    CHECK(retractions(40000) == 0);
    CHECK(retractions(40001) == 1);

    LayerPaths above = ends(40000, 4);
    std::reverse(above.paths[1].points.begin(), above.paths[1].points.end());
    std::swap(above.paths[0], above.paths[1]);
    const LayerPaths below = ends(40000, 3);
    const TravelMap map(outline, {}, above);
    const LayerText lower = gcode_layer(below, TravelMap(outline, {}, below), {}, {}),
                    upper = gcode_layer(above, map, {}, {});
    PrintStatistics sum;
    const std::string text = gcode_joint(&lower, upper, map, {}, {}, sum);
    CHECK(sum.travels == 0);
    CHECK(sum.retractions == 0);
    CHECK(text.find(" X") == std::string::npos);
}

TEST_CASE("skirt and brim are printed before the first layer's tracks and nowhere inside them") {
    const Region outline{{{0, 0}, {10 * mm, 0}, {10 * mm, 10 * mm}, {0, 10 * mm}}};
    const LayerPaths layer =
        layer_of({path_of(TrackKind::outer_perimeter,
                          {{20000, 20000}, {980000, 20000}, {980000, 980000}, {20000, 980000}}, true)},
                 0);
    const std::vector<ToolPath> beside{
        {TrackKind::skirt, 40000, true, {{-mm, -mm}, {11 * mm, -mm}, {11 * mm, 11 * mm}, {-mm, 11 * mm}}}};
    const LayerText text = gcode_layer(layer, TravelMap(outline, {}, layer), {}, {}, beside);
    CHECK(text.body.find(";TYPE:Skirt/Brim") == 0);
    CHECK(text.body.find(";TYPE:External perimeter") != std::string::npos);
    CHECK(text.statistics.retractions == 1);
    CHECK(text.statistics.length[static_cast<std::size_t>(TrackKind::skirt)] == Approx(48));
}

TEST_CASE("external supports are printed by their own tool, retracted and primed at every change") {
    PrinterSettings printer;
    printer.support_extruder = 2;
    const LayerPaths layer = layer_of({path_of(TrackKind::outer_perimeter, {{0, 0}, {10 * mm, 0}}),
                                       path_of(TrackKind::external_support, {{10 * mm, 0}, {20 * mm, 0}}),
                                       path_of(TrackKind::external_support, {{20 * mm, 0}, {20 * mm, 5 * mm}})});
    const TravelMap map({}, {}, layer);
    const auto text_of = [&](int number) {
        LayerPaths own = layer;
        own.layer = number;
        return gcode_layer(own, map, {}, printer);
    };
    const auto changes = [](const std::string& text) {
        std::vector<std::string> lines;
        std::istringstream all(text);
        for (std::string line, before; std::getline(all, line); before = line)
            if (line[0] == 'T') lines.push_back(before.substr(0, 5) + " " + line);
        return lines;
    };
    const LayerText lower = text_of(3), upper = text_of(4);
    CHECK(changes(lower.body) == std::vector<std::string>{"G1 E- T2"});
    CHECK(lower.statistics.retractions == 1);
    PrintStatistics statistics;
    const std::string joint = gcode_joint(&lower, upper, map, {}, printer, statistics);
    CHECK(joint.find("\nT0\n") != std::string::npos);
    CHECK(statistics.retractions == 1);
    CHECK(gcode_joint(nullptr, lower, map, {}, printer, statistics).find("\nT") ==
          std::string::npos);  // the header leaves T0
    // A layer that begins with supports goes on with the tool with which the one below has ended.
    LayerPaths turned = layer;
    turned.layer = 5;
    std::rotate(turned.paths.begin(), turned.paths.begin() + 1, turned.paths.end());
    const LayerText supports_first = gcode_layer(turned, map, {}, printer);
    CHECK(changes(supports_first.body) == std::vector<std::string>{"G1 E- T0"});
    CHECK(supports_first.statistics.retractions == 1);
    CHECK(gcode_joint(&upper, supports_first, map, {}, printer, statistics).find("\nT") == std::string::npos);
    CHECK(gcode_joint(nullptr, supports_first, map, {}, printer, statistics).find("\nT2\n") != std::string::npos);
    LayerText empty;
    CHECK(gcode_joint(&empty, upper, map, {}, printer, statistics).find("\nT0\n") != std::string::npos);
    // The first use of a tool primes what the header has retracted.
    PrintFacts used;
    used.support_tool = true;
    CHECK(changes(gcode_header({}, {}, printer, used, "")) == std::vector<std::string>{"M83 ; T2", "G1 E- T0"});
    CHECK(changes(gcode_header({}, {}, printer, {}, "")).empty());
    printer.support_extruder = 0;
    CHECK(changes(text_of(3).body).empty());
    CHECK(changes(gcode_header({}, {}, printer, used, "")).empty());
}

TEST_CASE("the first layer's temperatures are those of the header, the others come with the second layer") {
    PrinterSettings printer;
    printer.first_layer_temperature = 215, printer.first_layer_bed_temperature = 65;
    const std::string header = gcode_header({}, {}, printer, {});
    CHECK(header.find("M109 S215") != std::string::npos);
    CHECK(header.find("M190 S65") != std::string::npos);
    const auto joint = [&](int layer) {
        const LayerText text = gcode_layer(layer_of({}, layer), {}, {}, printer);
        PrintStatistics statistics;
        return gcode_joint(nullptr, text, {}, {}, printer, statistics);
    };
    CHECK(joint(1).find("M104 S205 ;") != std::string::npos);
    CHECK(joint(1).find("M140 S60 ;") != std::string::npos);
    for (const int layer : {0, 2}) CHECK(joint(layer).find("M1") == std::string::npos);
    printer.support_extruder = 1;
    CHECK(joint(1).find("M104 T0 S205 ;") != std::string::npos);  // whichever tool is at work
    printer.first_layer_temperature = 205, printer.first_layer_bed_temperature = 0;
    CHECK(joint(1).find("M104") == std::string::npos);
    CHECK(joint(1).find("M140") == std::string::npos);
    printer.start_gcode = "START T={first_layer_temperature} B={first_layer_bed_temperature}\n";
    CHECK(gcode_header({}, {}, printer, {}).find("\nSTART T=205 B=60\n") != std::string::npos);
    CHECK(gcode_header({}, {}, printer, {}).find("M109") == std::string::npos);
}

TEST_CASE("after the print the nozzle rises no higher than the printer is, and parks on its bed") {
    PrinterSettings printer;
    PrintFacts facts;
    facts.height_mm = 100;
    CHECK(gcode_footer({}, printer, facts).find("\nG90\nG0 Z105 F600") != std::string::npos);
    facts.height_mm = 248;
    CHECK(gcode_footer({}, printer, facts).find("\nG90\nG0 Z250 F600") != std::string::npos);
    printer.end_gcode = "G0 X{bed_min_x} Y{bed_max_y}\n";
    CHECK(gcode_footer({}, printer, facts).find("\nG0 X0 Y250\n") != std::string::npos);
    printer.bed_corner = {3, -5};
    CHECK(gcode_footer({}, printer, facts).find("\nG0 X3 Y245\n") != std::string::npos);
    printer.bed_corner = {}, printer.origin_at_centre = true;
    CHECK(gcode_footer({}, printer, facts).find("\nG0 X-125 Y125\n") != std::string::npos);
}
