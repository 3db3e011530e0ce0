#include "ribvault/verify/witness.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "ribvault/verify/point_signs.hpp"

namespace ribvault::verify {

namespace {

constexpr int area_cells = 12000;

Located mm_point(const CoverProblem& problem, const std::array<double, 2>& mm) {
    const double scale = static_cast<double>(units_per_mm);
    Located v;
    v.problem = &problem;
    v.candidate.vertex = -1;
    v.x = Interval(mm[0]) * Interval(scale), v.y = Interval(mm[1]) * Interval(scale);
    v.rational_tried = true;
    v.rational = Vec<Rational>{Rational(Rational(mm[0]) * scale), Rational(Rational(mm[1]) * scale)};
    return v;
}

// Winding number of a closed boundary at v; 0 when v is on it.
int winding_at(const CoverProblem& problem, std::span<const Edge> boundary, Located& v) {
    std::vector<int> all(boundary.size());
    std::iota(all.begin(), all.end(), 0);
    double low_x = v.x.inf(), low_y = v.y.inf();
    for (const Edge& e : boundary) {
        low_x = std::min(low_x, problem.vertices[e.a].cx);
        low_y = std::min(low_y, problem.vertices[e.a].cy);
    }
    double step = 1;
    do step *= 1.0378;
    while (!off_lines(problem, boundary, all, low_x - step, low_y - 0.7231 * step));
    return crossings(boundary, all, low_x - step, low_y - 0.7231 * step, v);
}

// A lower bound of the distance from v to the segment of a stadium.
double distance_below(const CoverProblem& problem, const Stadium& s, const Located& v) {
    const Vec<Interval> a = exact_point<Interval>(problem.vertices[s.a]),
                        b = exact_point<Interval>(problem.vertices[s.b]);
    const Vec<Interval> d = b - a, w = Vec<Interval>{v.x, v.y} - a;
    const double to_a = root(dot(w, w)).inf();
    const double to_b = root(dot(Vec<Interval>(w - d), Vec<Interval>(w - d))).inf();
    const Interval ahead = dot(w, d), norm = dot(d, d);
    double least = std::min(to_a, to_b);
    if (ahead.sup() > 0 && Interval(norm - ahead).sup() > 0 && norm.inf() > 0)
        least = std::min(least, Interval(CGAL::abs(cross(d, w)) / root(norm)).inf());
    return least;
}

std::optional<std::array<double, 2>> search(const CoverProblem& problem, const Uncovered& start, double reach) {
    const auto attempt = [&](double x, double y) -> std::optional<std::array<double, 2>> {
        const std::array<double, 2> mm{x / static_cast<double>(units_per_mm), y / static_cast<double>(units_per_mm)};
        if (in_uncovered(problem, mm)) return mm;
        return std::nullopt;
    };
    if (const auto found = attempt(start.x, start.y)) return found;
    // Along the direction in which M \ K leaves the point, which may be a cusp: ever smaller steps and turns, both
    // sides.
    const double base = std::atan2(start.hint.y, start.hint.x);
    double step = reach;
    for (int k = 0; k < 44; ++k, step /= 2) {
        double turn = 2.9;
        for (int j = 0; j < 48; ++j, turn *= 0.6)
            for (const double t : {turn, -turn})
                if (const auto found =
                        attempt(start.x + step * std::cos(base + t), start.y + step * std::sin(base + t)))
                    return found;
    }
    return std::nullopt;
}

}  // namespace

bool in_uncovered(const CoverProblem& problem, const std::array<double, 2>& mm) {
    Located v = mm_point(problem, mm);
    const Stage exact = Stage::rational;
    for (const Stadium& site : problem.sites)
        if (side_of_stadium(v, site, exact) != Side::outside) return false;
    bool in_m = false;
    for (std::size_t i = 0; i < problem.pieces.size() && !in_m; ++i)
        in_m = side_of_stadium(v, problem.pieces[i], exact) != Side::outside;
    // v is farther than a positive radius from the edges of K's region; on an edge of M it is not wanted as a witness.
    for (const Edge& e : problem.material)
        if (!in_m && side_of_stadium(v, {e.a, e.b, 0}, exact) == Side::on) return false;
    if (!in_m && winding_at(problem, problem.material, v) == 0) return false;
    return !in_region(problem, winding_at(problem, problem.region, v));
}

Unsupported describe_uncovered(const CoverProblem& problem, std::span<const Window> windows, const Uncovered& start,
                               double reach) {
    Unsupported result;
    const AreaEnclosure area = enclose_area(problem, windows, area_cells);
    const double unit_area = static_cast<double>(units_per_mm) * static_cast<double>(units_per_mm);
    result.area_lo = area.lo / unit_area, result.area_hi = area.hi / unit_area;
    std::optional<std::array<double, 2>> witness;
    if (area.known) {
        const std::array<double, 2> centre{area.x / static_cast<double>(units_per_mm),
                                           area.y / static_cast<double>(units_per_mm)};
        if (in_uncovered(problem, centre)) witness = centre;
    }
    if (!witness) witness = search(problem, start, reach);
    result.witness_certified = witness.has_value();
    result.witness = witness ? *witness
                             : std::array<double, 2>{start.x / static_cast<double>(units_per_mm),
                                                     start.y / static_cast<double>(units_per_mm)};
    const Located v = mm_point(problem, result.witness);
    double least = HUGE_VAL;
    for (const Stadium& site : problem.sites)
        least = std::min(least, -(site.radius.approx - reach - distance_below(problem, site, v)));
    // One ulp down after each of the three roundings of upward arithmetic.
    result.witness_distance = std::max(0.0, least * (1 - 1e-14) / static_cast<double>(units_per_mm) * (1 - 1e-14));
    if (problem.sites.empty()) result.witness_distance = HUGE_VAL;
    return result;
}

}  // namespace ribvault::verify
