#include "ribvault/print/gap_strips.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "ribvault/exact/nearest_segment.hpp"
#include "ribvault/exact/point_location.hpp"

namespace ribvault {
namespace {

/// A straight piece of a track.
struct Piece {
    TrackKind kind;
    Unit width;
    Segment centre;
    bool cut = false;  ///< begins within a step of the track
    bool chosen = false;
};

std::vector<Piece> pieces_of(const PlannedTrack& track, Unit longest) {
    std::vector<Piece> pieces;
    for (const ToolPath& path : track.paths)
        for (std::size_t k = 1; k < path.points.size(); ++k) {
            const Point a = path.points[k - 1], b = path.points[k];
            const auto parts = static_cast<int>(std::ceil(length(b - a) / static_cast<double>(longest)));
            Point from = a;
            for (int part = 1; part <= parts; ++part) {
                const Point to = part == parts ? b : part_way(a, b, static_cast<double>(part) / parts);
                if (to != from) pieces.push_back({path.kind, path.width, {from, to}, part > 1});
                from = to;
            }
        }
    return pieces;
}

/// Chooses pieces between chosen ones, and with `at_ends` before and after them, where these are no longer than `most`
/// together.
void close_up(std::vector<Piece>& pieces, double most, bool at_ends) {
    for (std::size_t from = 0; from < pieces.size();) {
        std::size_t to = from;
        double along = 0;
        for (; to < pieces.size() && pieces[to].chosen == pieces[from].chosen; ++to) along += length(pieces[to].centre);
        const bool first = from == 0, last = to == pieces.size();
        if (!pieces[from].chosen && along <= most && (at_ends ? !(first && last) : !first && !last))
            for (std::size_t k = from; k < to; ++k) pieces[k].chosen = true;
        from = to;
    }
}

/// The runs of pieces that are `chosen`, or that are not, as tracks.
void append_runs(const std::vector<Piece>& pieces, bool chosen, Entry entry, std::vector<PlannedTrack>& tracks) {
    bool open = false;
    for (const Piece& piece : pieces) {
        if (piece.chosen != chosen) {
            open = false;
            continue;
        }
        const bool goes_on = open && piece.cut;
        if (!open) tracks.push_back({{}, entry, no_stop});
        open = true;
        std::vector<ToolPath>& paths = tracks.back().paths;
        if (goes_on) {
            paths.back().points.back() = piece.centre.b;
            continue;
        }
        if (paths.empty() || paths.back().width != piece.width)
            paths.push_back({piece.kind, piece.width, false, {piece.centre.a}});
        paths.back().points.push_back(piece.centre.b);
    }
}

double area_of(std::vector<PlannedTrack>::const_iterator from, std::vector<PlannedTrack>::const_iterator to) {
    double area = 0;
    for (; from != to; ++from) area += area_of(*from);
    return area;
}

/// The centre lines of tracks, and how wide each is.
struct WideLines {
    std::vector<Segment> lines;
    std::vector<Unit> widths;
    void append(const PlannedTrack& track) {
        for (const ToolPath& path : track.paths) {
            append_segments(path, lines);
            widths.resize(lines.size(), path.width);
        }
    }
};

/// The outlines of the covering slices.
class CoveringOutlines {
public:
    explicit CoveringOutlines(const Covering& covering) {
        std::vector<Segment> all;
        for (const auto& slice : covering) {
            std::vector<Segment> edges = edges_of(slice->rounded);
            all.insert(all.end(), edges.begin(), edges.end());
            outlines_.emplace_back(std::move(edges), units_per_mm / 2);
        }
        edges_ = NearestSegment(std::move(all));
    }

    /// Does all of the piece's material, its ends round, lie in each of the outlines?
    bool hide(const Piece& piece) const {
        if (std::any_of(outlines_.begin(), outlines_.end(), [&](const PointLocation& outline) {
                return outline.locate(piece.centre.a) == Side::outside;
            }))
            return false;
        bool touched = false;
        edges_.visit(bounding_box(piece.centre, piece.width / 2), [&](std::uint32_t k) {
            if (!touched) touched = compare_distance(edges_.segments()[k], piece.centre, piece.width / 2) < 0;
        });
        return !touched;
    }

private:
    std::vector<PointLocation> outlines_;
    NearestSegment edges_;  ///< of all
};

}  // namespace

void append_strips(std::vector<PlannedTrack> strips, const Covering& covering, Unit d, LayerPlan& plan) {
    if (strips.empty()) return;
    if (covering.empty()) {
        std::move(strips.begin(), strips.end(), std::back_inserter(plan.tracks));
        return;
    }
    const CoveringOutlines outlines(covering);
    const std::size_t before = plan.spare.size();
    for (const PlannedTrack& strip : strips) {
        if (const ToolPath& path = strip.paths.front(); path.points.size() == 1) {  // a dot
            const auto across = static_cast<double>(path.width);
            if (outlines.hide({path.kind, path.width, {path.points.front(), path.points.front()}}))
                plan.unfilled_area += std::numbers::pi / 4 * across * across;
            else
                plan.tracks.push_back(strip);
            continue;
        }
        std::vector<Piece> pieces = pieces_of(strip, d);
        for (Piece& piece : pieces)
            piece.chosen = !outlines.hide(piece);
        close_up(pieces, static_cast<double>(d), true);
        append_runs(pieces, true, strip.entry, plan.tracks);
        append_runs(pieces, false, strip.entry, plan.spare);
    }
    plan.unfilled_area += area_of(plan.spare.begin() + static_cast<std::ptrdiff_t>(before), plan.spare.end());
}

std::vector<StripReach> seem_to_hang(const std::vector<Lane>& above, const std::vector<Segment>& walls,
                                     const LayerPlan& plan, const Settings& settings) {
    WideLines printed, not_printed;
    for (const PlannedTrack& track : plan.tracks) printed.append(track);
    for (const PlannedTrack& track : plan.spare) not_printed.append(track);
    printed.lines.insert(printed.lines.end(), walls.begin(), walls.end());
    printed.widths.resize(printed.lines.size(), settings.nozzle);
    const NearestSegment spare(std::move(not_printed.lines)), below(std::move(printed.lines));
    std::vector<StripReach> hanging;
    if (spare.empty() || below.empty()) return hanging;
    const Unit widest = *std::max_element(not_printed.widths.begin(), not_printed.widths.end()),
               widest_below = *std::max_element(printed.widths.begin(), printed.widths.end());
    const auto rho = static_cast<double>(settings.support_radius);
    const auto holds = [&](Point p, double more) {
        bool held = false;
        const Unit reach = widest_below / 2 + static_cast<Unit>(std::max(0.0, more));
        below.visit(bounding_box({p, p}, reach), [&](std::uint32_t k) {
            if (held) return;
            const double far = static_cast<double>(printed.widths[k]) / 2 + more;
            held = far >= 0 && squared_distance(p, below.segments()[k]).value() <= far * far;
        });
        return held;
    };
    for (const Lane& lane : above) {
        bool near = false;
        spare.visit(bounding_box(lane.centre, lane.width / 2 + settings.support_radius + widest / 2),
                    [&](std::uint32_t) { near = true; });
        if (!near) continue;
        const auto parts = std::max(
            1, static_cast<int>(std::ceil(2 * length(lane.centre) / static_cast<double>(settings.nozzle))));
        for (int k = 0; k <= parts; ++k) {
            const Point p = part_way(lane.centre.a, lane.centre.b, static_cast<double>(k) / parts);
            if (holds(p, rho - static_cast<double>(lane.width) / 2)) continue;
            for (int turn = 0; turn < 8; ++turn) {
                const double angle = turn * std::numbers::pi / 4, half = static_cast<double>(lane.width) / 2;
                const Point rim =
                    p + Point{round_to_lattice(half * std::cos(angle)), round_to_lattice(half * std::sin(angle))};
                if (!holds(rim, rho)) hanging.push_back({{rim, rim}, rho});
            }
        }
    }
    return hanging;
}

bool print_strips_under(const std::vector<StripReach>& hanging, Unit d, LayerPlan& plan) {
    if (plan.spare.empty() || hanging.empty()) return false;
    const std::vector<PlannedTrack> spare = std::exchange(plan.spare, {});
    std::vector<Segment> stretches;
    double farthest = 0;
    for (const StripReach& h : hanging) stretches.push_back(h.stretch), farthest = std::max(farthest, h.reach);
    const NearestSegment near(std::move(stretches));
    const std::size_t before = plan.tracks.size();
    for (const PlannedTrack& strip : spare) {
        std::vector<Piece> pieces = pieces_of(strip, d);
        for (Piece& piece : pieces) {
            const double half = static_cast<double>(piece.width) / 2;
            near.visit(bounding_box(piece.centre, static_cast<Unit>(std::ceil(farthest + half))), [&](std::uint32_t k) {
                if (!piece.chosen)
                    piece.chosen = distance(piece.centre, hanging[k].stretch) <= hanging[k].reach + half;
            });
        }
        close_up(pieces, 5 * static_cast<double>(d), false);
        append_runs(pieces, true, strip.entry, plan.tracks);
        append_runs(pieces, false, strip.entry, plan.spare);
    }
    plan.unfilled_area -= area_of(plan.tracks.begin() + static_cast<std::ptrdiff_t>(before), plan.tracks.end());
    return plan.tracks.size() > before;
}

void reach_over_strips(const LayerPlan& plan, Unit d, SupportForest& forest) {
    WideLines object;  // without the tracks of walls of several lines
    for (const PlannedTrack& track : plan.tracks)
        if (!is_support(track.paths.front().kind)) object.append(track);
    const NearestSegment tracks(std::move(object.lines));
    if (tracks.empty()) return;
    const auto width = static_cast<double>(d);
    for (std::size_t v = 0, before = num_vertices(forest); v < before; ++v) {
        const SupportVertex root = forest[v];
        if (!root.root || root.free || root.outside || out_degree(v, forest) != 1) continue;
        const NearestSegment::Hit hit = tracks.nearest(root.at);
        const double half = static_cast<double>(object.widths[hit.index]) / 2, wanted = half + width / 4,
                     far = std::sqrt(hit.distance.value());
        if (far <= wanted + width / 40 || far > half + 2 * width) continue;
        const auto w = add_vertex(root, forest);
        forest[w].at = part_way(nearest_point(root.at, tracks.segments()[hit.index]), root.at, wanted / far);
        forest[v].root = false;
        add_edge(v, w, forest);
    }
}

}  // namespace ribvault
