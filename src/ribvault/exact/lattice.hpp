// The lattice on which everything that ribvault *chooses* is placed: cavity boundaries, support vertices, track ends.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

namespace ribvault {

/// A length or coordinate in lattice units. One unit is 10 nm, so every decimal with up to five places (in mm) is
/// exact, and so is every coordinate that the G-code writer prints.
using Unit = std::int64_t;

inline constexpr Unit units_per_mm = 100000;

/// Coordinates stay below this bound (10 m), so that products of two coordinate differences fit 64 bits.
inline constexpr Unit lattice_bound = 1000000000;

inline double to_mm(Unit u) { return static_cast<double>(u) / static_cast<double>(units_per_mm); }
inline double area_to_mm2(double square_units) {
    return square_units / (static_cast<double>(units_per_mm) * static_cast<double>(units_per_mm));
}
/// Nearest lattice coordinate; a choice, never a decision.
inline Unit round_to_lattice(double units) { return static_cast<Unit>(std::llround(units)); }

/// A point of the lattice.
struct Point {
    Unit x = 0;
    Unit y = 0;
    friend bool operator==(const Point&, const Point&) = default;
    friend auto operator<=>(const Point&, const Point&) = default;
};
inline Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
inline Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }

/// The place a share of the way from a to b (0: a, 1: b), rounded once.
inline Point part_way(Point a, Point b, double share) {
    return a + Point{round_to_lattice(share * static_cast<double>(b.x - a.x)),
                     round_to_lattice(share * static_cast<double>(b.y - a.y))};
}

struct Segment {
    Point a;
    Point b;
};

using Contour = std::vector<Point>;
/// A region of the plane as closed contours: outer ones counter-clockwise, holes clockwise; contours do not cross.
/// The region is where the winding number is not zero.
using Region = std::vector<Contour>;

inline double length(Point d) { return std::hypot(static_cast<double>(d.x), static_cast<double>(d.y)); }
inline double length(const Segment& s) { return length(s.b - s.a); }

/// Axis-parallel box on the lattice, empty when lo > hi.
struct Box {
    Point lo{lattice_bound, lattice_bound};
    Point hi{-lattice_bound, -lattice_bound};
    void add(Point p) {
        lo.x = p.x < lo.x ? p.x : lo.x;
        lo.y = p.y < lo.y ? p.y : lo.y;
        hi.x = p.x > hi.x ? p.x : hi.x;
        hi.y = p.y > hi.y ? p.y : hi.y;
    }
    void grow(Unit by) { lo.x -= by, lo.y -= by, hi.x += by, hi.y += by; }
    bool empty() const { return lo.x > hi.x || lo.y > hi.y; }
};

/// What is within `beyond` of a segment's box.
inline Box bounding_box(const Segment& s, Unit beyond = 0) {
    Box box;
    box.add(s.a), box.add(s.b);
    box.grow(beyond);
    return box;
}
inline Box bounding_box(const Region& region) {
    Box box;
    for (const Contour& c : region)
        for (Point p : c) box.add(p);
    return box;
}

/// Signed area of a region in square units (holes count negative).
inline double signed_area(const Region& region) {
    double twice = 0;
    for (const Contour& c : region)
        for (std::size_t i = 0, n = c.size(); i < n; ++i) {
            const Point p = c[i] - c[0], q = c[(i + 1) % n] - c[0];
            twice += static_cast<double>(p.x) * static_cast<double>(q.y) -
                     static_cast<double>(p.y) * static_cast<double>(q.x);
        }
    return twice / 2;
}

}  // namespace ribvault
