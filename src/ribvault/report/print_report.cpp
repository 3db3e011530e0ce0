#include "ribvault/report/print_report.hpp"

#include <algorithm>

namespace ribvault {

void sum_up(PrintReport& r) {
    r.supported = true;
    r.length_mm = 0;
    r.unsupported_mm = r.bridged_mm = r.area_mm2 = {};
    r.layers_unsupported = 0;
    r.stages = {};
    int last_unsupported = -1;
    for (const HangingLayer& layer : r.layers) {
        r.length_mm += layer.length_mm;
        r.unsupported_mm += layer.unsupported_mm;
        r.bridged_mm += layer.bridged_mm;
        r.stages += layer.stages;
        for (const HangingRegion& region : layer.regions) r.area_mm2 += region.area_mm2;
        if (!layer.supported) {
            r.supported = false;
            if (layer.layer != last_unsupported) ++r.layers_unsupported;
            last_unsupported = layer.layer;
        }
        for (const HangingPiece& piece : layer.pieces) {
            HangingFeature& f = r.features[static_cast<std::size_t>(piece.feature)];
            if (f.worst_layer >= 0 && piece.distance_mm.lo <= f.worst_mm.lo) continue;
            f.worst_mm = piece.distance_mm;
            f.worst_at = piece.worst;
            f.worst_layer = layer.layer;
            f.worst_line = piece.line;
        }
    }
}

std::vector<std::size_t> worst_layers(const PrintReport& report, std::size_t most) {
    std::vector<double> area(report.layers.size());
    std::vector<std::size_t> order;
    for (std::size_t k = 0; k < report.layers.size(); ++k) {
        for (const HangingRegion& region : report.layers[k].regions) area[k] += region.area_mm2.middle();
        if (area[k] > 0 || !report.layers[k].pieces.empty()) order.push_back(k);
    }
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        if (area[a] != area[b]) return area[a] > area[b];
        return report.layers[a].unsupported_mm.hi > report.layers[b].unsupported_mm.hi;
    });
    if (order.size() > most) order.resize(most);
    return order;
}

}  // namespace ribvault
