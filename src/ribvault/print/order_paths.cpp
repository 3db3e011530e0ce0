#include "ribvault/print/order_paths.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "ribvault/print/islands.hpp"

namespace ribvault {
namespace {

constexpr std::size_t stages = 2;
using Tracks = std::vector<std::size_t>;

/// The tracks of one island, or all external supports, by stage.
struct IslandTracks {
    std::array<Tracks, stages> of;
    Point anchor;  ///< where its first stage begins
    bool empty = true;
    bool outside = false;  ///< external supports
};

Point first_point(const PlannedTrack& track) { return track.paths.front().points.front(); }
Point last_point(const PlannedTrack& track) { return end_of(track.paths.back()); }

/// Where perimeters that may be entered anywhere rather begin: next to an end of a track inside them, that most to the
/// rear, so that it stays about there from layer to layer. Nothing when there are none of both.
std::optional<Point> free_seam(const LayerPlan& plan, const IslandTracks& island) {
    std::optional<Point> seam;
    for (std::size_t inside : island.of[1])
        for (const Point end : {first_point(plan.tracks[inside]), last_point(plan.tracks[inside])}) {
            std::optional<Point> beside;
            double nearest = std::numeric_limits<double>::infinity();
            for (std::size_t t : island.of[0]) {
                const PlannedTrack& perimeter = plan.tracks[t];
                if (perimeter.entry != Entry::anywhere || perimeter.after != no_stop) continue;
                for (Point p : perimeter.paths.front().points)
                    if (const double d = length(p - end); d < nearest) nearest = d, beside = p;
            }
            if (beside && (!seam || more_to_the_rear(*beside, *seam))) seam = beside;
        }
    return seam;
}

/// External supports are the last.
std::vector<IslandTracks> sort_by_island(const LayerPlan& plan, const Region& outline) {
    const Islands islands(outline);
    std::vector<IslandTracks> all(islands.size() + 1);
    all.back().outside = true;
    for (std::size_t t = 0; t < plan.tracks.size(); ++t) {
        const PlannedTrack& track = plan.tracks[t];
        IslandTracks& island =
            track.paths.front().kind == TrackKind::external_support ? all.back() : all[islands.of(first_point(track))];
        island.of[static_cast<std::size_t>(stage_of(track.paths.front().kind))].push_back(t);
        island.empty = false;
    }
    std::erase_if(all, [](const IslandTracks& island) { return island.empty; });
    for (IslandTracks& island : all) {
        if (std::optional<Point> seam = free_seam(plan, island)) {
            island.anchor = *seam;
            continue;
        }
        const auto first =
            std::find_if(island.of.begin(), island.of.end(), [](const Tracks& tracks) { return !tracks.empty(); });
        island.anchor = first_point(plan.tracks[first->front()]);
        for (std::size_t t : *first)
            if (const Point p = first_point(plan.tracks[t]); more_to_the_rear(p, island.anchor)) island.anchor = p;
    }
    return all;
}

/// Islands on a short way from the rearmost one, then external supports; all that backwards, if so.
std::vector<std::size_t> order_of_islands(const std::vector<IslandTracks>& islands, bool backwards) {
    std::vector<TourStop> stops;
    Point rear = islands.front().anchor;
    for (const IslandTracks& island : islands) {
        if (island.outside) continue;
        stops.push_back({Entry::fixed, island.anchor, island.anchor, nullptr, no_stop});
        if (more_to_the_rear(island.anchor, rear)) rear = island.anchor;
    }
    std::vector<std::size_t> order;
    for (const Visit& v : short_tour(stops, rear, std::nullopt)) order.push_back(v.stop);
    if (islands.back().outside) order.push_back(islands.size() - 1);
    if (backwards) std::reverse(order.begin(), order.end());
    return order;
}

void append(PlannedTrack& track, std::size_t way, LayerPaths& layer) {
    if (track.entry == Entry::anywhere) {
        Contour& ring = track.paths.front().points;
        std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(way), ring.end());
    } else if (way == 1) {
        std::reverse(track.paths.begin(), track.paths.end());
        for (ToolPath& path : track.paths) std::reverse(path.points.begin(), path.points.end());
    }
    for (ToolPath& path : track.paths) layer.paths.push_back(std::move(path));
}

/// A short way through the tracks of one stage.
std::vector<Visit> tour_of(const LayerPlan& plan, const Tracks& tracks, Point from, std::optional<Point> to) {
    std::vector<std::size_t> number(plan.tracks.size(), no_stop);
    for (std::size_t k = 0; k < tracks.size(); ++k) number[tracks[k]] = k;
    std::vector<TourStop> stops;
    for (std::size_t t : tracks) {
        const PlannedTrack& track = plan.tracks[t];
        stops.push_back({track.entry, first_point(track), last_point(track), &track.paths.front().points,
                         track.after == no_stop ? no_stop : number[track.after]});
    }
    return short_tour(stops, from, to);
}

/// Prints the tracks of one stage; returns where the nozzle stands then.
Point append_stage(LayerPlan& plan, const Tracks& tracks, Point from, std::optional<Point> to, LayerPaths& layer) {
    for (const Visit& v : tour_of(plan, tracks, from, to)) append(plan.tracks[tracks[v.stop]], v.way, layer);
    return layer.paths.empty() ? from : end_of(layer.paths.back());
}

/// Where an island that is printed perimeters first is left when what they enclose begins at `from`; the layer above,
/// which is printed the other way round, starts there.
Point far_end(const LayerPlan& plan, const IslandTracks& island, Point from) {
    const std::vector<Visit> tour = tour_of(plan, island.of[1], from, std::nullopt);
    if (tour.empty()) return from;
    const PlannedTrack& last = plan.tracks[island.of[1][tour.back().stop]];
    if (last.entry == Entry::anywhere) return last.paths.front().points[tour.back().way];
    return tour.back().way == 0 ? last_point(last) : first_point(last);
}

}  // namespace

PrintStage stage_of(TrackKind kind) {
    return kind == TrackKind::outer_perimeter || kind == TrackKind::inner_perimeter ? PrintStage::perimeters
                                                                                    : PrintStage::inside;
}

LayerPaths order_paths(LayerPlan plan, const Region& outline, bool alternate) {
    LayerPaths layer;
    layer.layer = plan.layer;
    layer.gaps = plan.gaps, layer.gap_length = plan.gap_length, layer.bends = plan.bends;
    layer.thin_places = plan.thin_places, layer.thin_area = plan.thin_area, layer.unfilled_area = plan.unfilled_area;
    if (plan.tracks.empty()) return layer;

    const std::vector<IslandTracks> islands = sort_by_island(plan, outline);
    const bool backwards = plan.layer % 2 != 0, shell_last = backwards && alternate;
    const std::vector<std::size_t> order = order_of_islands(islands, backwards);
    std::vector<Point> entry(order.size());
    for (std::size_t i = order.size(); i-- > 0;) {
        const IslandTracks& island = islands[order[i]];
        entry[i] = island.anchor;
        // Where an even layer ends with external supports, they begin where the last island has ended.
        if (shell_last)
            entry[i] = far_end(plan, island, island.outside && i + 1 < order.size() ? entry[i + 1] : island.anchor);
    }
    Point here = entry.front();
    for (std::size_t i = 0; i < order.size(); ++i) {
        const IslandTracks& island = islands[order[i]];
        std::optional<Point> next;
        if (i + 1 < order.size()) next = entry[i + 1];
        if (shell_last) {
            here = append_stage(plan, island.of[1], here, island.of[0].empty() ? next : island.anchor, layer);
            here = append_stage(plan, island.of[0], here, next, layer);
        } else {
            if (!next && !alternate) next = island.anchor;
            here = append_stage(plan, island.of[0], here, island.of[1].empty() ? next : std::nullopt, layer);
            here = append_stage(plan, island.of[1], here, next, layer);
        }
    }
    return layer;
}

}  // namespace ribvault
