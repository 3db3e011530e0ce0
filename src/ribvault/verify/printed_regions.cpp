// What violates equation (2), described: groups, boundaries, distances, witnesses.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "ribvault/verify/printed_pair.hpp"
#include "ribvault/verify/trace_region.hpp"

namespace ribvault::verify {

namespace {

double distance_between(const PreparedTrack& p, const PreparedTrack& q) {
    const auto side = [](const PreparedTrack& t, double x, double y) { return t.dx * (y - t.ay) - t.dy * (x - t.ax); };
    if (side(p, q.ax, q.ay) * side(p, q.bx, q.by) < 0 && side(q, p.ax, p.ay) * side(q, p.bx, p.by) < 0) return 0;
    return std::min({centre_distance(p, q.ax, q.ay), centre_distance(p, q.bx, q.by), centre_distance(q, p.ax, p.ay),
                     centre_distance(q, p.bx, p.by)});
}

// Groups of stadiums that touch, or may: a number for each.
std::vector<int> groups_of(const std::vector<PreparedTrack>& tracks, double margin) {
    std::vector<int> parent(tracks.size());
    std::iota(parent.begin(), parent.end(), 0);
    const auto top = [&](int i) {
        while (parent[static_cast<std::size_t>(i)] != i)
            i = parent[static_cast<std::size_t>(i)] =
                parent[static_cast<std::size_t>(parent[static_cast<std::size_t>(i)])];
        return i;
    };
    const TrackGrid grid(tracks, 4 * margin);
    std::vector<int> near;
    for (std::size_t i = 0; i < tracks.size(); ++i) {
        grid.near(tracks[i], tracks[i].half + 4 * margin, near);
        for (const int j : near) {
            const auto& other = tracks[static_cast<std::size_t>(j)];
            if (top(static_cast<int>(i)) == top(j)) continue;
            if (distance_between(tracks[i], other) <= tracks[i].half + other.half + 4 * margin)
                parent[static_cast<std::size_t>(top(static_cast<int>(i)))] = top(j);
        }
    }
    std::vector<int> group(tracks.size());
    for (std::size_t i = 0; i < tracks.size(); ++i) group[i] = top(static_cast<int>(i));
    return group;
}

// The double (x, y) with as few decimals as keep it in the group and out of K.
std::optional<RationalPoint> short_point(const PrintedPair& pair, const std::vector<int>& tracks, double x, double y) {
    for (const double grain : {1e2, 1e3, 1e4, 1e6, 1e9, 0.0}) {
        const auto coordinate = [&](double a) {
            if (grain == 0 || std::abs(a) * grain > 1e18) return Rational(a);
            Rational r(mpz_class(std::round(a * grain)), mpz_class(grain));
            r.canonicalize();
            return r;
        };
        const RationalPoint p{coordinate(x), coordinate(y)};
        if (outside_lower(pair, p) &&
            std::any_of(tracks.begin(), tracks.end(), [&](int t) { return in_upper(pair, t, p); }))
            return p;
    }
    return std::nullopt;
}

UnsupportedRegion describe(const PrintedPair& pair, const std::vector<const OpenPart*>& parts,
                           const std::vector<PreparedTrack>& pieces, const PrintedOptions& options) {
    UnsupportedRegion region;
    std::vector<int> tracks;
    for (const OpenPart* p : parts) tracks.push_back(p->track);
    std::sort(tracks.begin(), tracks.end());
    tracks.erase(std::unique(tracks.begin(), tracks.end()), tracks.end());
    region.tracks.assign(tracks.begin(), tracks.end());

    const LowerTracks lower = pair.lower_tracks();
    const int effort = options.distance_cells + 64 * static_cast<int>(parts.size());
    region.boundary = trace_region(pair, tracks, pieces);
    for (const RegionComponent& c : region.boundary.components) {
        region.area_lo = std::nextafter(region.area_lo + c.area_lo, 0);
        region.area_hi = std::nextafter(region.area_hi + c.area_hi, HUGE_VAL);
    }
    // The region's points are those of the tracks farther than ρ from the material.
    const Farthest farthest = farthest_in(pieces, lower, effort);
    const double rho_down = pair.rho_approx;  // get_d truncates
    region.distance_lo = std::max(farthest.lo, rho_down),
    region.distance_hi = std::max(farthest.hi, region.distance_lo);

    std::optional<RationalPoint> witness = short_point(pair, tracks, farthest.x, farthest.y);
    for (const OpenPart* p : parts) {
        if (witness) break;
        if (p->gap) {
            witness = point_of_gap(pair.upper[static_cast<std::size_t>(p->track)], *p->gap);
        } else {
            witness = witness_from(pair, p->track, *p->local, *p->found);
        }
    }
    region.witness_certified = witness.has_value();
    region.witness = witness ? *witness : RationalPoint{Rational(farthest.x), Rational(farthest.y)};
    double distance = 0;
    pair.grid.nearest(region.witness[0].get_d(), region.witness[1].get_d(), distance);
    region.witness_distance = std::max(distance - 2 * pair.margin, witness ? rho_down : 0);
    return region;
}

}  // namespace

PreparedTrack part_of(const PrintedPair& pair, const OpenPart& part) {
    const PreparedTrack& t = pair.above[static_cast<std::size_t>(part.track)];
    if (t.inverse_norm == 0) return t;
    const double from = std::clamp(part.stretch.lo / t.length, 0.0, 1.0),
                 to = std::clamp(part.stretch.hi / t.length, 0.0, 1.0);
    return prepared_track(t.ax + from * t.dx, t.ay + from * t.dy, t.ax + to * t.dx, t.ay + to * t.dy, t.half);
}

std::vector<UnsupportedRegion> describe_regions(const PrintedPair& pair, std::vector<OpenPart>& parts,
                                                const PrintedOptions& options) {
    std::vector<PreparedTrack> pieces;
    for (const OpenPart& p : parts) pieces.push_back(part_of(pair, p));
    const std::vector<int> group = groups_of(pieces, pair.margin);
    std::vector<int> order(parts.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int i, int j) {
        return group[static_cast<std::size_t>(i)] < group[static_cast<std::size_t>(j)];
    });
    std::vector<UnsupportedRegion> regions;
    for (std::size_t i = 0; i < order.size();) {
        std::vector<const OpenPart*> members;
        std::vector<PreparedTrack> of_group;
        const int g = group[static_cast<std::size_t>(order[i])];
        for (; i < order.size() && group[static_cast<std::size_t>(order[i])] == g; ++i) {
            members.push_back(&parts[static_cast<std::size_t>(order[i])]);
            of_group.push_back(pieces[static_cast<std::size_t>(order[i])]);
        }
        regions.push_back(describe(pair, members, of_group, options));
    }
    std::sort(regions.begin(), regions.end(), [](const UnsupportedRegion& p, const UnsupportedRegion& q) {
        return p.tracks.front() < q.tracks.front();
    });
    return regions;
}

}  // namespace ribvault::verify
