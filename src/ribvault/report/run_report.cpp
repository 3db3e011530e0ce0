#include "ribvault/report/run_report.hpp"

#include <sys/resource.h>

#include <algorithm>

namespace ribvault {

void sum_up(RunReport& report) {
    std::sort(report.layers.begin(), report.layers.end(),
              [](const LayerReport& a, const LayerReport& b) { return a.layer < b.layer; });
    RunTotals& t = report.totals = {};
    VerdictSummary& v = report.verdict = {};
    for (const LayerReport& layer : report.layers) {
        t.shell_volume_mm3 += layer.shell_volume_mm3;
        t.support_volume_mm3 += layer.support_volume_mm3;
        t.support_length_mm += layer.support_length_mm;
        t.support_printed_length_mm += layer.support_printed_length_mm;
        t.perimeter_length_mm += layer.perimeter_length_mm;
        t.cover_length_mm += layer.cover_length_mm;
        t.filament_mm += layer.filament_mm;
        t.gaps += layer.gaps;
        t.closings += static_cast<long>(layer.closings.size());
        if (layer.verdict.supported)
            ++v.layers_proved;
        else
            v.layers_refuted.push_back(layer.layer);
        if (const auto& out = layer.verdict.external)
            v.external_overhangs.push_back({layer.layer, out->area_lo, out->area_hi});
        v.stages += layer.verdict.stages;
    }
    t.material_mm3 = t.shell_volume_mm3 + t.support_volume_mm3;
    v.proved = !report.layers.empty() && v.layers_refuted.empty();
}

double peak_memory_mb() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) * 1024 / 1e6;
}

}  // namespace ribvault
