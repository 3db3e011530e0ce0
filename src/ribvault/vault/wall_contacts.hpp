// Where walls meet each other or the shell: what moving them must not bring about.
#pragma once

#include "ribvault/vault/cavity_boundary.hpp"

namespace ribvault {

/// Do two walls meet otherwise than at a shared end? Exact.
inline bool collide(const Segment& s, const Segment& t) {
    if (!segments_touch(s, t)) return false;
    const bool shared = s.a == t.a || s.a == t.b || s.b == t.a || s.b == t.b;
    return !shared || segments_cross(s, t);
}

/// Do two walls from p, to q and to r, lie on each other? Exact.
inline bool lie_on_each_other(Point p, Point q, Point r) {
    if (orientation(p, q, r) != 0) return false;
    // Of vectors on one line no term of the product has another sign than the rest.
    const Point a = q - p, b = r - p;
    return static_cast<double>(a.x) * static_cast<double>(b.x) + static_cast<double>(a.y) * static_cast<double>(b.y) >
           0;
}

/// Does a wall meet the shell anywhere but at a root of it (`root_a`, `root_b`: its ends are roots)?
inline bool meets_shell(const Segment& wall, bool root_a, bool root_b, const CavityBoundary& boundary) {
    bool meets = false;
    boundary.edges.visit(bounding_box(wall), [&](std::uint32_t k) {
        const Segment& e = boundary.edges.segments()[k];
        if (meets || !segments_touch(wall, e)) return;
        const bool at_a = root_a && compare_distance(wall.a, e, 2 * root_tolerance) <= 0;
        const bool at_b = root_b && compare_distance(wall.b, e, 2 * root_tolerance) <= 0;
        meets = !at_a && !at_b;
    });
    return meets;
}

}  // namespace ribvault
