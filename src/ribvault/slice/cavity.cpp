#include "ribvault/slice/cavity.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>

#include "ribvault/exact/nearest_segment.hpp"
#include "ribvault/slice/lattice_clip.hpp"

namespace ribvault {
namespace {

/// Does the distance to `near` not grow from `middle` of the piece to its side (1: left, -1: right)? It falls where the
/// nearest point lies there. Where that is an end of `near` on the piece's own line, `near` must lead away to that
/// side, and not back.
bool falls_to(int side, const Segment& piece, Point middle, const Segment& near) {
    const Point at = nearest_point(middle, near);
    const int where = orientation(piece.a, piece.b, at);
    if (where != 0) return where == side;
    if (at != near.a && at != near.b) return false;
    const Point end = at == near.a ? near.b : near.a, along = end - at, back = middle - at;
    return orientation(piece.a, piece.b, end) == side &&
           static_cast<Int128>(along.x) * back.x + static_cast<Int128>(along.y) * back.y >= 0;
}

/// Is every point of the segment within radius of one of the tree's segments? A piece whose two ends are within the
/// radius of the same segment is, because the set within a radius of a segment is convex. Right when it says yes:
/// pieces begin at lattice points of the segment where it has any (ties along the axes stay ties), else at rounded
/// middles, less than a unit beside it, and the radius is a unit smaller for each. Says no when halving eight times
/// does not find such pieces. With `side` only segments count to which the distance does not grow on that side of the
/// piece, or within `sure` of which the piece is.
bool within_radius(const Segment& piece, const NearestSegment& tree, Unit radius, int side = 0, Unit sure = 0,
                   int depth = 0) {
    const Point way = piece.b - piece.a;
    const Unit steps = std::gcd(way.x, way.y);
    const Point middle = steps > 1
                             ? Point{piece.a.x + way.x / steps * (steps / 2), piece.a.y + way.y / steps * (steps / 2)}
                             : Point{(piece.a.x + piece.b.x) / 2, (piece.a.y + piece.b.y) / 2};
    const auto both_within = [&](const Segment& near, Unit r) {
        return compare_distance(piece.a, near, r) <= 0 && compare_distance(piece.b, near, r) <= 0;
    };
    const auto holds = [&](const Segment& near) {
        return both_within(near, side == 0 || falls_to(side, piece, middle, near) ? radius : sure);
    };
    for (Point p : {middle, piece.a, piece.b}) {
        const Segment& near = tree.segments()[tree.nearest(p).index];
        if (holds(near)) return true;
        if (side == 0) continue;
        // At a corner of the shell two edges are equally near.
        const Point corner = nearest_point(p, near);
        bool found = false;
        tree.visit({corner, corner}, [&](std::uint32_t k) { found = found || holds(tree.segments()[k]); });
        if (found) return true;
    }
    if (depth == 8 || squared_length(way) < 4) return false;
    if (steps <= 1) radius -= 1, sure -= 1;
    return within_radius({piece.a, middle}, tree, radius, side, sure, depth + 1) &&
           within_radius({middle, piece.b}, tree, radius, side, sure, depth + 1);
}

/// Is the sliver there only because `deep` is taken with the slack? Its edges must be within ρ of the shell, but those
/// that follow an edge of C_{i+1} a rounding inside it (`inner` leaves that much of the empty cavity in the sliver):
/// there the edge of C_{i+1} itself must be. And where an edge is within ρ by less than the slack, what it is near to
/// must lie on the sliver's side of it, so that the distance falls from there into the sliver; else it may have a ridge
/// inside.
bool is_tie(const Region& sliver, const NearestSegment& shell, const NearestSegment& edges_above, Unit radius,
            Unit slack) {
    if (edges_above.empty()) return false;
    constexpr Unit margin =
        static_cast<Unit>(2 * clip_rounding);  // `inner` and its corners lie no farther from C_{i+1}'s edges
    for (const Segment& e : edges_of(sliver)) {
        // The sliver lies to the left of its own edges and, being no part of C_{i+1}, to the right of that one's.
        bool tie = within_radius(e, shell, radius, 1, radius - slack / 4) || within_radius(e, edges_above, margin);
        edges_above.visit(bounding_box(e, margin), [&](std::uint32_t k) {
            const Segment& edge = edges_above.segments()[k];
            tie = tie && within_radius(edge, shell, radius, -1, radius - slack / 2);
        });
        if (!tie) return false;
    }
    return true;
}

/// Do two edges of the region's contours cross (exactly decided)? Clipper's rounding can make them.
bool contours_cross(const Region& region) {
    const NearestSegment edges(edges_of(region));
    bool cross = false;
    for (std::uint32_t k = 0; !cross && k < edges.segments().size(); ++k) {
        const Segment& e = edges.segments()[k];
        edges.visit(bounding_box(e),
                    [&](std::uint32_t j) { cross = cross || (j > k && segments_cross(e, edges.segments()[j])); });
    }
    return cross;
}

}  // namespace

Region erode_slice(const Slice& slice, const Settings& s) {
    return offset(slice.rounded, -(static_cast<double>(s.perimeters) * static_cast<double>(s.nozzle) + clip_rounding));
}

Region intersect(const Region& a, const Region& b) {
    if (a.empty() || b.empty()) return {};
    return clip(ClipperLib::ctIntersection, a, b);
}

Region uncross(Region region) {
    // Where contours cross by a rounding, a region pulled in by a few units has them apart.
    for (double by = 2; contours_cross(region); by *= 2) region = offset(region, -by);
    return region;
}

Cavity make_cavity(int layer, Region region, const Settings& s) {
    region = uncross(std::move(region));
    Cavity cavity;
    cavity.layer = layer, cavity.region = std::move(region);
    if (cavity.region.empty()) return cavity;
    cavity.inner = offset(cavity.region, -clip_rounding);
    cavity.deep = offset(cavity.region, -static_cast<double>(s.support_radius - s.slack), ClipperLib::jtRound,
                         static_cast<double>(s.slack) / 4);
    return cavity;
}

Region overhang_over_cavity(const Cavity& cavity, const Slice& slice_above, const Cavity& above, const Settings& s) {
    if (cavity.deep.empty()) return {};
    Region hanging = clip(ClipperLib::ctDifference, cavity.deep, above.inner);
    if (hanging.empty()) return {};
    if (s.top_layers == 0) {
        // Without covers the cavity may reach beyond the slice above; what is not printed needs no support.
        hanging = intersect(hanging, offset(slice_above.rounded, clip_rounding));
    }
    return without_ties(hanging, cavity, above, s);
}

Region without_ties(const Region& hanging, const Cavity& cavity, const Cavity& above, const Settings& s,
                    const std::function<bool(const Box&)>& indeed) {
    if (hanging.empty()) return {};
    NearestSegment shell, edge_above;
    Region kept;
    for (Region& piece : connected_pieces(hanging)) {
        const bool thin = offset(piece, -0.6 * static_cast<double>(s.slack) - clip_rounding).empty();
        if (thin && shell.empty()) {
            shell = NearestSegment(edges_of(cavity.region));
            edge_above = NearestSegment(edges_of(above.region));
        }
        if (!thin || !is_tie(piece, shell, edge_above, s.support_radius, s.slack) ||
            (indeed && !indeed(bounding_box(piece))))
            std::move(piece.begin(), piece.end(), std::back_inserter(kept));
    }
    // Grown by what rounding may have taken away.
    return kept.empty() ? kept : offset(kept, clip_rounding);
}

}  // namespace ribvault
