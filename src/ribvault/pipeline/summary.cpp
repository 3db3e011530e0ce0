#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>

#include "ribvault/pipeline/generate.hpp"
#include "ribvault/report/number_text.hpp"

namespace ribvault {
namespace {

__attribute__((format(printf, 2, 3))) void print(std::string& text, const char* format, ...) {
    char line[512];
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    text += line;
}

void describe_verdict(std::string& text, const RunReport& r) {
    const auto layers = static_cast<int>(r.layers.size());
    const bool gap = r.settings.reach_of_object() > r.settings.support_radius;
    if (r.verdict.proved)
        print(text, "proved    equation (2) holds on all %d layers, decided exactly%s\n", layers,
              r.verdict.print_proved ? ",\n          for the geometry and for what is extruded" : "");
    if (r.verdict.proved && gap)
        print(text,
              "          across the removal gap: outside, all is within rho of a support or within %.5g mm (g + r) of "
              "the object\n",
              to_mm(r.settings.reach_of_object()));
    if (r.verdict.proved && r.settings.support_gap_layers > 0)
        print(text,
              "          through the layers left empty: outside, the object lies on a support, on itself or on the bed "
              "at most %d layers farther down\n",
              r.settings.support_gap_layers);
    if (r.verdict.proved && r.settings.bed_only)
        print(text, "          on the bed alone: external supports stand on each other, nowhere on the object\n");
    if (gap && !r.verdict.external_overhangs.empty())
        print(text,
              "warning   on %zu layers there are crevices where the gap leaves no room for a support within rho; see "
              "\"external_overhangs\"\n",
              r.verdict.external_overhangs.size());
    if (!r.verdict.layers_with_patches_in_gap.empty())
        print(text,
              "warning   on %zu layers the object is too thin to be printed as thin as it is, and its tracks come "
              "nearer to a support than the gap\n",
              r.verdict.layers_with_patches_in_gap.size());
    if (!r.verdict.proved)
        print(text, "NOT PROVED  %zu of %d layers are not supported:\n", r.verdict.layers_refuted.size(), layers);
    int shown = 0;
    for (const LayerReport& layer : r.layers) {
        if (layer.verdict.supported || shown++ == 5) continue;
        if (const auto& hole = layer.verdict.internal ? layer.verdict.internal : layer.verdict.external)
            print(text, "  layer %d: %.3g to %.3g mm2, among them (%.6f, %.6f) mm\n", layer.layer, hole->area_lo,
                  hole->area_hi, hole->witness[0], hole->witness[1]);
        else
            print(text, "  layer %d: %s\n", layer.layer, layer.verdict.malformed.c_str());
    }
    if (!r.verdict.print_proved) {
        const double mm = r.verdict.print_unsupported_mm[1];
        const std::string what = mm < 0.0005 ? "sides of tracks, no centre line," : fixed(mm, 3) + " mm";
        print(text, "%s  of what is extruded, %s on %zu of %d layers hang in air:\n",
              r.settings.gaps == Gaps::paper ? "warning " : "NOT PROVED", what.c_str(),
              r.verdict.print_layers_refuted.size(), layers);
        int named = 0;
        for (const LayerReport& layer : r.layers)
            if (!layer.print.supported && named++ < 5)
                print(text, "  layer %d, near (%.3f, %.3f) mm\n", layer.layer, layer.print.place[0],
                      layer.print.place[1]);
    }
    if (!r.verdict.external_overhangs.empty() && !r.settings.outside()) {
        double area = 0;
        const ExternalOverhang* worst = &r.verdict.external_overhangs.front();
        for (const ExternalOverhang& o : r.verdict.external_overhangs) {
            area += o.area_hi_mm2;
            if (o.area_hi_mm2 > worst->area_hi_mm2) worst = &o;
        }
        print(text,
              "warning   the outside overhangs on %zu layers (at most %.3g mm2 in all, most on layer %d):\n"
              "          no internal support can hold that (--support both does); see \"external_overhangs\" in the "
              "report\n",
              r.verdict.external_overhangs.size(), area, worst->layer);
    }
}

}  // namespace

std::string summary(const RunReport& r, const Job& job) {
    std::string text;
    print(text, "%s: %zu triangles, %.2f x %.2f x %.2f mm, ", r.input_path.c_str(), r.input.triangles,
          r.input.size_mm[0], r.input.size_mm[1], r.input.size_mm[2]);
    if (r.input.closed())
        print(text, "%.1f mm3, ", std::abs(r.input.volume_mm3));
    else
        text += "not closed, ";
    print(text, "%zu component%s, %zu layers\n", r.input.components, r.input.components == 1 ? "" : "s",
          r.layers.size());
    describe_verdict(text, r);
    print(text, "material  %.1f mm3: shell and covers %.1f, supports %.1f (%.0f mm of track)", r.totals.material_mm3,
          r.totals.shell_volume_mm3, r.totals.support_volume_mm3, r.totals.support_printed_length_mm);
    if (r.settings.outside())
        print(text, ", external supports %.1f (%.0f mm)", r.totals.external_support_volume_mm3,
              r.totals.external_support_printed_length_mm);
    print(text, "; %.2f m of filament, %.1f mm3\n", r.totals.filament_mm / 1000, r.totals.extruded_mm3);
    if (r.settings.length_bound)
        print(
            text,
            "bound     whatever the method, internal supports need at least %.0f mm of track; here they have %.0f mm\n",
            r.totals.support_length_bound_mm, r.totals.support_length_mm);
    print(text, "print     about %.0f min; %ld travels, %.1f m, %ld retractions\n", r.totals.print_seconds / 60,
          r.totals.travels, r.totals.travel_mm / 1000, r.totals.retractions);
    if (r.totals.slenderness > 0) {
        const LayerReport& l = r.layers[static_cast<std::size_t>(r.totals.slenderest_layer)];
        print(text,
              "walls     most slender on layer %d at (%.1f, %.1f) mm: %.1f mm high, %.1f mm from a root, ratio %.0f\n",
              l.layer, l.slender_at[0], l.slender_at[1], l.slender_standing_mm, l.slender_to_root_mm, l.slenderness);
    }
    if (r.totals.thin_places > 0)
        print(text,
              "warning   %ld places are too narrow for a track and not printed (%.2f mm2 in all); the report says on "
              "which layers\n",
              r.totals.thin_places, r.totals.thin_area_mm2);
    const auto first = std::find_if(r.layers.begin(), r.layers.end(),
                                    [](const LayerReport& layer) { return !layer.empty; });
    if (first != r.layers.begin() && first != r.layers.end())
        print(text,
              "warning   nothing is printed on the lowest %ld layer%s, without room for a track: the print begins "
              "in the air\n",
              static_cast<long>(first - r.layers.begin()), first - r.layers.begin() == 1 ? "" : "s");
    if (r.totals.closings > 0)
        print(text, "warning   %ld gaps in open contours were closed; the report names them\n", r.totals.closings);
    print(text, "time      %.2f s on %d threads, %.0f MB\n", r.machine.seconds, r.machine.threads,
          r.machine.peak_memory_mb);
    const std::pair<const char*, const std::optional<std::filesystem::path>&> written[] = {
        {"G-code", job.gcode}, {"report", job.report}, {"layers", job.svg}, {"walls", job.mesh},
        {"shapes", job.layers}, {"page", job.html}};
    for (const auto& [name, path] : written)
        if (path) print(text, "%-9s %s\n", name, path->string().c_str());
    return text;
}

}  // namespace ribvault
