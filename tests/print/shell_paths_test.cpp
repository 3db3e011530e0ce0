#include <catch2/catch.hpp>
#include <numbers>
#include <random>

#include "print/geometry.hpp"
#include "ribvault/print/cover_lines.hpp"
#include "ribvault/print/shell_paths.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

constexpr Unit mm = units_per_mm;
constexpr double rounding = 2;  // lattice units

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

LayerPaths shell_paths(const Region& outline, const Region& cavity, const Settings& settings, int layer = 0) {
    LayerPaths paths;
    paths.layer = layer;
    append_shell_paths(slice_of(outline, layer), cavity, settings, paths);
    return paths;
}

/// Every postcondition of append_shell_paths.
void check_shell(const Region& outline, const Region& cavity, const Settings& settings, const LayerPaths& layer) {
    const auto d = static_cast<double>(settings.nozzle);
    const std::vector<Segment> border = segments(outline), inner = segments(cavity);
    bool covers_began = false;
    for (const ToolPath& path : layer.paths) {
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
        const LayerPaths layer = shell_paths(outline, cavity, settings, round);
        check_shell(outline, cavity, settings, layer);
        CHECK(std::any_of(layer.paths.begin(), layer.paths.end(),
                          [](const ToolPath& p) { return p.kind == TrackKind::cover; }));
        const LayerPaths again = shell_paths(outline, cavity, settings, round);
        CHECK(std::equal(layer.paths.begin(), layer.paths.end(), again.paths.begin(), again.paths.end(),
                         [](const ToolPath& a, const ToolPath& b) { return a.points == b.points; }));
    }
}

TEST_CASE("a full square is covered by one zigzag, d apart, at 45 degrees on even layers and 135 on odd") {
    const Region outline{rectangle(0, 0, 20 * mm, 20 * mm)};
    const Settings settings;
    for (int number : {0, 1, 2, 7}) {
        const LayerPaths layer = shell_paths(outline, {}, settings, number);
        check_shell(outline, {}, settings, layer);
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
    check_shell(outline, cavity, Settings{}, layer);
    // 72 pieces of lines; only where the border runs nearly along them is the way to the next longer than 2 d.
    CHECK(layer.paths.size() < 20);
}

TEST_CASE("places narrower than one track get nothing, those just wider get a perimeter, then a cover") {
    const auto tracks = [](Unit width) {
        return shell_paths({rectangle(0, 0, 10 * mm, width)}, {}, Settings{}).paths.size();
    };
    CHECK(tracks(39000) == 0);
    CHECK(tracks(41000) == 1);
    CHECK(tracks(118000) == 1);
    CHECK(tracks(125000) >= 2);
    CHECK(shell_paths({}, {}, Settings{}).paths.empty());
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
