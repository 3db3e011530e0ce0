#include "ribvault/vault/grow_supports.hpp"

#include <algorithm>
#include <map>
#include <queue>

#include "ribvault/vault/growing_supports.hpp"

namespace ribvault {
namespace {

constexpr Unit cell_pixels = 8;  // a cell holds 8 x 8 candidate points: one bit each

/// Deterministic random number of a place: ties of Section 4.3 do not depend on the order of evaluation.
std::uint64_t tie_of(Point p, std::uint64_t seed) {
    std::uint64_t z = seed ^ (static_cast<std::uint64_t>(p.x) * 0x9e3779b97f4a7c15ULL) ^ (static_cast<std::uint64_t>(p.y) * 0xc2b2ae3d27d4eb4fULL);
    for (int round = 0; round < 2; ++round) {  // the finaliser of splitmix64
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
        z ^= z >> 31;
    }
    return z;
}

struct Cell {
    Box box;
    std::uint64_t pixels = 0;  ///< candidate points inside the unsupported region
};

struct Candidate {
    SquaredDistance distance;  ///< to B_i; for a whole cell a lower bound
    std::uint64_t tie = 0;
    Point at;
    std::int64_t cell = -1;  ///< >= 0: this is a whole cell, not a point
};
struct Later {
    bool operator()(const Candidate& a, const Candidate& b) const {
        const int order = compare(a.distance, b.distance);
        if (order != 0) return order > 0;
        if ((a.cell >= 0) != (b.cell >= 0)) return b.cell >= 0;  // cells open before points at the same distance
        if (a.tie != b.tie) return a.tie > b.tie;
        return a.at > b.at;
    }
};
using Queue = std::priority_queue<Candidate, std::vector<Candidate>, Later>;

class Grower {
public:
    Grower(SupportForest forest, const Region& unsupported, const CavityBoundary& boundary, std::uint64_t seed, const Settings& settings)
        : settings_(settings), boundary_(boundary), seed_(seed),
          radius_(static_cast<double>(settings.nozzle / 2 + settings.support_radius)), slack_(static_cast<double>(settings.slack)),
          location_(edges_of(unsupported), cell_pixels * settings.sampling_pitch),
          supports_(std::move(forest), boundary.location.box(), boundary, settings) {}

    SupportForest run() {
        make_cells();
        add_pixels();
        for (std::vector<std::size_t> open = all_cells(); !open.empty(); open = add_between(open)) {
        }
        if (settings_.strategy == Strategy::thrifty) trim();
        return supports_.take();
    }

private:
    void make_cells() {
        const Unit pitch = settings_.sampling_pitch, size = cell_pixels * pitch;
        const Box& box = location_.box();
        const Unit x0 = floor_div(box.lo.x, size), x1 = floor_div(box.hi.x, size);
        const Unit y0 = floor_div(box.lo.y, size), y1 = floor_div(box.hi.y, size);
        std::vector<std::uint64_t> row(static_cast<std::size_t>(x1 - x0 + 1));
        std::vector<std::pair<double, int>> crossings;
        for (Unit cy = y0; cy <= y1; ++cy) {
            std::fill(row.begin(), row.end(), 0);
            for (Unit line = 0; line < cell_pixels; ++line) {
                const Unit y = cy * size + line * pitch + pitch / 2;
                crossings.clear();
                location_.visit_crossings(y, [&](const Segment& e, int winding) {
                    const double t = static_cast<double>(y - e.a.y) / static_cast<double>(e.b.y - e.a.y);
                    crossings.push_back({static_cast<double>(e.a.x) + t * static_cast<double>(e.b.x - e.a.x), winding});
                });
                std::sort(crossings.begin(), crossings.end());
                int winding = 0;
                for (std::size_t k = 0; k + 1 < crossings.size(); ++k) {
                    winding += crossings[k].second;
                    if (winding == 0) continue;
                    const Unit first = static_cast<Unit>(std::ceil((crossings[k].first - static_cast<double>(pitch / 2)) / static_cast<double>(pitch)));
                    const Unit last = static_cast<Unit>(std::floor((crossings[k + 1].first - static_cast<double>(pitch / 2)) / static_cast<double>(pitch)));
                    for (Unit px = first; px <= last; ++px) {
                        const Unit cx = floor_div(px, cell_pixels);
                        row[static_cast<std::size_t>(cx - x0)] |= std::uint64_t{1} << (line * cell_pixels + (px - cx * cell_pixels));
                    }
                }
            }
            for (Unit cx = x0; cx <= x1; ++cx) {
                const Cell cell{{{cx * size, cy * size}, {(cx + 1) * size, (cy + 1) * size}}, row[static_cast<std::size_t>(cx - x0)]};
                if (cell.pixels != 0 || location_.edge_meets(cell.box)) cell_at_[{cx, cy}] = cells_.size(), cells_.push_back(cell);
            }
        }
    }

    static Unit floor_div(Unit a, Unit b) { return a >= 0 ? a / b : -((b - 1 - a) / b); }
    static Point centre(const Box& box) { return {(box.lo.x + box.hi.x) / 2, (box.lo.y + box.hi.y) / 2}; }
    /// Upper bound of the distance from the centre to any point of the box.
    static double half_diagonal(const Box& box) { return 0.5 * length(box.hi - box.lo) + 1; }

    /// The first pass: the lattice's points, nearest to B_i first. Cells open only when their turn comes, and not at all
    /// when one wall already covers them. Contact at exactly r + ρ counts here: on a lattice it is the normal case.
    void add_pixels() {
        Queue queue;
        for (std::size_t k = 0; k < cells_.size(); ++k) {
            if (cells_[k].pixels == 0) continue;
            const Point c = centre(cells_[k].box);
            const double nearest = std::sqrt(boundary_.edges.nearest(c).distance.value()) - half_diagonal(cells_[k].box);
            const auto bound = static_cast<std::int64_t>(std::max(0.0, nearest));
            queue.push({{getenv("Q") ? static_cast<Int128>(0) : static_cast<Int128>(bound) * bound, 1}, 0, c, static_cast<std::int64_t>(k)});
        }
        const Unit pitch = settings_.sampling_pitch;
        while (!queue.empty()) {
            const Candidate candidate = queue.top();
            queue.pop();
            if (candidate.cell < 0) {
                if (!supports_.covers(candidate.at, radius_)) supports_.add_wall(candidate.at);
                continue;
            }
            const Cell& cell = cells_[static_cast<std::size_t>(candidate.cell)];
            if (supports_.covers(candidate.at, radius_ - half_diagonal(cell.box))) continue;
            for (Unit bit = 0; bit < cell_pixels * cell_pixels; ++bit) {
                if (!(cell.pixels >> bit & 1)) continue;
                const Point p{cell.box.lo.x + bit % cell_pixels * pitch + pitch / 2, cell.box.lo.y + bit / cell_pixels * pitch + pitch / 2};
                if (!supports_.covers(p, radius_)) queue.push(point_candidate(p));
            }
        }
    }

    Candidate point_candidate(Point p) const {
        static const double q = getenv("Q") ? atof(getenv("Q")) : 0;
        SquaredDistance d = boundary_.edges.nearest(p).distance;
        if (q > 0) { const auto b = static_cast<std::int64_t>(std::floor(std::sqrt(d.value()) / (q * 1e5)) * (q * 1e5)); d = {static_cast<Int128>(b) * b, 1}; }
        if (q < 0) { const auto b = static_cast<std::int64_t>(3e7 - std::sqrt(d.value())); d = {static_cast<Int128>(b) * b, 1}; }
        return {d, tie_of(p, seed_), p, -1}; }

    std::vector<std::size_t> all_cells() const {
        std::vector<std::size_t> open(cells_.size());
        for (std::size_t k = 0; k < open.size(); ++k) open[k] = k;
        return open;
    }

    /// The second pass, one round: finds points between the pixels that are not covered, adds their walls, and returns the
    /// cells that must be looked at again.
    std::vector<std::size_t> add_between(const std::vector<std::size_t>& open) {
        Queue queue;
        std::vector<std::size_t> again;
        for (const std::size_t k : open) {
            const std::size_t before = queue.size();
            examine(cells_[k].box, true, queue);
            if (queue.size() != before) again.push_back(k);
        }
        for (; !queue.empty(); queue.pop())
            if (!supports_.covers(queue.top().at, radius_ - slack_)) supports_.add_wall(queue.top().at);
        return again;
    }

    void examine(const Box& box, bool edges, Queue& queue) const {
        const Point c = centre(box);
        const double half = half_diagonal(box);
        if (supports_.covers(c, radius_ - half)) return;
        edges = edges && location_.edge_meets(box);
        const Side side = location_.locate(c);
        if (!edges && side == Side::outside) return;
        if (!supports_.covers(c, radius_ - slack_) && (side != Side::outside || half <= slack_)) {
            queue.push(point_candidate(c));
            return;
        }
        for (const Box& part : {Box{box.lo, c}, Box{{c.x, box.lo.y}, {box.hi.x, c.y}}, Box{{box.lo.x, c.y}, {c.x, box.hi.y}}, Box{c, box.hi}})
            examine(part, edges, queue);
    }

    /// Thrifty strategy: new walls, the last one first, end as early as what they are there for allows.
    void trim() {
        for (std::size_t k = supports_.new_tips().size(); k-- > 0;) {
            const GrowingSupports::NewTip tip = supports_.new_tips()[k];
            if (!supports_.is_tip(tip)) continue;
            const Segment wall = supports_.wall_of(tip);
            Box box;
            box.add(wall.a), box.add(wall.b);
            box.grow(static_cast<Unit>(radius_) + 1);
            supports_.remove(tip);
            if (covered(box)) continue;
            // Bisection: `lo` of the way from the joint is too short, `hi` is enough.
            double lo = 0, hi = 1;
            const double l = length(wall);
            while ((hi - lo) * l > 1000) {
                const double middle = (lo + hi) / 2;
                supports_.restore(tip, wall, middle);
                (covered(box) ? hi : lo) = middle;
                supports_.remove(tip);
            }
            supports_.restore(tip, wall, hi);
        }
    }
    /// Is every unsupported point of the box covered, with the slack to spare?
    bool covered(const Box& box) const {
        const Unit size = cell_pixels * settings_.sampling_pitch;
        for (Unit cy = floor_div(box.lo.y, size); cy <= floor_div(box.hi.y, size); ++cy)
            for (Unit cx = floor_div(box.lo.x, size); cx <= floor_div(box.hi.x, size); ++cx) {
                const auto found = cell_at_.find({cx, cy});
                if (found != cell_at_.end() && !covered(cells_[found->second].box, box, true)) return false;
            }
        return true;
    }
    bool covered(const Box& cell, const Box& box, bool edges) const {
        if (cell.lo.x > box.hi.x || cell.hi.x < box.lo.x || cell.lo.y > box.hi.y || cell.hi.y < box.lo.y) return true;
        const Point c = centre(cell);
        const double half = half_diagonal(cell);
        if (supports_.covers(c, radius_ - half)) return true;
        edges = edges && location_.edge_meets(cell);
        const Side side = location_.locate(c);
        if (!edges && side == Side::outside) return true;
        if (!supports_.covers(c, radius_ - slack_) && (side != Side::outside || half <= slack_)) return false;
        for (const Box& part : {Box{cell.lo, c}, Box{{c.x, cell.lo.y}, {cell.hi.x, c.y}}, Box{{cell.lo.x, c.y}, {c.x, cell.hi.y}}, Box{c, cell.hi}})
            if (!covered(part, box, edges)) return false;
        return true;
    }

    const Settings& settings_;
    const CavityBoundary& boundary_;
    std::uint64_t seed_;
    double radius_, slack_;
    std::map<std::pair<Unit, Unit>, std::size_t> cell_at_;
    PointLocation location_;
    GrowingSupports supports_;
    std::vector<Cell> cells_;
};

}  // namespace

SupportForest grow_supports(SupportForest propagated, const Region& unsupported, const CavityBoundary& boundary,
                            std::uint64_t layer_seed, const Settings& settings) {
    if (unsupported.empty()) return propagated;
    return Grower(std::move(propagated), unsupported, boundary, layer_seed, settings).run();
}

}  // namespace ribvault
