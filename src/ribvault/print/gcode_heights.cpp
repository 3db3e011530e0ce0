#include "ribvault/print/gcode_heights.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

namespace ribvault {
namespace {

constexpr std::int64_t thick_first = pm_per_mm / 2;  // a layer on the bed may be as high
constexpr std::int64_t plain_height = pm_per_mm / 5;

/// Per feature: whether its height is its layer's, whatever the file says.
std::vector<char> with_layers_height(const std::vector<GcodeFeature>& features) {
    std::vector<char> chosen;
    for (const GcodeFeature& f : features)
        chosen.push_back(f.kind == FeatureKind::bridge || f.name.find("roning") != std::string::npos);
    return chosen;
}

/// The median, the lower one of two; orders the range up to there.
template <class Iterator>
Iterator middle_of(Iterator begin, Iterator end) {
    const Iterator middle = begin + (end - begin - 1) / 2;
    std::nth_element(begin, middle, end);
    return middle;
}

/// All of `from` behind the tracks of `to`.
void append(GcodeLayer& to, GcodeLayer& from) {
    if (to.tracks.empty()) {
        to = std::move(from);
        return;
    }
    const auto first = static_cast<std::uint32_t>(to.points.size());
    to.points.insert(to.points.end(), from.points.begin(), from.points.end());
    for (GcodeTrack& track : from.tracks) track.a += first, track.b += first, to.tracks.push_back(track);
}

LayerGroups merged_by_rounding(LayerGroups& groups) {
    LayerGroups merged;
    Int128 z = 0;
    for (auto& [key, layer] : groups) {
        if (merged.empty() || key.z - z > z_rounding) z = key.z;
        append(merged[{z, key.height}], layer);
    }
    return merged;
}

/// The first layer over a raft: printed directly before one whose top is lower by less than half a layer.
void press_down(LayerGroups& groups, std::int64_t usual) {
    struct Printed {
        std::uint32_t first, last;  // lines of the file
        LayerGroups::iterator group;
    };
    std::vector<Printed> order;
    for (auto at = groups.begin(); at != groups.end(); ++at) {
        order.push_back({UINT32_MAX, 0, at});
        for (const GcodeTrack& t : at->second.tracks)
            order.back().first = std::min(order.back().first, t.line),
            order.back().last = std::max(order.back().last, t.line);
    }
    std::sort(order.begin(), order.end(), [](const Printed& p, const Printed& q) { return p.first < q.first; });
    const Int128 layer = usual * decimal_per_pm;
    for (std::size_t k = 0; k + 1 < order.size(); ++k) {
        const auto high = order[k].group, low = order[k + 1].group;
        const Int128 drop = high->first.z - low->first.z, pressed = low->first.z - layer;
        if (drop <= 0 || 2 * drop >= layer || order[k].last >= order[k + 1].first) continue;
        if (std::prev(high) != low || (low != groups.begin() && std::prev(low)->first.z + z_rounding >= pressed))
            continue;
        auto node = groups.extract(high);
        node.key() = {pressed, 0};
        groups.insert(std::move(node));
        ++k;
    }
}

/// Distances of the tops from the next lower ones; of the lowest from z = 0.
std::vector<std::int64_t> distances_of(const LayerGroups& groups) {
    std::vector<std::int64_t> distances;
    for (std::int64_t lower = 0; const auto& [key, layer] : groups)
        if (const std::int64_t top = in_pm(key.z); top > lower) distances.push_back(top - std::exchange(lower, top));
    return distances;
}

/// The layers that one infill feature is in, where its height is not said.
struct InfillLayers {
    std::vector<int> numbers;
    void add(int layer) {
        if (numbers.empty() || numbers.back() != layer) numbers.push_back(layer);
    }
    /// How many layers most are apart; 1 where these are few.
    int apart() const {
        if (numbers.size() < 4) return 1;
        std::vector<int> gaps(numbers.size());
        std::adjacent_difference(numbers.begin(), numbers.end(), gaps.begin());
        return *middle_of(gaps.begin() + 1, gaps.end());
    }
};

}  // namespace

std::int64_t usual_height(const LayerGroups& groups, const LayerHints& hints) {
    if (hints.layer_height) return *hints.layer_height;
    std::vector<std::int64_t> distances = distances_of(groups);
    if (distances.empty()) return plain_height;
    return *middle_of(distances.begin(), distances.end());
}

void resolve_heights(LayerGroups& groups, GcodePrint& print, const LayerHints& hints) {
    // Where the file says heights, these tell what is below.
    if (std::none_of(groups.begin(), groups.end(), [](const auto& group) { return group.first.height != 0; })) {
        groups = merged_by_rounding(groups);
        press_down(groups, usual_height(groups, hints));
    }
    const std::int64_t layer_height = usual_height(groups, hints);
    const std::int64_t tallest =
        5 * std::max(2 * layer_height, static_cast<std::int64_t>(hints.nozzle.value_or(0) * pm_per_mm)) / 4;
    LayerGroups resolved;
    const std::vector<char> of_layer = with_layers_height(print.features);
    std::vector<InfillLayers> infill(print.features.size());
    std::vector<std::int64_t> distances;  // heights that are the distance to the next lower layer
    std::int64_t lower = 0;               // top of the next lower z
    int number = 0;
    for (auto at = groups.begin(); at != groups.end(); ++number) {
        const Int128 z = at->first.z;
        const std::int64_t top = in_pm(z);
        auto end = at;
        std::int64_t said = 0;  // the height of most tracks at this z, bridges and ironing apart
        std::size_t most = 0;
        for (; end != groups.end() && end->first.z == z; ++end) {
            if (end->first.height == 0) continue;
            const auto count =
                static_cast<std::size_t>(std::count_if(end->second.tracks.begin(), end->second.tracks.end(),
                                                       [&](const GcodeTrack& t) { return !of_layer[t.feature]; }));
            if (count > most) most = count, said = end->first.height;
        }
        std::int64_t usual = said;
        if (usual == 0 && resolved.empty())
            usual = hints.first_layer_height.value_or(
                top <= std::max(thick_first, 2 * hints.layer_height.value_or(top)) ? top : *hints.layer_height);
        if (usual == 0) distances.push_back(usual = top - lower);
        // What reaches past lower tops, as combined infill does, has no air in it.
        const auto is_air = [&](std::int64_t height) {
            return !resolved.empty() && height > tallest && height <= top - lower + in_pm(z_rounding);
        };
        if (is_air(usual)) usual = layer_height, ++print.layers_over_air;
        if (usual <= 0) usual = hints.layer_height.value_or(plain_height);  // at or below the bed
        for (; at != end; ++at) {
            GcodeLayer& from = at->second;
            for (std::size_t k = 0; k < from.tracks.size(); ++k) {
                const GcodeTrack& t = from.tracks[k];
                std::int64_t height = usual;
                if (!of_layer[t.feature] && at->first.height != 0) {
                    if (!is_air(at->first.height)) height = at->first.height;
                } else if (print.features[t.feature].kind == FeatureKind::infill && said == 0) {
                    height *= hints.infill_layers;
                    infill[t.feature].add(number);
                }
                GcodeLayer& to = resolved[{z, height}];
                if (to.points.empty() || to.points.back() != from.points[t.a]) to.points.push_back(from.points[t.a]);
                GcodeTrack moved = t;
                moved.a = moved.b = static_cast<std::uint32_t>(to.points.size() - 1);
                if (t.a != t.b) {
                    to.points.push_back(from.points[t.b]);
                    ++moved.b;
                }
                moved.continues = t.continues && !to.tracks.empty() && to.tracks.back().b == moved.a;
                to.tracks.push_back(moved);
            }
            from = {};
        }
        lower = top;
    }
    groups = std::move(resolved);
    for (std::size_t k = 0; k < distances.size(); ++k) {
        const std::int64_t before = k > 0 ? distances[k - 1] : 0,
                           after = k + 1 < distances.size() ? distances[k + 1] : 0;
        print.thin_layers += 2 * distances[k] <= std::min(before, after);
    }
    for (std::size_t f = 0; f < infill.size(); ++f)
        if (const int apart = infill[f].apart(); apart > hints.infill_layers)
            print.sparse_infill = {print.features[f].name, apart};
}

}  // namespace ribvault
