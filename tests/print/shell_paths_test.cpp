#include <catch2/catch.hpp>
#include <numbers>
#include <random>

#include "print/geometry.hpp"
#include "ribvault/print/cover_lines.hpp"
#include "ribvault/print/order_paths.hpp"
#include "ribvault/print/shell_paths.hpp"
#include "ribvault/slice/cavity.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

constexpr Unit mm = units_per_mm;
constexpr double clipper = 2;  // lattice units

Contour rectangle(Unit x0, Unit y0, Unit x1, Unit y1, bool hole = false) {
    Contour c{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
    if (hole) std::reverse(c.begin(), c.end());
    return c;
}

/// A closed curve around the centre, its radius between lo and hi.
Contour star(std::mt19937_64& random, Point centre, int corners, double lo, double hi, bool hole = false) {
    std::uniform_real_distribution<double> radius(lo, hi);
    Contour c;
    for (int i = 0; i < corners; ++i) {
        const double angle = 2 * std::numbers::pi * i / corners, r = radius(random) * mm;
        c.push_back(
            {centre.x + round_to_lattice(r * std::cos(angle)), centre.y + round_to_lattice(r * std::sin(angle))});
    }
    if (hole) std::reverse(c.begin(), c.end());
    return c;
}

Slice slice_of(Region outline, int layer = 0) {
    Slice slice;
    slice.layer = layer;
    slice.rounded = std::move(outline);
    return slice;
}

LayerPaths shell_paths(const Region& outline, const Region& cavity, const Settings& settings, int layer = 0,
                       TrackSettings tracks = {}) {
    LayerPlan plan;
    plan.layer = layer;
    append_shell_paths(slice_of(outline, layer), cavity, settings, tracks, plan);
    return order_paths(std::move(plan), outline);
}

/// Every postcondition of append_shell_paths.
void check_shell(const Region& outline, const Region& cavity, const Settings& settings, const LayerPaths& layer,
                 Unit resolution) {
    const double rounding = clipper + static_cast<double>(resolution);
    const auto d = static_cast<double>(settings.nozzle);
    const std::vector<Segment> border = segments(outline), inner = segments(cavity);
    bool covers_began = false;
    for (const ToolPath& path : layer.paths) {
        if (path.kind == TrackKind::thin_wall) continue;
        REQUIRE(path.points.size() >= 2);
        REQUIRE(path.width == settings.nozzle);
        const std::vector<Segment> track = segments(path);
        const double to_border = distance(track, border);
        for (Point p : path.points) CHECK(winding_number(outline, p) == 1);
        if (path.kind == TrackKind::cover) {
            covers_began = true;
            CHECK_FALSE(path.closed);
            CHECK(to_border >= (settings.perimeters + 0.5) * d - rounding);
            if (!cavity.empty()) {
                CHECK(distance(track, inner) >= d / 2 - rounding);
                for (Point p : path.points) CHECK(winding_number(cavity, p) == 0);
            }
        } else {
            CHECK_FALSE(covers_began);
            CHECK(path.closed);
            CHECK(path.kind == (to_border < d - rounding ? TrackKind::outer_perimeter : TrackKind::inner_perimeter));
            const double j = std::round(to_border / d - 0.5);
            CHECK(std::abs(to_border - (j + 0.5) * d) <= rounding);
            for (Point p : path.points) {
                double own = INFINITY;
                for (const Segment& s : border) own = std::min(own, distance(p, s));
                CHECK(own <= 2 * (j + 0.5) * d + rounding);
            }
        }
    }
}

}  // namespace

TEST_CASE("perimeters of a square: centre lines at (j + 1/2) d, outermost first, rear start") {
    Settings settings;
    settings.perimeters = 3;
    const Region outline{rectangle(0, 0, 20 * mm, 20 * mm)};
    const LayerPaths layer = shell_paths(outline, {rectangle(120000, 120000, 1880000, 1880000)}, settings);
    REQUIRE(layer.paths.size() == 3);
    for (int j = 0; j < 3; ++j) {
        const Unit in = 20000 + j * 40000;
        const ToolPath& path = layer.paths[static_cast<std::size_t>(j)];
        CHECK(path.kind == (j == 0 ? TrackKind::outer_perimeter : TrackKind::inner_perimeter));
        CHECK(path.points == Contour{{in, 20 * mm - in}, {in, in}, {20 * mm - in, in}, {20 * mm - in, 20 * mm - in}});
        CHECK(length(path) == 4 * (20 * mm - 2.0 * static_cast<double>(in)));
    }
}

TEST_CASE("random slices with holes and cavities: tracks keep their distances") {
    std::mt19937_64 random(3);
    for (int round = 0; round < 40; ++round) {
        Settings settings;
        settings.perimeters = 1 + round % 3;
        const int corners = 12 + 3 * round;
        Region outline{star(random, {0, 0}, corners, 8, 10), star(random, {2 * mm, mm}, 9 + round, 1, 2, true)};
        Region cavity;
        if (round % 4 != 0) cavity.push_back(star(random, {-4 * mm, 0}, 40, 1, 2.5));
        TrackSettings tracks;
        if (round % 2 == 0) tracks.resolution = 0;
        const LayerPaths layer = shell_paths(outline, cavity, settings, round, tracks);
        check_shell(outline, cavity, settings, layer, tracks.resolution);
        CHECK(std::any_of(layer.paths.begin(), layer.paths.end(),
                          [](const ToolPath& p) { return p.kind == TrackKind::cover; }));
        const LayerPaths again = shell_paths(outline, cavity, settings, round, tracks);
        CHECK(std::equal(layer.paths.begin(), layer.paths.end(), again.paths.begin(), again.paths.end(),
                         [](const ToolPath& a, const ToolPath& b) { return a.points == b.points; }));
    }
}

TEST_CASE("a full square is covered by one zigzag, d apart, at 45 degrees on even layers and 135 on odd") {
    const Region outline{rectangle(0, 0, 20 * mm, 20 * mm)};
    const Settings settings;
    for (int number : {0, 1, 2, 7}) {
        const LayerPaths layer = shell_paths(outline, {}, settings, number);
        check_shell(outline, {}, settings, layer, TrackSettings().resolution);
        REQUIRE(layer.paths.size() == 2);
        const ToolPath& cover = layer.paths[1];
        double along = 0;
        std::vector<Unit> levels;
        for (const Segment& s : segments(cover)) {
            const Point step = s.b - s.a;
            if (number % 2 == 0 ? step.x != step.y : step.x != -step.y) continue;
            along += length(step);
            levels.push_back(number % 2 == 0 ? s.a.y - s.a.x : s.a.y + s.a.x);
        }
        const double filled = along * static_cast<double>(settings.nozzle) / (19.2 * mm * 19.2 * mm);
        CHECK(filled > 0.94);
        CHECK(filled < 1);
        std::sort(levels.begin(), levels.end());
        for (std::size_t i = 1; i < levels.size(); ++i)
            CHECK(std::abs(static_cast<double>(levels[i] - levels[i - 1]) - 40000 * std::numbers::sqrt2) <= 1);
    }
}

TEST_CASE("every point of a covered square's inside is within d of a track's centre line") {
    const Region outline{rectangle(0, 0, 5 * mm, 7 * mm)};
    const LayerPaths layer = shell_paths(outline, {}, Settings{});
    std::vector<Segment> tracks;
    for (const ToolPath& path : layer.paths)
        for (const Segment& s : segments(path)) tracks.push_back(s);
    double farthest = 0;
    for (Unit x = 0; x <= 5 * mm; x += 7000)
        for (Unit y = 0; y <= 7 * mm; y += 7000) {
            double nearest = INFINITY;
            for (const Segment& s : tracks) nearest = std::min(nearest, distance(Point{x, y}, s));
            farthest = std::max(farthest, nearest);
        }
    CHECK(farthest < 40000);
}

TEST_CASE("where the cavity reaches the innermost perimeter there is no cover") {
    const Region outline{rectangle(0, 0, 20 * mm, 20 * mm)};
    const LayerPaths layer = shell_paths(outline, {rectangle(40003, 40003, 1959997, 1959997)}, Settings{});
    CHECK(layer.paths.size() == 1);
}

TEST_CASE("covers around a cavity link along curved borders") {
    Region outline{{}}, cavity{{}};
    for (int i = 0; i < 360; ++i) {
        const double a = i * std::numbers::pi / 180;
        outline[0].push_back({round_to_lattice(10 * mm * std::cos(a)), round_to_lattice(10 * mm * std::sin(a))});
        cavity[0].push_back({round_to_lattice(5 * mm * std::cos(a)), round_to_lattice(5 * mm * std::sin(a))});
    }
    const LayerPaths layer = shell_paths(outline, cavity, Settings{});
    check_shell(outline, cavity, Settings{}, layer, TrackSettings().resolution);
    // 72 pieces of lines; only where the border runs nearly along them is the way to the next longer than 2 d.
    CHECK(std::count_if(layer.paths.begin(), layer.paths.end(),
                        [](const ToolPath& path) { return path.kind == TrackKind::cover; }) < 20);
}

TEST_CASE("places narrower than one track get a track of their width, those just wider a perimeter, then a cover") {
    const auto layer = [](Unit width, bool thin = true) {
        TrackSettings tracks;
        tracks.thin_walls = thin, tracks.fill_gaps = GapFill::none;
        return shell_paths({rectangle(0, 0, 10 * mm, width)}, {}, Settings{}, 0, tracks);
    };
    const LayerPaths wall = layer(32000);
    REQUIRE(wall.paths.size() == 1);
    CHECK(wall.paths[0].kind == TrackKind::thin_wall);
    CHECK(wall.paths[0].width == 32000);
    CHECK(wall.thin_places == 0);
    CHECK(length(wall.paths[0]) > 9 * mm);
    for (Point p : wall.paths[0].points) CHECK(std::abs(p.y - 16000) <= 1);
    for (const LayerPaths& without : {layer(19000), layer(32000, false)}) {
        CHECK(without.paths.empty());
        CHECK(without.thin_places == 1);
        CHECK(without.thin_area > 0.9 * 19000 * 10 * mm);
    }
    // Up to 3/2 tracks wide there is no room for two of them side by side.
    for (const Unit width : {Unit{41000}, Unit{50000}, Unit{59000}}) {
        const LayerPaths one = layer(width);
        REQUIRE(one.paths.size() == 1);
        CHECK(one.paths[0].kind == TrackKind::thin_wall);
        CHECK(one.paths[0].width <= width);
        CHECK(one.paths[0].width > width - 2000 - 10);
        CHECK(one.thin_places == 0);
    }
    CHECK(layer(41000, false).paths[0].kind == TrackKind::outer_perimeter);
    CHECK(layer(61000).paths.size() == 1);
    CHECK(layer(61000).paths[0].kind == TrackKind::outer_perimeter);
    CHECK(layer(61000).thin_places == 0);
    CHECK(layer(118000).paths.size() == 1);
    CHECK(layer(125000).paths.size() >= 2);
    CHECK(shell_paths({}, {}, Settings{}).paths.empty());
}

TEST_CASE("a wedge gets a thin wall whose width follows it, inside the slice, up to the perimeter") {
    const Region wedge{{{0, 0}, {20 * mm, -60000}, {20 * mm, 60000}}};
    const LayerPaths layer = shell_paths(wedge, {}, Settings{});
    Unit widest = 0, narrowest = mm;
    double from = 20.0 * mm, to = 0;
    for (const ToolPath& path : layer.paths) {
        if (path.kind != TrackKind::thin_wall) continue;
        widest = std::max(widest, path.width), narrowest = std::min(narrowest, path.width);
        CHECK(distance(segments(path), segments(wedge)) >= static_cast<double>(path.width) / 2 - 2);
        for (Point p : path.points)
            from = std::min(from, static_cast<double>(p.x)), to = std::max(to, static_cast<double>(p.x));
    }
    CHECK(narrowest == 20000);
    CHECK(widest >= 34000);
    CHECK(from < 3.5 * mm);  // the wedge is half a track wide at 3.33 mm
    double perimeter = 20.0 * mm;
    for (const ToolPath& path : layer.paths)
        if (path.kind == TrackKind::outer_perimeter)
            for (Point p : path.points) perimeter = std::min(perimeter, static_cast<double>(p.x));
    CHECK(perimeter - to < 40000);
}

TEST_CASE("the printed shell fills slices that a thin wall crosses: what has no material is reported") {
    // Two blocks joined by a wall of 0.3 mm.
    const Region outline{{{0, 0},
                          {5 * mm, 0},
                          {5 * mm, 2 * mm},
                          {12 * mm, 2 * mm},
                          {12 * mm, 0},
                          {17 * mm, 0},
                          {17 * mm, 5 * mm},
                          {12 * mm, 5 * mm},
                          {12 * mm, 230000},
                          {5 * mm, 230000},
                          {5 * mm, 5 * mm},
                          {0, 5 * mm}}};
    const LayerPaths layer = shell_paths(outline, {}, Settings{});
    double wall = 0;
    for (const ToolPath& path : layer.paths)
        if (path.kind == TrackKind::thin_wall) {
            wall += length(path);
            CHECK(path.width == 30000);
        }
    CHECK(wall > 6.5 * mm);
    CHECK(wall < 7.5 * mm);
    CHECK(layer.thin_places == 0);
}

namespace {

/// Two blocks, 6 mm high, and a neck of this width and length between them, which leaves the left one upwards with
/// `rise`.
Region blocks_with_neck(Unit width, Unit along, Unit rise = 0) {
    const Unit x0 = 5 * mm, x1 = x0 + along, low = 150000, high = low + width;
    return {{{0, 0},
             {x0, 0},
             {x0, low},
             {x1, low + rise},
             {x1, 0},
             {x1 + 5 * mm, 0},
             {x1 + 5 * mm, 6 * mm},
             {x1, 6 * mm},
             {x1, high + rise},
             {x0, high},
             {x0, 6 * mm},
             {0, 6 * mm}}};
}

}  // namespace

TEST_CASE("a thin wall overlaps the perimeters it grows out of by a quarter of a track at least, inside the slice") {
    for (const Unit width : {Unit{25000}, Unit{30000}, Unit{39000}, Unit{44000}, Unit{55000}})
        for (const Unit rise : {Unit{0}, Unit{200000}}) {
            INFO(width << " wide, rises by " << rise);
            const Region outline = blocks_with_neck(width, 4 * mm, rise);
            const LayerPaths layer = shell_paths(outline, {}, Settings{});
            std::vector<Segment> perimeters;
            for (const ToolPath& path : layer.paths)
                if (path.kind == TrackKind::outer_perimeter) append_segments(path, perimeters);
            int walls = 0;
            for (const ToolPath& path : layer.paths) {
                if (path.kind != TrackKind::thin_wall || length(path) < mm) continue;
                ++walls;
                const double half = static_cast<double>(path.width) / 2;
                CHECK(distance(segments(path), segments(outline)) >= half - 2);
                for (Point end : {path.points.front(), path.points.back()}) {
                    const double far = distance({{end, end}}, perimeters);
                    CHECK(far <= 20500);  // the perimeter's edge, to a hundredth of a track
                    CHECK(half + 20000 - far > 9500);
                }
            }
            CHECK(walls == 1);
        }
}

TEST_CASE("where a thin wall ends at the border it stays in the slice") {
    // A fin of 0.3 mm on a block.
    const Region outline{{{0, 0},
                          {5 * mm, 0},
                          {5 * mm, 2 * mm},
                          {9 * mm, 2 * mm},
                          {9 * mm, 230000},
                          {5 * mm, 230000},
                          {5 * mm, 5 * mm},
                          {0, 5 * mm}}};
    for (const ToolPath& path : shell_paths(outline, {}, Settings{}).paths) {
        if (path.kind != TrackKind::thin_wall) continue;
        CHECK(distance(segments(path), segments(outline)) >= 15000 - 2);
        const auto [from, to] = std::minmax(path.points.front().x, path.points.back().x);
        CHECK(from == 5 * mm);
        CHECK(std::abs(to - (9 * mm - 15000)) <= 2);
    }
}

namespace {

double material(const LayerPaths& layer) {
    double sum = 0;
    for (const ToolPath& path : layer.paths)
        sum += path.points.size() == 1 ? M_PI / 4 * static_cast<double>(path.width * path.width)
                                       : length(path) * static_cast<double>(path.width);
    return sum;
}

}  // namespace

TEST_CASE("a wall without room for two tracks gets one, however it lies: its perimeters leave it") {
    // Two blocks of 4 mm joined by a wall of 12 mm; the wedge is as wide as 3/2 tracks at 8.6 mm.
    const Unit half = 24500;
    const Contour joined{
        {0, 0},           {4 * mm, 0},       {4 * mm, 2 * mm - half}, {16 * mm, 2 * mm - half}, {16 * mm, 0},
        {20 * mm, 0},     {20 * mm, 4 * mm}, {16 * mm, 4 * mm},       {16 * mm, 2 * mm + half}, {4 * mm, 2 * mm + half},
        {4 * mm, 4 * mm}, {0, 4 * mm}};
    const Contour wedge{{0, 0}, {14 * mm, -48891}, {14 * mm, 48891}};
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> any(0, 2 * std::numbers::pi);
    for (int round = 0; round < 60; ++round) {
        const double angle = any(random);
        Contour outline;
        for (Point p : round % 3 != 0 ? joined : wedge) {
            const auto x = static_cast<double>(p.x), y = static_cast<double>(p.y);
            outline.push_back({round_to_lattice(x * std::cos(angle) - y * std::sin(angle)),
                               round_to_lattice(x * std::sin(angle) + y * std::cos(angle))});
        }
        INFO(round << ", turned by " << angle);
        TrackSettings tracks;
        tracks.fill_gaps = GapFill::all;
        const double solid = signed_area({outline}), printed = material(shell_paths({outline}, {}, {}, 0, tracks));
        CHECK(printed < 1.01 * solid);
        CHECK(printed > 0.9 * solid);
    }
}

TEST_CASE("short stubs get one track like long ones, wedges keep the perimeter around their tip") {
    const auto block_with = [](const Contour& tip) {  // on its upper side, from right to left
        Contour block{{0, 0}, {4 * mm, 0}, {4 * mm, 3 * mm}};
        for (Point p : tip) block.push_back(p + Point{2 * mm, 3 * mm});
        block.push_back({0, 3 * mm});
        return Region{block};
    };
    const auto tip_of = [](const LayerPaths& layer) {  // of the outer perimeter
        Unit top = 0;
        for (const ToolPath& path : layer.paths)
            if (path.kind == TrackKind::outer_perimeter)
                for (Point p : path.points) top = std::max(top, p.y);
        return top;
    };
    const LayerPaths block = shell_paths(block_with({}), {}, {});
    for (const Unit wide : {Unit{42000}, Unit{50000}, Unit{55000}})
        for (const Unit high : {8 * mm / 10, mm, 11 * mm / 10}) {
            INFO(wide << " units wide, " << high << " high");
            const Contour stub{{wide / 2, 0}, {wide / 2, high}, {-wide / 2, high}, {-wide / 2, 0}};
            const LayerPaths layer = shell_paths(block_with(stub), {}, {});
            CHECK(std::abs(static_cast<double>(tip_of(layer) - tip_of(block))) < clipper + 10);
            const double area = static_cast<double>(wide * high), printed = material(layer) - material(block);
            CHECK(printed < 1.05 * area);
            CHECK(printed > 0.6 * area);
            CHECK(layer.thin_places == 0);
        }
    for (const Unit high : {Unit{120000}, 2 * mm, 3 * mm}) {
        const LayerPaths layer = shell_paths(block_with({{30000, 0}, {0, high}, {-30000, 0}}), {}, {});
        INFO("wedge, " << high << " units high");
        CHECK(tip_of(layer) > tip_of(block) + high / 5);
    }
}

TEST_CASE("a neck as short as it is wide joins what it lies between, with the material it has room for") {
    for (const Unit width : {Unit{30000}, Unit{36000}, Unit{42000}, Unit{50000}, Unit{58000}})
        for (const Unit along : {Unit{80000}, Unit{90000}, Unit{110000}}) {
            INFO(width << " wide, " << along << " long");
            const LayerPaths layer = shell_paths(blocks_with_neck(width, along), {}, Settings{});
            CHECK(layer.thin_places == 0);
            int walls = 0;
            for (const ToolPath& path : layer.paths) {
                if (path.kind != TrackKind::thin_wall) continue;
                const auto [from, to] = std::minmax(path.points.front().x, path.points.back().x);
                if (to < 5 * mm - 20000 || from > 5 * mm + along + 20000) continue;
                ++walls;
                CHECK(path.width > width - 2010);
                CHECK(std::abs(from - 5 * mm) <= 500);
                CHECK(std::abs(to - 5 * mm - along) <= 500);
            }
            CHECK(walls == 1);
        }
}

TEST_CASE("a dot stands in the middle of its room, a little in the perimeters beside it") {
    // A neck wider than long has no room for a track along it.
    const Region neck = blocks_with_neck(36000, 30000);
    int dots = 0;
    for (const ToolPath& path : shell_paths(neck, {}, Settings{}).paths) {
        if (path.points.size() > 1) continue;
        ++dots;
        CHECK(std::abs(path.points[0].x - 5 * mm - 15000) <= 100);
        CHECK(std::abs(path.points[0].y - 168000) <= 1100);
        CHECK(path.width > 30000);
        CHECK(path.width <= 36000);
    }
    CHECK(dots == 1);
    const LayerPaths pin = shell_paths({rectangle(0, 0, 50000, 36000)}, {}, Settings{});
    REQUIRE(pin.paths.size() == 1);
    CHECK(pin.paths[0].points == std::vector<Point>{{25000, 18000}});
}

TEST_CASE("what there is no room for another perimeter in is filled between those that are there") {
    TrackSettings tracks;
    tracks.fill_gaps = GapFill::all;
    for (const int perimeters : {2, 3})
        for (const Unit width : {Unit{110000}, Unit{120000}, Unit{140000}}) {
            INFO(perimeters << " " << width);
            Settings settings;
            settings.perimeters = perimeters;
            const Region wall{rectangle(0, 0, 20 * mm, width)};
            const LayerPaths layer = shell_paths(wall, {}, settings, 0, tracks);
            CHECK(material(layer) > 0.93 * signed_area(wall));
            CHECK(material(layer) < 1.01 * signed_area(wall));
            CHECK(layer.unfilled_area < 0.05 * signed_area(wall));
            tracks.fill_gaps = GapFill::none;
            const LayerPaths open = shell_paths(wall, {}, settings, 0, tracks);
            CHECK(open.unfilled_area + material(open) > 0.95 * signed_area(wall));
            tracks.fill_gaps = GapFill::all;
        }
}

TEST_CASE("exactly half a track or three halves: one track, however the wall lies") {
    TrackSettings tracks;
    tracks.fill_gaps = GapFill::all;
    for (const int rings : {0, 1, 2})
        for (const Unit strip : {Unit{20000}, Unit{60000}})
            for (const double angle : {0.0, 0.3, 0.7, 1.0, 1.3, 2.5, 2.9}) {
                INFO(rings << " rings and " << strip << " units between them, turned by " << angle);
                Contour wall = rectangle(0, 0, 20 * mm, 80000 * rings + strip);
                for (Point& p : wall) {
                    const auto x = static_cast<double>(p.x), y = static_cast<double>(p.y);
                    p = {round_to_lattice(x * std::cos(angle) - y * std::sin(angle)),
                         round_to_lattice(x * std::sin(angle) + y * std::cos(angle))};
                }
                Settings settings;
                settings.perimeters = std::max(rings, 1);
                const LayerPaths layer = shell_paths({wall}, {}, settings, 0, tracks);
                const double solid = signed_area({wall});
                CHECK(layer.paths.size() == static_cast<std::size_t>(rings + 1));
                CHECK(material(layer) > 0.93 * solid);
                CHECK(material(layer) < 1.01 * solid);
                CHECK(layer.unfilled_area < 0.02 * solid);
                CHECK(layer.thin_places == 0);
            }
}

TEST_CASE("a round hole that a ring leaves in a cover is filled by a dot") {
    const Region post{rectangle(0, 0, 140000, 140000)};
    TrackSettings tracks;
    tracks.fill_gaps = GapFill::all;
    const LayerPaths filled = shell_paths(post, {}, Settings{}, 0, tracks);
    REQUIRE(filled.paths.size() == 2);
    const auto dot = std::find_if(filled.paths.begin(), filled.paths.end(),
                                  [](const ToolPath& path) { return path.points.size() == 1; });
    REQUIRE(dot != filled.paths.end());
    CHECK(dot->width >= 56000);
    CHECK(dot->width <= 60000);
    CHECK(distance(segments(*dot), segments(post)) >= 40000 + static_cast<double>(dot->width) / 2 - clipper);
    tracks.fill_gaps = GapFill::none;
    for (const ToolPath& path : shell_paths(post, {}, Settings{}, 0, tracks).paths) CHECK(path.points.size() > 1);
}

TEST_CASE("what is too thin for a wider first layer's tracks gets those of the other layers") {
    TrackSettings tracks;
    tracks.first_layer_width = 80000;
    const LayerPaths layer = shell_paths({rectangle(0, 0, 10 * mm, 38000)}, {}, Settings{}, 0, tracks);
    REQUIRE(layer.paths.size() == 1);
    CHECK(layer.paths[0].width == 38000);
    CHECK(layer.thin_places == 0);
}

TEST_CASE("what a wider first layer's perimeters leave between them gets the strips of the other layers") {
    Settings settings;
    settings.perimeters = 2;
    TrackSettings tracks;
    tracks.first_layer_width = 80000;
    tracks.fill_gaps = GapFill::all;
    for (const Unit width : {Unit{190000}, Unit{200000}}) {  // two perimeters, and room for 0.3 and 0.4 mm
        const Region bar{rectangle(0, 0, 20 * mm, width)};
        const LayerPaths layer = shell_paths(bar, {}, settings, 0, tracks);
        CHECK(material(layer) > 0.95 * signed_area(bar));
        CHECK(material(layer) < 1.01 * signed_area(bar));
        CHECK(layer.unfilled_area < 0.05 * signed_area(bar));
        CHECK(layer.unfilled_area >= 0);
    }
}

TEST_CASE("a pin at least half as wide as a track is printed, as a dot where it has room for nothing longer") {
    for (Unit diameter = 15000; diameter <= 70000; diameter += 1000) {
        Contour pin;
        for (int i = 0; i < 64; ++i) {
            const double angle = 2 * std::numbers::pi * (i + 0.5) / 64;
            pin.push_back({round_to_lattice(0.5 * static_cast<double>(diameter) * std::cos(angle)),
                           round_to_lattice(0.5 * static_cast<double>(diameter) * std::sin(angle))});
        }
        const LayerPaths layer = shell_paths({pin}, {}, Settings{});
        INFO(diameter << " units across, " << layer.paths.size() << " paths");
        if (diameter < 20000) {
            CHECK(layer.paths.empty());
            CHECK(layer.thin_places == 1);
            continue;
        }
        if (diameter < 20100) continue;  // the polygon is a little narrower than its circle
        REQUIRE(layer.paths.size() == 1);
        CHECK(layer.thin_places == 0);
        const ToolPath& path = layer.paths.front();
        CHECK(2 * path.width >= Settings{}.nozzle);
        CHECK(path.width > std::min(diameter, Settings{}.nozzle) - 2500);  // steps of d / 20
        std::vector<Segment> track;
        append_segments(path, track);
        CHECK(distance(track, segments({pin})) >= static_cast<double>(path.width) / 2 - clipper);
        TrackSettings none;
        none.thin_walls = false;
        if (diameter < 40000) CHECK(shell_paths({pin}, {}, Settings{}, 0, none).thin_places == 1);
    }
}

TEST_CASE("inner first: an island without inner perimeters waits for none of another island") {
    Settings settings;
    settings.perimeters = 2;
    TrackSettings tracks;
    tracks.inner_first = true;
    for (const Unit first : {Unit{0}, 11 * mm}) {
        const Region outline{rectangle(first, 0, first + 10 * mm, 10 * mm),
                             rectangle(10 * mm + 30000 - first, 0, 10 * mm + 100000 - first, 10 * mm)};
        LayerPlan plan;
        append_shell_paths(slice_of(outline), {}, settings, tracks, plan);
        int inner = 0, outer = 0;
        for (const PlannedTrack& track : plan.tracks) {
            const TrackKind kind = track.paths.front().kind;
            inner += kind == TrackKind::inner_perimeter, outer += kind == TrackKind::outer_perimeter;
            if (track.after == no_stop) continue;
            const auto island = [&](const PlannedTrack& t) {
                return winding_number({outline[0]}, t.paths.front().points.front());
            };
            CHECK(island(track) == island(plan.tracks[track.after]));
        }
        CHECK(inner == 1);
        CHECK(outer == 2);
        const std::size_t tracks_in_all = plan.tracks.size();
        CHECK(order_paths(std::move(plan), outline).paths.size() == tracks_in_all);
    }
}

TEST_CASE("every ring of perimeters comes after all rings before it that it runs beside") {
    const Contour three_halls{{0, 0},
                              {5 * mm, 0},
                              {5 * mm, 2 * mm},
                              {8 * mm, 2 * mm},
                              {8 * mm, 0},
                              {13 * mm, 0},
                              {13 * mm, 2 * mm},
                              {16 * mm, 2 * mm},
                              {16 * mm, 0},
                              {21 * mm, 0},
                              {21 * mm, 5 * mm},
                              {16 * mm, 5 * mm},
                              {16 * mm, 3 * mm},
                              {13 * mm, 3 * mm},
                              {13 * mm, 5 * mm},
                              {8 * mm, 5 * mm},
                              {8 * mm, 3 * mm},
                              {5 * mm, 3 * mm},
                              {5 * mm, 5 * mm},
                              {0, 5 * mm}};
    const Region beside_edge{rectangle(0, 0, 8 * mm, 8 * mm), rectangle(mm, 2 * mm, 2 * mm, 6 * mm, true)};
    for (const Region& outline : {Region{three_halls}, beside_edge})
        for (const int perimeters : {2, 3})
            for (const bool inner_first : {false, true}) {
                Settings settings;
                settings.perimeters = perimeters;
                TrackSettings tracks;
                tracks.inner_first = inner_first;
                const LayerPaths layer = shell_paths(outline, outline, settings, 0, tracks);
                std::vector<int> rings;  // the outermost is 0
                for (const ToolPath& path : layer.paths) {
                    if (stage_of(path.kind) != PrintStage::perimeters) continue;
                    const double far = distance(segments(path), segments(outline));
                    rings.push_back(static_cast<int>(std::lround(far / 40000 - 0.5)));
                }
                INFO(perimeters << " perimeters" << (inner_first ? ", inner first" : ""));
                CHECK(rings.size() > static_cast<std::size_t>(perimeters));
                const auto last_inner = std::find_if(rings.rbegin(), rings.rend(), [](int j) { return j > 0; });
                const auto first_inner = std::find_if(rings.begin(), rings.end(), [](int j) { return j > 0; });
                if (inner_first)
                    CHECK(std::find(rings.begin(), last_inner.base(), 0) == last_inner.base());
                else
                    CHECK(std::find(first_inner, rings.end(), 0) == rings.end());
            }
}

TEST_CASE("a thin wall with a small bump stays one track") {
    const Region outline{
        {{0, 0}, {10 * mm, 0}, {10 * mm, 32000}, {510000, 32000}, {505000, 38000}, {500000, 32000}, {0, 32000}}};
    LayerPlan plan;
    append_shell_paths(slice_of(outline), {}, {}, {}, plan);
    CHECK(plan.tracks.size() == 1);
}

TEST_CASE(
    "a strip between perimeter and cavity too narrow for a cover is filled with its width, or its area reported") {
    const Region outline{rectangle(0, 0, 20 * mm, 20 * mm)};
    const auto layer = [&](Unit strip) {
        TrackSettings tracks;
        tracks.fill_gaps = GapFill::all;
        return shell_paths(outline, {rectangle(40000 + strip, 40003, 1959997, 1959997)}, Settings{}, 0, tracks);
    };
    const LayerPaths filled = layer(30000);
    double length_of_strip = 0;
    for (const ToolPath& path : filled.paths)
        if (path.kind == TrackKind::thin_wall) {
            CHECK(path.width >= 28000);
            CHECK(path.width <= 30000);
            length_of_strip += length(path);
        }
    CHECK(length_of_strip > 18.5 * mm);
    CHECK(filled.unfilled_area < 1e9);
    const LayerPaths open = layer(15000);
    CHECK(std::none_of(open.paths.begin(), open.paths.end(),
                       [](const ToolPath& p) { return p.kind == TrackKind::thin_wall; }));
    CHECK(open.unfilled_area == Approx(15000.0 * 19.2 * mm).epsilon(0.01));
    CHECK(open.thin_places == 0);
}

TEST_CASE("a strip that shows from nowhere is spare, as far as the covering slices reach") {
    const Region outline{rectangle(0, 0, 20 * mm, 20 * mm)}, cavity{rectangle(70000, 40003, 1959997, 1959997)};
    const auto plan_with = [&](const Covering& covering, GapFill which) {
        TrackSettings tracks;
        tracks.fill_gaps = which;
        LayerPlan plan;
        append_shell_paths(slice_of(outline), cavity, Settings{}, tracks, plan, covering);
        return plan;
    };
    const auto along = [](const std::vector<PlannedTrack>& tracks) {
        double sum = 0;
        for (const PlannedTrack& track : tracks)
            for (const ToolPath& path : track.paths)
                if (path.kind == TrackKind::thin_wall) sum += length(path);
        return sum;
    };
    const auto slice = [](Region region) { return std::make_shared<const Slice>(slice_of(std::move(region))); };
    const Covering slope{slice(outline), slice({rectangle(30000, 0, 20 * mm, 20 * mm)})},
        steep{slice({rectangle(42000, 0, 20 * mm, 20 * mm)}), slice(outline)},
        step{slice({rectangle(30000, 0, 20 * mm, 12 * mm)}), slice(outline)};
    const LayerPlan all = plan_with(slope, GapFill::all);
    const double whole = along(all.tracks);
    CHECK(whole > 18.5 * mm);
    CHECK(all.spare.empty());
    const LayerPlan hidden = plan_with(slope, GapFill::needed);
    CHECK(along(hidden.tracks) == 0);
    CHECK(along(hidden.spare) == whole);
    CHECK(hidden.unfilled_area == Approx(all.unfilled_area + whole * 28000));
    // Of this one the outer edge shows.
    CHECK(along(plan_with(steep, GapFill::needed).spare) == 0);
    CHECK(along(plan_with({}, GapFill::needed).tracks) == whole);
    // What is printed whole is not cut into the pieces that were looked at.
    const auto points = [](const LayerPlan& plan) {
        std::vector<std::vector<Point>> all_points;
        for (const PlannedTrack& track : plan.tracks)
            for (const ToolPath& path : track.paths) all_points.push_back(path.points);
        return all_points;
    };
    CHECK(points(plan_with(steep, GapFill::needed)) == points(all));
    const LayerPlan part = plan_with(step, GapFill::needed);
    CHECK(along(part.tracks) + along(part.spare) == Approx(whole).margin(10));
    CHECK(along(part.spare) == Approx(11.5 * mm).margin(0.5 * mm));
    CHECK(plan_with(slope, GapFill::none).spare.empty());
}

TEST_CASE("what shows of a layer is printed alike with all gaps filled and with those needed") {
    std::mt19937_64 random(41);
    for (int round = 0; round < 12; ++round) {
        const Settings settings;
        const Contour middle = star(random, {}, 40, 7, 10);
        const auto moved = [&](double by) {  // the star's corners in or out by up to so much
            std::uniform_real_distribution<double> share(0, by);
            Contour c = middle;
            for (Point& p : c) {
                const double r = std::hypot(static_cast<double>(p.x), static_cast<double>(p.y));
                p = part_way({}, p, 1 - share(random) * mm / r);
            }
            return c;
        };
        const double slope = round % 2 == 0 ? 0.4 : 1.2;
        const Slice own = slice_of({middle}, 1), below = slice_of({moved(slope)}, 0),
                    above = slice_of({moved(slope)}, 2);
        const Region cavity = intersect(intersect(erode_slice(own, settings), erode_slice(below, settings)),
                                        erode_slice(above, settings));
        const Covering covering{std::make_shared<const Slice>(below), std::make_shared<const Slice>(above)};
        const auto plan_with = [&](GapFill which) {
            TrackSettings tracks;
            tracks.fill_gaps = which;
            LayerPlan plan;
            plan.layer = 1;
            append_shell_paths(own, cavity, settings, tracks, plan, covering);
            return plan;
        };
        const LayerPlan all = plan_with(GapFill::all), needed = plan_with(GapFill::needed);
        CHECK_FALSE(needed.spare.empty());
        const auto covers = [](const LayerPlan& plan, Point p, double more) {
            for (const PlannedTrack& track : plan.tracks)
                for (const ToolPath& path : track.paths) {
                    std::vector<Segment> lines;
                    append_segments(path, lines);
                    for (const Segment& line : lines)
                        if (distance({p, p}, line) <= static_cast<double>(path.width) / 2 + more) return true;
                }
            return false;
        };
        std::uniform_int_distribution<Unit> at(-10 * mm, 10 * mm);
        int looked_at = 0, open = 0;
        for (int k = 0; k < 20000 && looked_at < 400; ++k) {
            const Point p{at(random), at(random)};
            if (winding_number(own.rounded, p) == 0) continue;
            if (winding_number(below.rounded, p) != 0 && winding_number(above.rounded, p) != 0) continue;
            ++looked_at;
            open += covers(all, p, 0) && !covers(needed, p, 2);
        }
        CHECK(looked_at > 50);
        CHECK(open == 0);
    }
}

TEST_CASE("perimeters come outer first or inner first, each after its neighbour") {
    Settings settings;
    settings.perimeters = 3;
    const Region outline{rectangle(0, 0, 20 * mm, 20 * mm), rectangle(6 * mm, 6 * mm, 14 * mm, 14 * mm, true)};
    for (const bool inner_first : {false, true}) {
        TrackSettings tracks;
        tracks.inner_first = inner_first;
        const LayerPaths layer =
            shell_paths(outline, {rectangle(2 * mm, 2 * mm, 4 * mm, 18 * mm)}, settings, 2, tracks);
        std::vector<double> to_outside, to_hole;
        for (const ToolPath& path : layer.paths) {
            if (!path.closed) continue;
            const double outside = distance(segments(path), segments({outline[0]})),
                         hole = distance(segments(path), segments({outline[1]}));
            (outside < hole ? to_outside : to_hole).push_back(std::min(outside, hole));
        }
        REQUIRE(to_outside.size() == 3);
        REQUIRE(to_hole.size() == 3);
        for (const auto& rings : {to_outside, to_hole})
            CHECK(std::is_sorted(rings.begin(), rings.end(),
                                 [&](double a, double b) { return inner_first ? a > b : a < b; }));
    }
}

TEST_CASE("the seam lies at the rear, at the sharpest corner, or anywhere") {
    const Contour shape{{0, 0}, {10 * mm, 0}, {16 * mm, 2 * mm}, {10 * mm, 4 * mm}, {10 * mm, 10 * mm}, {0, 10 * mm}};
    for (int quarters = 0; quarters < 4; ++quarters) {
        Contour outline = shape;
        for (int k = 0; k < quarters; ++k)
            for (Point& p : outline) p = {-p.y, p.x};
        const auto seam = [&](Seam rule) {
            TrackSettings tracks;
            tracks.seam = rule;
            return shell_paths({outline}, {}, Settings{}, 0, tracks).paths.front().points.front();
        };
        CHECK(length(seam(Seam::corner) - outline[2]) < 80000);  // where it turns by 143 degrees
        for (Point p : outline)
            CHECK(5 * seam(Seam::aligned).y - 2 * seam(Seam::aligned).x >=
                  5 * p.y - 2 * p.x - 12 * 40000);  // but for the corner's inset
    }
}

TEST_CASE("monotonic covers: every line comes after all that lie before it, beside it") {
    std::mt19937_64 random(31);
    for (int round = 0; round < 20; ++round) {
        Region outline{star(random, {0, 0}, 14 + round, 6, 9)};
        if (round % 2) outline.push_back(star(random, {0, 0}, 9, 2, 3, true));
        TrackSettings tracks;
        tracks.covers = CoverPattern::monotonic;
        const LayerPaths layer = shell_paths(outline, {}, Settings{}, 2 * round, tracks);
        // On even layers lines rise at 45 degrees: y - x is the same along each.
        std::vector<Segment> printed;
        for (const ToolPath& path : layer.paths) {
            if (path.kind != TrackKind::cover) continue;
            for (const Segment& s : segments(path)) {
                if (s.b.y - s.a.y != s.b.x - s.a.x) continue;
                for (const Segment& before : printed) {
                    if (before.a.y - before.a.x <= s.a.y - s.a.x + 10) continue;
                    CHECK(distance(before, s) > 1.05 * 40000);  // not beside each other
                }
                printed.push_back(s);
            }
        }
        CHECK(printed.size() > 10);
    }
}

TEST_CASE("concentric covers follow the border, d apart, and leave no middle unfilled") {
    TrackSettings tracks;
    tracks.covers = CoverPattern::concentric;
    const Region outline{rectangle(0, 0, 10 * mm, 10 * mm)};
    const LayerPaths layer = shell_paths(outline, {}, Settings{}, 0, tracks);
    check_shell({outline}, {}, Settings{}, [&] {
        LayerPaths perimeters = layer;
        std::erase_if(perimeters.paths, [](const ToolPath& p) { return p.kind == TrackKind::cover; });
        return perimeters;
    }(), tracks.resolution);
    double material = 0;
    for (const ToolPath& path : layer.paths) {
        material += length(path) * static_cast<double>(path.width);
        if (path.kind == TrackKind::cover && path.closed)
            CHECK(distance(segments(path), segments(outline)) >= 60000 - clipper);
    }
    CHECK(material > 0.95 * mm * mm * 100);
    CHECK(material < 1.01 * mm * mm * 100);
}

TEST_CASE("concentric covers: where there is no room for two tracks side by side, no ring goes there and back") {
    TrackSettings tracks;
    tracks.covers = CoverPattern::concentric;
    for (const GapFill fill : {GapFill::all, GapFill::none})
        for (Unit width = 122000; width <= 380000; width += 6000) {
            tracks.fill_gaps = fill;
            const Region bar{rectangle(0, 0, 20 * mm, width)};
            const LayerPaths layer = shell_paths(bar, {}, {}, 0, tracks);
            INFO(width << " units wide");
            CHECK(material(layer) < signed_area(bar) + 20000.0 * 20 * mm);  // two tracks in the room of 3/2
            if (fill == GapFill::all)                                       // less than half a track stays open
                CHECK(material(layer) > 0.97 * signed_area(bar) - 20000.0 * 20 * mm);
        }
}

TEST_CASE("the first layer's tracks have its width, those above d") {
    TrackSettings tracks;
    tracks.first_layer_width = 50000;
    const Region outline{rectangle(0, 0, 10 * mm, 10 * mm)};
    for (const int number : {0, 1})
        for (const ToolPath& path : shell_paths(outline, {}, Settings{}, number, tracks).paths)
            CHECK(path.width == (number == 0 ? 50000 : 40000));
    CHECK(distance(segments(shell_paths(outline, {}, Settings{}, 0, tracks).paths.front()), segments(outline)) ==
          25000);
    tracks.first_layer_width = 30000;
    CHECK_THROWS_WITH(tracks.check(40000), Catch::Contains("--first-layer-width"));
}

TEST_CASE("cover lines end inside the area, exactly, and every area with an inside gets one") {
    std::mt19937_64 random(11);
    for (int round = 0; round < 100; ++round) {
        const double size = 0.05 + 0.05 * round;
        const Region area{star(random, {round * 12345, -round * 54321}, 5 + round % 30, size / 2, size)};
        const std::vector<Segment> border = segments(area);
        for (const bool falling : {false, true}) {
            const std::vector<Contour> lines = cover_lines(area, 40000, falling);
            CHECK_FALSE(lines.empty());
            for (const Contour& line : lines)
                for (Point p : line) {
                    const bool on_border = std::any_of(border.begin(), border.end(), [&](const Segment& s) {
                        return side(s.a, s.b, p) == 0 && distance(p, s) == 0;
                    });
                    CHECK((on_border || winding_number(area, p) == 1));
                }
        }
    }
}

TEST_CASE("an area without an inside has no cover lines") {
    CHECK(cover_lines({}, 40000, false).empty());
    CHECK(cover_lines({{{0, 0}, {mm, mm}, {2 * mm, 2 * mm}}}, 40000, false).empty());
}
