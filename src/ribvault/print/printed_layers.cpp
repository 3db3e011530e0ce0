#include "ribvault/print/printed_layers.hpp"

#include <algorithm>

#include "ribvault/print/gcode_arcs.hpp"

namespace ribvault {
namespace {

constexpr std::int64_t arc_bound = static_cast<std::int64_t>(arc_bound_mm * 1e9);  // 1e-9 mm

/// 1e-9 mm as mm, exactly.
Rational in_mm(std::int64_t value) {
    Rational mm(mpz_class(static_cast<long>(value)), 1000000000L);
    mm.canonicalize();
    return mm;
}

void append(const GcodeLayer& layer, std::int64_t widen_chords, PrintedLayer& to) {
    std::vector<std::array<Rational, 2>> points;
    points.reserve(layer.points.size());
    for (const GcodePoint& p : layer.points) points.push_back({to_rational(p.x), to_rational(p.y)});
    to.tracks.reserve(to.tracks.size() + layer.tracks.size());
    std::int64_t last_width = 0;
    Rational width;
    for (const GcodeTrack& t : layer.tracks) {
        const std::int64_t wide = std::max<std::int64_t>(1, t.width + (t.chord ? widen_chords : 0));
        if (wide != last_width) width = in_mm(last_width = wide);
        to.tracks.push_back({points[t.a], points[t.b], width, t.feature, t.line});
    }
}

}  // namespace

PrintedLayer layer_above(const GcodePrint& print, std::size_t entry) {
    const GcodeLayer& layer = print.layers[entry];
    PrintedLayer above{to_rational(layer.z), in_mm(layer.height), {}};
    append(layer, 2 * arc_bound, above);
    return above;
}

PrintedLayer material_below(const GcodePrint& print, std::size_t entry) {
    const GcodeLayer& layer = print.layers[entry];
    PrintedLayer material{to_rational(layer.z) - in_mm(layer.height), {}, {}};
    for (const std::size_t k : layer.below) append(print.layers[k], -2 * arc_bound, material);
    return material;
}

std::vector<char> continued_tracks(const GcodeLayer& layer) {
    std::vector<char> all;
    all.reserve(layer.tracks.size());
    for (const GcodeTrack& t : layer.tracks) all.push_back(t.continues ? 1 : 0);
    return all;
}

}  // namespace ribvault
