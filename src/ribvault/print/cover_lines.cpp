#include "ribvault/print/cover_lines.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>

namespace ribvault {
namespace {

/// Where a contour crosses line c, the points with y - x = c. The abscissa is floor + a fraction, exact in both parts
/// that matter: its floor, and whether the fraction is zero.
struct Crossing {
    std::size_t line = 0;
    Unit floor = 0;
    bool fraction = false;
    std::size_t contour = 0;
    std::size_t edge = 0;        ///< index in the contour
    std::size_t next = 0;        ///< the crossing that follows along the contour
    std::size_t previous = 0;
    std::size_t across = 0;      ///< the other end of the line's piece inside the area
    Point at;                    ///< this end of the piece, the last lattice point inside
    bool used = true;            ///< the piece is printed already, or has no lattice points
};

struct Fill {
    Region contours;
    std::vector<Unit> lines;          ///< c of every line, ascending
    std::vector<Crossing> crossings;  ///< in the order of the contours
    std::vector<std::vector<std::size_t>> pieces_by_line;  ///< left ends
};

Unit level(Point p) { return p.y - p.x; }

/// Lines at 45° are `width` apart when their c differ by width √2.
std::vector<Unit> place_lines(const Region& contours, Unit width) {
    Unit lo = std::numeric_limits<Unit>::max(), hi = std::numeric_limits<Unit>::min();
    for (const Contour& contour : contours)
        for (Point p : contour) lo = std::min(lo, level(p)), hi = std::max(hi, level(p));
    std::vector<Unit> lines;
    if (lo >= hi) return lines;
    const double step = static_cast<double>(width) * std::numbers::sqrt2, extent = static_cast<double>(hi - lo);
    const auto steps = static_cast<Unit>(extent / step);
    const double margin = (extent - static_cast<double>(steps) * step) / 2;
    for (Unit k = 0; k <= steps; ++k)
        lines.push_back(std::min(hi - 1, lo + round_to_lattice(margin + static_cast<double>(k) * step)));
    return lines;
}

/// Crossings of one edge, in its direction. An edge owns its lower end and not its upper one, so that a line through a
/// vertex is crossed an even number of times in all.
void cross_edge(Fill& fill, std::size_t contour, std::size_t edge) {
    const Contour& points = fill.contours[contour];
    const Point p = points[edge], q = points[(edge + 1) % points.size()];
    const Unit from = level(p), to = level(q);
    const auto begin = std::lower_bound(fill.lines.begin(), fill.lines.end(), std::min(from, to));
    const auto end = std::lower_bound(begin, fill.lines.end(), std::max(from, to));
    const std::size_t first = fill.crossings.size();
    for (auto line = begin; line != end; ++line) {
        const Unit sign = to > from ? 1 : -1;
        const Unit rise = sign * (to - from), product = sign * (*line - from) * (q.x - p.x);
        const Unit quotient = product / rise, rest = product % rise;
        Crossing crossing;
        crossing.line = static_cast<std::size_t>(line - fill.lines.begin());
        crossing.floor = p.x + quotient - (rest < 0 ? 1 : 0);
        crossing.fraction = rest != 0;
        crossing.contour = contour;
        crossing.edge = edge;
        fill.crossings.push_back(crossing);
    }
    if (to < from) std::reverse(fill.crossings.begin() + static_cast<std::ptrdiff_t>(first), fill.crossings.end());
}

void cross_contours(Fill& fill) {
    for (std::size_t contour = 0; contour < fill.contours.size(); ++contour) {
        const std::size_t first = fill.crossings.size();
        for (std::size_t edge = 0; edge < fill.contours[contour].size(); ++edge) cross_edge(fill, contour, edge);
        const std::size_t end = fill.crossings.size();
        for (std::size_t i = first; i < end; ++i) {
            fill.crossings[i].next = i + 1 < end ? i + 1 : first;
            fill.crossings[fill.crossings[i].next].previous = i;
        }
    }
}

/// Pairs the crossings of every line to its pieces inside the area. Returns the left end of every piece, by line.
std::vector<std::size_t> pair_crossings(Fill& fill) {
    std::vector<std::size_t> order(fill.crossings.size()), pieces;
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
        const Crossing &a = fill.crossings[i], &b = fill.crossings[j];
        if (a.line != b.line) return a.line < b.line;
        if (a.floor != b.floor) return a.floor < b.floor;
        if (a.fraction != b.fraction) return b.fraction;
        return i < j;
    });
    fill.pieces_by_line.resize(fill.lines.size());
    for (std::size_t i = 0; i + 1 < order.size(); i += 2) {
        Crossing &left = fill.crossings[order[i]], &right = fill.crossings[order[i + 1]];
        const Unit c = fill.lines[left.line], lo = left.floor + (left.fraction ? 1 : 0), hi = right.floor;
        left.across = order[i + 1], right.across = order[i];
        left.at = {lo, lo + c}, right.at = {hi, hi + c};
        left.used = right.used = lo >= hi;
        pieces.push_back(order[i]);
        fill.pieces_by_line[left.line].push_back(order[i]);
    }
    return pieces;
}

/// The contour's vertices between crossing a and the next one along it, when the way over them is within the limit.
std::optional<Contour> boundary_between(const Fill& fill, std::size_t a, double limit) {
    const Crossing &from = fill.crossings[a], &to = fill.crossings[from.next];
    const Contour& points = fill.contours[from.contour];
    std::size_t steps = (to.edge + points.size() - from.edge) % points.size();
    if (steps == 0 && from.next < a) steps = points.size();
    Contour way;
    Point at = from.at;
    double sum = 0;
    for (std::size_t i = 1; i <= steps; ++i) {
        way.push_back(points[(from.edge + i) % points.size()]);
        sum += length(way.back() - at);
        at = way.back();
        if (sum > limit) return std::nullopt;
    }
    if (sum + length(to.at - at) > limit) return std::nullopt;
    return way;
}

/// Whether a piece on the line below, beside the one that begins at `crossing`, is not printed yet. Pieces beside each
/// other overlap along the lines.
bool waits(const Fill& fill, std::size_t crossing) {
    const auto ends = [&](std::size_t i) {
        return std::minmax(fill.crossings[i].floor, fill.crossings[fill.crossings[i].across].floor);
    };
    const std::size_t line = fill.crossings[crossing].line;
    if (line == 0) return false;
    const auto [lo, hi] = ends(crossing);
    // The lines rise at 45 degrees: a step across them moves the abscissa by half their distance in c.
    const Unit shift = (fill.lines[line] - fill.lines[line - 1]) / 2;
    for (std::size_t i : fill.pieces_by_line[line - 1]) {
        if (fill.crossings[i].used) continue;
        const auto [below_lo, below_hi] = ends(i);
        if (below_lo - shift <= hi && below_hi - shift >= lo) return true;
    }
    return false;
}

/// The end of an unused piece on a neighbouring line to which `from` can be joined; `way` gets what lies between.
std::optional<std::size_t> link_from(const Fill& fill, std::size_t from, double limit, bool monotonic, Contour& way) {
    const Crossing& here = fill.crossings[from];
    for (const bool upwards : {true, false}) {
        if (monotonic && !upwards) break;
        for (const bool forwards : {true, false}) {
            const std::size_t other = forwards ? here.next : here.previous;
            const Crossing& there = fill.crossings[other];
            if (there.used || there.line != (upwards ? here.line + 1 : here.line - 1)) continue;
            if (monotonic && waits(fill, other)) continue;
            std::optional<Contour> between = boundary_between(fill, forwards ? from : other, limit);
            if (!between) continue;
            if (!forwards) std::reverse(between->begin(), between->end());
            way = std::move(*between);
            return other;
        }
    }
    return std::nullopt;
}

}  // namespace

std::vector<Contour> cover_lines(const Region& area, Unit width, bool falling, bool monotonic) {
    const auto turned = [falling](Point p) { return falling ? Point{-p.x, p.y} : p; };
    Fill fill;
    fill.contours = area;
    for (Contour& contour : fill.contours)
        for (Point& p : contour) p = turned(p);
    fill.lines = place_lines(fill.contours, width);
    cross_contours(fill);

    std::vector<Contour> tracks;
    for (std::size_t piece : pair_crossings(fill)) {
        if (fill.crossings[piece].used) continue;
        Contour track, way;
        const auto add = [&](Point p) {
            if (track.empty() || track.back() != turned(p)) track.push_back(turned(p));
        };
        for (std::optional<std::size_t> in = piece; in;) {
            Crossing& entry = fill.crossings[*in];
            Crossing& exit = fill.crossings[entry.across];
            entry.used = exit.used = true;
            add(entry.at);
            add(exit.at);
            way.clear();
            in = link_from(fill, entry.across, 2 * static_cast<double>(width), monotonic, way);
            for (Point p : way) add(p);
        }
        tracks.push_back(std::move(track));
    }
    return tracks;
}

}  // namespace ribvault
