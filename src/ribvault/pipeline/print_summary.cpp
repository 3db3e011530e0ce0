#include <algorithm>

#include "ribvault/pipeline/verify_print.hpp"
#include "ribvault/print/gcode_print.hpp"
#include "ribvault/report/number_text.hpp"

namespace ribvault {
namespace {

std::string share(const Enclosure& part, double whole) {
    if (whole <= 0 || part.hi <= 0) return "0 %";
    const double percent = 50 * (part.lo + part.hi) / whole;
    return percent < 0.01 ? "< 0.01 %" : fixed(percent, 2) + " %";
}

std::string where(const HangingFeature& f) {
    return "layer " + std::to_string(f.worst_layer) + ", x " + fixed(f.worst_at[0], 3) + " y " +
           fixed(f.worst_at[1], 3) + ", line " + std::to_string(f.worst_line);
}

/// Outside: inside they are infill.
bool has_supports(const PrintReport& r) {
    return std::any_of(r.features.begin(), r.features.end(), [](const HangingFeature& f) {
        return f.tracks > 0 && f.kind == kind_name(FeatureKind::support);
    });
}

void describe_features(std::string& text, const PrintReport& r) {
    std::size_t width = 12;
    for (const HangingFeature& f : r.features)
        if (f.tracks > 0) width = std::max(width, f.name.size() + (f.judged ? 0 : 13));
    const int w = static_cast<int>(std::min<std::size_t>(width, 40));
    const bool bridges = r.longest_bridge_mm.has_value();
    append_formatted(text, "%-*s %12s %16s %9s %s %-10s %s\n", w, "feature", "length mm", "unsupported mm", "share",
                     bridges ? "   bridges mm " : "", "worst mm", "where");
    const auto row = [&](const std::string& name, double length, const Enclosure& hangs, const Enclosure& bridged,
                         const std::string& worst, const std::string& place) {
        append_formatted(text, "%-*.60s %12.2f %16s %9s ", w, name.c_str(), length, number_text(hangs, 3).c_str(),
                         share(hangs, length).c_str());
        if (bridges) append_formatted(text, "%13s  ", number_text(bridged, 3).c_str());
        append_formatted(text, "%-10s %s\n", worst.c_str(), place.c_str());
    };
    for (const HangingFeature& f : r.features) {
        if (f.tracks == 0) continue;
        if (!f.judged) {
            append_formatted(text, "%-*.60s %12.2f  not judged\n", w, f.name.c_str(), f.length_mm);
            continue;
        }
        const bool hangs = f.worst_layer >= 0;
        row(f.name, f.length_mm, f.unsupported_mm, f.bridged_mm, hangs ? number_text(f.worst_mm, 3) : "-",
            hangs ? where(f) : "");
    }
    row("total", r.length_mm, r.unsupported_mm, r.bridged_mm, "", "");
}

void describe_verdict(std::string& text, const PrintReport& r) {
    if (r.supported) {
        append_formatted(text, "supported  equation (2) holds on all %d layers, decided exactly%s\n", r.layer_count,
                         r.area_mm2.hi > 0     ? ", but for regions that --min-area lets pass"
                         : r.bridged_mm.hi > 0 ? ", but for the bridges"
                                               : "");
        if (r.support_gap_mm > 0 || r.support_gap_layers > 0)
            append_formatted(text,
                             "           across gaps: within %.5g mm and half a nozzle of the object, and with %s left "
                             "empty under it\n",
                             r.support_gap_mm, many(r.support_gap_layers, "layer").c_str());
        if (r.bed_only)
            append_formatted(text,
                             "           with supports that lie on supports alone, down to the bed (--bed-only)\n");
        if (r.inside)
            append_formatted(
                text,
                "           inside the outline of the layer below; what hangs outside it was not judged (--inside)\n");
    } else {
        append_formatted(text, "NOT SUPPORTED  on %d of %d layers, %s mm2 in all have no material within rho below:\n",
                         r.layers_unsupported, r.layer_count, number_text(r.area_mm2, 3).c_str());
        for (const std::size_t k : worst_layers(r, 5)) {
            const HangingLayer& layer = r.layers[k];
            Enclosure area;
            const HangingRegion* worst = nullptr;
            for (const HangingRegion& region : layer.regions) {
                area += region.area_mm2;
                if (worst == nullptr || region.area_mm2.middle() > worst->area_mm2.middle()) worst = &region;
            }
            if (worst == nullptr) continue;
            append_formatted(
                text, "  layer %d (z %.2f): %s mm2 in %zu regions, the largest at x %.3f y %.3f, line %lld\n",
                layer.layer, layer.z_mm, number_text(area, 3).c_str(), layer.regions.size(), worst->witness[0],
                worst->witness[1], static_cast<long long>(worst->lines.empty() ? 0 : worst->lines.front()));
        }
    }
}

}  // namespace

std::string summary(const PrintReport& r, const VerifyJob& job) {
    std::string text;
    append_formatted(
        text, "%s: %s, %lld lines, %d layers; widths %s\n", r.input_path.c_str(),
        r.flavour == "unknown" ? "unknown slicer" : r.flavour.c_str(), static_cast<long long>(r.lines), r.layer_count,
        r.widths_computed == 0 ? "as written"
        : r.widths_written == 0
            ? ("from E, filament " + fixed(r.filament_mm, 2) + " mm (" + r.filament_source + ")").c_str()
            : ("as written, some from E, filament " + fixed(r.filament_mm, 2) + " mm (" + r.filament_source + ")")
                  .c_str());
    append_formatted(text, "judged with rho = %s mm (%s", fixed(r.support_radius_mm, 4).c_str(),
                     r.support_radius_source.c_str());
    if (r.support_radius_source != "--support-radius")
        append_formatted(text, "; nozzle %s mm, %s", fixed(r.nozzle_mm, 2).c_str(), r.nozzle_source.c_str());
    append_formatted(text, ")\n\n");
    describe_features(text, r);
    if (r.set_aside_mm > 0)
        append_formatted(text, "%.2f mm of start and custom G-code are set aside\n", r.set_aside_mm);
    text += '\n';
    describe_verdict(text, r);
    if (!r.supported && !r.inside && r.flavour == "ribvault")
        text += has_supports(r) ? "           where supports leave gaps, give them (--support-gap, "
                                  "--support-gap-layers), as to generate\n"
                                : "           what hangs outside the object counts here; generate leaves it out, and "
                                  "so does --inside\n";
    if (!r.cut.empty()) append_formatted(text, "cut off    %s; judged up to there\n", r.cut.c_str());
    append_formatted(text, "time       %.2f s on %d threads, %.0f MB\n", r.seconds, r.threads, r.peak_memory_mb);
    const std::pair<const char*, const std::optional<std::filesystem::path>&> written[] = {
        {"report", job.report}, {"page", job.html}, {"pictures", job.svg}};
    for (const auto& [name, path] : written)
        if (path) append_formatted(text, "%-10s %s\n", name, path->string().c_str());
    return text;
}

}  // namespace ribvault
