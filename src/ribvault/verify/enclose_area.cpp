// How large M \ K is, from cells that are in it and bounds of what of the others is.
#include <algorithm>
#include <cmath>

#include "ribvault/verify/cell.hpp"

namespace ribvault::verify {

namespace {

/// Whether they come within `margin` of each other.
bool meet(const Window& p, const Window& q, double margin) {
    return std::max(p.lo_x, q.lo_x) < std::min(p.hi_x, q.hi_x) + margin &&
           std::max(p.lo_y, q.lo_y) < std::min(p.hi_y, q.hi_y) + margin;
}

/// Windows whose root cells do not overlap, in place of these.
std::vector<Window> apart(const Subdivision& s, std::span<const Window> windows) {
    std::vector<Window> result;
    for (Window window : windows) {
        for (std::size_t k = 0; k < result.size();) {
            if (!meet(root_square(s, result[k]), root_square(s, window), s.margin)) {
                ++k;
                continue;
            }
            window = united(window, result[k]);
            result[k] = result.back();
            result.pop_back();
            k = 0;
        }
        result.push_back(window);
    }
    return result;
}

/// A convex polygon of few corners.
using Polygon = boost::container::small_vector<Vec<double>, 16>;

/// What of the polygon has n·(p - origin) >= least.
Polygon clipped(const Polygon& polygon, Vec<double> n, double least) {
    Polygon result;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec<double>&p = polygon[i], &q = polygon[i + 1 < polygon.size() ? i + 1 : 0];
        const double at_p = n.x * p.x + n.y * p.y - least, at_q = n.x * q.x + n.y * q.y - least;
        if (at_p >= 0) result.push_back(p);
        if ((at_p >= 0) == (at_q >= 0)) continue;
        const double t = at_p / (at_p - at_q);
        result.push_back({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)});
    }
    return result;
}

double area_of(const Polygon& polygon) {
    double twice = 0;
    for (std::size_t i = 2; i < polygon.size(); ++i)
        twice += (polygon[i - 1].x - polygon[0].x) * (polygon[i].y - polygon[0].y) -
                 (polygon[i - 1].y - polygon[0].y) * (polygon[i].x - polygon[0].x);
    return std::max(0.0, twice / 2);
}

/// An open cell, and bounds of the area of M \ K in it.
struct Part {
    Cell cell;
    double lo = 0, hi = 0;
    Vec<double> middle{0, 0};  ///< of what is certainly uncovered, when lo > 0
};

/// In a cell that at most one edge of M crosses, from side to side as boundaries are closed, M is the cell or a
/// half-plane of it. The distance f from a segment is convex and, at distances of d and more from it, has second
/// derivatives of at most 1 / d. So with its gradient g at the centre c and the cell's half diagonal h
///     f(c) + g·(p - c) <= f(p) <= f(c) + g·(p - c) + h² / (2 (f(c) - h)),
/// and M outside a stadium is between two polygons.
Part bounded(const Subdivision& s, Cell&& open) {
    Part part{std::move(open), 0, 0, {}};
    const Cell& cell = part.cell;
    const CoverProblem& problem = *s.problem;
    part.hi = 4 * cell.half * cell.half;
    if (!cell.pieces.empty() || !cell.region.empty() || cell.edges.size() > 1 || cell.sites.size() > 12) return part;
    const double h = cell.half * 1.4142135623730952;
    Polygon least{{-cell.half, -cell.half}, {cell.half, -cell.half}, {cell.half, cell.half}, {-cell.half, cell.half}};
    Polygon most = least;
    const auto cut = [&](Vec<double> n, double from, double slack) {
        least = clipped(least, n, from + s.margin), most = clipped(most, n, from - slack - s.margin);
    };
    for (const int e : cell.edges) {
        const Track& t = s.material[static_cast<std::size_t>(e)];
        const double length = std::sqrt(t.dx * t.dx + t.dy * t.dy);
        if (length < 512 * s.margin) return part;
        const Vec<double> left{-t.dy / length, t.dx / length};
        const auto height = [&](double x, double y) { return (x - t.ax) * left.x + (y - t.ay) * left.y; };
        const bool reference_left = height(cell.ref_x, cell.ref_y) > 0;
        if (std::abs(height(cell.ref_x, cell.ref_y)) < s.margin) return part;
        const bool on_left = (reference_left ? cell.material_winding : cell.material_winding + 1) != 0;
        const bool on_right = (reference_left ? cell.material_winding - 1 : cell.material_winding) != 0;
        const double from = -height(cell.x, cell.y);
        if (on_left && on_right) continue;
        if (on_left)
            cut(left, from, 0);
        else
            cut({-left.x, -left.y}, -from, 0);
    }
    bool nothing_certain = false;
    for (const int i : cell.sites) {
        const Track& t = s.sites[static_cast<std::size_t>(i)];
        const double vx = cell.x - t.ax, vy = cell.y - t.ay;
        const double along = std::clamp((vx * t.dx + vy * t.dy) * t.inverse_norm, 0.0, 1.0);
        const double ex = vx - along * t.dx, ey = vy - along * t.dy, d = std::sqrt(ex * ex + ey * ey);
        if (d <= 1.5 * h) {
            nothing_certain = true;
            continue;
        }
        cut({ex / d, ey / d}, problem.sites[static_cast<std::size_t>(i)].radius.approx - d, h * h / (2 * (d - h)));
    }
    part.hi = area_of(most);
    if (nothing_certain) return part;
    part.lo = std::min(area_of(least), part.hi);
    for (const Vec<double>& p : least)
        part.middle.x += p.x / static_cast<double>(least.size()),
            part.middle.y += p.y / static_cast<double>(least.size());
    part.middle.x += cell.x, part.middle.y += cell.y;
    return part;
}

}  // namespace

AreaEnclosure enclose_area(const CoverProblem& problem, std::span<const Window> windows, int max_cells) {
    AreaEnclosure area;
    const Subdivision s = subdivision(problem);
    std::vector<Part> open;  // a heap: what is known least comes first
    const auto less_unknown = [](const Part& p, const Part& q) { return p.hi - p.lo < q.hi - q.lo; };
    double largest = 0;
    const auto candidate = [&](Vec<double> place, double uncovered) {
        if (uncovered > largest) largest = uncovered, area.x = place.x, area.y = place.y, area.known = true;
    };
    Cell child;
    const auto enter = [&](CellState state) {
        if (state == CellState::uncovered) {
            const double size = 4 * child.half * child.half;
            area.lo += size, area.hi += size;
            candidate({child.x, child.y}, size);
        } else if (state == CellState::open) {
            Part part = bounded(s, std::move(child));
            area.lo += part.lo, area.hi += part.hi;
            if (part.lo > 0) candidate(part.middle, part.lo);
            if (part.cell.half <= 64 * s.margin) return;
            open.push_back(std::move(part));
            std::push_heap(open.begin(), open.end(), less_unknown);
        }
    };
    for (const Window& window : apart(s, windows)) enter(root_cell(s, window, child));
    for (int cells = 4; !open.empty() && area.hi - area.lo > 0.01 * area.hi && cells <= max_cells; cells += 4) {
        std::pop_heap(open.begin(), open.end(), less_unknown);
        Part part = std::move(open.back());
        open.pop_back();
        area.lo -= part.lo, area.hi -= part.hi;
        refer_to_centre(s, part.cell);
        for (int i = 0; i < 4; ++i) enter(quarter(s, part.cell, i, child));
    }
    // The upper bound was rounded up at every step. The lower one never was above the area, so that rounding a few
    // thousand sums is far below 1e-9 of it.
    area.lo = std::max(0.0, area.lo * (1 - 1e-9) - 1e-9 * (area.hi - area.lo));
    area.hi = area.hi * (1 + 1e-9);
    return area;
}

}  // namespace ribvault::verify
