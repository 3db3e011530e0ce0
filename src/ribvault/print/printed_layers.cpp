#include "ribvault/print/printed_layers.hpp"

#include <algorithm>
#include <cmath>

#include "ribvault/print/gcode_arcs.hpp"

namespace ribvault {
namespace {

constexpr std::int64_t arc_bound = static_cast<std::int64_t>(arc_bound_mm * 1e9);  // 1e-9 mm

Millimetres to_mm(Decimal d) {
    constexpr std::int64_t picometre = decimal_one / Millimetres::picometres_per_mm;
    if (d.value % picometre == 0)
        return Millimetres::of_picometres(
            static_cast<std::int64_t>(d.value / picometre));  // decimal_limit is far below 9e9
    return to_rational(d);
}

void append(const GcodeLayer& layer, const std::vector<char>& outline, std::int64_t GcodeTrack::*width,
            std::int64_t widen_chords, PrintedLayer& to) {
    std::vector<PrintedPoint> points;
    points.reserve(layer.points.size());
    for (const GcodePoint& p : layer.points) points.push_back({to_mm(p.x), to_mm(p.y)});
    to.tracks.reserve(to.tracks.size() + layer.tracks.size());
    for (const GcodeTrack& t : layer.tracks) {
        const std::int64_t wide = std::max<std::int64_t>(1, t.*width + (t.chord ? widen_chords : 0));
        to.tracks.push_back({points[t.a], points[t.b], Millimetres::of_picometres(wide), t.feature, t.line,
                             !outline.empty() && outline[static_cast<std::size_t>(&t - layer.tracks.data())] != 0});
    }
}

/// Calls visit(first, end, closed) for every run of tracks that follow each other without a travel and hold outer
/// perimeter; `closed`: it ends exactly where it begins.
template <class Visit>
void visit_outer_walls(const std::vector<GcodeFeature>& features, const GcodeLayer& layer, const Visit& visit) {
    const std::vector<GcodeTrack>& tracks = layer.tracks;
    for (std::size_t k = 0; k < tracks.size();) {
        std::size_t end = k + 1;
        const auto feature = [&](std::size_t t) -> const GcodeFeature& { return features[tracks[t].feature]; };
        const auto of_wall = [&](std::size_t t) { return feature(t).outer_wall || feature(t).overhang; };
        bool is_outer = feature(k).outer_wall;
        for (; end < tracks.size() && tracks[end].continues; ++end) {
            if (tracks[end].feature != tracks[k].feature && !(of_wall(k) && of_wall(end))) break;
            is_outer = is_outer || feature(end).outer_wall;
        }
        if (is_outer) visit(k, end, end - k > 2 && layer.points[tracks[k].a] == layer.points[tracks[end - 1].b]);
        k = end;
    }
}

}  // namespace

PrintedLayer layer_above(const GcodePrint& print, std::size_t entry) {
    PrintedLayer above;
    append(print.layers[entry], {}, &GcodeTrack::width, 2 * arc_bound, above);
    return above;
}

PrintedLayer layer_below(const GcodePrint& print, std::size_t entry) {
    PrintedLayer material;
    append(print.layers[entry], {}, &GcodeTrack::width_below, -2 * arc_bound, material);
    return material;
}

PrintedLayer material_below(const GcodePrint& print, std::size_t entry) {
    PrintedLayer material;
    for (const std::size_t k : print.layers[entry].below)
        append(print.layers[k], outline_tracks(print.features, print.layers[k]), &GcodeTrack::width_below,
               -2 * arc_bound, material);
    return material;
}

std::vector<char> outline_tracks(const std::vector<GcodeFeature>& features, const GcodeLayer& layer) {
    std::vector<char> result(layer.tracks.size(), 0);
    visit_outer_walls(features, layer, [&](std::size_t first, std::size_t end, bool closed) {
        if (closed)
            std::fill(result.begin() + static_cast<std::ptrdiff_t>(first),
                      result.begin() + static_cast<std::ptrdiff_t>(end), 1);
    });
    return result;
}

OutlineState outline_state(const std::vector<GcodeFeature>& features, const GcodeLayer& layer) {
    OutlineState state;
    visit_outer_walls(features, layer, [&](std::size_t first, std::size_t end, bool closed) {
        state.loops = state.loops || closed;
        if (closed || end - first < 3) return;
        const GcodePoint &a = layer.points[layer.tracks[first].a], &b = layer.points[layer.tracks[end - 1].b];
        const double apart = std::hypot(to_double(b.x) - to_double(a.x), to_double(b.y) - to_double(a.y));
        state.left_open = state.left_open || apart <= 1e-9 * static_cast<double>(layer.tracks[first].width);
    });
    return state;
}

std::vector<char> continued_tracks(const GcodeLayer& layer) {
    std::vector<char> all;
    all.reserve(layer.tracks.size());
    for (const GcodeTrack& t : layer.tracks) all.push_back(t.continues ? 1 : 0);
    return all;
}

}  // namespace ribvault
