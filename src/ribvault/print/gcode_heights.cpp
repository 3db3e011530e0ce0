#include "ribvault/print/gcode_heights.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <utility>

#include "ribvault/print/interleaved_layers.hpp"

namespace ribvault {
namespace {

constexpr std::int64_t thick_first =
    pm_per_mm / 2;  // a layer on the bed may be as high, and others that nothing is known of
constexpr std::int64_t plain_height = pm_per_mm / 5;

/// Per feature: whether its height is its layer's, whatever the file says.
std::vector<char> with_layers_height(const std::vector<GcodeFeature>& features) {
    std::vector<char> chosen;
    for (const GcodeFeature& f : features) chosen.push_back(f.kind == FeatureKind::bridge || f.ironing);
    return chosen;
}

/// The median, the lower one of two; orders the range up to there.
template <class Iterator>
Iterator middle_of(Iterator begin, Iterator end) {
    const Iterator middle = begin + (end - begin - 1) / 2;
    std::nth_element(begin, middle, end);
    return middle;
}

LayerGroups merged_by_rounding(LayerGroups& groups) {
    LayerGroups merged;
    Int128 z = 0;
    for (auto& [key, layer] : groups) {
        if (merged.empty() || key.z - z > z_rounding) z = key.z;
        append_tracks(merged[{z, key.height}], layer);
    }
    return merged;
}

/// Lines on the bed that are printed before all else, directly before the lowest layer and higher: they are part of it.
void join_purge_lines(LayerGroups& groups, std::int64_t highest) {
    if (groups.size() < 2) return;
    const auto first_line = [](const auto& group) {
        std::uint32_t first = UINT32_MAX;
        for (const GcodeTrack& t : group.second.tracks) first = std::min(first, t.line);
        return first;
    };
    const auto lowest = groups.begin();
    auto purge = lowest;
    std::uint32_t begin = first_line(*lowest);
    for (auto at = std::next(lowest); at != groups.end(); ++at)
        if (const std::uint32_t first = first_line(*at); first < begin) {
            if (purge != lowest) return;  // more was printed before
            purge = at;
        }
    if (purge == lowest || in_pm(purge->first.z) > highest) return;
    for (const GcodeTrack& t : purge->second.tracks)
        if (t.line > begin) return;
    append_tracks(lowest->second, purge->second);
    groups.erase(purge);
}

/// Distances of the tops from the next lower ones; of the lowest from z = 0.
std::vector<std::int64_t> distances_of(const LayerGroups& groups) {
    std::vector<std::int64_t> distances;
    for (std::int64_t lower = 0; const auto& [key, layer] : groups)
        if (const std::int64_t top = in_pm(key.z); top > lower) distances.push_back(top - std::exchange(lower, top));
    return distances;
}

/// How much of one infill feature is in which layers, where its height is not said.
struct InfillLayers {
    std::map<int, double> lengths;  ///< mm, by layer
    /// How many layers most are apart that have a fifth or more of the longest, which slicers leave bits of in those
    /// between; 1 where these are few.
    int apart() const {
        double longest = 0;
        for (const auto& [layer, length] : lengths) longest = std::max(longest, length);
        std::vector<int> numbers;
        for (const auto& [layer, length] : lengths)
            if (5 * length >= longest) numbers.push_back(layer);
        if (numbers.size() < 4) return 1;
        std::vector<int> gaps(numbers.size());
        std::adjacent_difference(numbers.begin(), numbers.end(), gaps.begin());
        return *middle_of(gaps.begin() + 1, gaps.end());
    }
};

/// The height that the file says of most tracks at one z, those apart that have the layer's; 0 when it says none.
std::int64_t said_height(LayerGroups::const_iterator at, LayerGroups::const_iterator end,
                         const std::vector<char>& of_layer) {
    std::int64_t said = 0;
    std::size_t most = 0;
    for (; at != end; ++at) {
        if (at->first.height == 0) continue;
        const auto count =
            static_cast<std::size_t>(std::count_if(at->second.tracks.begin(), at->second.tracks.end(),
                                                   [&](const GcodeTrack& t) { return !of_layer[t.feature]; }));
        if (count > most) most = count, said = at->first.height;
    }
    return said;
}

/// What lies at which level, into `levels`, which know their z.
void enter_layers(const LayerGroups& groups, std::vector<LevelTracks>& levels) {
    auto level = levels.begin();
    for (const auto& [key, layer] : groups) {
        while (level->z != key.z) ++level;
        level->entries.push_back(&layer);
    }
}

}  // namespace

void append_track(GcodeLayer& layer, const GcodePoint& from, const GcodePoint& to, GcodeTrack track) {
    if (layer.points.empty() || layer.points.back() != from) layer.points.push_back(from);
    track.a = track.b = static_cast<std::uint32_t>(layer.points.size() - 1);
    if (from != to) layer.points.push_back(to), ++track.b;
    track.continues = track.continues && !layer.tracks.empty() && layer.tracks.back().b == track.a;
    layer.tracks.push_back(track);
}

void append_tracks(GcodeLayer& to, GcodeLayer& from) {
    if (to.tracks.empty()) {
        to = std::move(from);
        return;
    }
    const auto first = static_cast<std::uint32_t>(to.points.size());
    to.points.insert(to.points.end(), from.points.begin(), from.points.end());
    for (GcodeTrack& track : from.tracks) track.a += first, track.b += first, to.tracks.push_back(track);
}

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
        join_purge_lines(groups, std::max(thick_first, 2 * usual_height(groups, hints)));
    }
    const std::int64_t layer_height = usual_height(groups, hints);
    const std::int64_t tallest =
        5 * std::max(2 * layer_height, static_cast<std::int64_t>(hints.nozzle.value_or(0) * pm_per_mm)) / 4;
    LayerGroups resolved;
    const std::vector<char> of_layer = with_layers_height(print.features);
    std::vector<InfillLayers> infill(print.features.size());
    std::vector<LevelTracks> levels;
    std::int64_t lower = 0;  // top of the next lower z
    int number = 0;
    for (auto at = groups.begin(); at != groups.end(); ++number) {
        const Int128 z = at->first.z;
        const std::int64_t top = in_pm(z);
        const auto end = std::find_if(at, groups.end(), [&](const auto& group) { return group.first.z != z; });
        const std::int64_t said = said_height(at, end, of_layer);
        std::int64_t usual = said;
        if (usual == 0 && resolved.empty())
            usual = hints.first_layer_height.value_or(
                top <= std::max(thick_first, 2 * hints.layer_height.value_or(top)) ? top : *hints.layer_height);
        levels.push_back({z, usual == 0, {}});
        if (usual == 0) usual = top - lower;
        // What reaches past lower tops, as combined infill does, has no air in it.
        const auto is_air = [&](std::int64_t height) {
            return !resolved.empty() && height > tallest && height <= top - lower + in_pm(z_rounding);
        };
        if (is_air(usual)) usual = layer_height, ++print.layers_over_air;
        if (usual <= 0) usual = hints.layer_height.value_or(plain_height);  // at or below the bed
        for (; at != end; ++at) {
            GcodeLayer& from = at->second;
            for (const GcodeTrack& t : from.tracks) {
                std::int64_t height = usual;
                if (!of_layer[t.feature] && at->first.height != 0) {
                    if (!is_air(at->first.height)) height = at->first.height;
                } else if (print.features[t.feature].kind == FeatureKind::infill && said == 0) {
                    height *= hints.infill_layers;
                    const GcodePoint &a = from.points[t.a], &b = from.points[t.b];
                    infill[t.feature].lengths[number] += std::hypot(to_double(b.x - a.x), to_double(b.y - a.y));
                }
                append_track(resolved[{z, height}], from.points[t.a], from.points[t.b], t);
            }
            from = {};
        }
        lower = top;
    }
    groups = std::move(resolved);
    enter_layers(groups, levels);
    print.interleaved_layers = interleaved_layers(levels, std::max(tallest, thick_first) * decimal_per_pm);
    for (std::size_t f = 0; f < infill.size(); ++f)
        if (const int apart = infill[f].apart(); apart > hints.infill_layers)
            print.sparse_infill = {print.features[f].name, apart};
}

}  // namespace ribvault
