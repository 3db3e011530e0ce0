// M \ K = {}? Depth first over cells; in the cells that no single statement settles, the candidate points decide.
#include <algorithm>
#include <cmath>

#include "ribvault/verify/cell.hpp"
#include "ribvault/verify/local_cover.hpp"
#include "ribvault/verify/point_signs.hpp"

namespace ribvault::verify {

namespace {

void count(StageCounts& stages, Stage stage) {
    ++(stage == Stage::interval ? stages.interval : stage == Stage::rational ? stages.rational : stages.algebraic);
}

struct Leaf {
    const Subdivision& s;
    const Cell& cell;
    StageCounts& stages;
    double reach;
    Surroundings near;

    Leaf(const Subdivision& subdivision, const Cell& c, StageCounts& counts)
        : s(subdivision), cell(c), stages(counts), reach(c.half * 1.4142135623730952 + 8 * s.margin) {
        near.sites = view(cell.sites);
        near.edges = view(cell.edges);
        near.pieces = view(cell.pieces);
        near.x = cell.ref_x, near.y = cell.ref_y;
        near.winding = cell.material_winding;
    }

    bool circle_meets(int centre, double radius) const {
        const Vertex& v = s.problem->vertices[centre];
        const double dx = cell.x - v.cx, dy = cell.y - v.cy;
        return std::abs(std::sqrt(dx * dx + dy * dy) - radius) <= reach;
    }

    // The two curves of a stadium parallel to its segment, the circles about its ends: those that meet the cell.
    void add_curves(const Stadium& stadium, bool from_material,
                    boost::container::small_vector<Curve, 24>& curves) const {
        const auto add_circle = [&](int centre) {
            if (!circle_meets(centre, stadium.radius.approx)) return;
            for (const Curve& c : curves)
                if (!c.line && c.a == centre && c.radius == stadium.radius && c.from_material == from_material) return;
            curves.push_back({false, centre, centre, 0, stadium.radius, from_material});
        };
        add_circle(stadium.a);
        if (stadium.b == stadium.a) return;
        add_circle(stadium.b);
        const Vertex &p = s.problem->vertices[stadium.a], &q = s.problem->vertices[stadium.b];
        const double dx = q.cx - p.cx, dy = q.cy - p.cy, length = std::sqrt(dx * dx + dy * dy);
        const double vx = cell.x - p.cx, vy = cell.y - p.cy;
        // The ends' error of 2^-50 c turns the line by 2^-50 c / length; too short a segment for this distance: keep
        // its lines.
        const bool tiny = 512 * length <= std::abs(vx) + std::abs(vy);
        const double along = tiny ? 0 : (vx * dx + vy * dy) / length;
        const double above = tiny ? 0 : (dx * vy - dy * vx) / length;
        if (!tiny && (along < -reach || along > length + reach)) return;
        for (const int side : {-1, 1})
            if (tiny || std::abs(above - side * stadium.radius.approx) <= reach)
                curves.push_back({true, stadium.a, stadium.b, side, stadium.radius, from_material});
    }

    bool outside(const Located& v) const {
        const double limit = cell.half + 4 * s.margin;
        return v.x.sup() < cell.x - limit || v.x.inf() > cell.x + limit || v.y.sup() < cell.y - limit ||
               v.y.inf() > cell.y + limit;
    }

    // Whether the candidate refutes M inside K.
    bool refutes(const Candidate& candidate, Stage already, Uncovered& found) {
        Located v = located(*s.problem, candidate);
        if (outside(v)) return false;
        const auto wide = [&](const Interval& a) { return !(a.sup() - a.inf() <= s.margin); };
        if (wide(v.x) || wide(v.y)) {
            // Curves that nearly touch. Certainly inside a site is as good as a place; else the lists need one.
            for (const int i : cell.sites)
                if (side_of_stadium(v, s.problem->sites[i], Stage::interval) == Side::inside) {
                    count(stages, already);
                    return false;
                }
            refine(v);
            if (outside(v)) return false;
        }
        Vec<double> hint{1, 0};
        Leaving leaving;
        const Local local = decide_locally(v, near, hint, &leaving);
        count(stages, std::max(v.stage, already));
        if (local != Local::uncovered) return false;
        found = {(v.x.inf() + v.x.sup()) / 2, (v.y.inf() + v.y.sup()) / 2, hint, candidate, leaving};
        return true;
    }

    bool refutes_meeting(const Curve& c1, const Curve& c2, Uncovered& found) {
        // A line of K touches the circle about its own end smoothly: no corner of the uncovered set.
        if (!c1.from_material && !c2.from_material && c1.radius == c2.radius && c1.line != c2.line) {
            const Curve &line = c1.line ? c1 : c2, &circle = c1.line ? c2 : c1;
            if (circle.a == line.a || circle.a == line.b) return false;
        }
        Stage stage = Stage::interval;
        const int n = meeting_points(*s.problem, c1, c2, stage);
        if (n == 0) return false;
        Candidate candidate{Candidate::Kind::meeting, -1, 0, c1, c2, 0};
        if (n == 1) return refutes(candidate, stage, found);
        for (const int r : {-1, 1}) {
            candidate.root = r;
            if (refutes(candidate, stage, found)) return true;
        }
        return false;
    }

    bool refute(Uncovered& found) {
        const CoverProblem& problem = *s.problem;
        const auto near_cell = [&](double x, double y) {
            return std::abs(x - cell.x) <= cell.half + 8 * s.margin && std::abs(y - cell.y) <= cell.half + 8 * s.margin;
        };
        for (const int e : cell.edges) {
            const int a = problem.material[e].a;
            const Vertex& v = problem.vertices[a];
            if (near_cell(v.cx, v.cy) && refutes({Candidate::Kind::vertex, a, 0, {}, {}, 0}, Stage::interval, found))
                return true;
        }
        for (const int p : cell.pieces) {
            const Stadium& piece = problem.pieces[p];
            const int a = problem.vertices[piece.b].cx < problem.vertices[piece.a].cx ? piece.b : piece.a;
            const Vertex& v = problem.vertices[a];
            if (near_cell(v.cx - piece.radius.approx, v.cy) &&
                refutes({Candidate::Kind::leftmost, a, piece.radius, {}, {}, 0}, Stage::interval, found))
                return true;
        }
        boost::container::small_vector<Curve, 24> below, above;
        for (const int i : cell.sites) add_curves(problem.sites[i], false, below);
        for (const int i : cell.pieces) add_curves(problem.pieces[i], true, above);
        for (const int e : cell.edges)
            above.push_back({true, problem.material[e].a, problem.material[e].b, 0, 0, true});
        for (std::size_t i = 0; i < below.size(); ++i) {
            for (const Curve& c : above)
                if (refutes_meeting(below[i], c, found)) return true;
            for (std::size_t j = 0; j < i; ++j)
                if (refutes_meeting(below[i], below[j], found)) return true;
        }
        return false;
    }
};

}  // namespace

std::optional<Uncovered> find_uncovered(const CoverProblem& problem, std::span<const Window> windows,
                                        StageCounts& stages) {
    if (windows.empty()) return std::nullopt;
    const Subdivision s = subdivision(problem, windows.size());
    double smallest = 0;
    for (const Stadium& site : problem.sites)
        smallest = smallest == 0 ? site.radius.approx : std::min(smallest, site.radius.approx);
    std::vector<Cell> open;
    Cell child;
    // Keeps `child` when it is open; says whether all of it is uncovered.
    const auto uncovered = [&](CellState state) {
        if (state == CellState::open)
            open.push_back(std::move(child));
        else
            ++stages.interval;
        return state == CellState::uncovered;
    };
    for (const Window& window : windows) {
        if (uncovered(root_cell(s, window, child))) return Uncovered{child.x, child.y, {1, 0}, {}, {}};
        while (!open.empty()) {
            Cell cell = std::move(open.back());
            open.pop_back();
            // A cell smaller than this that meets the boundary of K's region lies in the stadium there, so it is
            // settled. Cells near the margin are the end in any case: doubles cannot tell points apart there, exact
            // numbers do.
            const bool few = cell.sites.size() <= 3 && cell.edges.size() <= 4 && cell.pieces.size() <= 2;
            if (cell.region.empty() && (few || cell.half < smallest / 16 || cell.half < 64 * s.margin)) {
                Uncovered found;
                if (Leaf(s, cell, stages).refute(found)) return found;
                continue;
            }
            refer_to_centre(s, cell);
            for (int i = 0; i < 4; ++i)
                if (uncovered(quarter(s, cell, i, child))) return Uncovered{child.x, child.y, {1, 0}, {}, {}};
        }
    }
    return std::nullopt;
}

}  // namespace ribvault::verify
