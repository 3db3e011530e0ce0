#include "ribvault/print/place_dot.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "ribvault/exact/real_vector.hpp"

namespace ribvault {
namespace {

constexpr double along = 1000, across = 400;  ///< spacing of the samples, lattice units
constexpr double room = sampling_room;

Vec nearest_on(const Segment& s, Vec p) {
    const Vec a = vec(s.a), d = vec(s.b) - a;
    const double l = dot(d, d), t = l > 0 ? std::clamp(dot(p - a, d) / l, 0.0, 1.0) : 0;
    return a + t * d;
}

/// How far p is beyond the lane's reach.
double excess(Vec p, const Lane& lane, double rho) {
    return norm(p - nearest_on(lane.centre, p)) - static_cast<double>(lane.width) / 2 - rho;
}
/// The least of them, or any that is at most `enough`.
double excess(Vec p, const std::vector<Lane>& material, double rho, double enough) {
    double least = HUGE_VAL;
    for (const Lane& lane : material) {
        least = std::min(least, excess(p, lane, rho));
        if (least <= enough) break;
    }
    return least;
}

/// Those of the material that may be nearest to a sample of a cross-section, those nearest to its middle first: no
/// farther from that than the nearest by more than the section's length.
void nearest_to(const std::vector<Vec>& section, const std::vector<Lane>& material, double rho,
                std::vector<Lane>& nearest) {
    const Vec middle = 0.5 * (section.front() + section.back());
    std::vector<std::pair<double, std::size_t>> order;
    order.reserve(material.size());
    for (std::size_t k = 0; k < material.size(); ++k) order.emplace_back(excess(middle, material[k], rho), k);
    std::sort(order.begin(), order.end());
    const double length = norm(section.back() - section.front()) + 1;
    nearest.clear();
    for (const auto& [beyond, k] : order) {
        if (beyond > order.front().first + length) break;
        nearest.push_back(material[k]);
    }
}

/// Those that hold up something of the stretch.
std::vector<Lane> within_reach(const HangingStretch& stretch, const std::vector<Lane>& material, double rho) {
    const Segment& centre = stretch.track.centre;
    const Vec a = vec(centre.a), d = vec(centre.b) - a;
    const double l = norm(d), half = static_cast<double>(stretch.track.width) / 2;
    const Vec ahead = l > 0 ? 1 / l * d : Vec{1, 0};
    // All that hangs lies in the disc around its middle.
    const double from = std::max(stretch.from, -half), to = std::min(stretch.to, l + half);
    const Vec middle = a + (from + to) / 2 * ahead;
    const double radius = (to - from) / 2 + half;
    std::vector<Lane> near;
    for (const Lane& lane : material)
        if (norm(middle - nearest_on(lane.centre, middle)) <= radius + static_cast<double>(lane.width) / 2 + rho + 1)
            near.push_back(lane);
    return near;
}

/// Samples of every cross-section.
std::vector<std::vector<Vec>> sections_of(const HangingStretch& stretch) {
    const Vec a = vec(stretch.track.centre.a), d = vec(stretch.track.centre.b) - a;
    const double l = norm(d), half = static_cast<double>(stretch.track.width) / 2;
    const Vec ahead = l > 0 ? 1 / l * d : Vec{1, 0}, aside{-ahead.y, ahead.x};
    const double from = std::max(stretch.from, -half), to = std::min(stretch.to, l + half);
    std::vector<std::vector<Vec>> sections(static_cast<std::size_t>((to - from) / along) + 2);
    for (std::size_t k = 0; k < sections.size(); ++k) {
        const double s = from + (to - from) * static_cast<double>(k) / static_cast<double>(sections.size() - 1);
        const double beyond = std::max({0.0, -s, s - l});
        const double reach = std::sqrt(std::max(0.0, half * half - beyond * beyond));
        const int steps = static_cast<int>(2 * reach / across) + 2;
        for (int j = 0; j < steps; ++j)
            sections[k].push_back(a + s * ahead + (-reach + 2 * reach * j / (steps - 1)) * aside);
    }
    return sections;
}

/// Samples of one cross-section of what may hang.
struct Section {
    std::vector<Vec> beyond;  ///< what is beyond the material's reach
    Vec worst;
    double excess = -HUGE_VAL;  ///< of the worst: how far beyond it is, negative within reach
};

std::vector<Section> look_at(const HangingStretch& stretch, const std::vector<Lane>& material, Unit rho) {
    const std::vector<Lane> near = within_reach(stretch, material, static_cast<double>(rho));
    std::vector<Section> sections;
    std::vector<Lane> nearest;
    for (const std::vector<Vec>& samples : sections_of(stretch)) {
        Section& section = sections.emplace_back();
        nearest_to(samples, near, static_cast<double>(rho), nearest);
        for (const Vec p : samples) {
            // What is within reach by more than another sample need not be known.
            const double e = excess(p, nearest, static_cast<double>(rho), std::min(section.excess, 0.0));
            if (e > section.excess) section.excess = e, section.worst = p;
            if (e > 0) section.beyond.push_back(p);
        }
    }
    return sections;
}

bool less_far(const Section& a, const Section& b) { return a.excess < b.excess; }

}  // namespace

std::vector<Point> hanging_points(const HangingStretch& stretch, const std::vector<Lane>& material, Unit rho) {
    std::vector<Point> points;
    for (const Section& section : look_at(stretch, material, rho))
        for (const Vec p : section.beyond) points.push_back(rounded(p));
    return points;
}

Point nearest_to_hanging(const HangingStretch& stretch, const std::vector<Lane>& material, Unit rho) {
    const std::vector<Section> sections = look_at(stretch, material, rho);
    return rounded(std::max_element(sections.begin(), sections.end(), less_far)->worst);
}

std::optional<PlacedDot> place_dot(const HangingStretch& stretch, const std::vector<Lane>& material, Unit width,
                                   Unit rho) {
    if (material.empty()) return std::nullopt;
    const std::vector<Section> sections = look_at(stretch, material, rho);
    if (std::max_element(sections.begin(), sections.end(), less_far)->excess < -room)
        return PlacedDot{stretch.track.centre.a, 0, false};
    std::vector<Vec> points;  // where a section is within reach, what of it is farthest
    for (const Section& section : sections)
        if (section.beyond.empty())
            points.push_back(section.worst);
        else
            points.insert(points.end(), section.beyond.begin(), section.beyond.end());
    Vec middle;
    for (const Vec& p : points) middle = middle + 1.0 / static_cast<double>(points.size()) * p;

    const double farthest = std::numbers::pi / 4 * static_cast<double>(width);
    const double radius = static_cast<double>(width) / 2 + static_cast<double>(rho) - room;
    std::optional<PlacedDot> best;
    for (const Lane& lane : material) {
        if (lane.width < width) continue;
        // The first place on the straight way from the lane to the middle of what hangs from which all of it is within
        // reach.
        const Vec start = nearest_on(lane.centre, middle), way = middle - start;
        const double l = norm(way);
        if (l == 0 || l > farthest + radius) continue;  // the middle, too, is in the dot's reach
        const Vec ahead = 1 / l * way;
        double first = 0, last = HUGE_VAL;
        for (const Vec& p : points) {
            const double t = dot(p - start, ahead), aside = dot(p - start, p - start) - t * t,
                         chord = radius * radius - aside;
            if (chord < 0) {
                last = -1;
                break;
            }
            first = std::max(first, t - std::sqrt(chord)), last = std::min(last, t + std::sqrt(chord));
        }
        if (first > last || first > farthest || (best && first >= best->way)) continue;
        best = PlacedDot{rounded(start + first * ahead), first, true};
    }
    return best;
}

}  // namespace ribvault
