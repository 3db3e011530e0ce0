#include "ribvault/pipeline/judge_layer.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <set>

#include "ribvault/print/printed_layers.hpp"
#include "ribvault/verify/bridges.hpp"
#include "ribvault/verify/outside_outline.hpp"

namespace ribvault {
namespace {

constexpr int distance_cells =
    20000;  // effort of a region's greatest distance: more than it takes for bounds within 1e-3

template <class Point>
std::array<double, 2> place(const Point& p) { return {p[0].get_d(), p[1].get_d()}; }

std::array<double, 2> along(const PrintedTrack& t, double mm) {
    const auto a = place(t.a), b = place(t.b);
    const double whole = std::hypot(b[0] - a[0], b[1] - a[1]);
    const double share = whole > 0 ? std::clamp(mm / whole, 0.0, 1.0) : 0;
    return {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])};
}

HangingPiece describe(const UnsupportedPiece& p, const PrintedLayer& upper) {
    const PrintedTrack& track = upper.tracks[p.track];
    HangingPiece piece;
    piece.line = track.line;
    piece.feature = track.feature;
    piece.length_mm = p.to_mm - p.from_mm;
    piece.from = along(track, p.from_mm);
    piece.to = along(track, p.to_mm);
    piece.distance_mm = {p.distance_lo, p.distance_hi};
    piece.worst = p.worst;
    return piece;
}

HangingRegion describe(const UnsupportedRegion& r, const PrintedLayer& upper, const PrintedLayer& lower,
                       double min_area) {
    HangingRegion region;
    region.boundary = r.boundary;
    for (const BoundaryCurve& c : r.boundary.curves)
        region.curve_lines.push_back((c.above ? upper : lower).tracks[c.track].line);
    region.area_mm2 = {r.area_lo, r.area_hi};
    region.distance_mm = {r.distance_lo, r.distance_hi};
    region.witness = place(r.witness);
    region.witness_exact = {r.witness[0].get_str(), r.witness[1].get_str()};
    region.witness_distance_mm = r.witness_distance;
    region.witness_certified = r.witness_certified;
    std::set<std::int64_t> lines;
    std::set<int> features;
    for (const std::size_t t : r.tracks) lines.insert(upper.tracks[t].line), features.insert(upper.tracks[t].feature);
    region.lines.assign(lines.begin(), lines.end());
    region.features.assign(features.begin(), features.end());
    region.ignored = r.area_hi <= min_area;
    return region;
}

/// Takes the bridges out of `upper` and enters them.
PrintedLayer without_bridges(const GcodeLayer& layer, PrintedLayer upper, const PrintedLayer& lower,
                             const std::vector<char>& judged, const LayerRules& rules, JudgedLayer& result) {
    PrintedOptions lines_only;
    lines_only.judged = judged;
    lines_only.areas = lines_only.regions = false;
    const PrintedVerdict verdict = verify_printed(upper, lower, rules.support_radius, lines_only);
    result.layer.stages += verdict.stages;
    const std::vector<char> continues = continued_tracks(layer);
    const std::vector<Bridge> bridges = find_bridges(upper, continues, judged, verdict, *rules.longest_bridge);
    if (bridges.empty()) return upper;
    for (const Bridge& bridge : bridges)
        for (const std::size_t k : bridge.pieces) {
            HangingPiece piece = describe(verdict.pieces[k], upper);
            const double least = std::min(piece.length_mm, verdict.unsupported_length[verdict.pieces[k].track][0]);
            const Enclosure length{least, piece.length_mm};
            result.layer.bridged_mm += length;
            result.features[static_cast<std::size_t>(piece.feature)].bridged_mm += length;
            result.layer.bridges.push_back(std::move(piece));
        }
    return take_out_bridges(upper, continues, verdict, bridges);
}

/// Of groups of tracks that were judged apart.
struct GroupVerdict {
    PrintedVerdict all;
    bool unlocated = false;  ///< a track is refuted and no region shows where
};

void add_verdict(PrintedVerdict more, PrintedVerdict& verdict) {
    verdict.centre_lines_supported = verdict.centre_lines_supported && more.centre_lines_supported;
    verdict.supported = verdict.supported && more.supported;
    for (std::size_t k = 0; k < more.unsupported_length.size(); ++k)
        verdict.unsupported_length[k] = {sum_down(verdict.unsupported_length[k][0], more.unsupported_length[k][0]),
                                         sum_up(verdict.unsupported_length[k][1], more.unsupported_length[k][1])};
    std::move(more.pieces.begin(), more.pieces.end(), std::back_inserter(verdict.pieces));
    std::stable_sort(verdict.pieces.begin(), verdict.pieces.end(),
                     [](const UnsupportedPiece& a, const UnsupportedPiece& b) { return a.track < b.track; });
    std::move(more.regions.begin(), more.regions.end(), std::back_inserter(verdict.regions));
    verdict.stages += more.stages;
}

GroupVerdict located(PrintedVerdict verdict) {
    std::vector<char> shown(verdict.track_supported.size(), 0);
    for (const UnsupportedRegion& region : verdict.regions)
        for (const std::size_t k : region.tracks) shown[k] = 1;
    bool unlocated = false;
    for (std::size_t k = 0; k < shown.size(); ++k) unlocated = unlocated || (!verdict.track_supported[k] && !shown[k]);
    return {std::move(verdict), unlocated};
}

/// The entries under this one and under its gap, each once; nothing where the gap reaches down to the bed. Layers on
/// which nothing is printed count.
std::optional<std::vector<std::size_t>> entries_below(const GcodePrint& print, std::size_t entry, int gap) {
    std::map<std::size_t, int, std::greater<>> layers_down{{entry, 0}};
    for (auto at = layers_down.begin(); at != layers_down.end(); ++at) {
        const GcodeLayer& layer = print.layers[at->first];
        const int down = at->second + layer.air_layers + 1;
        if (down > gap + 1) continue;
        if (layer.on_bed) return std::nullopt;
        for (const std::size_t e : layer.air_layers > 0 ? layer.under_air : layer.below) {  // all of smaller number
            int& least = layers_down.try_emplace(e, down).first->second;
            least = std::min(least, down);
        }
    }
    std::vector<std::size_t> entries;
    for (const auto& [e, down] : layers_down)
        if (down > 0) entries.push_back(e);
    return std::vector<std::size_t>(entries.rbegin(), entries.rend());
}

void append(std::vector<PrintedTrack> more, std::vector<PrintedTrack>& tracks) {
    std::move(more.begin(), more.end(), std::back_inserter(tracks));
}

GroupVerdict judge(const PrintedLayer& upper, const PrintedLayer& lower, const std::vector<char>& judged,
                   const LayerRules& rules) {
    PrintedOptions options;
    options.judged = judged;
    if (rules.distances) options.distance_cells = distance_cells;
    return located(verify_printed(upper, lower, rules.support_radius, options));
}

/// Enters a verdict over other tracks below, which come after those of `lower` then.
void add_group(GroupVerdict more, PrintedLayer over, GroupVerdict& verdict, PrintedLayer& lower) {
    for (UnsupportedRegion& region : more.all.regions)
        for (BoundaryCurve& curve : region.boundary.curves)
            if (!curve.above) curve.track += lower.tracks.size();
    append(std::move(over.tracks), lower.tracks);
    verdict.unlocated = verdict.unlocated || more.unlocated;
    add_verdict(std::move(more.all), verdict.all);
}

/// All of `upper` over `lower`, the material directly below, or where the rules tell supports from the object, each
/// over what may hold it up: all of that is `lower` then.
GroupVerdict judge_groups(const GcodePrint& print, std::size_t entry, const PrintedLayer& upper, PrintedLayer& lower,
                          const std::vector<char>& judged, const LayerRules& rules) {
    if (rules.object_reach == 0 && rules.gap_layers == 0 && !rules.supports_alone)
        return judge(upper, lower, judged, rules);
    const auto is_support = [&](const PrintedTrack& t) {
        return print.features[static_cast<std::size_t>(t.feature)].kind == FeatureKind::support;
    };
    const auto group = [&](bool supports) {
        std::vector<char> chosen = judged;
        for (std::size_t k = 0; k < chosen.size(); ++k)
            chosen[k] = chosen[k] != 0 && is_support(upper.tracks[k]) == supports ? 1 : 0;
        return chosen;
    };
    const auto widen = [&](PrintedLayer& layer) {
        if (rules.object_reach == 0) return;
        for (PrintedTrack& t : layer.tracks)
            if (!is_support(t)) t.width = Rational(Rational(t.width) + 2 * rules.object_reach);
    };
    PrintedLayer under_object = lower;
    const std::optional<std::vector<std::size_t>> entries = entries_below(print, entry, rules.gap_layers);
    if (rules.gap_layers > 0 && entries)
        for (const std::size_t e : *entries) {
            const PrintedLayer more = layer_below(print, e);
            under_object.tracks.insert(under_object.tracks.end(), more.tracks.begin(), more.tracks.end());
        }
    if (rules.supports_alone) std::erase_if(lower.tracks, [&](const PrintedTrack& t) { return !is_support(t); });
    widen(lower), widen(under_object);
    GroupVerdict verdict = judge(upper, lower, group(true), rules);
    if (!entries) return verdict;  // the bed holds up the object
    GroupVerdict object = judge(upper, under_object, group(false), rules);
    add_group(std::move(object), std::move(under_object), verdict, lower);
    return verdict;
}

/// The same where gaps widen what holds up: they do so outside the outline of `lower` alone. Inside, everything must
/// lie on what is directly below. What of `upper` lies outside comes after its tracks then.
GroupVerdict judge_inside_and_outside(const GcodePrint& print, std::size_t entry, PrintedLayer& upper,
                                      PrintedLayer& lower, std::vector<char> judged, const LayerRules& rules) {
    PrintedLayer inside = lower;
    OutsideTracks outside = tracks_outside(upper, lower);
    append(std::move(outside.stretches), inside.tracks);
    std::vector<char> apart(judged.size(), 0);
    for (const PrintedTrack& t : outside.extruded) apart.push_back(rules.judged[static_cast<std::size_t>(t.feature)]);
    append(std::move(outside.extruded), upper.tracks);
    judged.resize(apart.size(), 0);
    GroupVerdict verdict = judge_groups(print, entry, upper, lower, apart, rules);
    GroupVerdict within = judge(upper, inside, judged, rules);
    add_group(std::move(within), std::move(inside), verdict, lower);
    return verdict;
}

}  // namespace

JudgedLayer judge_layer(const GcodePrint& print, std::size_t entry, const LayerRules& rules) {
    const GcodeLayer& layer = print.layers[entry];
    JudgedLayer result;
    result.features.resize(print.features.size());
    HangingLayer& out = result.layer;
    out.layer = layer.layer;
    out.entry = entry;
    out.z_mm = to_double(layer.z);
    out.height_mm = static_cast<double>(layer.height) * 1e-9;
    out.on_bed = layer.on_bed;
    bool any_judged = false;
    for (const GcodeTrack& t : layer.tracks) {
        const GcodePoint &a = layer.points[t.a], &b = layer.points[t.b];
        const double length = std::hypot(to_double(b.x - a.x), to_double(b.y - a.y));
        FeatureShare& share = result.features[t.feature];
        ++share.tracks;
        share.length_mm += length;
        if (rules.judged[t.feature] == 0) continue;
        any_judged = true;
        out.length_mm += length;
    }
    if (layer.on_bed || !any_judged) return result;

    const auto judged_of = [&](const PrintedLayer& tracks) {
        std::vector<char> judged;
        for (const PrintedTrack& t : tracks.tracks) judged.push_back(rules.judged[static_cast<std::size_t>(t.feature)]);
        return judged;
    };
    PrintedLayer lower = material_below(print, entry);
    PrintedLayer upper = layer_above(print, entry);
    if (rules.inside) append(stretches_outside(upper, lower), lower.tracks);
    if (rules.longest_bridge) {
        const std::vector<char> judged_bridges = judged_of(upper);
        upper = without_bridges(layer, std::move(upper), lower, judged_bridges, rules, result);
    }
    const std::vector<char> judged = judged_of(upper);
    const bool gaps = rules.object_reach != 0 || rules.gap_layers > 0;
    const auto [verdict, unlocated] = rules.inside ? judge(upper, lower, judged, rules)
                                      : gaps       ? judge_inside_and_outside(print, entry, upper, lower, judged, rules)
                                                   : judge_groups(print, entry, upper, lower, judged, rules);
    out.stages += verdict.stages;
    for (std::size_t k = 0; k < upper.tracks.size(); ++k) {
        const Enclosure length{verdict.unsupported_length[k][0], verdict.unsupported_length[k][1]};
        out.unsupported_mm += length;
        result.features[static_cast<std::size_t>(upper.tracks[k].feature)].unsupported_mm += length;
    }
    for (const UnsupportedPiece& p : verdict.pieces) out.pieces.push_back(describe(p, upper));
    for (const UnsupportedRegion& r : verdict.regions) out.regions.push_back(describe(r, upper, lower, rules.min_area));
    const auto counts = [](const HangingRegion& r) { return !r.ignored; };
    out.supported = verdict.supported || (!unlocated && std::none_of(out.regions.begin(), out.regions.end(), counts));
    return result;
}

}  // namespace ribvault
