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
    PatchLayer(const PlanTracks& on, LayerPlan& plan, Unit width,
               const std::function<bool(TrackKind, const Segment&)>& open)
        : on_(on), plan_(plan), width_(width), open_(open), dot_(std::numbers::pi / 4 * static_cast<double>(width)) {}

    Unit run(const std::vector<Patch>& patches) {
        for (const Patch& patch : patches)
            if (patch.segment.a != patch.segment.b || !join(patch)) lay(patch.kind, patch.segment);
        insert_spurs();
        prolong_tracks();
        for (const Way& way : ways_)
            if (way.leads == Leads::alone)
                plan_.tracks.push_back(
                    {{{way.kind, width_, false, way.points, way.on_track}}, Entry::either_end, no_stop});
        return round_to_lattice(added_);
    }

private:
    enum class Leads { alone, from_end, from_beginning, aside };
    /// From a place on a track, where it leads from one, to one dot after the other.
    struct Way {
        TrackKind kind;
        std::vector<Point> points;
        Leads leads = Leads::alone;
        bool on_track = false;  ///< one that is alone begins on another's centre line
        std::size_t track = no_stop;
    };
    struct Spur {
        double along;  ///< from the beginning of the step
        std::size_t way;
    };
    using Step = std::tuple<std::size_t, std::size_t, std::size_t>;

    void add(Way way) {
        added_ +=
            (way.leads == Leads::aside ? 2 : 1) * (way.points.size() > 1 ? length(way.points[1] - way.points[0]) : 0);
        ways_.push_back(std::move(way));
    }
    void lay(TrackKind kind, const Segment& s, bool on_track = false) {
        add({kind, is_tiny_step(s.a, s.b) ? std::vector<Point>{s.a} : std::vector<Point>{s.a, s.b}, Leads::alone,
             on_track});
    }

    bool join(const Patch& patch) {
        Point dot = patch.segment.a;
        if (on_.segments().empty()) return false;
        const NearestSegment::Hit hit = on_.segments().nearest(dot);
        Point from;
        if (Way* way = nearest_way(patch, from);
            way && compare(SquaredDistance{squared_length(dot - from), 1}, hit.distance) < 0)
            return lead_on(*way, from, dot);
        const Segment& step = on_.segments().segments()[hit.index];
        const auto [t, p, k] = on_.place(hit.index);
        const PlannedTrack& track = plan_.tracks[t];
        const ToolPath& path = track.paths[p];
        if ((patch.kind == TrackKind::external_support) != (path.kind == TrackKind::external_support)) return false;
        from = nearest_point(dot, step);
        for (const Point end : {step.a, step.b})
            if (is_tiny_step(from, end)) from = end;
        if (dot == from) return path.width >= width_;
        dot = beyond_tiny(from, dot);
        const double way = length(dot - from);
        if (way > dot_ || !is_open(patch.kind, {from, dot})) return false;
        if (!path.closed) {
            const bool last = p + 1 == track.paths.size() && k + 2 >= path.points.size() && from == step.b;
            const bool first = p == 0 && k == 0 && from == step.a && track.entry == Entry::either_end;
            for (const Leads leads : {Leads::from_end, Leads::from_beginning})
                if ((leads == Leads::from_end ? last : first) && prolonged_.insert({t, leads}).second) {
                    add({patch.kind, {from, dot}, leads, false, t});
                    return true;
                }
        }
        if (is_support(path.kind) && !path.closed && path.width == width_ && path.points.size() > 1 &&
            2 * way <= dot_) {
            spurs_[{t, p, k}].push_back({length(from - step.a), ways_.size()});
            add({patch.kind, {from, dot}, Leads::aside, false, t});
        } else {
            lay(patch.kind, {from, dot}, path.width >= width_);
        }
        return true;
    }

    /// A way goes on from its last dot to another one; elsewhere a new one begins on it.
    bool lead_on(Way& way, Point from, Point dot) {
        if (is_tiny_step(from, way.points.back())) from = way.points.back();
        if (dot == from) return true;
        dot = beyond_tiny(from, dot);
        const double l = length(dot - from);
        if (l > dot_ || !is_open(way.kind, {from, dot})) return false;
        if (from != way.points.back()) {
            lay(way.kind, {from, dot}, true);
            return true;
        }
        way.points.push_back(dot);
        added_ += (way.leads == Leads::aside ? 2 : 1) * l;
        return true;
    }

    bool is_open(TrackKind kind, const Segment& way) const { return !open_ || open_(kind, way); }

    /// `to`, or on the way there what is just far enough for a step.
    static Point beyond_tiny(Point from, Point to) {
        if (!is_tiny_step(from, to)) return to;
        return part_way(from, to, 1.01 * static_cast<double>(shortest_step) / length(to - from));
    }

    /// Of the same kind; `at`: its point nearest to the patch.
    Way* nearest_way(const Patch& patch, Point& at) {
        Way* nearest = nullptr;
        double least = HUGE_VAL;
        for (Way& way : ways_) {
            if (way.kind != patch.kind) continue;
            for (std::size_t k = way.points.size() == 1 ? 0 : 1; k < way.points.size(); ++k) {
                const Segment s{way.points[k == 0 ? 0 : k - 1], way.points[k]};
                if (const double d = squared_distance(patch.segment.a, s).value(); d < least)
                    least = d, nearest = &way, at = nearest_point(patch.segment.a, s);
            }
        }
        return nearest;
    }

    void insert_spurs() {
        // From the last step of a path to its first, so that numbers of steps stay true.
        for (auto it = spurs_.rbegin(); it != spurs_.rend(); ++it) {
            const auto [t, p, k] = it->first;
            std::vector<Point>& points = plan_.tracks[t].paths[p].points;
            std::vector<Spur>& spurs = it->second;
            std::sort(spurs.begin(), spurs.end(), [](const Spur& a, const Spur& b) { return a.along < b.along; });
            std::vector<Point> whole{points[k]};
            const auto go = [&](Point to) {
                if (whole.back() != to) whole.push_back(to);
            };
            for (const Spur& spur : spurs) {
                std::vector<Point> way = ways_[spur.way].points;
                // Two that leave close to each other leave at the same place.
                if (is_tiny_step(whole.back(), way.front())) way.front() = whole.back();
                std::for_each(way.begin(), way.end(), go);
                std::for_each(way.rbegin(), way.rend(), go);
            }
            if (whole.size() > 1 && whole.back() == points[k + 1]) whole.pop_back();
            points.erase(points.begin() + static_cast<std::ptrdiff_t>(k));
            points.insert(points.begin() + static_cast<std::ptrdiff_t>(k), whole.begin(), whole.end());
        }
    }

    void prolong_tracks() {
        for (Way& way : ways_) {
            if (way.leads != Leads::from_end && way.leads != Leads::from_beginning) continue;
            std::vector<ToolPath>& paths = plan_.tracks[way.track].paths;
            const bool at_end = way.leads == Leads::from_end;
            ToolPath& path = at_end ? paths.back() : paths.front();
            const bool same = path.kind == way.kind && path.width == width_;
            if (!at_end) std::reverse(way.points.begin(), way.points.end());
            if (same)
                path.points.insert(at_end ? path.points.end() : path.points.begin(),
                                   way.points.begin() + (at_end ? 1 : 0), way.points.end() - (at_end ? 0 : 1));
            else
                paths.insert(at_end ? paths.end() : paths.begin(), ToolPath{way.kind, width_, false, way.points});
        }
    }

    const PlanTracks& on_;
    LayerPlan& plan_;
    const Unit width_;
    const std::function<bool(TrackKind, const Segment&)>& open_;
    const double dot_;  ///< length of track that takes as much material as a dot
    double added_ = 0;
    std::set<std::pair<std::size_t, Leads>> prolonged_;
    std::vector<Way> ways_;
    std::map<Step, std::vector<Spur>> spurs_;
};

}  // namespace

PlanTracks::PlanTracks(const LayerPlan& plan) : segments_(segments_of(plan, places_)) {}

Unit lay_patches(const std::vector<Patch>& patches, const PlanTracks& on, LayerPlan& plan, Unit width,
                 const std::function<bool(TrackKind, const Segment&)>& open) {
    return PatchLayer(on, plan, width, open).run(patches);
}

}  // namespace ribvault
