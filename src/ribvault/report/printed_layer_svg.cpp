#include "ribvault/report/printed_layer_svg.hpp"

#include <algorithm>
#include <map>

#include "ribvault/report/boundary_path.hpp"
#include "ribvault/report/number_text.hpp"
#include "ribvault/report/svg_path.hpp"

namespace ribvault {
namespace {

constexpr double margin = 2;  // mm

Point lattice(const GcodePoint& p) {
    const auto units = [](Decimal d) { return static_cast<Unit>(d.value / (decimal_one / units_per_mm)); };
    return {units(p.x), units(p.y)};
}

Point lattice(const std::array<double, 2>& p) {
    return {round_to_lattice(p[0] * units_per_mm), round_to_lattice(p[1] * units_per_mm)};
}

/// All tracks of a layer, one path a width.
std::string tracks(const GcodeLayer& layer, const char* colour) {
    std::map<double, std::string> by_width;
    for (const PrintedLine& line : printed_lines(layer)) append_line(by_width[line.width_mm], line.points);
    std::string svg;
    for (const auto& [width, data] : by_width)
        svg += std::string("<path fill=\"none\" stroke=\"") + colour +
               "\" stroke-linecap=\"round\" stroke-linejoin=\"round\" stroke-width=\"" + svg_number(width) + "\" d=\"" +
               data + "\"/>\n";
    return svg;
}

std::string pieces(const std::vector<HangingPiece>& all, const char* colour) {
    std::string data;
    for (const HangingPiece& p : all) append_line(data, {lattice(p.from), lattice(p.to)});
    if (data.empty()) return {};
    return std::string("<path fill=\"none\" stroke=\"") + colour +
           "\" stroke-linecap=\"round\" stroke-width=\".25\" d=\"" + data + "\"/>\n";
}

std::string text(double x, double y, double size, const std::string& words) {
    return "<text x=\"" + svg_number(x) + "\" y=\"" + svg_number(y) + "\" font-family=\"sans-serif\" font-size=\"" +
           svg_number(size) + "\">" + words + "</text>\n";
}

std::string caption(const HangingLayer& l) {
    Enclosure area;
    for (const HangingRegion& r : l.regions) area += r.area_mm2;
    return "layer " + std::to_string(l.layer) + ", z " + fixed(l.z_mm, 2) + " mm: " + fixed(l.unsupported_mm.hi, 2) +
           " mm of " + fixed(l.length_mm, 1) + " mm hang, " + number_text(area, 2) + " mm²";
}

std::string legend(double x, double y, double size, bool bridges) {
    std::string svg;
    double at = x;
    const auto entry = [&](const char* colour, double width, const char* name, double room) {
        svg += std::string("<path stroke=\"") + colour + "\" stroke-width=\"" + svg_number(width) + "\" d=\"M" +
               svg_number(at) + " " + svg_number(y - 0.35 * size) + "h" + svg_number(size) + "\"/>\n" +
               text(at + 1.4 * size, y, size, name);
        at += room * size;
    };
    entry("#ccc", 0.7 * size, "below", 6);
    entry("#9fd3f5", 0.7 * size, "track", 5.5);
    entry("#d55e00", 0.35 * size, "unsupported", 9.5);
    if (bridges) entry("#009e73", 0.35 * size, "bridge", 6);
    return svg;
}

}  // namespace

std::vector<PrintedLine> printed_lines(const GcodeLayer& layer) {
    std::vector<PrintedLine> lines;
    const GcodeTrack* before = nullptr;
    for (const GcodeTrack& t : layer.tracks) {
        const bool goes_on = before != nullptr && t.a == before->b && t.a != t.b && before->a != before->b &&
                             t.feature == before->feature && t.width == before->width;
        if (!goes_on) {
            lines.push_back({t.feature, static_cast<double>(t.width) * 1e-9, {lattice(layer.points[t.a])}});
        }
        if (t.a != t.b) lines.back().points.push_back(lattice(layer.points[t.b]));
        before = &t;
    }
    return lines;
}

std::string printed_layer_svg(const GcodePrint& print, const PrintReport& report, std::size_t entry) {
    const HangingLayer& hanging = report.layers[entry];
    const GcodeLayer& layer = print.layers[hanging.entry];
    Box box;
    for (const GcodePoint& p : layer.points) box.add(lattice(p));
    const double size = std::max(32.0, to_mm(box.hi.x - box.lo.x)) / 38;
    const double left = to_mm(box.lo.x) - margin, top = -to_mm(box.hi.y) - margin, bottom = -to_mm(box.lo.y) + margin;
    const double width = std::max(to_mm(box.hi.x - box.lo.x) + 2 * margin, 34 * size),
                 height = bottom - top + 4.5 * size;
    const double pixels = std::clamp(1000 / width, 2.0, 20.0);
    std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"" + svg_number(left) + " " +
                      svg_number(top) + " " + svg_number(width) + " " + svg_number(height) + "\" width=\"" +
                      fixed(width * pixels, 0) + "\" height=\"" + fixed(height * pixels, 0) + "\">\n";
    svg += "<title>" + caption(hanging) + "</title>\n<rect x=\"" + svg_number(left) + "\" y=\"" + svg_number(top) +
           "\" width=\"" + svg_number(width) + "\" height=\"" + svg_number(height) + "\" fill=\"#fff\"/>\n";
    for (const std::size_t k : layer.below) svg += tracks(print.layers[k], "#ccc");
    svg += "<g opacity=\".8\">\n" + tracks(layer, "#9fd3f5") + "</g>\n";
    std::string regions;
    for (const HangingRegion& r : hanging.regions) regions += boundary_data(r.boundary, YAxis::down);
    if (!regions.empty()) svg += "<path fill=\"#f0a060\" d=\"" + regions + "\"/>\n";
    svg += pieces(hanging.bridges, "#009e73") + pieces(hanging.pieces, "#d55e00");
    const auto worst = std::max_element(
        hanging.regions.begin(), hanging.regions.end(),
        [](const HangingRegion& a, const HangingRegion& b) { return a.area_mm2.middle() < b.area_mm2.middle(); });
    if (worst != hanging.regions.end())
        svg += "<circle cx=\"" + svg_number(worst->witness[0]) + "\" cy=\"" + svg_number(-worst->witness[1]) +
               "\" r=\"1\" fill=\"none\" stroke=\"#000\" stroke-width=\".12\"/>\n";
    svg += text(left + 0.5 * size, bottom + 1.4 * size, size, caption(hanging));
    svg += legend(left + 0.5 * size, bottom + 3.4 * size, size, report.longest_bridge_mm.has_value());
    return svg + "</svg>\n";
}

}  // namespace ribvault
