// Pictures show what is there: shell, every track, every root, junction and tip, where they are.
#include "ribvault/report/layer_svg.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <pugixml.hpp>
#include <random>
#include <sstream>

#include "print/random_forest.hpp"
#include "ribvault/report/svg_path.hpp"

using namespace ribvault;

namespace {

struct Place {
    double x, y;
};
using Polyline = std::vector<Place>;

/// Reads path data of the commands M, l, h and z back, in mm with y upwards.
std::vector<Polyline> read_path(const std::string& data) {
    std::vector<Polyline> lines;
    std::size_t at = 0;
    char command = 0;
    const auto number = [&] {
        while (at < data.size() && data[at] == ' ') ++at;
        std::size_t used = 0;
        // Numbers may follow each other without a blank: "-.5-.25", so the second sign ends the first.
        std::size_t stop = at + 1;
        while (stop < data.size() && (std::isdigit(data[stop]) || data[stop] == '.')) ++stop;
        const double value = std::stod(data.substr(at, stop - at), &used);
        REQUIRE(used == stop - at);
        at = stop;
        return value;
    };
    while (at < data.size()) {
        if (std::isalpha(data[at])) command = data[at++];
        if (command == 'z') continue;
        if (command == 'M') {
            const double x = number(), y = number();
            lines.push_back({{x, -y}});
            continue;
        }
        REQUIRE((command == 'l' || command == 'h'));
        REQUIRE_FALSE(lines.empty());
        const Place last = lines.back().back();
        const double dx = number(), dy = command == 'l' ? number() : 0;
        lines.back().push_back({last.x + dx, last.y - dy});
    }
    return lines;
}

double total_length(const std::vector<Polyline>& lines) {
    double sum = 0;
    for (const Polyline& line : lines)
        for (std::size_t i = 1; i < line.size(); ++i)
            sum += std::hypot(line[i].x - line[i - 1].x, line[i].y - line[i - 1].y);
    return sum;
}

double area(const std::vector<Polyline>& contours) {
    double twice = 0;
    for (const Polyline& c : contours)
        for (std::size_t i = 0; i < c.size(); ++i) {
            const Place p = c[i], q = c[(i + 1) % c.size()];
            twice += p.x * q.y - p.y * q.x;
        }
    return twice / 2;
}

/// The pictures' parts by colour; fails the test when the text is not XML.
struct Picture {
    pugi::xml_document document;
    std::multimap<std::string, std::string> paths;  ///< fill or stroke -> data
    std::string title;
    double x, y, width, height;

    explicit Picture(const std::string& svg) {
        REQUIRE(document.load_string(svg.c_str()));
        const pugi::xml_node root = document.child("svg");
        std::istringstream(root.attribute("viewBox").value()) >> x >> y >> width >> height;
        title = root.child_value("title");
        for (const pugi::xml_node path : root.children("path")) {
            const std::string fill = path.attribute("fill").value(), stroke = path.attribute("stroke").value();
            paths.emplace(fill.empty() || fill == "none" ? stroke : fill, path.attribute("d").value());
        }
    }
    /// The first path of a colour: what is drawn comes before its legend.
    std::vector<Polyline> first(const std::string& colour) const {
        const auto found = paths.lower_bound(colour);
        return found == paths.end() || found->first != colour ? std::vector<Polyline>{} : read_path(found->second);
    }
};

Contour square(Unit lo, Unit hi) { return {{lo, lo}, {hi, lo}, {hi, hi}, {lo, hi}}; }
Contour turned(Contour c) {
    std::reverse(c.begin(), c.end());
    return c;
}

constexpr Unit mm = units_per_mm;
constexpr const char *shell = "#bbb", *tracks = "#56b4e9", *centre = "#003a5c", *roots = "#0072b2",
                     *junctions = "#e69f00", *tips = "#000", *dots = "#cc79a7", *unsupported = "#d55e00";

}  // namespace

TEST_CASE("a picture shows every track, root, junction, tip and dot of random forests") {
    std::mt19937_64 random(5);
    for (int round = 0; round < 20; ++round) {
        SupportForest forest = test::random_forest(random, 6, 25, mm / 10, 3 * mm, 0.2);
        for (int k = 0; k < round % 4; ++k) add_vertex({{k * mm, 19 * mm}, true}, forest);
        Slice slice;
        slice.layer = round;
        slice.rounded = {square(-21 * mm, 21 * mm)};
        const LayerDrawing drawing = draw_layer(slice, {square(-20 * mm, 20 * mm)}, forest, {}, Settings());
        const Picture picture(layer_svg(drawing));
        std::size_t expected_roots = 0, expected_junctions = 0, expected_tips = 0, expected_dots = 0;
        for (auto [v, end] = vertices(forest); v != end; ++v) {
            const auto valence = out_degree(*v, forest);
            expected_dots += valence == 0;
            expected_roots += valence > 0 && forest[*v].root;
            expected_junctions += valence >= 3;
            expected_tips += valence == 1 && !forest[*v].root;
        }
        CHECK(picture.first(roots).size() == expected_roots);
        CHECK(picture.first(junctions).size() == expected_junctions);
        CHECK(picture.first(tips).size() == expected_tips);
        REQUIRE(picture.paths.count(dots) == (expected_dots > 0 ? 2 : 1));  // the legend's is the last
        if (expected_dots > 0) CHECK(picture.first(dots).size() == expected_dots);
        CHECK(static_cast<std::size_t>(drawing.dots) == expected_dots);
        CHECK(static_cast<std::size_t>(drawing.roots) == expected_roots);
        CHECK(static_cast<std::size_t>(drawing.junctions) == expected_junctions);
        CHECK(static_cast<std::size_t>(drawing.tips) == expected_tips);
        CHECK_THAT(layer_svg(drawing), Catch::Contains("roots " + std::to_string(expected_roots) + ", junctions " +
                                                       std::to_string(expected_junctions) + ", tips " +
                                                       std::to_string(expected_tips) + ", dots " +
                                                       std::to_string(expected_dots)));
        const double length = ribvault::length(forest) / mm;
        CHECK(drawing.support_length_mm == Approx(length));
        for (const char* part : {tracks, centre})
            CHECK(total_length(picture.first(part)) ==
                  Approx(length).margin(0.0015 * static_cast<double>(num_edges(forest))));
        CHECK(picture.paths.count(unsupported) == 1);  // the legend's alone
    }
}

TEST_CASE("each mark lies around its vertex, in its own shape") {
    SupportForest forest(6);
    forest[0] = {{2 * mm, 2 * mm}, true}, forest[1] = {{8 * mm, 3 * mm}, false};
    forest[2] = {{9 * mm, 7 * mm}, false}, forest[3] = {{12 * mm, 4 * mm}, false};
    forest[4] = {{15 * mm, 16 * mm}, true};  // a dot
    forest[5] = {{10 * mm, 9 * mm}, false};  // beyond the bend in vertex 2
    add_edge(0, 1, forest), add_edge(1, 2, forest), add_edge(1, 3, forest), add_edge(2, 5, forest);
    Slice slice;
    slice.rounded = {square(0, 20 * mm)};
    const Picture picture(layer_svg(slice, {square(mm, 19 * mm)}, forest, {}, Settings()));
    const auto check = [&](const char* colour, std::size_t corners, std::vector<Place> expected) {
        INFO(colour);
        const auto marks = picture.first(colour);
        REQUIRE(marks.size() == expected.size());
        for (std::size_t m = 0; m < marks.size(); ++m) {
            CHECK(marks[m].size() == corners);
            Place mean{0, 0};
            for (const Place p : marks[m]) {
                mean.x += p.x / static_cast<double>(corners);
                mean.y += p.y / static_cast<double>(corners);
            }
            CHECK(mean.x == Approx(expected[m].x).margin(0.002));
            CHECK(mean.y == Approx(expected[m].y).margin(0.002));
        }
    };
    check(roots, 2, {{2, 2}});  // "M2 -2h0" with square ends
    check(junctions, 2, {{8, 3}});
    check(tips, 3, {{12, 4}, {10, 9}});
    check(dots, 4, {{15, 16}});
}

TEST_CASE("the shell is the slice without its cavity, y upwards") {
    Slice slice;
    slice.rounded = {square(0, 20 * mm), turned(square(8 * mm, 12 * mm))};
    const Region cavity = {square(1 * mm, 19 * mm), turned(square(7 * mm, 13 * mm))};
    const Picture picture(layer_svg(slice, cavity, {}, {}, Settings()));
    const auto contours = picture.first(shell);
    REQUIRE(contours.size() == 4);
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i) sum += (i < 2 ? 1 : -1) * area({contours[i]});
    CHECK(sum == Approx((400 - 16) - (324 - 36)));
    CHECK_THAT(picture.paths.find(shell)->second, Catch::StartsWith("M0 0l20 0 0-20-20 0z"));
    CHECK(picture.document.child("svg").child("path").attribute("fill-rule").value() == std::string("evenodd"));
}

TEST_CASE("what had been unsupported is drawn over the tracks' width and under their centre lines") {
    Slice slice;
    slice.rounded = {square(0, 20 * mm)};
    SupportForest forest(2);
    forest[0] = {{mm, 5 * mm}, true}, forest[1] = {{4 * mm, 5 * mm}, false};
    add_edge(0, 1, forest);
    const std::string svg = layer_svg(slice, {square(mm, 19 * mm)}, forest, {square(2 * mm, 3 * mm)}, Settings());
    CHECK(area(Picture(svg).first(unsupported)) == Approx(1));
    CHECK(svg.find(tracks) < svg.find(unsupported));
    CHECK(svg.find(unsupported) < svg.find(centre));
}

TEST_CASE("a dot is drawn as a line of no length with round ends, at the track's width") {
    SupportForest forest(1);
    forest[0] = {{mm / 4, -2 * mm}, true};
    Settings settings;
    settings.support_width = 60000;
    Slice slice;
    slice.rounded = {square(-5 * mm, 5 * mm)};
    const std::string svg = layer_svg(slice, {}, forest, {}, settings);
    CHECK_THAT(
        svg, Catch::Contains("stroke-linecap=\"round\" stroke-linejoin=\"round\" stroke-width=\".6\" d=\"M.25 2h0\""));
}

TEST_CASE("walls of several tracks are drawn as wide as these together, as far as the cavity goes") {
    SupportForest forest(5);
    forest[0] = {.at = {mm, 5 * mm}, .root = true, .wide = true}, forest[1] = {.at = {4 * mm, 9 * mm}, .wide = true};
    forest[2] = {.at = {19 * mm, 5 * mm}, .root = true}, forest[3] = {.at = {16 * mm, 5 * mm}};
    forest[4] = {.at = {10 * mm, 15 * mm}, .root = true, .wide = true};
    add_edge(0, 1, forest), add_edge(2, 3, forest);
    Slice slice;
    slice.layer = 7;
    slice.rounded = {square(0, 20 * mm)};
    const Region cavity{square(mm, 19 * mm)};
    SupportForest unmarked = forest;
    for (auto [v, end] = vertices(unmarked); v != end; ++v) unmarked[*v].wide = false;
    Settings settings;
    CHECK(layer_svg(slice, cavity, forest, {}, settings) == layer_svg(slice, cavity, unmarked, {}, settings));
    for (const int lines : {2, 3}) {
        settings.wall_lines = lines;
        const std::string svg = layer_svg(slice, cavity, forest, {}, settings);
        const Picture picture(svg);
        std::map<std::string, pugi::xml_node> by_width;  // without the legend's, which is the last
        for (const pugi::xml_node path : picture.document.child("svg").children("path"))
            if (path.attribute("stroke").value() == std::string(tracks))
                by_width.emplace(path.attribute("stroke-width").value(), path);
        REQUIRE(by_width.count(".4") == 1);
        REQUIRE(by_width.count(lines == 2 ? ".8" : "1.2") == 1);
        const pugi::xml_node narrow = by_width[".4"], wide = by_width[lines == 2 ? ".8" : "1.2"];
        CHECK(total_length(read_path(narrow.attribute("d").value())) == Approx(3));
        CHECK_FALSE(narrow.attribute("clip-path"));
        CHECK(read_path(wide.attribute("d").value()).size() == 2);  // the wall and the dot
        CHECK(total_length(read_path(wide.attribute("d").value())) == Approx(5));
        const pugi::xml_node clip = picture.document.child("svg").child("clipPath");
        CHECK(wide.attribute("clip-path").value() == "url(#" + std::string(clip.attribute("id").value()) + ")");
        CHECK(clip.child("path").attribute("d").value() == region_data(cavity));
        CHECK(total_length(picture.first(centre)) == Approx(8));
        slice.layer = 8;  // a contact sheet holds both
        CHECK_THAT(layer_svg(slice, cavity, forest, {}, settings), !Catch::Contains(clip.attribute("id").value()));
        slice.layer = 7;
    }
}

TEST_CASE("what overhangs outside is the slice without what is within rho of the one below") {
    Slice slice, below;
    slice.layer = 7;
    slice.rounded = {square(0, 20 * mm)};
    below.layer = 6;
    below.rounded = {square(0, 15 * mm), turned(square(2 * mm, 4 * mm))};
    Settings settings;
    settings.support_radius = 30000;
    const std::string svg = layer_svg(slice, {square(mm, 14 * mm)}, {}, {}, settings, &below);
    pugi::xml_document document;
    REQUIRE(document.load_string(svg.c_str()));
    const pugi::xml_node mask = document.child("svg").child("mask");
    const pugi::xml_node shown = mask.find_child_by_attribute("path", "fill", "#fff"),
                         hidden = mask.find_child_by_attribute("path", "fill", "#000"),
                         drawn = document.child("svg").find_child_by_attribute("path", "fill", "#009e73");
    CHECK(area(read_path(shown.attribute("d").value())) == Approx(400));
    CHECK(area(read_path(hidden.attribute("d").value())) == Approx(225 - 4));
    CHECK(hidden.attribute("stroke-width").value() == std::string(".6"));
    CHECK(hidden.attribute("stroke-linejoin").value() == std::string("round"));
    CHECK(area(read_path(drawn.attribute("d").value())) == Approx(400));
    CHECK(drawn.attribute("mask").value() == "url(#" + std::string(mask.attribute("id").value()) + ")");
    CHECK_THAT(svg, Catch::Contains("overhangs outside"));
    slice.layer = 8;  // a contact sheet holds both
    CHECK_THAT(layer_svg(slice, {}, {}, {}, settings, &below), !Catch::Contains(mask.attribute("id").value()));
    CHECK_THAT(layer_svg(slice, {}, {}, {}, settings), !Catch::Contains("overhangs") && !Catch::Contains("mask"));
}

TEST_CASE("everything lies inside the frame, and the caption names layer, height and length") {
    Slice slice;
    slice.layer = 3;
    slice.rounded = {square(100 * mm, 117 * mm)};
    SupportForest forest(2);
    forest[0] = {{101 * mm, 105 * mm}, true}, forest[1] = {{104 * mm, 109 * mm}, false};
    add_edge(0, 1, forest);
    Settings settings;
    settings.first_layer_height = 30000;
    const Picture picture(layer_svg(slice, {square(101 * mm, 116 * mm)}, forest, {}, settings));
    CHECK(picture.title == "layer 3, z 0.80 mm, supports 5.0 mm");  // 0.3 + 2.5 * 0.2
    for (const auto& [colour, data] : picture.paths)
        for (const Polyline& line : read_path(data))
            for (const Place p : line) {
                INFO(colour << " " << p.x << " " << p.y);
                CHECK(p.x >= picture.x);
                CHECK(p.x <= picture.x + picture.width);
                CHECK(-p.y >= picture.y);
                CHECK(-p.y <= picture.y + picture.height);
            }
}

TEST_CASE("an empty layer is a picture, too") {
    const Picture picture(layer_svg(Slice(), {}, {}, {}, Settings()));
    CHECK(picture.first(shell).size() == 1);  // the legend's alone
    CHECK(picture.width > 0);
    CHECK(picture.height > 0);
}

TEST_CASE("numbers take as few characters as they can and never lose a micrometre") {
    CHECK(svg_number(0) == "0");
    CHECK(svg_number(-0.0004) == "0");
    CHECK(svg_number(0.4) == ".4");
    CHECK(svg_number(-0.25) == "-.25");
    CHECK(svg_number(20) == "20");
    CHECK(svg_number(-3.005) == "-3.005");
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> uniform(-300, 300);
    for (int k = 0; k < 10000; ++k) {
        const double value = uniform(random);
        CHECK(std::abs(std::stod(svg_number(value)) - value) <= 0.0005 + 1e-9);
    }
}

TEST_CASE("long outlines do not drift: relative steps end where the contour ends") {
    Contour spiral;
    for (int k = 0; k < 20000; ++k)
        spiral.push_back({round_to_lattice((1000 + 33.3 * k) * std::cos(0.01 * k)),
                          round_to_lattice((1000 + 33.3 * k) * std::sin(0.01 * k))});
    const auto back = read_path(region_data({spiral}));
    REQUIRE(back.size() == 1);
    CHECK(back[0].back().x == Approx(to_mm(spiral.back().x)).margin(0.001));
    CHECK(back[0].back().y == Approx(to_mm(spiral.back().y)).margin(0.001));
}
