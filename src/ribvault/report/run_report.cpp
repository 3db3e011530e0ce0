#include "ribvault/report/run_report.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <fstream>

namespace ribvault {

void sum_up(RunReport& report) {
    std::sort(report.layers.begin(), report.layers.end(),
              [](const LayerReport& a, const LayerReport& b) { return a.layer < b.layer; });
    RunTotals& t = report.totals = {};
    VerdictSummary& v = report.verdict = {};
    for (const LayerReport& layer : report.layers) {
        t.shell_volume_mm3 += layer.shell_volume_mm3;
        t.support_volume_mm3 += layer.support_volume_mm3;
        t.external_support_volume_mm3 += layer.external_support_volume_mm3;
        t.external_support_printed_length_mm += layer.external_support_printed_length_mm;
        t.support_length_mm += layer.support_length_mm;
        t.support_length_bound_mm += layer.support_length_bound_mm;
        t.support_printed_length_mm += layer.support_printed_length_mm;
        t.perimeter_length_mm += layer.perimeter_length_mm;
        t.cover_length_mm += layer.cover_length_mm;
        t.filament_mm += layer.filament_mm;
        t.thin_wall_length_mm += layer.thin_wall_length_mm;
        t.thin_places += layer.thin_places;
        t.thin_area_mm2 += layer.thin_area_mm2;
        t.unfilled_area_mm2 += layer.unfilled_area_mm2;
        t.extruded_mm3 += layer.extruded_mm3;
        t.prime_surplus_mm3 += layer.prime_surplus_mm3;
        t.travels += layer.travels;
        t.travel_mm += layer.travel_mm;
        t.open_air_mm += layer.open_air_mm;
        t.retractions += layer.retractions;
        t.detours += layer.detours;
        t.print_seconds += layer.print_seconds;
        t.gaps += layer.gaps;
        t.wide_trees += layer.wide_trees;
        t.braces += layer.braces;
        if (layer.slenderness > t.slenderness) t.slenderness = layer.slenderness, t.slenderest_layer = layer.layer;
        t.closed_gaps += layer.closed_gaps;
        t.bends += layer.bends;
        t.patches += layer.patches;
        t.patch_length_mm += layer.patch_length_mm;
        t.closings += static_cast<long>(layer.closings.size());
        t.layers_with_slivers_removed += layer.slivers_removed;
        if (layer.verdict.supported)
            ++v.layers_proved;
        else
            v.layers_refuted.push_back(layer.layer);
        if (const auto& out = layer.verdict.external)
            v.external_overhangs.push_back({layer.layer, out->area_lo, out->area_hi});
        if (layer.patch_in_gap) v.layers_with_patches_in_gap.push_back(layer.layer);
        v.stages += layer.verdict.stages;
        if (!layer.print.supported) v.print_layers_refuted.push_back(layer.layer);
        if (layer.print.external_hangs && !layer.verdict.external && !report.settings.outside())
            v.layers_over_narrow_places.push_back(layer.layer);
        v.print_unsupported_mm += layer.print.unsupported_mm;
        v.print_external_mm += layer.print.external_mm;
        v.print_stages += layer.print.stages;
    }
    t.material_mm3 = t.shell_volume_mm3 + t.support_volume_mm3 + t.external_support_volume_mm3;
    v.proved = !report.layers.empty() && v.layers_refuted.empty();
    v.print_proved = !report.layers.empty() && v.print_layers_refuted.empty();
}

double peak_memory_mb() {
    // getrusage also counts what the process that started this one had at that time; Linux says it without.
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;)
        if (double kilobytes = 0; word == "VmHWM:" && status >> kilobytes) return kilobytes * 1024 / 1e6;
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) * 1024 / 1e6;
}

}  // namespace ribvault
