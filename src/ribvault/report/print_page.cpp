#include "ribvault/report/print_page.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "ribvault/report/print_page_template.hpp"
#include "ribvault/report/printed_layer_svg.hpp"

namespace ribvault {
namespace {

using Json = nlohmann::ordered_json;

/// Five bits a character, lowest first, 32 for "more"; the sign in the lowest bit.
void append_number(std::string& text, std::int64_t value) {
    static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
    auto rest = static_cast<std::uint64_t>(value < 0 ? -value : value) * 2 + (value < 0 ? 1 : 0);
    do {
        const std::uint64_t digit = rest % 32;
        rest /= 32;
        text += digits[digit + (rest > 0 ? 32 : 0)];
    } while (rest > 0);
}

/// Points in hundredths of a mm, each relative to the one before.
std::string packed(const std::vector<Point>& points) {
    std::string text;
    std::int64_t x = 0, y = 0;
    bool first = true;
    for (const Point& p : points) {
        const auto hundredths = [](Unit u) { return std::llround(static_cast<double>(u) * 100 / units_per_mm); };
        const std::int64_t nx = hundredths(p.x), ny = hundredths(p.y);
        if (!first && nx == x && ny == y) continue;
        append_number(text, nx - x), append_number(text, ny - y);
        x = nx, y = ny, first = false;
    }
    return text;
}

Json rounded(double value, double places = 1000) {
    if (!std::isfinite(value)) return nullptr;
    return std::round(value * places) / places;
}

Json pieces(const std::vector<HangingPiece>& all) {
    Json list = Json::array();
    for (const HangingPiece& p : all)
        list.push_back({p.feature, p.line, rounded(p.from[0]), rounded(p.from[1]), rounded(p.to[0]), rounded(p.to[1]), rounded(p.distance_mm.hi)});
    return list;
}

Json entry(const GcodePrint& print, const HangingLayer& hanging) {
    const GcodeLayer& layer = print.layers[hanging.entry];
    Json lines = Json::array(), regions = Json::array();
    for (const PrintedLine& line : printed_lines(layer)) lines.push_back({line.feature, std::llround(line.width_mm * 1000), packed(line.points)});
    for (const HangingRegion& r : hanging.regions)
        regions.push_back({rounded(r.area_mm2.lo, 1e6), rounded(r.area_mm2.hi, 1e6), rounded(r.distance_mm.hi), rounded(r.witness[0]),
                           rounded(r.witness[1]), r.lines.empty() ? 0 : r.lines.front(), r.features});
    return {{"layer", hanging.layer},   {"z", rounded(hanging.z_mm)},
            {"bed", hanging.on_bed},    {"length", rounded(hanging.length_mm)},
            {"hangs", rounded(hanging.unsupported_mm.hi)}, {"below", layer.below},
            {"lines", lines},           {"pieces", pieces(hanging.pieces)},
            {"bridges", pieces(hanging.bridges)}, {"regions", regions}};
}

std::string fixed(double value, int places) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", places, value);
    return text;
}

Json content(const GcodePrint& print, const PrintReport& r) {
    Json features = Json::array(), entries = Json::array();
    for (const HangingFeature& f : r.features) {
        Json j{{"name", f.name}, {"judged", f.judged}, {"tracks", f.tracks}, {"length", rounded(f.length_mm)}, {"hangs", rounded(f.unsupported_mm.hi)}};
        if (f.worst_layer >= 0) j["worst"] = rounded(f.worst_mm.hi);
        features.push_back(std::move(j));
    }
    double box[4] = {1e9, 1e9, -1e9, -1e9};
    for (const GcodeLayer& layer : print.layers)
        for (const GcodePoint& p : layer.points) {
            const double x = to_double(p.x), y = to_double(p.y);
            box[0] = std::min(box[0], x), box[1] = std::min(box[1], y), box[2] = std::max(box[2], x), box[3] = std::max(box[3], y);
        }
    for (const HangingLayer& layer : r.layers) entries.push_back(entry(print, layer));
    const std::string name = r.input_path.substr(r.input_path.find_last_of("/\\") + 1);
    const std::string verdict = r.supported ? "Supported on all " + std::to_string(r.layer_count) + " layers."
                                            : "Hangs on " + std::to_string(r.layers_unsupported) + " of " + std::to_string(r.layer_count) + " layers.";
    const std::string facts = (r.flavour == "unknown" ? "" : r.flavour + ", ") + "ρ = " + fixed(r.support_radius_mm, 3) + " mm (" +
                              r.support_radius_source + "); " + fixed(r.unsupported_mm.hi, 1) + " of " + fixed(r.length_mm, 0) + " mm and " +
                              fixed(r.area_mm2.lo, 2) + " to " + fixed(r.area_mm2.hi, 2) + " mm² have no material within ρ below." + (r.cut.empty() ? "" : " The file is cut off: " + r.cut + ".");
    return {{"name", name}, {"supported", r.supported}, {"verdict", verdict}, {"facts", facts}, {"bridges", r.longest_bridge_mm.has_value()}, {"rho", r.support_radius_mm},
            {"box", box},   {"features", features},     {"entries", entries}};
}

}  // namespace

std::string print_page(const GcodePrint& print, const PrintReport& report) {
    constexpr std::string_view mark = "@DATA@";
    std::string json = content(print, report).dump(-1, ' ', false, Json::error_handler_t::replace);
    // A name in the file must not end the script element.
    for (std::size_t at = json.find('<'); at != std::string::npos; at = json.find('<', at + 1)) json.replace(at, 1, "\\u003c");
    const std::string_view page(print_page_template);
    const std::size_t at = page.find(mark);
    return std::string(page.substr(0, at)) + json + std::string(page.substr(at + mark.size()));
}

}  // namespace ribvault
