// How large M \ K is, from cells that are in it and bounds of what of the others is.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

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

/// The line of an edge of M that cuts a cell.
struct Line {
    Vec<double> left;     ///< its normal, of length 1
    double from;          ///< left·(p - c) there, c being the cell's centre
    bool reference_left;  ///< on which side the cell's reference point is
};

/// Nothing unless the edge passes the cell from side to side, or passes it by.
std::optional<Line> line_through(const PreparedTrack& t, const Cell& cell, double margin) {
    const double half = cell.half + 4 * margin;
    if (t.length < 512 * margin) return std::nullopt;
    double enters = -HUGE_VAL, leaves = HUGE_VAL;
    for (const auto& [at, d] : {std::pair(t.ax - cell.x, t.dx), std::pair(t.ay - cell.y, t.dy)}) {
        if (d == 0) {
            if (std::abs(at) > half) leaves = -HUGE_VAL;
            continue;
        }
        const double one = (-half - at) / d, other = (half - at) / d;
        enters = std::max(enters, std::min(one, other)), leaves = std::min(leaves, std::max(one, other));
    }
    if (enters <= leaves && (enters <= 0 || leaves >= 1)) return std::nullopt;
    Line line{{-t.dy / t.length, t.dx / t.length}, 0, false};
    line.from = (t.ax - cell.x) * line.left.x + (t.ay - cell.y) * line.left.y;
    const double height = (cell.ref_x - cell.x) * line.left.x + (cell.ref_y - cell.y) * line.left.y - line.from;
    if (std::abs(height) < margin) return std::nullopt;
    line.reference_left = height > 0;
    return line;
}

/// The two edges of M as lines that meet in the cell, where they are the ends of one line that turns there. `both`: M's
/// boundary has what is left of both lines on its left; else what is left of either.
struct Corner {
    std::array<Line, 2> lines;
    bool both;
};
std::optional<Corner> corner_of(const Subdivision& s, const Cell& cell) {
    const auto e = static_cast<std::size_t>(cell.edges[0]), f = static_cast<std::size_t>(cell.edges[1]);
    const bool in_order = s.problem->material[e].b == s.problem->material[f].a;
    if (!in_order && s.problem->material[f].b != s.problem->material[e].a) return std::nullopt;
    const PreparedTrack &in = s.material[in_order ? e : f], &out = s.material[in_order ? f : e];
    const auto inside = [&](double x, double y, double half) {
        return std::max(std::abs(x - cell.x), std::abs(y - cell.y)) < half;
    };
    const double wide = cell.half + 4 * s.margin;
    if (!inside(out.ax, out.ay, cell.half - s.margin) || inside(in.ax, in.ay, wide) || inside(out.bx, out.by, wide))
        return std::nullopt;
    Corner corner{};
    for (const bool first : {true, false}) {
        // From the corner on to both sides, so that each line passes the cell.
        const PreparedTrack& t = first ? in : out;
        if (t.length < 512 * s.margin) return std::nullopt;
        const double x = 8 * wide / t.length * t.dx, y = 8 * wide / t.length * t.dy;
        const std::optional<Line> line =
            line_through(prepared_track(out.ax - x, out.ay - y, out.ax + x, out.ay + y, 0), cell, s.margin);
        if (!line) return std::nullopt;
        corner.lines[first ? 0 : 1] = *line;
    }
    corner.both = in.dx * out.dy - in.dy * out.dx > 0;
    return corner;
}

/// What M \ K has of one side of the lines in a cell: all of `least`, and nothing outside `most`.
struct Bounds {
    Polygon least, most;
    void cut(Vec<double> n, double from, double slack, double margin) {
        least = clipped(least, n, from + margin), most = clipped(most, n, from - slack - margin);
    }
    void cut(const Line& line, bool left, double margin) {
        if (left)
            cut(line.left, line.from, 0, margin);
        else
            cut({-line.left.x, -line.left.y}, -line.from, 0, margin);
    }
};

/// The parts of the cell that M has, where at most two edges cross the cell, from side to side, or turn in it.
std::optional<boost::container::small_vector<Bounds, 4>> parts_of_material(const Subdivision& s, const Cell& cell,
                                                                          const Bounds& whole) {
    boost::container::small_vector<Bounds, 4> parts;
    const std::size_t n = cell.edges.size();
    const std::optional<Corner> corner = n == 2 ? corner_of(s, cell) : std::nullopt;
    std::array<Line, 2> lines{};
    if (corner) lines = corner->lines;
    for (std::size_t k = 0; k < n && !corner; ++k) {
        const std::optional<Line> line =
            line_through(s.material[static_cast<std::size_t>(cell.edges[k])], cell, s.margin);
        if (!line) return std::nullopt;
        lines[k] = *line;
    }
    // How often what is on these sides of the lines is on the left of the boundary.
    const auto on_left = [&](bool first, bool second) -> int {
        if (!corner) return static_cast<int>(first) + static_cast<int>(second);
        return corner->both ? first && second : first || second;
    };
    const int reference = on_left(lines[0].reference_left, lines[1].reference_left);
    for (const bool first : {true, false})
        for (const bool second : {true, false}) {
            if ((n < 1 && !first) || (n < 2 && !second)) continue;
            const bool a = n < 1 ? lines[0].reference_left : first, b = n < 2 ? lines[1].reference_left : second;
            if (cell.material_winding + on_left(a, b) - reference == 0) continue;
            Bounds part = whole;
            if (n > 0) part.cut(lines[0], first, s.margin);
            if (n > 1) part.cut(lines[1], second, s.margin);
            parts.push_back(std::move(part));
        }
    return parts;
}

/// The distance f from a segment is convex and, at distances of d and more from it, has second derivatives of at most
/// 1 / d. So with its gradient g at the centre c and the cell's half diagonal h
///     f(c) + g·(p - c) <= f(p) <= f(c) + g·(p - c) + h² / (2 (f(c) - h)),
/// and what is outside a stadium is between two polygons. Beside the segment, away from its ends, the two are one.
Part bounded(const Subdivision& s, Cell&& open) {
    Part part{std::move(open), 0, 0, {}};
    const Cell& cell = part.cell;
    const double all = 4 * cell.half * cell.half;
    part.hi = all;
    if (!cell.pieces.empty() || !cell.region.empty() || cell.edges.size() > 2 || cell.sites.size() > 12) return part;
    const double h = cell.half * 1.4142135623730952;
    const double half = cell.half;
    const Polygon square{{-half, -half}, {half, -half}, {half, half}, {-half, half}};
    Bounds bounds{square, square};
    bool nothing_certain = false;
    for (const int i : cell.sites) {
        const PreparedTrack& t = s.sites[static_cast<std::size_t>(i)];
        const double vx = cell.x - t.ax, vy = cell.y - t.ay;
        const double place = (vx * t.dx + vy * t.dy) * t.inverse_norm, along = std::clamp(place, 0.0, 1.0);
        const double ex = vx - along * t.dx, ey = vy - along * t.dy, d = std::sqrt(ex * ex + ey * ey);
        if (d <= 1.5 * h) {
            nothing_certain = true;
            continue;
        }
        const double to_end = std::min(place, 1 - place) * t.length;
        const double slack = to_end > h + s.margin ? 0 : h * h / (2 * (d - h));
        bounds.cut({ex / d, ey / d}, t.half - d, slack, s.margin);
    }
    const auto parts = parts_of_material(s, cell, bounds);
    if (!parts) {
        part.hi = area_of(bounds.most);
        return part;
    }
    part.hi = 0;
    double largest = 0;
    for (const Bounds& of : *parts) {
        const double most = area_of(of.most), least = nothing_certain ? 0 : std::min(area_of(of.least), most);
        part.lo += least, part.hi += most;
        if (least <= largest) continue;
        largest = least, part.middle = {0, 0};
        for (const Vec<double>& p : of.least)
            part.middle.x += p.x / static_cast<double>(of.least.size()),
                part.middle.y += p.y / static_cast<double>(of.least.size());
        part.middle.x += cell.x, part.middle.y += cell.y;
    }
    part.hi = std::min(part.hi, all);
    part.lo = std::min(part.lo, part.hi);
    return part;
}

}  // namespace

AreaEnclosure enclose_area(const CoverProblem& problem, std::span<const Window> windows, int max_cells) {
    AreaEnclosure area;
    const Subdivision s = subdivision(problem, windows.size());
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
