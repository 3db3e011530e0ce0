#include "ribvault/print/lay_patches.hpp"

#include <algorithm>
#include <map>
#include <numbers>
#include <set>
#include <tuple>

#include "ribvault/print/drop_tiny_steps.hpp"

namespace ribvault {
namespace {

NearestSegment segments_of(const LayerPlan& plan, std::vector<PlanTracks::Place>& places) {
    std::vector<Segment> segments;
    for (std::size_t t = 0; t < plan.tracks.size(); ++t)
        for (std::size_t p = 0; p < plan.tracks[t].paths.size(); ++p) {
            const std::size_t before = segments.size();
            append_segments(plan.tracks[t].paths[p], segments);
            for (std::size_t k = before; k < segments.size(); ++k) places.push_back({t, p, k - before});
        }
    return NearestSegment(std::move(segments));
}

class PatchLayer {
public:
    PatchLayer(const PlanTracks& on, LayerPlan& plan, Unit width, const std::function<bool(const Segment&)>& open)
        : on_(on), plan_(plan), width_(width), open_(open), dot_(std::numbers::pi / 4 * static_cast<double>(width)) {}

    Unit run(const std::vector<Patch>& patches) {
        for (const Patch& patch : patches)
            if (patch.segment.a != patch.segment.b || !join(patch)) lay(patch.kind, patch.segment);
        insert_spurs();
        return round_to_lattice(added_);
    }

private:
    struct Spur {
        double along;  ///< from the beginning of the step
        Point from, to;
    };
    using Step = std::tuple<std::size_t, std::size_t, std::size_t>;

    void lay(TrackKind kind, const Segment& s, bool on_track = false) {
        laid_.push_back({s, kind});
        ToolPath path{kind, width_, false, {s.a}, on_track};
        if (!is_tiny_step(s.a, s.b)) path.points.push_back(s.b), added_ += length(s);
        plan_.tracks.push_back({{std::move(path)}, Entry::either_end, no_stop});
    }

    bool join(const Patch& patch) {
        Point dot = patch.segment.a;
        if (on_.segments().empty()) return false;
        const NearestSegment::Hit hit = on_.segments().nearest(dot);
        if (const Patch* near = nearest_laid(patch); near && compare(squared_distance(dot, near->segment), hit.distance) < 0) {
            const Point from = nearest_point(dot, near->segment);
            if (dot == from) return true;
            dot = beyond_tiny(from, dot);
            if (length(dot - from) > dot_ || !is_open(patch.kind, {from, dot})) return false;
            lay(patch.kind, {from, dot}, true);
            return true;
        }
        const Segment& step = on_.segments().segments()[hit.index];
        const auto [t, p, k] = on_.place(hit.index);
        PlannedTrack& track = plan_.tracks[t];
        const ToolPath& path = track.paths[p];
        if ((patch.kind == TrackKind::external_support) != (path.kind == TrackKind::external_support)) return false;
        Point from = nearest_point(dot, step);
        for (const Point end : {step.a, step.b})
            if (is_tiny_step(from, end)) from = end;
        if (dot == from) return path.width >= width_;
        dot = beyond_tiny(from, dot);
        const double way = length(dot - from);
        if (way > dot_ || !is_open(patch.kind, {from, dot})) return false;
        if (!path.closed) {
            const bool last = p + 1 == track.paths.size() && k + 2 >= path.points.size() && from == step.b;
            const bool first = p == 0 && k == 0 && from == step.a && track.entry == Entry::either_end;
            for (const bool at_end : {true, false})
                if ((at_end ? last : first) && prolonged_.insert({t, at_end}).second) {
                    prolong(t, at_end, patch.kind, dot);
                    added_ += way;
                    laid_.push_back({{from, dot}, patch.kind});
                    return true;
                }
        }
        if (is_support(path.kind) && !path.closed && path.width == width_ && path.points.size() > 1 && 2 * way <= dot_) {
            spurs_[{t, p, k}].push_back({length(from - step.a), from, dot});
            added_ += 2 * way;
            laid_.push_back({{from, dot}, patch.kind});
        } else {
            lay(patch.kind, {from, dot}, path.width >= width_);
        }
        return true;
    }

    bool is_open(TrackKind kind, const Segment& way) const { return !open_ || kind != TrackKind::external_support || open_(way); }

    /// `to`, or on the way there what is just far enough for a step.
    static Point beyond_tiny(Point from, Point to) {
        if (!is_tiny_step(from, to)) return to;
        const Point way = to - from;
        const double t = 1.01 * static_cast<double>(shortest_step) / length(way);
        return from + Point{round_to_lattice(t * static_cast<double>(way.x)), round_to_lattice(t * static_cast<double>(way.y))};
    }

    /// Of the same kind.
    const Patch* nearest_laid(const Patch& patch) const {
        const Patch* nearest = nullptr;
        double least = HUGE_VAL;
        for (const Patch& laid : laid_) {
            if (laid.kind != patch.kind) continue;
            if (const double d = squared_distance(patch.segment.a, laid.segment).value(); d < least) least = d, nearest = &laid;
        }
        return nearest;
    }

    /// Points before the first one would shift the steps that spurs leave from: they are kept apart until the end.
    void prolong(std::size_t t, bool at_end, TrackKind kind, Point to) {
        PlannedTrack& track = plan_.tracks[t];
        ToolPath& path = at_end ? track.paths.back() : track.paths.front();
        const Point from = at_end ? path.points.back() : path.points.front();
        if (path.kind == kind && path.width == width_ && at_end) {
            path.points.push_back(to);
        } else if (at_end) {
            track.paths.push_back({kind, width_, false, {from, to}});
        } else {
            before_[t] = {kind, width_, false, {to, from}};
        }
    }

    void insert_spurs() {
        // From the last step of a path to its first, so that numbers of steps stay true.
        for (auto it = spurs_.rbegin(); it != spurs_.rend(); ++it) {
            const auto [t, p, k] = it->first;
            std::vector<Point>& points = plan_.tracks[t].paths[p].points;
            std::vector<Spur>& spurs = it->second;
            std::sort(spurs.begin(), spurs.end(), [](const Spur& a, const Spur& b) { return a.along < b.along; });
            std::vector<Point> way{points[k]};
            const auto go = [&](Point to) {
                if (way.back() != to) way.push_back(to);
            };
            for (const Spur& spur : spurs) {
                // Two that leave close to each other leave at the same place.
                const Point from = is_tiny_step(way.back(), spur.from) ? way.back() : spur.from;
                go(from), go(spur.to), go(from);
            }
            if (way.size() > 1 && way.back() == points[k + 1]) way.pop_back();
            points.erase(points.begin() + static_cast<std::ptrdiff_t>(k));
            points.insert(points.begin() + static_cast<std::ptrdiff_t>(k), way.begin(), way.end());
        }
        for (auto& [t, path] : before_) {
            PlannedTrack& track = plan_.tracks[t];
            ToolPath& first = track.paths.front();
            if (first.kind == path.kind && first.width == path.width)
                first.points.insert(first.points.begin(), path.points.front());
            else
                track.paths.insert(track.paths.begin(), std::move(path));
        }
    }

    const PlanTracks& on_;
    LayerPlan& plan_;
    const Unit width_;
    const std::function<bool(const Segment&)>& open_;
    const double dot_;  ///< length of track that takes as much material as a dot
    double added_ = 0;
    std::set<std::pair<std::size_t, bool>> prolonged_;  ///< the track; at its end, or its beginning
    std::vector<Patch> laid_;  ///< what was added so far
    std::map<Step, std::vector<Spur>> spurs_;
    std::map<std::size_t, ToolPath> before_;
};

}  // namespace

PlanTracks::PlanTracks(const LayerPlan& plan) : segments_(segments_of(plan, places_)) {}

Unit lay_patches(const std::vector<Patch>& patches, const PlanTracks& on, LayerPlan& plan, Unit width, const std::function<bool(const Segment&)>& open) {
    return PatchLayer(on, plan, width, open).run(patches);
}

}  // namespace ribvault
