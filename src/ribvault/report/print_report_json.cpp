#include <nlohmann/json.hpp>

#include "ribvault/report/json_values.hpp"
#include "ribvault/report/print_report.hpp"

namespace ribvault {
namespace {

using Json = nlohmann::ordered_json;

Json point(const std::array<double, 2>& p) { return Json::array({measured(p[0]), measured(p[1])}); }

Json feature(const HangingFeature& f) {
    Json j{{"name", f.name},
           {"kind", f.kind},
           {"judged", f.judged},
           {"tracks", f.tracks},
           {"length_mm", measured(f.length_mm)},
           {"unsupported_mm", bounds(f.unsupported_mm)},
           {"bridged_mm", bounds(f.bridged_mm)},
           {"worst", nullptr}};
    if (f.worst_layer >= 0)
        j["worst"] = {{"distance_mm", bounds(f.worst_mm)},
                      {"layer", f.worst_layer},
                      {"at_mm", point(f.worst_at)},
                      {"line", f.worst_line}};
    return j;
}

Json pieces(const PrintReport& r, const std::vector<HangingPiece>& all) {
    Json list = Json::array();
    for (const HangingPiece& p : all)
        list.push_back({{"line", p.line},
                        {"feature", r.features[static_cast<std::size_t>(p.feature)].name},
                        {"length_mm", measured(p.length_mm)},
                        {"from_mm", point(p.from)},
                        {"to_mm", point(p.to)},
                        {"distance_mm", bounds(p.distance_mm)},
                        {"worst_mm", point(p.worst)}});
    return list;
}

Json exact(const std::array<Rational, 2>& p) { return Json::array({p[0].get_str(), p[1].get_str()}); }

Json curve(const BoundaryCurve& c, std::int64_t line) {
    Json j{{"kind", c.line ? "line" : "circle"}, {"of", c.above ? "above" : "below"}, {"line", line}};
    if (c.line)
        j["from_mm"] = exact(c.a), j["to_mm"] = exact(c.b);
    else
        j["centre_mm"] = exact(c.a);
    j["radius_mm"] = c.radius.get_str();
    return j;
}

/// A whole circle has no vertices: null.
Json piece(const BoundaryPiece& p) {
    const auto vertex = [](std::size_t v) -> Json { return v == BoundaryPiece::nowhere ? Json(nullptr) : Json(v); };
    return Json::array({p.curve, vertex(p.from), vertex(p.to), p.turn});
}

Json boundary(const HangingRegion& region) {
    const RegionBoundary& b = region.boundary;
    Json curves = Json::array(), vertices = Json::array(), components = Json::array();
    for (std::size_t k = 0; k < b.curves.size(); ++k) curves.push_back(curve(b.curves[k], region.curve_lines[k]));
    for (const BoundaryVertex& v : b.vertices)
        vertices.push_back({{"curves", {v.first, v.second}},
                            {"root", v.root},
                            {"x_mm", bounds({v.x[0], v.x[1]})},
                            {"y_mm", bounds({v.y[0], v.y[1]})}});
    for (const RegionComponent& c : b.components) {
        Json loops = Json::array();
        for (const BoundaryLoop& loop : c.loops) {
            Json pieces = Json::array();
            for (const BoundaryPiece& p : loop) pieces.push_back(piece(p));
            loops.push_back(std::move(pieces));
        }
        components.push_back({{"area_mm2", bounds({c.area_lo, c.area_hi})}, {"loops", std::move(loops)}});
    }
    return {{"curves", std::move(curves)}, {"vertices", std::move(vertices)}, {"components", std::move(components)}};
}

Json regions(const PrintReport& r, const std::vector<HangingRegion>& all) {
    Json list = Json::array();
    for (const HangingRegion& region : all) {
        Json names = Json::array();
        for (const int f : region.features) names.push_back(r.features[static_cast<std::size_t>(f)].name);
        Json j{{"area_mm2", bounds(region.area_mm2)},
               {"distance_mm", bounds(region.distance_mm)},
               {"witness_mm", region.witness_exact},
               {"witness_certified", region.witness_certified},
               {"witness_distance_mm", bounds({region.witness_distance_mm, 0})[0]},
               {"lines", region.lines},
               {"features", names},
               {"ignored", region.ignored}};
        if (r.boundaries) j["boundary"] = boundary(region);
        list.push_back(std::move(j));
    }
    return list;
}

Json layer(const PrintReport& r, const HangingLayer& l) {
    return {{"layer", l.layer},
            {"z_mm", measured(l.z_mm)},
            {"height_mm", measured(l.height_mm)},
            {"on_bed", l.on_bed},
            {"supported", l.supported},
            {"length_mm", measured(l.length_mm)},
            {"unsupported_mm", bounds(l.unsupported_mm)},
            {"bridged_mm", bounds(l.bridged_mm)},
            {"pieces", pieces(r, l.pieces)},
            {"bridges", pieces(r, l.bridges)},
            {"regions", regions(r, l.regions)},
            {"stages", stages(l.stages)}};
}

std::string text_of(const Json& j) { return j.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace

std::string to_json(const PrintReport& r) {
    std::vector<int> unsupported;
    for (const HangingLayer& l : r.layers)
        if (!l.supported && (unsupported.empty() || unsupported.back() != l.layer)) unsupported.push_back(l.layer);
    const Json input{{"path", r.input_path},
                     {"bytes", r.bytes},
                     {"lines", r.lines},
                     {"flavour", r.flavour},
                     {"program", r.program},
                     {"cut", r.cut.empty() ? Json(nullptr) : Json(r.cut)},
                     {"set_aside_mm", measured(r.set_aside_mm)},
                     {"widths_written", r.widths_written},
                     {"widths_computed", r.widths_computed}};
    const Json settings{{"support_radius_mm", r.support_radius_mm},
                        {"support_radius_exact_mm", r.support_radius_exact},
                        {"support_radius_source", r.support_radius_source},
                        {"nozzle_mm", r.nozzle_mm},
                        {"nozzle_source", r.nozzle_source},
                        {"filament_diameter_mm", r.filament_mm},
                        {"filament_source", r.filament_source},
                        {"layer_height_mm", r.layer_height_mm ? Json(*r.layer_height_mm) : Json(nullptr)},
                        {"infill_layers", r.infill_layers},
                        {"allow_bridges_mm", r.longest_bridge_mm ? Json(*r.longest_bridge_mm) : Json(nullptr)},
                        {"min_area_mm2", r.min_area_mm2},
                        {"inside", r.inside},
                        {"support_gap_mm", r.support_gap_mm},
                        {"support_gap_layers", r.support_gap_layers},
                        {"bed_only", r.bed_only}};
    const Json verdict{{"supported", r.supported},
                       {"layers", r.layer_count},
                       {"layers_unsupported", unsupported},
                       {"layers_without_outline", r.layers_without_outline},
                       {"stages", stages(r.stages)}};
    const Json totals{{"length_mm", measured(r.length_mm)},
                      {"unsupported_mm", bounds(r.unsupported_mm)},
                      {"bridged_mm", bounds(r.bridged_mm)},
                      {"area_mm2", bounds(r.area_mm2)}};
    const Json machine{{"threads", r.threads},
                       {"seconds", r.seconds},
                       {"read_seconds", r.read_seconds},
                       {"peak_memory_mb", r.peak_memory_mb}};
    std::string text = "{\n\"schema\": \"ribvault-verify/1\",\n";
    const auto member = [&](const char* name, const Json& j) {
        text += std::string("\"") + name + "\": " + text_of(j) + ",\n";
    };
    member("program", {{"name", "ribvault"}, {"version", r.version}});
    member("input", input);
    member("settings", settings);
    member("verdict", verdict);
    member("totals", totals);
    text += "\"features\": [";
    for (std::size_t k = 0; k < r.features.size(); ++k)
        text += (k > 0 ? ",\n" : "\n") + text_of(feature(r.features[k]));
    text += "\n],\n\"layers\": [";
    for (std::size_t k = 0; k < r.layers.size(); ++k) text += (k > 0 ? ",\n" : "\n") + text_of(layer(r, r.layers[k]));
    text += "\n],\n\"machine\": " + text_of(machine) + "\n}\n";
    return text;
}

}  // namespace ribvault
