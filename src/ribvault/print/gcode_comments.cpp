#include "ribvault/print/gcode_comments.hpp"

#include <algorithm>
#include <array>

#include "ribvault/lower_case.hpp"

namespace ribvault {
namespace {

constexpr std::size_t most_features = 200;  // a file with more types has none that mean anything

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
}

bool take(std::string_view& text, std::string_view prefix) {
    if (!text.starts_with(prefix)) return false;
    text.remove_prefix(prefix.size());
    return true;
}

/// A positive length in 1e-9 mm; digits beyond are dropped.
std::optional<std::int64_t> length(std::string_view text) {
    const std::optional<Decimal> d = parse_decimal(text);
    if (!d || d->value <= 0 || d->value > Int128{1000} * decimal_one) return std::nullopt;
    return static_cast<std::int64_t>(d->value / (decimal_one / 1000000000));
}

/// A layer's height, to the nearest µm: slicers write 0.200001 for the same height as 0.2.
std::optional<std::int64_t> height_of(std::string_view text) {
    constexpr std::int64_t um = 1000000;
    const std::optional<std::int64_t> height = length(text);
    if (!height || *height < um) return std::nullopt;
    return (*height + um / 2) / um * um;
}

/// "0.4,0.6" or "1.75|1.75": what can be read of it.
std::vector<Decimal> diameters(std::string_view text) {
    std::vector<Decimal> all;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find_first_of(",|;"), text.size());
        if (const auto d = parse_decimal(text.substr(0, end)); d && d->value > 0) all.push_back(*d);
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return all;
}

FeatureKind kind_of(const std::string& name) {
    const auto any = [&](std::initializer_list<const char*> words) {
        return std::any_of(words.begin(), words.end(),
                           [&](const char* w) { return name.find(w) != std::string::npos; });
    };
    if (any({"custom"})) return FeatureKind::custom;
    if (any({"tower", "pillar", "shield"})) return FeatureKind::tower;
    if (any({"skirt", "brim", "raft"})) return FeatureKind::skirt;
    if (any({"support"})) return FeatureKind::support;
    if (any({"bridge", "overhang"})) return FeatureKind::bridge;
    if (any({"solid", "top", "bottom", "skin", "ironing"})) return FeatureKind::solid;
    if (any({"perimeter", "wall"})) return FeatureKind::perimeter;
    if (any({"fill", "single extrusion"})) return FeatureKind::infill;
    return FeatureKind::other;
}

GcodeFeature feature_named(std::string_view name) {
    const std::string lower = lower_case(name);
    GcodeFeature feature{std::string(name), kind_of(lower)};
    feature.outer_wall =
        lower == "external perimeter" || lower == "outer wall" || lower == "wall-outer" || lower == "outer perimeter";
    feature.overhang = lower.starts_with("overhang");
    feature.ironing = lower.find("ironing") != std::string::npos;
    return feature;
}

/// Simplify3D before version 4 and Slic3r name features by these words and nothing else.
constexpr std::array<std::string_view, 17> bare_names{"outer perimeter",
                                                      "inner perimeter",
                                                      "perimeter",
                                                      "infill",
                                                      "solid layer",
                                                      "solid infill",
                                                      "bridge",
                                                      "gap fill",
                                                      "skirt",
                                                      "brim",
                                                      "skirt/brim",
                                                      "raft",
                                                      "support",
                                                      "dense support",
                                                      "support material",
                                                      "support material interface",
                                                      "prime pillar"};

}  // namespace

const char* flavour_name(GcodeFlavour flavour) {
    switch (flavour) {
        case GcodeFlavour::ribvault: return "ribvault";
        case GcodeFlavour::prusa_slicer: return "PrusaSlicer";
        case GcodeFlavour::orca_slicer: return "OrcaSlicer";
        case GcodeFlavour::bambu_studio: return "Bambu Studio";
        case GcodeFlavour::cura: return "CuraEngine";
        case GcodeFlavour::slic3r: return "Slic3r";
        case GcodeFlavour::simplify3d: return "Simplify3D";
        case GcodeFlavour::unknown: break;
    }
    return "unknown";
}

const char* kind_name(FeatureKind kind) {
    switch (kind) {
        case FeatureKind::perimeter: return "perimeter";
        case FeatureKind::infill: return "infill";
        case FeatureKind::solid: return "solid";
        case FeatureKind::bridge: return "bridge";
        case FeatureKind::support: return "support";
        case FeatureKind::skirt: return "skirt";
        case FeatureKind::tower: return "tower";
        case FeatureKind::custom: return "custom";
        case FeatureKind::other: break;
    }
    return "other";
}

GcodeComments::GcodeComments() { known_.emplace("untyped", 0); }

void GcodeComments::set_feature(std::string_view name) {
    name = trimmed(name);
    if (name.empty()) name = "untyped";
    marked = true;
    if (features[feature].name == name) return;
    const auto [place, added] = known_.emplace(name, static_cast<std::uint16_t>(features.size()));
    if (added) {
        if (features.size() == most_features) {
            known_.erase(place);
            feature = 0;
            return;
        }
        features.push_back(feature_named(name));
    }
    feature = place->second;
}

void GcodeComments::note_program(std::string_view comment) {
    static constexpr std::pair<std::string_view, GcodeFlavour> names[] = {{"prusaslicer", GcodeFlavour::prusa_slicer},
                                                                          {"superslicer", GcodeFlavour::prusa_slicer},
                                                                          {"orcaslicer", GcodeFlavour::orca_slicer},
                                                                          {"bambustudio", GcodeFlavour::bambu_studio},
                                                                          {"bambu studio", GcodeFlavour::bambu_studio},
                                                                          {"cura_steamengine", GcodeFlavour::cura},
                                                                          {"slic3r", GcodeFlavour::slic3r},
                                                                          {"simplify3d", GcodeFlavour::simplify3d},
                                                                          {"ribvault", GcodeFlavour::ribvault}};
    const std::string text = lower_case(comment);
    if (text.find("generated") == std::string::npos && !text.starts_with("bambustudio")) return;
    for (const auto& [name, which] : names) {
        if (text.find(name) == std::string::npos) continue;
        flavour = which;
        program = std::string(comment.substr(0, 100));
        return;
    }
}

void GcodeComments::read_setting(std::string_view key, std::string_view value) {
    if (key == "filament_diameter" || key == "filamentDiameters") {
        if (const std::vector<Decimal> found = diameters(value); !found.empty()) {
            filaments.clear();
            for (const Decimal d : found) filaments.push_back(to_double(d));
        }
    } else if (key == "nozzle_diameter" || key == "extruderDiameter" || key == "NOZZLE_DIAMETER" ||
               key == "EXTRUDER_TRAIN.0.NOZZLE.DIAMETER") {
        if (auto found = diameters(value); !found.empty()) nozzles = std::move(found);
    } else if (key == "layer_height" || key == "layerHeight" || key == "Layer height") {
        layer_height = height_of(value);
    } else if (key == "first_layer_height" || key == "initial_layer_print_height") {
        first_layer_height = height_of(value);
    } else if (key == "use_volumetric_e") {
        volumetric = value == "1";
    } else if (key == "FLAVOR") {  // Cura's; UltiGCode's E is volume
        volumetric = value == "UltiGCode" || value.find("Volumetric") != std::string_view::npos;
    }
}

void GcodeComments::read(std::string_view whole) {
    std::string_view text = whole;
    if (take(text, "TYPE:")) return set_feature(text);
    if (take(text, "WIDTH:")) {
        width = length(text);
        return;
    }
    if (take(text, "HEIGHT:")) {
        height = height_of(text);
        return;
    }
    if (take(text, "LAYER:")) {
        ++layers_named_;
        marked = true;
        if (const auto n = parse_decimal(text)) layer = static_cast<int>(n->value / decimal_one);
        raft = raft || (layer && *layer < 0);
        return;
    }
    if (take(text, "LAYER_CHANGE")) {
        marked = true;
        return;
    }
    if (take(text, "LAYER_COUNT:")) {
        if (const auto n = parse_decimal(text)) layers_announced_ = static_cast<std::int64_t>(n->value / decimal_one);
        return;
    }
    text = trimmed(text);
    if (text.empty()) return;
    if (take(text, "FEATURE:") || take(text, "feature ")) return set_feature(text);
    if (take(text, "LINE_WIDTH:")) {
        width = length(text);
        return;
    }
    if (take(text, "LAYER_HEIGHT:")) {
        height = height_of(text);
        return;
    }
    if (take(text, "CHANGE_LAYER")) {
        marked = true;
        return;
    }
    if (text.starts_with("tool H")) {  // Simplify3D: "tool H0.200 W0.480"
        const std::size_t w = text.find(" W");
        height = height_of(text.substr(6, w == std::string_view::npos ? w : w - 6));
        width = w == std::string_view::npos ? std::nullopt : length(text.substr(w + 2));
        return;
    }
    if (flavour == GcodeFlavour::simplify3d) {
        if (text.starts_with("layer ") && text.find("Z =") != std::string_view::npos) marked = true;
        if (std::find(bare_names.begin(), bare_names.end(), text) != bare_names.end()) return set_feature(text);
    }
    if (flavour == GcodeFlavour::unknown || program.empty()) note_program(text);
    if (text == "end of print" || text.starts_with("End of G") || text == "End GCode" ||
        text == "EXECUTABLE_BLOCK_END" || text.starts_with("filament used") || text.ends_with("_config = end"))
        ended_ = true;
    if (text == "EXECUTABLE_BLOCK_START") block_started_ = true;
    const std::size_t sign = text.find_first_of("=:,");
    if (sign != std::string_view::npos && sign < 40)
        read_setting(trimmed(text.substr(0, sign)), trimmed(text.substr(sign + 1)));
}

void GcodeComments::read_behind_move(std::string_view comment) {
    if (flavour != GcodeFlavour::slic3r) return;
    comment = trimmed(comment);
    if (std::find(bare_names.begin(), bare_names.end(), comment) != bare_names.end()) set_feature(comment);
}

std::string GcodeComments::missing_end() const {
    // Cura counts layers in which nothing is printed.
    if (layers_announced_ > layers_named_ && layers_named_ > 0 && !(ended_ && flavour == GcodeFlavour::cura))
        return "it announces " + std::to_string(layers_announced_) + " layers and names " +
               std::to_string(layers_named_);
    if (ended_) return {};
    switch (flavour) {
        case GcodeFlavour::ribvault: return "the line '; end of print' is missing";
        case GcodeFlavour::prusa_slicer: return "the settings that PrusaSlicer writes at the end are missing";
        case GcodeFlavour::cura: return "the line ';End of Gcode' is missing";
        case GcodeFlavour::slic3r: return "the settings that Slic3r writes at the end are missing";
        case GcodeFlavour::orca_slicer:
        case GcodeFlavour::bambu_studio:
            return block_started_ ? "the line '; EXECUTABLE_BLOCK_END' is missing" : "";
        case GcodeFlavour::simplify3d:
        case GcodeFlavour::unknown: break;
    }
    return {};
}

}  // namespace ribvault
