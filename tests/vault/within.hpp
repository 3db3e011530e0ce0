// Proofs by halving: is every point of a segment, or of a region, within a radius of one of the tracks?
#pragma once

#include "exact/rationals.hpp"
#include "ribvault/exact/nearest_segment.hpp"
#include "ribvault/exact/point_location.hpp"

namespace ribvault::test {

namespace within_detail {

inline bool halve(const RationalPoint& a, const RationalPoint& b, const std::vector<Segment>& near,
                  const Rational& square, int depth) {
    for (const Segment& s : near)
        if (rational_squared_distance(a, s) <= square && rational_squared_distance(b, s) <= square) return true;
    if (depth == 0) return false;
    const RationalPoint middle{(a.x + b.x) / 2, (a.y + b.y) / 2};
    return halve(a, middle, near, square, depth - 1) && halve(middle, b, near, square, depth - 1);
}

inline bool halve(const Box& box, const PointLocation& region, const NearestSegment& tracks, Unit radius, Point& bad) {
    const Point corners[] = {box.lo, {box.hi.x, box.lo.y}, box.hi, {box.lo.x, box.hi.y}};
    const Point middle{(box.lo.x + box.hi.x) / 2, (box.lo.y + box.hi.y) / 2};
    if (!region.edge_meets(box) && region.locate(middle) == Side::outside) return true;
    Box reach = box;
    reach.grow(radius);
    bool held = false;
    tracks.visit(reach, [&](std::uint32_t k) {
        held = held || std::all_of(std::begin(corners), std::end(corners),
                                   [&](Point c) { return compare_distance(c, tracks.segments()[k], radius) <= 0; });
    });
    if (held) return true;
    bad = middle;
    if (box.hi.x - box.lo.x < 4) return false;
    return halve({box.lo, middle}, region, tracks, radius, bad) &&
           halve({{middle.x, box.lo.y}, {box.hi.x, middle.y}}, region, tracks, radius, bad) &&
           halve({{box.lo.x, middle.y}, {middle.x, box.hi.y}}, region, tracks, radius, bad) &&
           halve({middle, box.hi}, region, tracks, radius, bad);
}

}  // namespace within_detail

/// True is a proof: the segment falls into pieces both ends of which lie within the radius of one and the same track,
/// and what lies within a radius of a track is convex.
inline bool within(const Segment& s, const NearestSegment& tracks, Unit radius) {
    Box box;
    box.add(s.a), box.add(s.b), box.grow(radius);
    std::vector<Segment> near;
    tracks.visit(box, [&](std::uint32_t k) { near.push_back(tracks.segments()[k]); });
    return within_detail::halve(rational(s.a), rational(s.b), near, Rational(whole(radius) * whole(radius)), 12);
}

/// True is a proof in the same way, square by square. `bad`: where it failed.
inline bool within(const Region& region, const std::vector<Segment>& tracks, Unit radius, Point& bad) {
    if (region.empty()) return true;
    const PointLocation location(edges_of(region), 2 * radius);
    Box box = bounding_box(region);
    Unit side = 8;
    while (side < std::max(box.hi.x - box.lo.x, box.hi.y - box.lo.y)) side *= 2;
    box.hi = {box.lo.x + side, box.lo.y + side};
    return within_detail::halve(box, location, NearestSegment(tracks), radius, bad);
}

}  // namespace ribvault::test
