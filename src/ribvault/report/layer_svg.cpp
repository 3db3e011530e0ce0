#include "ribvault/report/layer_svg.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <string_view>

#include "ribvault/report/svg_path.hpp"
#include "ribvault/vault/wall_stability.hpp"

namespace ribvault {
namespace {

constexpr double margin = 1;  // mm around the outermost contour

constexpr std::string_view shell_style = R"(fill="#bbb" fill-rule="evenodd")";
constexpr std::string_view track_style =
    R"(fill="none" stroke="#56b4e9" stroke-linecap="round" stroke-linejoin="round")";
constexpr std::string_view unsupported_style = R"(fill="#d55e00" fill-opacity=".45")";
constexpr std::string_view overhang_colour = "#009e73";
constexpr std::string_view line_style = R"(fill="none" stroke="#003a5c" stroke-width=".05")";
constexpr std::string_view root_style = R"(stroke="#0072b2" stroke-linecap="square")";
constexpr std::string_view junction_style = R"(stroke="#e69f00" stroke-linecap="round")";
constexpr std::string_view tip_style = R"(fill="#000")";
constexpr std::string_view dot_style = R"(fill="#cc79a7" stroke="#000" stroke-width=".03")";

void append_element(std::string& svg, std::string_view style, const std::string& data, double stroke_width = 0) {
    if (data.empty()) return;
    svg.append("<path ").append(style);
    if (stroke_width > 0) svg.append(" stroke-width=\"").append(svg_number(stroke_width)).append("\"");
    svg.append(" d=\"").append(data).append("\"/>\n");
}

/// The walls, each in its width. A track's end reaches half its width over the shell; walls of several tracks would
/// reach farther there, even out of the object, than what is printed of them, which is clipped to the cavity
/// (print/wide_walls.hpp).
void append_tracks(std::string& svg, const SupportForest& forest, const Region& cavity, const Settings& settings,
                   int layer) {
    std::set<Unit> widths;
    for (auto [v, end] = vertices(forest); v != end; ++v) widths.insert(wall_width(forest[*v], settings));
    for (const Unit width : widths) {
        std::string style(track_style);
        if (width > settings.support_width) {
            const std::string id = "cavity" + std::to_string(layer);  // a contact sheet holds several layers
            svg.append("<clipPath id=\"" + id + "\"><path clip-rule=\"evenodd\" d=\"" + region_data(cavity) +
                       "\"/></clipPath>\n");
            style += " clip-path=\"url(#" + id + ")\"";
        }
        const auto drawn = [&](const SupportVertex& v) { return wall_width(v, settings) == width; };
        append_element(svg, style, track_data(forest, drawn), to_mm(width));
    }
}

/// What of the slice lies farther than ρ from the one below: the renderer cuts it out.
void append_overhang(std::string& svg, const Region& slice, const Region& below, Unit radius, int layer) {
    const std::string id = "beyond" + std::to_string(layer), all = region_data(slice);
    svg.append(
        "<mask id=\"" + id + "\"><path fill=\"#fff\" fill-rule=\"evenodd\" d=\"" + all +
        "\"/><path fill=\"#000\" fill-rule=\"evenodd\" stroke=\"#000\" stroke-linejoin=\"round\" stroke-width=\"" +
        svg_number(2 * to_mm(radius)) + "\" d=\"" + region_data(below) + "\"/></mask>\n");
    append_element(svg, "fill=\"" + std::string(overhang_colour) + "\" fill-rule=\"evenodd\" mask=\"url(#" + id + ")\"",
                   all);
}

struct Marks {
    std::string roots, junctions, tips, dots;
};

/// A diamond of the given half-diagonal.
void append_diamond(std::string& data, double x, double y, double half) {
    const std::string h = svg_number(half);
    data.append("M").append(svg_number(x - half)).append(" ").append(svg_number(y));
    data.append("l" + h + "-" + h + " " + h + " " + h + "-" + h + " " + h + "z");
}

/// A triangle, point up, whose corners are `radius` from (x, y).
void append_triangle(std::string& data, double x, double y, double radius) {
    const double half = 0.866 * radius;
    data.append("M").append(svg_number(x)).append(" ").append(svg_number(y - radius));
    data.append("l").append(svg_number(half)).append(" ").append(svg_number(1.5 * radius));
    data.append("h").append(svg_number(-2 * half)).append("z");
}

Marks marks_of(const SupportForest& forest, double width, LayerDrawing& d) {
    Marks marks;
    for (auto [v, end] = vertices(forest); v != end; ++v) {
        const Point p = forest[*v].at;
        const auto valence = out_degree(*v, forest);
        if (valence == 0) {
            append_diamond(marks.dots, to_mm(p.x), -to_mm(p.y), 0.45 * width);
            ++d.dots;
        } else if (forest[*v].root) {
            append_dot(marks.roots, p);
            ++d.roots;
        } else if (valence == 1) {
            append_triangle(marks.tips, to_mm(p.x), -to_mm(p.y), 0.45 * width);
            ++d.tips;
        }
        if (valence >= 3) {
            append_dot(marks.junctions, p);
            ++d.junctions;
        }
    }
    return marks;
}

std::string caption(const LayerDrawing& d) {
    const auto fixed = [](double value, int places) {
        char text[32];
        return std::string(text, std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, places).ptr);
    };
    return "layer " + std::to_string(d.layer) + ", z " + fixed(d.z_mm, 2) + " mm, supports " +
           fixed(d.support_length_mm, 1) + " mm";
}

std::string svg_start(double x, double y, double width, double height, double pixels_per_mm) {
    std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"";
    svg.append(svg_number(x) + " " + svg_number(y) + " " + svg_number(width) + " " + svg_number(height) +
               "\" width=\"");
    svg.append(svg_number(std::round(width * pixels_per_mm)) + "\" height=\"" +
               svg_number(std::round(height * pixels_per_mm)) + "\">\n");
    svg.append("<rect x=\"" + svg_number(x) + "\" y=\"" + svg_number(y) + "\" width=\"" + svg_number(width) +
               "\" height=\"" + svg_number(height) + "\" fill=\"#fff\"/>\n");
    return svg;
}

std::string counts(const LayerDrawing& d) {
    return "roots " + std::to_string(d.roots) + ", junctions " + std::to_string(d.junctions) + ", tips " +
           std::to_string(d.tips) + ", dots " + std::to_string(d.dots);
}

void append_text(std::string& svg, double x, double y, double size, const std::string& text) {
    svg.append("<text x=\"" + svg_number(x) + "\" y=\"" + svg_number(y) + "\" font-family=\"sans-serif\" font-size=\"" +
               svg_number(size) + "\">" + text + "</text>\n");
}

/// A bar of 10 mm with its label to the right; y is the bar's.
void append_scale_bar(std::string& svg, double x, double y, double size) {
    svg.append("<path fill=\"none\" stroke=\"#000\" stroke-width=\"" + svg_number(0.15 * size) + "\" d=\"M" +
               svg_number(x) + " " + svg_number(y) + "h10\"/>\n");
    append_text(svg, x + 10 + 0.5 * size, y + 0.35 * size, size, "10 mm");
}

/// What the marks mean, in one row; y is its base line.
void append_legend(std::string& svg, double x, double y, double size, bool overhang) {
    const double middle = y - 0.35 * size;
    const auto swatch = [&](std::string_view style, double width, double offset, const std::string& name) {
        std::string data("M");
        data.append(svg_number(x + offset + 0.3 * size)).append(" ").append(svg_number(middle)).append("h");
        data.append(width > 0.9 * size ? svg_number(0.8 * size) : "0");
        append_element(svg, style, data, width);
        append_text(svg, x + offset + 1.6 * size, y, size, name);
    };
    swatch(R"(stroke="#bbb")", size, 0, "shell");
    swatch(R"(stroke="#56b4e9")", size, 5.5 * size, "track");
    swatch(R"(stroke="#d55e00" stroke-opacity=".45")", size, 11 * size, "was unsupported");
    swatch(root_style, 0.7 * size, 22.5 * size, "root");
    swatch(junction_style, 0.8 * size, 27.5 * size, "junction");
    std::string tip, dot;
    append_triangle(tip, x + 35.2 * size, middle, 0.45 * size);
    append_element(svg, tip_style, tip);
    append_text(svg, x + 36.2 * size, y, size, "tip");
    append_diamond(dot, x + 39.2 * size, middle, 0.45 * size);
    append_element(svg, dot_style, dot);
    append_text(svg, x + 40.2 * size, y, size, "dot");
    if (!overhang) return;
    y += 1.5 * size;
    append_element(svg, "fill=\"" + std::string(overhang_colour) + "\"",
                   "M" + svg_number(x) + " " + svg_number(y) + "h" + svg_number(1.4 * size) + "v-" +
                       svg_number(0.8 * size) + "h-" + svg_number(1.4 * size) + "z");
    append_text(svg, x + 1.8 * size, y, size, "overhangs outside");
}

}  // namespace

LayerDrawing draw_layer(const Slice& slice, const Region& cavity, const SupportForest& forest,
                        const Region& unsupported, const Settings& settings, const Slice* below) {
    LayerDrawing d;
    d.layer = slice.layer;
    d.z_mm = slice.layer == 0 ? to_mm(settings.first_layer_height) / 2
                              : to_mm(settings.first_layer_height) + (slice.layer - 0.5) * to_mm(settings.layer_height);
    d.box = bounding_box(slice.rounded);
    for (auto [v, end] = vertices(forest); v != end; ++v)
        if (forest[*v].outside) d.box.add(forest[*v].at);
    d.support_length_mm = length(forest) / units_per_mm;

    const double width = to_mm(settings.support_width);
    const Marks marks = marks_of(forest, width, d);
    append_element(d.marks, shell_style, region_data(slice.rounded) + region_data(cavity));
    d.overhang = below != nullptr;
    if (below) append_overhang(d.marks, slice.rounded, below->rounded, settings.support_radius, d.layer);
    append_tracks(d.marks, forest, cavity, settings, d.layer);
    append_element(d.marks, unsupported_style, region_data(unsupported));
    append_element(d.marks, line_style, track_data(forest));
    append_element(d.marks, root_style, marks.roots, 0.6 * width);
    append_element(d.marks, junction_style, marks.junctions, 0.8 * width);
    append_element(d.marks, tip_style, marks.tips);
    append_element(d.marks, dot_style, marks.dots);
    return d;
}

std::string layer_svg(const LayerDrawing& drawing) {
    Box box = drawing.box;
    if (box.empty()) box.add({0, 0});
    const double size = std::max(30.0, to_mm(box.hi.x - box.lo.x)) / 45;
    const double left = to_mm(box.lo.x) - margin, top = -to_mm(box.hi.y) - margin;
    const double width = std::max(to_mm(box.hi.x - box.lo.x) + 2 * margin, 40 * size + 2 * margin);
    const double bottom = -to_mm(box.lo.y) + margin;
    const double height = bottom + (drawing.overhang ? 7.7 : 6.3) * size - top;
    std::string svg = svg_start(left, top, width, height, 20);
    svg.append("<title>" + caption(drawing) + "</title>\n" + drawing.marks);
    append_scale_bar(svg, left + margin, bottom + 0.8 * size, size);
    append_text(svg, left + margin, bottom + 2.7 * size, size, caption(drawing));
    append_text(svg, left + margin, bottom + 4.1 * size, size, counts(drawing));
    append_legend(svg, left + margin, bottom + 5.7 * size, 0.9 * size, drawing.overhang);
    svg += "</svg>\n";
    return svg;
}

std::string layer_svg(const Slice& slice, const Region& cavity, const SupportForest& forest, const Region& unsupported,
                      const Settings& settings, const Slice* below) {
    return layer_svg(draw_layer(slice, cavity, forest, unsupported, settings, below));
}

}  // namespace ribvault
