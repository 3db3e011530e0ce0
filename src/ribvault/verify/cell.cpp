#include "ribvault/verify/cell.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ribvault::verify {

namespace {

constexpr double half_diagonal = 1.4142135623730952;  // above the square root of 2

bool stadium_contains(const Subdivision& s, const Stadium& stadium, const Cell& cell, double centre_distance) {
    const double reach = stadium.radius - s.margin;
    if (centre_distance > reach) return false;
    if (centre_distance + cell.half * half_diagonal <= reach) return true;
    if (centre_distance + cell.half > reach) return false;
    for (const double dx : {-cell.half, cell.half})
        for (const double dy : {-cell.half, cell.half})
            if (distance(*s.problem, stadium.a, stadium.b, cell.x + dx, cell.y + dy) > reach) return false;
    return true;
}

// Moves the child's reference point off all lines and counts the parent's edges between it and the parent's.
void refer(const CoverProblem& problem, const Cell& parent, Cell& child) {
    double u = 0.1379, w = 0.0713;
    for (;;) {
        child.ref_x = child.x + u * child.half, child.ref_y = child.y + w * child.half;
        if (off_lines(problem, problem.material, view(parent.edges), child.ref_x, child.ref_y) &&
            off_lines(problem, problem.region, view(parent.region), child.ref_x, child.ref_y))
            break;
        u = std::fmod(u + 0.6180339887, 1.0), w = std::fmod(w + 0.7548776662, 1.0);
    }
    child.material_winding = parent.material_winding;
    child.region_winding = parent.region_winding;
    if (parent.edges.empty() && parent.region.empty()) return;
    Located to = double_point(problem, child.ref_x, child.ref_y);
    child.material_winding += crossings(problem.material, view(parent.edges), parent.ref_x, parent.ref_y, to);
    child.region_winding += crossings(problem.region, view(parent.region), parent.ref_x, parent.ref_y, to);
}

}  // namespace

double distance(const CoverProblem& problem, int a, int b, double x, double y) {
    const Vertex &p = problem.vertices[a], &q = problem.vertices[b];
    const double dx = q.cx - p.cx, dy = q.cy - p.cy, vx = x - p.cx, vy = y - p.cy;
    const double norm = dx * dx + dy * dy;
    const double t = norm > 0 ? std::clamp((vx * dx + vy * dy) / norm, 0.0, 1.0) : 0.0;
    const double ex = vx - t * dx, ey = vy - t * dy;
    return std::sqrt(ex * ex + ey * ey);
}

// With coordinates and radii below c, a vertex's place is off by at most 2^-50 c, and a point at the clamped parameter t is
// on the segment up to 2^-50 c whatever the error of t; an error of t moves the distance in second order only. So every
// distance is right within 2^-46 c, and 2^-40 c leaves room for the sums around it.
Subdivision subdivision(const CoverProblem& problem) {
    double c = 1;
    for (const Vertex& v : problem.vertices) c = std::max({c, std::abs(v.cx), std::abs(v.cy)});
    for (const Stadium& s : problem.sites) c = std::max(c, s.radius);
    for (const Stadium& s : problem.pieces) c = std::max(c, s.radius);
    return {&problem, std::ldexp(c, -40)};
}

Cell root_cell(const Subdivision& s, const Window& window) {
    const CoverProblem& problem = *s.problem;
    const auto all = [](Indices& list, std::size_t n) {
        list.resize(n);
        std::iota(list.begin(), list.end(), 0);
    };
    // From a point left of and below everything, where both winding numbers are 0.
    Cell outside;
    all(outside.edges, problem.material.size());
    all(outside.region, problem.region.size());
    double lo_x = window.lo_x, lo_y = window.lo_y;
    for (const Vertex& v : problem.vertices) lo_x = std::min(lo_x, v.cx), lo_y = std::min(lo_y, v.cy);
    double step = 1 + window.hi_x - window.lo_x;
    do {
        step *= 1.0378;
        outside.ref_x = lo_x - step, outside.ref_y = lo_y - 0.7231 * step;
    } while (!off_lines(problem, problem.material, view(outside.edges), outside.ref_x, outside.ref_y) ||
             !off_lines(problem, problem.region, view(outside.region), outside.ref_x, outside.ref_y));

    Cell cell;
    cell.x = (window.lo_x + window.hi_x) / 2, cell.y = (window.lo_y + window.hi_y) / 2;
    cell.half = std::max(window.hi_x - window.lo_x, window.hi_y - window.lo_y) / 2 + 64 * s.margin;
    cell.edges = outside.edges, cell.region = outside.region;
    all(cell.sites, problem.sites.size());
    all(cell.pieces, problem.pieces.size());
    refer(problem, outside, cell);
    return cell;
}

CellState state_of(const Subdivision& s, const Cell& cell) {
    const CoverProblem& problem = *s.problem;
    if (cell.edges.empty() && cell.material_winding == 0 && cell.pieces.empty()) return CellState::settled;
    if (cell.region.empty() && in_region(problem, cell.region_winding)) return CellState::settled;
    for (const int i : cell.sites) {
        const Stadium& site = problem.sites[i];
        if (stadium_contains(s, site, cell, distance(problem, site.a, site.b, cell.x, cell.y))) return CellState::settled;
    }
    if (!cell.sites.empty() || !cell.region.empty()) return CellState::open;
    if (cell.edges.empty() && cell.material_winding != 0) return CellState::uncovered;
    for (const int i : cell.pieces) {
        const Stadium& piece = problem.pieces[i];
        if (stadium_contains(s, piece, cell, distance(problem, piece.a, piece.b, cell.x, cell.y)))
            return CellState::uncovered;
    }
    return CellState::open;
}

Cell quarter(const Subdivision& s, const Cell& parent, int index) {
    const CoverProblem& problem = *s.problem;
    Cell cell;
    cell.half = parent.half / 2;
    cell.x = parent.x + (index & 1 ? cell.half : -cell.half);
    cell.y = parent.y + (index & 2 ? cell.half : -cell.half);
    const double reach = cell.half * half_diagonal + 8 * s.margin;
    for (const int i : parent.sites) {
        const Stadium& site = problem.sites[i];
        if (distance(problem, site.a, site.b, cell.x, cell.y) <= site.radius + reach) cell.sites.push_back(i);
    }
    for (const int i : parent.pieces) {
        const Stadium& piece = problem.pieces[i];
        if (distance(problem, piece.a, piece.b, cell.x, cell.y) <= piece.radius + reach) cell.pieces.push_back(i);
    }
    for (const int i : parent.edges)
        if (distance(problem, problem.material[i].a, problem.material[i].b, cell.x, cell.y) <= reach)
            cell.edges.push_back(i);
    for (const int i : parent.region)
        if (distance(problem, problem.region[i].a, problem.region[i].b, cell.x, cell.y) <= reach)
            cell.region.push_back(i);
    refer(problem, parent, cell);
    return cell;
}

}  // namespace ribvault::verify
