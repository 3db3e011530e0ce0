#include "ribvault/report/print_page.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <nlohmann/json.hpp>

#include "ribvault/report/boundary_path.hpp"
#include "ribvault/report/number_text.hpp"
#include "ribvault/report/packed.hpp"
#include "ribvault/report/printed_layer_svg.hpp"

namespace ribvault {
namespace {

using Json = nlohmann::ordered_json;

Json rounded(double value, double places = 1000) {
    if (!std::isfinite(value)) return nullptr;
    return std::round(value * places) / places;
}

Json pieces(const std::vector<HangingPiece>& all) {
    Json list = Json::array();
    for (const HangingPiece& p : all)
        list.push_back({p.feature, p.line, rounded(p.from[0]), rounded(p.from[1]), rounded(p.to[0]), rounded(p.to[1]),
                        rounded(p.distance_mm.hi)});
    return list;
}

/// Per feature of the layer: its index, the length of its centre lines in mm, and length times width times height in
/// mm³ (of dots: a disc's area times height).
Json lengths(const GcodeLayer& layer) {
    std::map<int, std::array<double, 2>> sums;
    for (const GcodeTrack& t : layer.tracks) {
        const GcodePoint &a = layer.points[t.a], &b = layer.points[t.b];
        const double length = std::hypot(to_double(b.x) - to_double(a.x), to_double(b.y) - to_double(a.y));
        sums[t.feature][0] += length;
        const double width = static_cast<double>(t.width) * 1e-9, height = static_cast<double>(layer.height) * 1e-9;
        sums[t.feature][1] += (t.a == t.b ? std::numbers::pi / 4 * width : length) * width * height;
    }
    Json list = Json::array();
    for (const auto& [feature, sum] : sums) list.push_back({feature, rounded(sum[0]), rounded(sum[1])});
    return list;
}

Json numbers(const GcodeLayer& layer, const HangingLayer& hanging) {
    Json regions = Json::array();
    for (const HangingRegion& r : hanging.regions)
        regions.push_back({rounded(r.area_mm2.lo, 1e6), rounded(r.area_mm2.hi, 1e6), rounded(r.distance_mm.hi),
                           rounded(r.witness[0]), rounded(r.witness[1]), r.lines.empty() ? 0 : r.lines.front(),
                           r.features, boundary_data(r.boundary, YAxis::up)});
    return {{"layer", hanging.layer},   {"z", rounded(hanging.z_mm)},
            {"height", rounded(hanging.height_mm)},
            {"bed", hanging.on_bed},    {"length", rounded(hanging.length_mm)},
            {"hangs", rounded(hanging.unsupported_mm.hi)}, {"below", layer.below},
            {"lengths", lengths(layer)}, {"pieces", pieces(hanging.pieces)},
            {"bridges", pieces(hanging.bridges)}, {"regions", regions}};
}

/// Lines: feature, width in µm, points.
std::string packed_lines(const GcodeLayer& layer) {
    Packed out;
    const std::vector<PrintedLine> lines = printed_lines(layer);
    out.natural(lines.size());
    for (const PrintedLine& line : lines) {
        out.natural(line.feature);
        out.natural(static_cast<std::uint64_t>(std::llround(line.width_mm * 1000)));
        out.points(line.points);
    }
    return out.bytes();
}

Json facts(const GcodePrint& print, const PrintReport& r) {
    Json features = Json::array();
    for (const HangingFeature& f : r.features) {
        Json j{{"name", f.name},
               {"kind", f.kind},
               {"judged", f.judged},
               {"tracks", f.tracks},
               {"length", rounded(f.length_mm)},
               {"hangs", rounded(f.unsupported_mm.hi)}};
        if (f.worst_layer >= 0) j["worst"] = rounded(f.worst_mm.hi);
        features.push_back(std::move(j));
    }
    double box[4] = {1e9, 1e9, -1e9, -1e9};
    for (const GcodeLayer& layer : print.layers)
        for (const GcodePoint& p : layer.points) {
            const double x = to_double(p.x), y = to_double(p.y);
            box[0] = std::min(box[0], x), box[1] = std::min(box[1], y), box[2] = std::max(box[2], x),
            box[3] = std::max(box[3], y);
        }
    const std::string name = r.input_path.substr(r.input_path.find_last_of("/\\") + 1);
    const std::string verdict = r.supported ? "Supported on all " + std::to_string(r.layer_count) + " layers."
                                            : "Hangs on " + std::to_string(r.layers_unsupported) + " of " +
                                                  std::to_string(r.layer_count) + " layers.";
    const std::string rule =
        (r.flavour == "unknown" ? "" : r.flavour + ", ") + "ρ = " + fixed(r.support_radius_mm, 3) + " mm (" +
        r.support_radius_source + ")" + (r.inside ? ", inside the outline of the layer below" : "") +
        (r.support_gap_mm > 0 ? ", removal gap " + fixed(r.support_gap_mm, 3) + " mm" : "") +
        (r.support_gap_layers > 0 ? ", " + many(r.support_gap_layers, "layer") + " left empty over supports" : "") +
        (r.bed_only ? ", supports on the bed alone" : "") + "; ";
    const bool all = r.unsupported_mm.hi == 0 && r.area_mm2.hi == 0,
               apart = r.inside || r.support_gap_mm > 0 || r.support_gap_layers > 0 || r.bed_only;
    const std::string found =
        all ? "all " + fixed(r.length_mm, 0) + " mm of tracks " +
                  (apart ? "are held up by these rules." : "have material within ρ below.")
            : fixed(r.unsupported_mm.hi, 1) + " of " + fixed(r.length_mm, 0) + " mm and " +
                  number_text(r.area_mm2, 2) + " mm² " +
                  (apart ? "are not held up by these rules." : "have no material within ρ below.");
    const std::string words = rule + found + (r.cut.empty() ? "" : " The file is cut off: " + r.cut + ".");
    return {{"kind", "gcode"},
            {"name", name},
            {"supported", r.supported},
            {"verdict", verdict},
            {"words", words},
            {"bridges", r.longest_bridge_mm.has_value()},
            {"rho", r.support_radius_mm},
            {"apart", apart},  // judged by rules that are not equation (2) everywhere
            {"box", box},
            {"features", features}};
}

}  // namespace

void append_print(RunPage& page, const GcodePrint& print, const PrintReport& report) {
    page.begin_run();
    for (const HangingLayer& hanging : report.layers) {
        const GcodeLayer& layer = print.layers[hanging.entry];
        page.add_layer(page_record(numbers(layer, hanging).dump(), packed_lines(layer)));
    }
    page.end_run(facts(print, report).dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace ribvault
