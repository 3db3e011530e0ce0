#include "ribvault/print/gcode_layers.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <utility>

#include "ribvault/exact/nearest_segment.hpp"

namespace ribvault {
namespace {

constexpr double pooled_mm = 0.25;  // shorter stretches share one flow
constexpr std::int64_t widest = 100 * pm_per_mm;
constexpr double on_track = units_per_mm / 100.0;              // units from its centre line
constexpr Int128 most_pressed = 3 * Int128{decimal_one} / 10;  // 0.3 mm: more is no overlap, but air

GcodePoint flat(const std::array<Decimal, 3>& p) { return {p[0], p[1]}; }

/// The number with the fewest decimals, three at most, that differs by no more than this share; in 1e-9 mm.
std::int64_t shortest_number(double mm, double share) {
    const double least = std::clamp(1000 * mm, 1.0, static_cast<double>(widest) / 1e6);  // µm
    for (const double step : {100, 10}) {
        const double rounded = std::round(least / step) * step;
        if (rounded > 0 && std::abs(rounded - least) <= share * least) return std::llround(rounded) * 1000000;
    }
    return std::llround(least) * 1000000;
}

struct FlowWidths {
    double above, below;    ///< mm: what must be held up; what holds up
    bool too_wide = false;  ///< `below` leaves out some of what is pushed
    bool unsure = false;    ///< a dot by its length; a stub that begins on another track is as wide as above
};

/// Of a track that is pushed over `area`, mm², along `length`, mm. A disc of the same area has all that is pushed in
/// it, whatever the length.
FlowWidths widths_of(double area, double length, bool whole_path, double widest_track) {
    if (length <= 0) return {0, 0};
    const double disc = std::sqrt(4 / std::numbers::pi * area), rectangle = area / length,
                 least = std::min(rectangle, disc);
    if (rectangle > widest_track) return {least, std::min(least, widest_track), least > widest_track};
    const bool dot = whole_path && 4 * length < disc;
    return {rectangle, dot ? least : rectangle, false, dot};
}

Point on_lattice(const GcodePoint& p) {
    return {round_to_lattice(to_double(p.x) * units_per_mm), round_to_lattice(to_double(p.y) * units_per_mm)};
}

/// Of these tracks, those that begin or end on the centre line of another have the round end in that one's material:
/// what is pushed for them is what they add to it.
void widen_stubs_on_tracks(GcodeLayer& layer, const std::vector<std::size_t>& stubs) {
    if (stubs.empty()) return;
    std::vector<Segment> others;
    for (std::size_t k = 0, next = 0; k < layer.tracks.size(); ++k) {
        const GcodeTrack& t = layer.tracks[k];
        if (next < stubs.size() && stubs[next] == k)
            ++next;
        else
            others.push_back({on_lattice(layer.points[t.a]), on_lattice(layer.points[t.b])});
    }
    if (others.empty()) return;
    const NearestSegment tree(std::move(others));
    const auto is_on_track = [&](std::size_t point) {
        return tree.nearest(on_lattice(layer.points[point])).distance.value() <= on_track * on_track;
    };
    for (const std::size_t k : stubs) {
        GcodeTrack& stub = layer.tracks[k];
        if (is_on_track(stub.a) || is_on_track(stub.b)) stub.width_below = stub.width;
    }
}

}  // namespace

/// The width, or minus the number (from 1) of the flow that it will be computed from.
std::int64_t LayerCollector::width_of(const Extrusion& e) {
    if (e.width) {
        close_flow();
        return *e.width;
    }
    Flow alone;
    alone.length = e.length_mm, alone.pushed = e.pushed, alone.step = static_cast<float>(e.pushed_step);
    const bool same = flow_open_ && flows_.back().feature == e.feature && flows_.back().tool == e.tool &&
                      flows_.back().volumetric == e.volumetric && flows_.back().length < pooled_mm &&
                      may_be_as_wide(flows_.back(), alone, e.length_step);
    if (!same) {
        close_flow();
        alone.path = static_cast<std::uint32_t>(paths_);
        alone.tool = e.tool, alone.feature = e.feature, alone.volumetric = e.volumetric;
        flows_.push_back(alone);
        length_step_ = e.length_step;
        flow_open_ = true;
    } else {
        flows_.back().length += e.length_mm;
        flows_.back().pushed += e.pushed;
    }
    return -static_cast<std::int64_t>(flows_.size());
}

/// Whether two stretches push as much for their lengths, up to the last decimals of what the file writes.
bool LayerCollector::may_be_as_wide(const Flow& a, const Flow& b, double length_step) {
    if (a.length <= 0 || b.length <= 0) return true;
    const auto error = [&](const Flow& f) { return (f.step + f.pushed / f.length * length_step) / f.length; };
    return std::abs(a.pushed / a.length - b.pushed / b.length) <= error(a) + error(b);
}

bool LayerCollector::is_whole_path(std::size_t flow) const {
    const auto same_path = [&](std::size_t other) {
        return other < flows_.size() && flows_[other].path == flows_[flow].path;
    };
    return !same_path(flow + 1) && !same_path(flow - 1);
}

/// What is left of a path, too short for a flow of its own, shares the one before.
void LayerCollector::close_flow() {
    if (!std::exchange(flow_open_, false) || flows_.size() < 2 || flows_.back().length >= pooled_mm) return;
    Flow& last = flows_.back();
    auto before = std::next(flows_.rbegin());
    while (before->with_previous) ++before;
    if (before->path != last.path || before->feature != last.feature || before->tool != last.tool ||
        before->volumetric != last.volumetric || !may_be_as_wide(*before, last, length_step_))
        return;
    before->length += last.length;
    before->pushed += last.pushed;
    last.with_previous = true;
}

GcodeLayer& LayerCollector::group(const Extrusion& e) {
    const LayerKey key{e.to[2].value, e.height.value_or(0)};
    const bool over_raft = e.over_raft == 1;
    if (last_group_ == nullptr || key != last_key_ || over_raft != last_over_raft_) {
        last_group_ = over_raft ? &over_raft_[key] : &groups_[key];
        last_key_ = key, last_over_raft_ = over_raft;
    }
    return *last_group_;
}

void LayerCollector::file(GcodeLayer& layer, const Extrusion& e, std::int64_t width, bool continues) {
    GcodeTrack track;
    track.line = e.line, track.feature = e.feature, track.chord = e.chord;
    track.width = track.width_below = width;
    track.continues = continues;
    append_track(layer, flat(e.from), flat(e.to), track);
}

void LayerCollector::extrude(const Extrusion& e) {
    const bool climbs = e.from[2] != e.to[2], continues = std::exchange(in_path_, true);
    const std::int64_t width = width_of(e);
    if (!climbs && !climbed_) {
        if (e.over_raft == 2 && (!second_over_raft_ || e.to[2].value < *second_over_raft_))
            second_over_raft_ = e.to[2].value;
        file(group(e), e, width, continues);
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
        file(group(c.extrusion), c.extrusion, c.width, c.continues);
    }
    climbing_.resize(level_from_);
}

void LayerCollector::end_path() {
    if (!in_path_) return;
    close_flow();
    in_path_ = false;
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
    for (const LayerGroups* groups : {&groups_, &over_raft_})
        for (const auto& [key, layer] : *groups)
            for (const GcodeTrack& t : layer.tracks) add(layer.points[t.a], layer.points[t.b]);
    for (const Climb& c : climbing_) add(flat(c.extrusion.from), flat(c.extrusion.to));
    *this = LayerCollector{};
    return sum;
}

void LayerCollector::press_on_raft(const LayerHints& hints) {
    const Int128 layer = usual_height(groups_, hints) * decimal_per_pm;
    for (auto& [key, tracks] : over_raft_) {
        Int128 z = key.z;
        if (key.height == 0 && second_over_raft_) {
            const Int128 pressed = *second_over_raft_ - layer;
            if (z > pressed && z - pressed <= most_pressed) z = pressed;
        }
        append_tracks(groups_[{z, key.height}], tracks);
    }
    over_raft_.clear();
}

void LayerCollector::file_climbs(const LayerHints& hints) {
    if (climbing_.empty()) return;
    std::vector<Int128> level;
    for (const auto& [key, layer] : groups_)
        if (level.empty() || level.back() != key.z) level.push_back(key.z);
    const std::int64_t usual = usual_height(groups_, hints);
    const auto top_of = [](const Climb& c) { return std::max(c.extrusion.from[2].value, c.extrusion.to[2].value); };
    std::map<std::uint64_t, Int128> tops;  // of paths
    for (const Climb& c : climbing_) {
        const auto [at, is_new] = tops.try_emplace(c.path, top_of(c));
        if (!is_new) at->second = std::max(at->second, top_of(c));
    }
    for (const Climb& c : climbing_) {
        const std::int64_t height = std::max<std::int64_t>(1, c.extrusion.height.value_or(usual));
        const Int128 top = top_of(c), step = height * decimal_per_pm;
        const auto above = std::lower_bound(level.begin(), level.end(), top);
        const Int128 under = above == level.begin() ? 0 : *std::prev(above);
        const Int128 bottom = under + std::max<Int128>(0, (top - under - 1) / step) * step;
        Int128 z = bottom + step;
        if (above != level.begin() && tops[c.path] - under <= z_rounding) {
            z = under;  // the path as a whole climbs no higher than slicers round
        } else if (above != level.end() && z + z_rounding >= *above) {
            z = *above;
            // A vase's last turn ends level before it has climbed a layer: as thick as one at first, then thinner.
            if (c.width < 0 && z - bottom < step)
                flows_[static_cast<std::size_t>(-c.width - 1)].height = (height + in_pm(z - bottom)) / 2;
        }
        file(groups_[{z, c.extrusion.height.value_or(0)}], c.extrusion, c.width, c.continues);
    }
    climbing_.clear();
    level_from_ = 0;
}

void LayerCollector::resolve_widths(GcodePrint& print, GcodeLayer& layer, const LayerHints& hints) const {
    std::vector<std::size_t> unsure;
    for (GcodeTrack& t : layer.tracks) {
        if (t.width > 0) {
            ++print.widths_written;
            continue;
        }
        ++print.widths_computed;
        auto flow = flows_.begin() + static_cast<std::ptrdiff_t>(-t.width - 1);
        const double height = static_cast<double>(flow->height.value_or(layer.height)) * 1e-9;
        while (flow->with_previous) --flow;
        const double diameter =
            hints.filaments[std::min(static_cast<std::size_t>(flow->tool), hints.filaments.size() - 1)];
        const double filament = flow->volumetric || hints.volumetric ? 1 : std::numbers::pi / 4 * diameter * diameter;
        const FlowWidths widths = widths_of(flow->pushed * filament / height, flow->length,
                                            is_whole_path(static_cast<std::size_t>(flow - flows_.begin())),
                                            static_cast<double>(hints.widest_track) * 1e-9);
        const double error = flow->pushed > 0 ? flow->step / flow->pushed : 0;
        t.width = shortest_number(widths.above, error), t.width_below = shortest_number(widths.below, error);
        if (widths.unsure) unsure.push_back(static_cast<std::size_t>(&t - layer.tracks.data()));
        if (!widths.too_wide) continue;
        print.too_wide.widest = hints.widest_track;
        print.too_wide.line = print.too_wide.tracks++ == 0 ? t.line : std::min(print.too_wide.line, t.line);
    }
    widen_stubs_on_tracks(layer, unsure);
}

void LayerCollector::finish(GcodePrint& print, const LayerHints& hints) {
    end_path();
    last_group_ = nullptr;
    press_on_raft(hints);
    file_climbs(hints);
    resolve_heights(groups_, print, hints);
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
            std::size_t j = k - 1;
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
