#include <nlohmann/json.hpp>

#include "ribvault/report/json_values.hpp"
#include "ribvault/report/report_members.hpp"

namespace ribvault {
namespace {

using Json = nlohmann::ordered_json;

Json facts(const MeshFacts& f) {
    return {{"triangles", f.triangles},
            {"vertices", f.vertices},
            {"size_mm", {measured(f.size_mm[0]), measured(f.size_mm[1]), measured(f.size_mm[2])}},
            {"volume_mm3", measured(f.volume_mm3)},
            {"components", f.components},
            {"closed", f.closed()},
            {"boundary_edges", f.boundary_edges},
            {"non_manifold_edges", f.non_manifold_edges},
            {"unbalanced_edges", f.unbalanced_edges},
            {"degenerate_triangles", f.degenerate_triangles},
            {"duplicate_triangles", f.duplicate_triangles},
            {"inverted_components", f.inverted_components}};
}

Json placement(const Placement& p) {
    Json axes = Json::array(), offset = Json::array();
    for (std::size_t k = 0; k < 3; ++k) {
        axes.push_back(std::string(p.sign[k] < 0 ? "-" : "+") + "xyz"[p.axis[k]]);
        offset.push_back(p.offset[k].get_str());
    }
    const Json rotation = p.rotation ? Json(*p.rotation) : Json(nullptr);
    return {{"rotation", rotation}, {"axes", axes}, {"scale", p.scale.get_str()}, {"offset_mm", offset}};
}

const char* name_of(QuarterBonus places) {
    return places == QuarterBonus::nowhere ? "nowhere" : places == QuarterBonus::narrow ? "narrow" : "everywhere";
}

Json settings(const Settings& s) {
    return {{"layer_height_mm", to_mm(s.layer_height)},
            {"first_layer_height_mm", to_mm(s.first_layer_height)},
            {"nozzle_mm", to_mm(s.nozzle)},
            {"support_width_mm", to_mm(s.support_width)},
            {"support_radius_mm", to_mm(s.support_radius)},
            {"perimeters", s.perimeters},
            {"top_layers", s.top_layers},
            {"bottom_layers", s.bottom_layers},
            {"propagation", s.propagation == Propagation::shrink ? "shrink" : "erode_straighten"},
            {"order", s.order == Order::doubling ? "doubling" : "distance"},
            {"support", s.support == Support::external ? "external"
                        : s.support == Support::both   ? "both"
                                                       : "internal"},
            {"support_gap_mm", to_mm(s.support_gap)},
            {"support_gap_layers", s.support_gap_layers},
            {"bed_only", s.bed_only},
            {"pillars", s.pillars},
            {"pillar_length_mm", to_mm(s.pillar_length)},
            {"leaning_length_mm", to_mm(s.leaning_length)},
            {"leaning_ratio", s.leaning_ratio},
            {"trim", s.trim},
            {"gaps", s.gaps == Gaps::proved  ? "proved"
                     : s.gaps == Gaps::paper ? "paper"
                                             : "none"},
            {"erosion_step_mm", to_mm(s.erosion_step)},
            {"straighten", s.straighten && s.propagation != Propagation::shrink},
            {"straighten_step_mm", to_mm(s.straighten_step)},
            {"branch_bonus", s.branch_bonus},
            {"branch_bonus_length_mm", to_mm(s.branch_bonus_length)},
            {"quarter_bonus", name_of(s.quarter_bonus)},
            {"choose_bonus", s.choose_bonus},
            {"length_bound", s.length_bound},
            {"valence_limit", s.valence_limit},
            {"wall_lines", s.wall_lines},
            {"wall_lines_longer_mm", to_mm(s.wall_lines_longer)},
            {"wall_lines_taller_mm", to_mm(s.wall_lines_taller)},
            {"brace_mm", to_mm(s.brace)},
            {"seed", s.seed},
            {"tries", s.tries},
            {"sampling_pitch_mm", to_mm(s.sampling_pitch)},
            {"slack_mm", to_mm(s.slack)},
            {"max_gap_mm", to_mm(s.max_gap)}};
}

Json tracks(const TrackSettings& t, const Settings& s) {
    static constexpr const char* patterns[] = {"zigzag", "monotonic", "concentric"};
    static constexpr const char* gap_fills[] = {"all", "needed", "none"};
    static constexpr const char* seams[] = {"aligned", "corner", "nearest"};
    return {{"inner_first", t.inner_first},
            {"alternate", t.alternate},
            {"covers", patterns[static_cast<std::size_t>(t.covers)]},
            {"seam", seams[static_cast<std::size_t>(t.seam)]},
            {"thin_walls", t.thin_walls},
            {"fill_gaps", t.fill_gaps != GapFill::none},
            {"gap_fill", gap_fills[static_cast<std::size_t>(t.fill_gaps)]},
            {"resolution_mm", to_mm(t.resolution)},
            {"first_layer_width_mm", to_mm(t.width_on(0, s.nozzle))},
            {"skirt_loops", t.skirt_loops},
            {"skirt_distance_mm", to_mm(t.skirt_distance)},
            {"brim_width_mm", to_mm(t.brim_width)}};
}

Json printer(const PrinterSettings& p) {
    static constexpr const char* flavours[] = {"marlin", "klipper", "reprapfirmware"};
    return {{"name", p.name},
            {"flavour", flavours[static_cast<std::size_t>(p.flavour)]},
            {"filament_diameter_mm", p.filament_diameter},
            {"nozzle_temperature_c", p.nozzle_temperature},
            {"bed_temperature_c", p.bed_temperature},
            {"first_layer_temperature_c", p.first_layer_temperature},
            {"first_layer_bed_temperature_c", p.first_layer_bed_temperature},
            {"support_extruder", p.support_extruder},
            {"support_temperature_c", p.support_temperature},
            {"fan_percent", p.fan_percent},
            {"print_speed_mm_s", p.print_speed},
            {"support_speed_mm_s", p.support_speed},
            {"first_layer_speed_mm_s", p.first_layer_speed},
            {"min_layer_time_s", p.min_layer_time},
            {"min_print_speed_mm_s", p.min_print_speed},
            {"travel_speed_mm_s", p.travel_speed},
            {"retraction_mm", p.retraction},
            {"retraction_speed_mm_s", p.retraction_speed},
            {"retract_over_mm", p.retract_over},
            {"longest_detour_mm", p.longest_detour},
            {"prime_surplus", p.prime_surplus},
            {"surplus_clearance_mm", p.surplus_clearance},
            {"bed_mm", {p.bed_x, p.bed_y, p.bed_z}},
            {"round_bed", p.round_bed},
            {"bed_corner_mm", p.corner_of_bed()},
            {"origin_at_centre", p.origin_at_centre},
            {"speed_limits_mm_s", p.limits.speed},
            {"acceleration_limits_mm_s2", p.limits.acceleration},
            {"jerk_mm_s", p.limits.jerk},
            {"print_acceleration_mm_s2", p.limits.print_acceleration},
            {"retract_acceleration_mm_s2", p.limits.retract_acceleration},
            {"travel_acceleration_mm_s2", p.limits.travel_acceleration}};
}

/// Bounds and witnesses are not rounded: the statement is about these very numbers.
Json unsupported(const std::optional<Unsupported>& u) {
    if (!u) return nullptr;
    return {{"area_mm2", {u->area_lo, u->area_hi}},
            {"witness_mm", u->witness},
            {"witness_certified", u->witness_certified},
            {"witness_distance_mm", u->witness_distance}};
}

Json verdict(const LayerVerdict& v) {
    return {{"supported", v.supported},
            {"internal", unsupported(v.internal)},
            {"external", unsupported(v.external)},
            {"malformed", v.malformed.empty() ? Json(nullptr) : Json(v.malformed)},
            {"stages", stages(v.stages)}};
}

Json print_verdict(const PrintVerdict& v) {
    return {{"supported", v.supported},
            {"unsupported_mm", bounds(v.unsupported_mm)},
            {"external_mm", bounds(v.external_mm)},
            {"place_mm", v.supported ? Json(nullptr) : Json(v.place)},
            {"stages", stages(v.stages)}};
}

Json layer_members(const LayerReport& l) {
    Json closings = Json::array();
    for (const GapClosing& c : l.closings) closings.push_back({{"x_mm", c.x}, {"y_mm", c.y}, {"length_mm", c.length}});
    return {{"layer", l.layer},
            {"z_mm", measured(l.z_mm)},
            {"shell_area_mm2", measured(l.shell_area_mm2)},
            {"shell_volume_mm3", measured(l.shell_volume_mm3)},
            {"support_length_mm", measured(l.support_length_mm)},
            {"support_length_bound_mm", measured(l.support_length_bound_mm)},
            {"support_printed_length_mm", measured(l.support_printed_length_mm)},
            {"support_volume_mm3", measured(l.support_volume_mm3)},
            {"external_support_printed_length_mm", measured(l.external_support_printed_length_mm)},
            {"external_support_volume_mm3", measured(l.external_support_volume_mm3)},
            {"gaps", l.gaps},
            {"perimeter_length_mm", measured(l.perimeter_length_mm)},
            {"cover_length_mm", measured(l.cover_length_mm)},
            {"thin_wall_length_mm", measured(l.thin_wall_length_mm)},
            {"thin_places", l.thin_places},
            {"thin_area_mm2", measured(l.thin_area_mm2)},
            {"unfilled_area_mm2", measured(l.unfilled_area_mm2)},
            {"filament_mm", measured(l.filament_mm)},
            {"extruded_mm3", measured(l.extruded_mm3)},
            {"prime_surplus_mm3", measured(l.prime_surplus_mm3)},
            {"travels", l.travels},
            {"travel_mm", measured(l.travel_mm)},
            {"open_air_mm", measured(l.open_air_mm)},
            {"retractions", l.retractions},
            {"detours", l.detours},
            {"print_seconds", measured(l.print_seconds)},
            {"trees", l.trees},
            {"wide_trees", l.wide_trees},
            {"braces", l.braces},
            {"slenderness", measured(l.slenderness)},
            {"slender_standing_mm", measured(l.slender_standing_mm)},
            {"slender_to_root_mm", measured(l.slender_to_root_mm)},
            {"slender_at_mm", {measured(l.slender_at[0]), measured(l.slender_at[1])}},
            {"closed_gaps", l.closed_gaps},
            {"bends", l.bends},
            {"patches", l.patches},
            {"patch_in_gap", l.patch_in_gap},
            {"patch_length_mm", measured(l.patch_length_mm)},
            {"verdict", verdict(l.verdict)},
            {"print", print_verdict(l.print)},
            {"closings", closings},
            {"slivers_removed", l.slivers_removed},
            {"empty", l.empty}};
}

Json summary(const VerdictSummary& v) {
    Json external = Json::array();
    for (const ExternalOverhang& o : v.external_overhangs)
        external.push_back({{"layer", o.layer}, {"area_mm2", {o.area_lo_mm2, o.area_hi_mm2}}});
    return {{"proved", v.proved},
            {"layers_proved", v.layers_proved},
            {"layers_refuted", v.layers_refuted},
            {"external_overhangs", external},
            {"layers_with_patches_in_gap", v.layers_with_patches_in_gap},
            {"stages", stages(v.stages)},
            {"print",
             {{"proved", v.print_proved},
              {"layers_refuted", v.print_layers_refuted},
              {"unsupported_mm", bounds(v.print_unsupported_mm)},
              {"external_mm", bounds(v.print_external_mm)},
              {"layers_over_narrow_places", v.layers_over_narrow_places},
              {"stages", stages(v.print_stages)}}}};
}

Json totals(const RunTotals& t, std::size_t layers) {
    return {{"layers", layers},
            {"shell_volume_mm3", measured(t.shell_volume_mm3)},
            {"support_volume_mm3", measured(t.support_volume_mm3)},
            {"external_support_volume_mm3", measured(t.external_support_volume_mm3)},
            {"external_support_printed_length_mm", measured(t.external_support_printed_length_mm)},
            {"material_mm3", measured(t.material_mm3)},
            {"support_length_mm", measured(t.support_length_mm)},
            {"support_length_bound_mm", measured(t.support_length_bound_mm)},
            {"support_printed_length_mm", measured(t.support_printed_length_mm)},
            {"perimeter_length_mm", measured(t.perimeter_length_mm)},
            {"cover_length_mm", measured(t.cover_length_mm)},
            {"thin_wall_length_mm", measured(t.thin_wall_length_mm)},
            {"thin_places", t.thin_places},
            {"thin_area_mm2", measured(t.thin_area_mm2)},
            {"unfilled_area_mm2", measured(t.unfilled_area_mm2)},
            {"filament_mm", measured(t.filament_mm)},
            {"extruded_mm3", measured(t.extruded_mm3)},
            {"prime_surplus_mm3", measured(t.prime_surplus_mm3)},
            {"travels", t.travels},
            {"travel_mm", measured(t.travel_mm)},
            {"open_air_mm", measured(t.open_air_mm)},
            {"retractions", t.retractions},
            {"detours", t.detours},
            {"print_seconds", measured(t.print_seconds)},
            {"slenderness", measured(t.slenderness)},
            {"slenderest_layer", t.slenderest_layer},
            {"wide_trees", t.wide_trees},
            {"braces", t.braces},
            {"gaps", t.gaps},
            {"closed_gaps", t.closed_gaps},
            {"bends", t.bends},
            {"patches", t.patches},
            {"patch_length_mm", measured(t.patch_length_mm)},
            {"closings", t.closings},
            {"layers_with_slivers_removed", t.layers_with_slivers_removed}};
}

Json machine(const MachineFacts& m) {
    Json seconds = Json::object();
    for (const auto& [stage, s] : m.stage_seconds) seconds[stage] = measured(s);
    return {{"threads", m.threads},
            {"seconds", measured(m.seconds)},
            {"peak_memory_mb", measured(m.peak_memory_mb)},
            {"stage_seconds", seconds}};
}

std::string text_of(const Json& value) { return value.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace

std::string layer_json(const LayerReport& layer) { return text_of(layer_members(layer)); }

std::string run_members(const RunReport& report, std::string_view separator) {
    std::string text;
    const auto member = [&](const char* name, const Json& value) {
        text.append(text.empty() ? "" : separator).append("\"").append(name).append("\": ").append(text_of(value));
    };
    member("program", {{"name", "ribvault"}, {"version", report.version}});
    member("input",
           {{"path", report.input_path}, {"mesh", facts(report.input)}, {"placement", placement(report.placement)}});
    member("settings", settings(report.settings));
    member("tracks", tracks(report.tracks, report.settings));
    member("printer", printer(report.printer));
    Json candidates = Json::array();
    for (const Candidate& c : report.candidates)
        candidates.push_back({{"quarter_bonus", name_of(c.quarter_bonus)},
                              {"seed", c.seed},
                              {"support_length_mm", measured(c.length_mm)},
                              {"tips", c.tips},
                              {"cost_mm", measured(c.cost_mm)}});
    member("candidates", candidates);
    member("verdict", summary(report.verdict));
    member("totals", totals(report.totals, report.layers.size()));
    return text;
}

std::string to_json(const RunReport& report) {
    std::string text = "{\n  \"schema\": \"ribvault-run/1\",\n  " + run_members(report, ",\n  ") + ",\n  \"layers\": [";
    for (std::size_t i = 0; i < report.layers.size(); ++i)
        text.append(i == 0 ? "\n    " : ",\n    ").append(layer_json(report.layers[i]));
    text += report.layers.empty() ? "]" : "\n  ]";
    text += ",\n  \"machine\": " + text_of(machine(report.machine)) + "\n}\n";
    return text;
}

}  // namespace ribvault
