#include "ribvault/print/gcode_layers.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <utility>

namespace ribvault {
namespace {

constexpr double pooled_mm = 0.25;                 // shorter stretches share one flow
constexpr std::int64_t pm_per_mm = 1000000000;     // 1e-9 mm
constexpr Int128 decimal_per_pm = decimal_one / pm_per_mm;
constexpr std::int64_t widest = 100 * pm_per_mm;
constexpr Int128 z_rounding = decimal_one / 200;       // 0.005 mm, as slicers round
constexpr std::int64_t thick_first = pm_per_mm / 2;    // a layer on the bed may be as high

std::int64_t in_pm(Int128 z) { return static_cast<std::int64_t>(z / decimal_per_pm); }

GcodePoint flat(const std::array<Decimal, 3>& p) { return {p[0], p[1]}; }

/// Per feature: whether its height is its layer's, whatever the file says.
std::vector<char> with_layers_height(const std::vector<GcodeFeature>& features) {
    std::vector<char> chosen;
    for (const GcodeFeature& f : features)
        chosen.push_back(f.kind == FeatureKind::bridge || f.name.find("roning") != std::string::npos);
    return chosen;
}

/// What heights of layers are usual, and from where on they are none.
struct UsualHeight {
    std::int64_t layer, tallest;
    UsualHeight(const std::vector<std::int64_t>& distances, const LayerHints& hints) {
        std::vector<std::int64_t> sorted = distances;
        std::sort(sorted.begin(), sorted.end());
        layer = hints.layer_height.value_or(sorted.empty() ? pm_per_mm / 5 : sorted[(sorted.size() - 1) / 2]);
        tallest = 5 * std::max(2 * layer, static_cast<std::int64_t>(hints.nozzle.value_or(0) * pm_per_mm)) / 4;
    }
};

}  // namespace

/// The width, or minus the number (from 1) of the flow that it will be computed from.
std::int64_t LayerCollector::width_of(const Extrusion& e) {
    if (e.width) {
        flow_open_ = false;
        return *e.width;
    }
    const bool same = flow_open_ && flows_.back().feature == e.feature && flows_.back().tool == e.tool &&
                      flows_.back().volumetric == e.volumetric && flows_.back().length < pooled_mm;
    if (!same) flows_.push_back({0, 0, e.volumetric, e.tool, e.feature});
    flow_open_ = true;
    flows_.back().length += e.length_mm;
    flows_.back().pushed += e.pushed;
    return -static_cast<std::int64_t>(flows_.size());
}

GcodeLayer& LayerCollector::group(Key key) {
    if (last_group_ == nullptr || key != last_key_) {
        last_group_ = &groups_[key];
        last_key_ = key;
    }
    return *last_group_;
}

void LayerCollector::file(GcodeLayer& layer, const Extrusion& e, std::int64_t width, bool continues) {
    const GcodePoint from = flat(e.from), to = flat(e.to);
    if (layer.points.empty() || layer.points.back() != from) {
        layer.points.push_back(from);
        continues = false;
    }
    GcodeTrack track;
    track.a = track.b = static_cast<std::uint32_t>(layer.points.size() - 1);
    if (from != to) {
        layer.points.push_back(to);
        ++track.b;
    }
    track.line = e.line, track.feature = e.feature, track.chord = e.chord, track.width = width;
    track.continues = continues && !layer.tracks.empty() && layer.tracks.back().b == track.a;
    layer.tracks.push_back(track);
}

void LayerCollector::extrude(const Extrusion& e) {
    const bool climbs = e.from[2] != e.to[2], continues = std::exchange(in_path_, true);
    const std::int64_t width = width_of(e);
    if (!climbs && !climbed_) {
        file(group({e.to[2].value, e.height.value_or(0)}), e, width, continues);
        return;
    }
    climbing_.push_back({e, width, continues, paths_});
    if (climbs) level_from_ = climbing_.size();
    climbed_ = true;
}

/// The level tracks at the end of a path that had climbed are level for good.
void LayerCollector::file_level_end() {
    for (std::size_t k = level_from_; k < climbing_.size(); ++k) {
        const Climb& c = climbing_[k];
        file(group({c.extrusion.to[2].value, c.extrusion.height.value_or(0)}), c.extrusion, c.width, c.continues);
    }
    climbing_.resize(level_from_);
}

void LayerCollector::end_path() {
    if (!in_path_) return;
    in_path_ = flow_open_ = false;
    ++paths_;
    if (!climbed_) return;
    file_level_end();
    climbed_ = false;
}

double LayerCollector::set_aside() {
    end_path();
    double sum = 0;
    const auto add = [&](const GcodePoint& a, const GcodePoint& b) {
        sum += std::hypot(to_double(b.x - a.x), to_double(b.y - a.y));
    };
    for (const auto& [key, layer] : groups_)
        for (const GcodeTrack& t : layer.tracks) add(layer.points[t.a], layer.points[t.b]);
    for (const Climb& c : climbing_) add(flat(c.extrusion.from), flat(c.extrusion.to));
    *this = LayerCollector{};
    return sum;
}

void LayerCollector::file_climbs(const LayerHints& hints) {
    if (climbing_.empty()) return;
    std::vector<Int128> level;
    for (const auto& [key, layer] : groups_)
        if (level.empty() || level.back() != key.z) level.push_back(key.z);
    Int128 step = 0;  // of layers that no level extrusion tells of
    if (climbing_.front().extrusion.height) step = *climbing_.front().extrusion.height * decimal_per_pm;
    else if (hints.layer_height) step = *hints.layer_height * decimal_per_pm;
    else if (level.size() >= 2) step = level.back() - level[level.size() - 2];
    else if (level.size() == 1) step = level.back();
    if (step <= 0) step = decimal_one / 5;
    const auto top_of = [](const Climb& c) { return std::max(c.extrusion.from[2].value, c.extrusion.to[2].value); };
    std::map<std::uint64_t, Int128> tops;  // of paths
    for (const Climb& c : climbing_) {
        const auto [at, is_new] = tops.try_emplace(c.path, top_of(c));
        if (!is_new) at->second = std::max(at->second, top_of(c));
    }
    for (const Climb& c : climbing_) {
        const Int128 top = top_of(c);
        const auto above = std::lower_bound(level.begin(), level.end(), top);
        const Int128 under = above == level.begin() ? 0 : *std::prev(above);
        Int128 z = under + std::max<Int128>(1, (top - under + step - 1) / step) * step;
        if (above != level.begin() && tops[c.path] - under <= z_rounding)
            z = under;  // the path as a whole climbs no higher than slicers round
        else if (above != level.end() && (*above - top < step || z > *above))
            z = *above;
        file(group({z, c.extrusion.height.value_or(0)}), c.extrusion, c.width, c.continues);
    }
    climbing_.clear();
    level_from_ = 0;
}

void LayerCollector::merge_rounded() {
    // Where the file says heights, these tell what is below.
    if (std::any_of(groups_.begin(), groups_.end(), [](const auto& group) { return group.first.height != 0; })) return;
    Groups merged;
    Int128 z = 0;
    for (auto& [key, layer] : groups_) {
        if (merged.empty() || key.z - z > z_rounding) z = key.z;
        GcodeLayer& to = merged[{z, key.height}];
        if (to.tracks.empty()) {
            to = std::move(layer);
            continue;
        }
        const auto first = static_cast<std::uint32_t>(to.points.size());
        to.points.insert(to.points.end(), layer.points.begin(), layer.points.end());
        for (GcodeTrack& track : layer.tracks) track.a += first, track.b += first, to.tracks.push_back(track);
    }
    groups_ = std::move(merged);
}

void LayerCollector::resolve_heights(GcodePrint& print, const LayerHints& hints) {
    Groups resolved;
    const std::vector<char> of_layer = with_layers_height(print.features);
    std::vector<std::int64_t> all;  // distances of tops
    for (std::int64_t lower = 0; const auto& [key, layer] : groups_)
        if (const std::int64_t top = in_pm(key.z); top > lower) all.push_back(top - std::exchange(lower, top));
    const UsualHeight heights(all, hints);
    std::vector<std::int64_t> distances;  // heights that are the distance to the next lower layer
    std::int64_t lower = 0;               // top of the next lower z
    for (auto at = groups_.begin(); at != groups_.end();) {
        const Int128 z = at->first.z;
        const std::int64_t top = in_pm(z);
        auto end = at;
        std::int64_t said = 0;  // the height of most tracks at this z, bridges and ironing apart
        std::size_t most = 0;
        for (; end != groups_.end() && end->first.z == z; ++end) {
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
            return !resolved.empty() && height > heights.tallest && height <= top - lower + in_pm(z_rounding);
        };
        if (is_air(usual)) usual = heights.layer, ++print.layers_over_air;
        if (usual <= 0) usual = hints.layer_height.value_or(pm_per_mm / 5);  // at or below the bed
        for (; at != end; ++at) {
            GcodeLayer& from = at->second;
            for (std::size_t k = 0; k < from.tracks.size(); ++k) {
                const GcodeTrack& t = from.tracks[k];
                const bool is_said = !of_layer[t.feature] && at->first.height != 0;
                const std::int64_t height = is_said && !is_air(at->first.height) ? at->first.height : usual;
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
    groups_ = std::move(resolved);
    for (std::size_t k = 0; k < distances.size(); ++k) {
        const std::int64_t before = k > 0 ? distances[k - 1] : 0,
                           after = k + 1 < distances.size() ? distances[k + 1] : 0;
        print.thin_layers += 2 * distances[k] <= std::min(before, after);
    }
}

void LayerCollector::resolve_widths(GcodePrint& print, GcodeLayer& layer, const LayerHints& hints) const {
    const double height = static_cast<double>(layer.height) * 1e-9;
    for (GcodeTrack& t : layer.tracks) {
        if (t.width > 0) {
            ++print.widths_written;
            continue;
        }
        ++print.widths_computed;
        const Flow& flow = flows_[static_cast<std::size_t>(-t.width - 1)];
        const double diameter =
            hints.filaments[std::min(static_cast<std::size_t>(flow.tool), hints.filaments.size() - 1)];
        const double area = flow.volumetric || hints.volumetric ? 1 : std::numbers::pi / 4 * diameter * diameter;
        const double um = flow.length > 0 ? 1000 * flow.pushed * area / (flow.length * height) : 1;
        const double clamped = std::clamp(std::round(um), 1.0, static_cast<double>(widest) / 1000000);
        t.width = static_cast<std::int64_t>(clamped) * 1000000;
    }
}

void LayerCollector::finish(GcodePrint& print, const LayerHints& hints) {
    end_path();
    last_group_ = nullptr;
    file_climbs(hints);
    last_group_ = nullptr;
    merge_rounded();
    resolve_heights(print, hints);
    int number = -1;
    Int128 z = 0;
    for (auto& [key, layer] : groups_) {
        if (number < 0 || key.z != z) ++number, z = key.z;
        layer.layer = number;
        layer.z = {key.z};
        layer.height = key.height;
        resolve_widths(print, layer, hints);
        layer.points.shrink_to_fit(), layer.tracks.shrink_to_fit();
        print.layers.push_back(std::move(layer));
    }
    print.layer_count = number + 1;
    *this = LayerCollector{};
    find_layers_below(print.layers);
}

void find_layers_below(std::vector<GcodeLayer>& layers) {
    if (layers.empty()) return;
    const auto top = [&](std::size_t k) { return in_pm(layers[k].z.value); };
    const auto bottom = [&](std::size_t k) { return top(k) - layers[k].height; };
    const std::int64_t bed = bottom(0);
    for (std::size_t k = 0; k < layers.size(); ++k) {
        GcodeLayer& layer = layers[k];
        const std::int64_t rounding = std::min(pm_per_mm / 200, layer.height / 4);  // 0.005 mm, less than the layer
        layer.below.clear(), layer.under_air.clear(), layer.air_layers = 0;
        layer.on_bed = layer.layer == 0 || bottom(k) <= bed + rounding;
        if (layer.on_bed) continue;
        for (std::size_t j = k; j-- > 0;) {
            if (top(j) < bottom(k) - rounding) break;
            if (top(j) >= top(k)) continue;
            if (top(j) <= bottom(k) + rounding || bottom(j) < bottom(k) - rounding) layer.below.push_back(j);
        }
        if (layer.below.empty()) {
            std::size_t j = k;
            while (j > 0 && top(j) > bottom(k) + rounding) --j;
            if (top(j) > bottom(k) + rounding) {  // nothing ends below: what is under it is the bed
                layer.on_bed = true;
                continue;
            }
            const std::int64_t nearest = top(j), air = bottom(k) - nearest;
            if (air > layer.height)
                layer.air_layers = static_cast<int>((air - rounding + layer.height - 1) / layer.height);
            std::vector<std::size_t>& entries = layer.air_layers > 0 ? layer.under_air : layer.below;
            for (; top(j) == nearest; --j) {
                entries.push_back(j);
                if (j == 0) break;
            }
        }
        std::reverse(layer.below.begin(), layer.below.end());
    }
}

}  // namespace ribvault
