#include "ribvault/print/place_dot.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ribvault {
namespace {

constexpr double along = 1000, across = 400;  ///< spacing of the samples, lattice units
constexpr double room = along;                ///< that the dot keeps for what lies between samples

struct Vector {
    double x = 0, y = 0;
};
Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y}; }
Vector operator-(Vector a, Vector b) { return {a.x - b.x, a.y - b.y}; }
Vector operator*(double t, Vector a) { return {t * a.x, t * a.y}; }
double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y; }
Vector vector(Point p) { return {static_cast<double>(p.x), static_cast<double>(p.y)}; }
Point lattice(Vector v) { return {round_to_lattice(v.x), round_to_lattice(v.y)}; }

Vector nearest_on(const Segment& s, Vector p) {
    const Vector a = vector(s.a), d = vector(s.b) - a;
    const double l = dot(d, d), t = l > 0 ? std::clamp(dot(p - a, d) / l, 0.0, 1.0) : 0;
    return a + t * d;
}

/// How far p is beyond the reach of all material.
double excess(Vector p, const std::vector<Lane>& material, double rho) {
    double least = HUGE_VAL;
    for (const Lane& lane : material) {
        const Vector d = p - nearest_on(lane.centre, p);
        least = std::min(least, std::sqrt(dot(d, d)) - static_cast<double>(lane.width) / 2 - rho);
    }
    return least;
}

/// What hangs, as samples: of every cross-section all that is beyond reach, or what is nearest to that.
std::vector<Vector> hanging(const HangingStretch& stretch, const std::vector<Lane>& material, double rho, double& most) {
    const Vector a = vector(stretch.track.centre.a), d = vector(stretch.track.centre.b) - a;
    const double l = std::sqrt(dot(d, d)), half = static_cast<double>(stretch.track.width) / 2;
    const Vector ahead = l > 0 ? 1 / l * d : Vector{1, 0}, aside{-ahead.y, ahead.x};
    const double from = std::max(stretch.from, -half), to = std::min(stretch.to, l + half);
    const int sections = static_cast<int>((to - from) / along) + 2;
    std::vector<Vector> points;
    most = -HUGE_VAL;
    for (int k = 0; k < sections; ++k) {
        const double s = from + (to - from) * k / (sections - 1);
        const double beyond = s < 0 ? -s : s > l ? s - l : 0, reach = std::sqrt(std::max(0.0, half * half - beyond * beyond));
        const int steps = static_cast<int>(2 * reach / across) + 2;
        Vector worst;
        double worst_excess = -HUGE_VAL;
        for (int j = 0; j < steps; ++j) {
            const Vector p = a + s * ahead + (-reach + 2 * reach * j / (steps - 1)) * aside;
            const double e = excess(p, material, rho);
            if (e > worst_excess) worst_excess = e, worst = p;
            if (e > 0) points.push_back(p);
        }
        if (worst_excess <= 0) points.push_back(worst);
        most = std::max(most, worst_excess);
    }
    return points;
}

}  // namespace

std::optional<PlacedDot> place_dot(const HangingStretch& stretch, const std::vector<Lane>& material, Unit width, Unit rho) {
    if (material.empty()) return std::nullopt;
    double most = 0;
    const std::vector<Vector> points = hanging(stretch, material, static_cast<double>(rho), most);
    if (most < -room) return PlacedDot{stretch.track.centre.a, 0, false};
    Vector middle;
    for (const Vector& p : points) middle = middle + 1.0 / static_cast<double>(points.size()) * p;

    const double farthest = std::numbers::pi / 4 * static_cast<double>(width);
    const double radius = static_cast<double>(width) / 2 + static_cast<double>(rho) - room;
    std::optional<PlacedDot> best;
    for (const Lane& lane : material) {
        if (lane.width < width) continue;
        // The first place on the straight way from the lane to the middle of what hangs from which all of it is within reach.
        const Vector start = nearest_on(lane.centre, middle), way = middle - start;
        const double l = std::sqrt(dot(way, way));
        if (l == 0) continue;
        const Vector ahead = 1 / l * way;
        double first = 0, last = HUGE_VAL;
        for (const Vector& p : points) {
            const double t = dot(p - start, ahead), aside = dot(p - start, p - start) - t * t, chord = radius * radius - aside;
            if (chord < 0) {
                last = -1;
                break;
            }
            first = std::max(first, t - std::sqrt(chord)), last = std::min(last, t + std::sqrt(chord));
        }
        if (first > last || first > farthest || (best && first >= best->way)) continue;
        best = PlacedDot{lattice(start + first * ahead), first, true};
    }
    return best;
}

}  // namespace ribvault
