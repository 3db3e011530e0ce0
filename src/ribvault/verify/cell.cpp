#include "ribvault/verify/cell.hpp"

#include <algorithm>
#include <cmath>

#include "ribvault/verify/winding.hpp"

namespace ribvault::verify {

namespace {

constexpr std::size_t few_windows = 8;                ///< for which it does not pay to put things in rows and squares
constexpr double half_diagonal = 1.4142135623730952;  // above the square root of 2

PreparedTrack track_of(const CoverProblem& problem, int a, int b, double radius) {
    const Vertex &p = problem.vertices[a], &q = problem.vertices[b];
    return prepared_track(p.cx, p.cy, q.cx, q.cy, radius);
}

// `distance`: from the cell's centre to the stadium's segment.
bool stadium_contains(const Subdivision& s, const PreparedTrack& track, const Cell& cell, double distance) {
    const double reach = track.half - s.margin;
    if (distance + cell.half * half_diagonal <= reach) return true;
    if (distance + cell.half > reach || reach < 0) return false;
    for (const double dx : {-cell.half, cell.half})
        for (const double dy : {-cell.half, cell.half})
            if (squared_centre_distance(track, cell.x + dx, cell.y + dy) > reach * reach) return false;
    return true;
}

// Sign of cross(d, v), or 0 when it may be wrong. Each coordinate difference is off by at most 2^-15 margin (its
// vertices by 2^-50 c, margin being 2^-34 c), and the products and their difference by 2^-51 of their sizes.
int certain_turn(const Subdivision& s, double dx, double dy, double vx, double vy) {
    const double p = dx * vy, q = dy * vx;
    const double error = 0x1p-14 * s.margin * (std::abs(dx) + std::abs(dy) + std::abs(vx) + std::abs(vy)) +
                         0x1p-50 * (std::abs(p) + std::abs(q) + s.margin * s.margin);
    return p - q > error ? 1 : p - q < -error ? -1 : 0;
}
// On which side of an edge's line (x, y) lies; exact when doubles do not tell, as for edges shorter than their
// rounding.
int side_of_edge(const Subdivision& s, const PreparedTrack& t, const Edge& e, double x, double y) {
    const int turn = certain_turn(s, t.dx, t.dy, x - t.ax, y - t.ay);
    if (turn != 0) return turn;
    const Vec<Rational> a = exact_point<Rational>(s.problem->vertices[e.a]);
    return sign_of(cross(Vec<Rational>(exact_point<Rational>(s.problem->vertices[e.b]) - a),
                         Vec<Rational>(Vec<Rational>{Rational(x), Rational(y)} - a)));
}

template <class Edges>
bool off_edge_lines(const Subdivision& s, const std::vector<PreparedTrack>& tracks, const Edges& edges,
                    const Indices& which, double x, double y) {
    return std::all_of(which.begin(), which.end(),
                       [&](int i) { return side_of_edge(s, tracks[i], edges[i], x, y) != 0; });
}

// Whether the vertex is left of, or on, the line from (x, y) to (u, w); exact when doubles do not tell.
bool left_of_path(const Subdivision& s, int vertex, double x, double y, double u, double w) {
    const Vertex& v = s.problem->vertices[vertex];
    const int turn = certain_turn(s, u - x, w - y, v.cx - x, v.cy - y);
    if (turn != 0) return turn > 0;
    const Vec<Rational> from{Rational(x), Rational(y)};
    return sign_of(cross(Vec<Rational>(Vec<Rational>{Rational(u), Rational(w)} - from),
                         Vec<Rational>(exact_point<Rational>(v) - from))) >= 0;
}

int path_crossings(const Subdivision& s, const std::vector<PreparedTrack>& tracks, const std::vector<Edge>& edges,
                   const Indices& which, const Cell& cell, double to_x, double to_y) {
    return winding_change(
        edges, which, [&](int i) { return side_of_edge(s, tracks[i], edges[i], cell.ref_x, cell.ref_y); },
        [&](int i) { return side_of_edge(s, tracks[i], edges[i], to_x, to_y); },
        [&](int vertex) { return left_of_path(s, vertex, cell.ref_x, cell.ref_y, to_x, to_y); });
}

// The centre of the cell, up to a few margins by which it may have to leave a line.
Vec<double> off_lines(const Subdivision& s, const Cell& cell) {
    double x = cell.x, y = cell.y, u = 0.37, w = 0.59;
    while (!off_edge_lines(s, s.material, s.problem->material, cell.edges, x, y) ||
           !off_edge_lines(s, s.sites, s.problem->region, cell.region, x, y)) {
        x = cell.x + (6 * u - 3) * s.margin, y = cell.y + (6 * w - 3) * s.margin;
        u = std::fmod(u + 0.6180339887, 1.0), w = std::fmod(w + 0.7548776662, 1.0);
    }
    return {x, y};
}

// Winding number of all edges about a point on none of them: those that a ray to +x crosses. A vertex on the ray counts
// as above it.
int winding_at(const Subdivision& s, const std::vector<PreparedTrack>& tracks, const std::vector<Edge>& edges,
               const HeightRows& rows, double x, double y) {
    const auto above = [&](double height, int vertex) {
        if (height > y + s.margin) return true;
        if (height < y - s.margin) return false;
        return exact_point<Rational>(s.problem->vertices[vertex]).y >= Rational(y);
    };
    const auto crossing = [&](std::size_t i) {
        const PreparedTrack& t = tracks[i];
        if (std::max(t.ay, t.by) < y - s.margin || std::min(t.ay, t.by) > y + s.margin ||
            std::max(t.ax, t.bx) < x - s.margin)
            return 0;
        return ray_crossing(above(t.ay, edges[i].a), above(t.by, edges[i].b),
                            [&] { return side_of_edge(s, t, edges[i], x, y); });
    };
    int winding = 0;
    if (rows.empty())
        for (std::size_t i = 0; i < edges.size(); ++i) winding += crossing(i);
    else
        rows.visit(y - s.margin, y + s.margin, [&](std::uint32_t i) { winding += crossing(i); });
    return winding;
}

// The state of a cell with complete lists that no single stadium of K covers. `in_piece`: one piece of M covers it.
CellState state_of(const CoverProblem& problem, const Cell& cell, bool in_piece) {
    if (cell.edges.empty() && cell.material_winding == 0 && cell.pieces.empty()) return CellState::settled;
    if (cell.region.empty() && in_region(problem, cell.region_winding)) return CellState::settled;
    if (!cell.sites.empty()) return CellState::open;
    return in_piece || (cell.edges.empty() && cell.material_winding != 0) ? CellState::uncovered : CellState::open;
}

}  // namespace

// The centre is a corner of all quarters, which inherit it.
void refer_to_centre(const Subdivision& s, Cell& cell) {
    const auto [x, y] = off_lines(s, cell);
    cell.material_winding += path_crossings(s, s.material, s.problem->material, cell.edges, cell, x, y);
    cell.region_winding += path_crossings(s, s.sites, s.problem->region, cell.region, cell, x, y);
    cell.ref_x = x, cell.ref_y = y;
}

// With coordinates and radii below c, a vertex's place is off by at most 2^-50 c, and a point at the clamped parameter
// t is on the segment up to 2^-50 c whatever the error of t; an error of t moves the distance in second order only. So
// every distance is right within 2^-46 c. 2^-34 c is far above that, and wide enough for the intervals of most
// candidates. The squares of a TrackGrid are at least 48 margins wide, so a thousandth of one, by which it looks
// farther, is 2^-38 c; its places are off by at most 2^-42 c.
Subdivision subdivision(const CoverProblem& problem, std::size_t windows) {
    double c = 1;
    for (const Vertex& v : problem.vertices) c = std::max({c, std::abs(v.cx), std::abs(v.cy)});
    for (const Stadium& s : problem.sites) c = std::max(c, s.radius.approx);
    for (const Stadium& s : problem.pieces) c = std::max(c, s.radius.approx);
    Subdivision s;
    s.problem = &problem;
    s.margin = std::ldexp(c, -34);
    for (const Stadium& t : problem.sites) s.sites.push_back(track_of(problem, t.a, t.b, t.radius.approx));
    for (const Edge& t : problem.material) s.material.push_back(track_of(problem, t.a, t.b, 0));
    for (const Stadium& t : problem.pieces) s.pieces.push_back(track_of(problem, t.a, t.b, t.radius.approx));
    if (windows < few_windows) return s;
    const auto rows = [&](const std::vector<PreparedTrack>& tracks, std::size_t count) {
        return HeightRows(count, [&](std::size_t i) {
            const PreparedTrack& t = tracks[i];
            const double reach = 32 * s.margin;
            return std::pair(std::min(t.ay, t.by) - reach, std::max(t.ay, t.by) + reach);
        });
    };
    s.region_rows = rows(s.sites, problem.region.size()), s.material_rows = rows(s.material, s.material.size());
    s.squares = std::make_unique<const Subdivision::Squares>(Subdivision::Squares{
        TrackGrid(s.sites, 32 * s.margin), TrackGrid(s.material, 32 * s.margin), TrackGrid(s.pieces, 32 * s.margin)});
    return s;
}

Window root_square(const Subdivision& s, const Window& window) {
    const double half = std::max(window.hi_x - window.lo_x, window.hi_y - window.lo_y) / 2,
                 grown = 1.0173 * half + 64 * s.margin;
    const double x = (window.lo_x + window.hi_x) / 2 + 0.0137 * half,
                 y = (window.lo_y + window.hi_y) / 2 - 0.0091 * half;
    return {x - grown, y - grown, x + grown, y + grown};
}

CellState root_cell(const Subdivision& s, const Window& window, Cell& cell) {
    const CoverProblem& problem = *s.problem;
    const Window square = root_square(s, window);
    cell.sites.clear(), cell.edges.clear(), cell.pieces.clear(), cell.region.clear();
    cell.x = (square.lo_x + square.hi_x) / 2, cell.y = (square.lo_y + square.hi_y) / 2;
    cell.half = (square.hi_x - square.lo_x) / 2;
    const auto near = [&](const PreparedTrack& t, double radius) {
        const double reach = cell.half + radius + 16 * s.margin;
        return std::max(t.ax, t.bx) > cell.x - reach && std::min(t.ax, t.bx) < cell.x + reach &&
               std::max(t.ay, t.by) > cell.y - reach && std::min(t.ay, t.by) < cell.y + reach;
    };
    std::vector<int> found;
    // Those of the tracks, in their order, that come near the square.
    const auto visit_near = [&](const TrackGrid Subdivision::Squares::*grid, const std::vector<PreparedTrack>& tracks,
                                const auto& use) {
        const auto look_at = [&](int i) {
            const PreparedTrack& t = tracks[static_cast<std::size_t>(i)];
            if (near(t, t.half)) use(i);
        };
        if (s.squares) {
            ((*s.squares).*grid).near(cell.x, cell.y, cell.half, found);
            std::for_each(found.begin(), found.end(), look_at);
        } else {
            for (int i = 0; i < static_cast<int>(tracks.size()); ++i) look_at(i);
        }
    };
    visit_near(&Subdivision::Squares::sites, s.sites, [&](int i) {
        cell.sites.push_back(i);
        if (static_cast<std::size_t>(i) < problem.region.size() && near(s.sites[i], 0)) cell.region.push_back(i);
    });
    visit_near(&Subdivision::Squares::material, s.material, [&](int i) { cell.edges.push_back(i); });
    visit_near(&Subdivision::Squares::pieces, s.pieces, [&](int i) { cell.pieces.push_back(i); });
    const auto [x, y] = off_lines(s, cell);
    cell.ref_x = x, cell.ref_y = y;
    cell.material_winding = winding_at(s, s.material, problem.material, s.material_rows, x, y);
    cell.region_winding = winding_at(s, s.sites, problem.region, s.region_rows, x, y);
    return state_of(problem, cell, false);
}

CellState quarter(const Subdivision& s, const Cell& parent, int index, Cell& cell) {
    const CoverProblem& problem = *s.problem;
    cell.half = parent.half / 2;
    cell.x = parent.x + (index & 1 ? cell.half : -cell.half);
    cell.y = parent.y + (index & 2 ? cell.half : -cell.half);
    cell.sites.clear(), cell.edges.clear(), cell.pieces.clear(), cell.region.clear();
    const double reach = cell.half * half_diagonal + 8 * s.margin;
    const int region_edges = static_cast<int>(problem.region.size());
    for (const int i : parent.sites) {
        const PreparedTrack& site = s.sites[i];
        const double squared = squared_centre_distance(site, cell.x, cell.y);
        if (squared > (site.half + reach) * (site.half + reach)) continue;
        const double d = std::sqrt(squared);
        if (stadium_contains(s, site, cell, d)) return CellState::settled;
        cell.sites.push_back(i);
        if (i < region_edges && d <= reach) cell.region.push_back(i);
    }
    for (const int i : parent.edges)
        if (squared_centre_distance(s.material[i], cell.x, cell.y) <= reach * reach) cell.edges.push_back(i);
    bool in_piece = false;
    for (const int i : parent.pieces) {
        const PreparedTrack& piece = s.pieces[i];
        const double squared = squared_centre_distance(piece, cell.x, cell.y);
        if (squared > (piece.half + reach) * (piece.half + reach)) continue;
        cell.pieces.push_back(i);
        in_piece = in_piece || stadium_contains(s, piece, cell, std::sqrt(squared));
    }
    cell.ref_x = parent.ref_x, cell.ref_y = parent.ref_y;
    cell.material_winding = parent.material_winding, cell.region_winding = parent.region_winding;
    return state_of(problem, cell, in_piece);
}

}  // namespace ribvault::verify
