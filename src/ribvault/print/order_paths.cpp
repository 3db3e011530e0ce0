#include "ribvault/print/order_paths.hpp"

#include <algorithm>
#include <array>

#include "ribvault/print/islands.hpp"

namespace ribvault {
namespace {

constexpr std::size_t stages = 4;
using Tracks = std::vector<std::size_t>;

/// The tracks of one island by stage.
struct IslandTracks {
    std::array<Tracks, stages> of;
    Point anchor;  ///< where its first stage begins
    bool empty = true;
};

bool more_to_the_rear(Point a, Point b) { return a.y != b.y ? a.y > b.y : a.x < b.x; }

Point first_point(const PlannedTrack& track) { return track.paths.front().points.front(); }
Point last_point(const PlannedTrack& track) { return end_of(track.paths.back()); }

std::vector<IslandTracks> sort_by_island(const LayerPlan& plan, const Region& outline) {
    const Islands islands(outline);
    std::vector<IslandTracks> all(islands.size());
    for (std::size_t t = 0; t < plan.tracks.size(); ++t) {
        const PlannedTrack& track = plan.tracks[t];
        IslandTracks& island = all[islands.of(first_point(track))];
        island.of[static_cast<std::size_t>(stage_of(track.paths.front().kind))].push_back(t);
        island.empty = false;
    }
    std::erase_if(all, [](const IslandTracks& island) { return island.empty; });
    for (IslandTracks& island : all) {
        const auto first = std::find_if(island.of.begin(), island.of.end(), [](const Tracks& tracks) { return !tracks.empty(); });
        island.anchor = first_point(plan.tracks[first->front()]);
        for (std::size_t t : *first)
            if (const Point p = first_point(plan.tracks[t]); more_to_the_rear(p, island.anchor)) island.anchor = p;
    }
    return all;
}

std::vector<std::size_t> order_of_islands(const std::vector<IslandTracks>& islands, bool backwards) {
    std::vector<TourStop> stops;
    Point rear = islands.front().anchor;
    for (const IslandTracks& island : islands) {
        stops.push_back({Entry::fixed, island.anchor, island.anchor, nullptr, no_stop});
        if (more_to_the_rear(island.anchor, rear)) rear = island.anchor;
    }
    std::vector<std::size_t> order;
    for (const Visit& v : short_tour(stops, rear, std::nullopt)) order.push_back(v.stop);
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

/// Prints the tracks of one stage; returns where the nozzle stands then.
Point append_stage(LayerPlan& plan, const Tracks& tracks, Point from, std::optional<Point> to, std::vector<std::size_t>& number,
                   LayerPaths& layer) {
    for (std::size_t k = 0; k < tracks.size(); ++k) number[tracks[k]] = k;
    std::vector<TourStop> stops;
    for (std::size_t t : tracks) {
        const PlannedTrack& track = plan.tracks[t];
        stops.push_back({track.entry, first_point(track), last_point(track), &track.paths.front().points,
                         track.after == no_stop ? no_stop : number[track.after]});
    }
    for (const Visit& v : short_tour(stops, from, to)) append(plan.tracks[tracks[v.stop]], v.way, layer);
    return layer.paths.empty() ? from : end_of(layer.paths.back());
}

}  // namespace

PrintStage stage_of(TrackKind kind) {
    switch (kind) {
        case TrackKind::outer_perimeter:
        case TrackKind::inner_perimeter: return PrintStage::perimeters;
        case TrackKind::thin_wall: return PrintStage::thin_walls;
        case TrackKind::cover: return PrintStage::covers;
        case TrackKind::skirt:
        case TrackKind::support: break;
    }
    return PrintStage::supports;
}

LayerPaths order_paths(LayerPlan plan, const Region& outline) {
    LayerPaths layer;
    layer.layer = plan.layer;
    layer.gaps = plan.gaps, layer.gap_length = plan.gap_length;
    layer.thin_places = plan.thin_places, layer.thin_area = plan.thin_area;
    if (plan.tracks.empty()) return layer;

    const std::vector<IslandTracks> islands = sort_by_island(plan, outline);
    const std::vector<std::size_t> order = order_of_islands(islands, plan.layer % 2 != 0);
    std::vector<std::size_t> number(plan.tracks.size());
    Point here = islands[order.front()].anchor;
    for (std::size_t i = 0; i < order.size(); ++i) {
        const IslandTracks& island = islands[order[i]];
        const Point next = i + 1 < order.size() ? islands[order[i + 1]].anchor : island.anchor;
        std::size_t last = stages - 1;
        while (island.of[last].empty()) --last;
        for (std::size_t stage = 0; stage <= last; ++stage)
            here = append_stage(plan, island.of[stage], here, stage == last ? std::optional(next) : std::nullopt, number, layer);
    }
    return layer;
}

}  // namespace ribvault
