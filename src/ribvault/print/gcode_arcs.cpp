#include "ribvault/print/gcode_arcs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ribvault {
namespace {

constexpr double sagitta = 0.9 * arc_bound_mm;  // what is left covers the rounding of the ends to 1e-9 mm
constexpr double largest_radius = 10000;        // mm
constexpr double radii_differ = 0.1;            // mm: more is no rounding of I and J

std::string mm(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3f mm", value);
    return text;
}

}  // namespace

std::string arc_points(const GcodeMotion& m, std::vector<std::array<Decimal, 3>>& points, double& length_mm) {
    // Everything relative to the start: differences are exact, so nothing is lost far from the origin.
    const bool clockwise = m.kind == GcodeMotion::Kind::clockwise;
    const double dx = to_double(m.to[0] - m.from[0]), dy = to_double(m.to[1] - m.from[1]);
    double cx = 0, cy = 0;
    if (m.radius.value != 0) {
        const double radius = std::abs(to_double(m.radius)), half = std::hypot(dx, dy) / 2;
        if (half > radius + radii_differ / 2)
            return "an arc of radius " + mm(radius) + " between points " + mm(2 * half) +
                   " apart; expected at least half of that";
        const double height = std::sqrt(std::max(0.0, radius * radius - half * half)) / (2 * half);
        const double side = clockwise == (m.radius.value > 0) ? 1 : -1;
        cx = dx / 2 + side * height * dy;
        cy = dy / 2 - side * height * dx;
    } else {
        cx = to_double(m.centre[0] - m.from[0]);
        cy = to_double(m.centre[1] - m.from[1]);
    }
    const double r0 = std::hypot(cx, cy), r1 = std::hypot(dx - cx, dy - cy);
    if (!(r0 < largest_radius && r1 < largest_radius))
        return "an arc with a radius of 10 m or more, beyond any printer";
    if (std::abs(r0 - r1) > radii_differ)
        return "the arc's ends are " + mm(r0) + " and " + mm(r1) + " from its centre; expected the same";
    const double start = std::atan2(-cy, -cx), end = std::atan2(dy - cy, dx - cx), full = 2 * std::numbers::pi;
    double turn = m.moves_flat() ? end - start : 0;
    if (clockwise) {
        while (turn >= 0) turn -= full;
    } else {
        while (turn <= 0) turn += full;
    }
    // Between radii r0 and r1 the curve is r(φ) = r0 + s φ, its second derivative no longer than r + 2 s; a chord over
    // an angle φ lies within an eighth of that times φ² of it.
    const double bend = std::max(r0, r1) + 2 * std::abs(r1 - r0) / std::abs(turn);
    const double step = std::sqrt(8 * sagitta / bend);
    const auto count = std::max<long>(1, static_cast<long>(std::ceil(std::abs(turn) / step)));
    const double rise = to_double(m.to[2] - m.from[2]);
    points.clear();
    for (long k = 1; k < count; ++k) {
        const double share = static_cast<double>(k) / static_cast<double>(count);
        const double angle = start + share * turn, r = r0 + share * (r1 - r0);
        points.push_back({m.from[0] + rounded_decimal(cx + r * std::cos(angle)),
                          m.from[1] + rounded_decimal(cy + r * std::sin(angle)),
                          m.from[2] + rounded_decimal(share * rise)});
    }
    points.push_back(m.to);
    length_mm = std::abs(turn) * (r0 + r1) / 2;
    return {};
}

}  // namespace ribvault
