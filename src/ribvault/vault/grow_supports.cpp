#include "ribvault/vault/grow_supports.hpp"

#include <algorithm>
#include <queue>

#include "ribvault/exact/nearest_segment.hpp"
#include "ribvault/exact/point_location.hpp"
#include "ribvault/slice/lattice_clip.hpp"
#include "ribvault/vault/growing_supports.hpp"
#include "ribvault/vault/trim_walls.hpp"
#include "ribvault/vault/unsupported_cells.hpp"

namespace ribvault {
namespace {

/// Deterministic random number of a place: ties of Section 4.3 do not depend on the order of evaluation.
std::uint64_t tie_of(Point p, std::uint64_t seed) {
    std::uint64_t z = seed ^ (static_cast<std::uint64_t>(p.x) * 0x9e3779b97f4a7c15ULL) ^
                      (static_cast<std::uint64_t>(p.y) * 0xc2b2ae3d27d4eb4fULL);
    for (int round = 0; round < 2; ++round) {  // the finaliser of splitmix64
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
        z ^= z >> 31;
    }
    return z;
}

struct Candidate {
    SquaredDistance distance;  ///< to B_i, or the lower end of its band; for a whole cell a lower bound
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

/// The contours of those pieces of a region in which a disc of radius 3/4 of a support's width has room.
std::vector<Segment> wide_pieces(const Region& region, Unit width) {
    std::vector<Segment> wide;
    for (const Region& piece : connected_pieces(region)) {
        const Box box = bounding_box(piece);
        if (2 * std::min(box.hi.x - box.lo.x, box.hi.y - box.lo.y) < 3 * width ||
            offset(piece, -0.75 * static_cast<double>(width)).empty())
            continue;
        const std::vector<Segment> border = edges_of(piece);
        wide.insert(wide.end(), border.begin(), border.end());
    }
    return wide;
}

class Grower {
public:
    Grower(SupportForest forest, const Region& unsupported, const CavityBoundary& boundary, std::uint64_t seed,
           const Settings& settings)
        : settings_(settings),
          boundary_(boundary),
          seed_(seed),
          radius_(settings.reach_of_support()),
          slack_(settings.slack),
          unsupported_(unsupported, settings),
          supports_(std::move(forest), boundary.location.box(), boundary, settings) {
        if (settings.branch_bonus && settings.quarter_bonus == QuarterBonus::narrow)
            wide_ = PointLocation(wide_pieces(unsupported, settings.support_width), units_per_mm);
    }

    GrownSupports run() {
        add_pixels();
        std::vector<std::size_t> open = all_cells();
        // What no wall may come near to (removal gap) stays open: a round that adds nothing is the last.
        for (int before = -1; !open.empty() && supports_.added() != before;) {
            before = supports_.added();
            open = add_between(open);
        }
        if (settings_.trim) trim_walls(supports_, unsupported_, settings_);
        return {supports_.take(), full_bonus_, quarter_bonus_};
    }

private:
    void add_wall(Point p) { supports_.add_wall(p, bonus(p)); }

    /// Equation (4)'s bonus for a wall to p. Notes which one it is.
    Unit bonus(Point p) {
        if (!settings_.branch_bonus) return 0;
        const bool quarter = settings_.quarter_bonus == QuarterBonus::everywhere ||
                             (settings_.quarter_bonus == QuarterBonus::narrow && wide_.locate(p) == Side::outside);
        (quarter ? quarter_bonus_ : full_bonus_) = true;
        return quarter ? settings_.branch_bonus_length / 4 : settings_.branch_bonus_length;
    }

    static double half_diagonal(const Box& box) { return UnsupportedCells::half_diagonal(box); }

    /// The first pass: the lattice's points, nearest to B_i first. Cells open only when their turn comes, and not at
    /// all when one wall already covers them. Contact at exactly r + ρ counts here: on a lattice it is the normal case.
    void add_pixels() {
        Queue queue;
        const std::vector<UnsupportedCells::Cell>& cells = unsupported_.cells();
        for (std::size_t k = 0; k < cells.size(); ++k) {
            if (cells[k].pixels == 0) continue;
            const Point c = UnsupportedCells::centre(cells[k].box);
            const double nearest = std::sqrt(to_shell(c).value()) - half_diagonal(cells[k].box);
            const auto bound = static_cast<std::int64_t>(std::max(0.0, nearest));
            queue.push({in_order({static_cast<Int128>(bound) * bound, 1}), 0, c, static_cast<std::int64_t>(k)});
        }
        while (!queue.empty()) {
            const Candidate candidate = queue.top();
            queue.pop();
            if (candidate.cell < 0) {
                if (!supports_.covers(candidate.at, radius_)) add_wall(candidate.at);
                continue;
            }
            const UnsupportedCells::Cell& cell = cells[static_cast<std::size_t>(candidate.cell)];
            if (supports_.covers_around(candidate.at, half_diagonal(cell.box), radius_)) continue;
            for (Unit bit = 0; bit < 64; ++bit) {
                if (!(cell.pixels >> bit & 1)) continue;
                const Point p = unsupported_.pixel(cell, bit);
                if (!supports_.covers(p, radius_)) queue.push(point_candidate(p));
            }
        }
    }

    Candidate point_candidate(Point p) const { return {in_order(to_shell(p)), tie_of(p, seed_), p, -1}; }

    /// Where there is no shell all points are equally near.
    SquaredDistance to_shell(Point p) const {
        return boundary_.has_shell() ? boundary_.edges.nearest(p).distance : SquaredDistance{0, 1};
    }

    /// What decides when a point at this distance to B_i is looked at.
    SquaredDistance in_order(const SquaredDistance& distance) const {
        if (settings_.order == Order::distance) return distance;
        SquaredDistance band{0, 1};
        for (Unit end = settings_.support_radius; compare({static_cast<Int128>(end) * end, 1}, distance) <= 0; end *= 2)
            band.numerator = static_cast<Int128>(end) * end;
        return band;
    }

    std::vector<std::size_t> all_cells() const {
        std::vector<std::size_t> open(unsupported_.cells().size());
        for (std::size_t k = 0; k < open.size(); ++k) open[k] = k;
        return open;
    }

    /// The second pass, one round: finds points between the pixels that are not covered, adds their walls, and returns
    /// the cells that must be looked at again.
    std::vector<std::size_t> add_between(const std::vector<std::size_t>& open) {
        Queue queue;
        std::vector<std::size_t> again;
        for (const std::size_t k : open) {
            const std::size_t before = queue.size();
            unsupported_.find_uncovered(k, unsupported_.cells()[k].box, supports_, [&](Point p) {
                queue.push(point_candidate(p));
                return false;
            });
            if (queue.size() != before) again.push_back(k);
        }
        for (; !queue.empty(); queue.pop())
            if (!supports_.covers(queue.top().at, radius_ - slack_)) add_wall(queue.top().at);
        return again;
    }

    const Settings& settings_;
    const CavityBoundary& boundary_;
    std::uint64_t seed_;
    Unit radius_, slack_;
    UnsupportedCells unsupported_;
    PointLocation wide_;  ///< where the bonus counts in full, with QuarterBonus::narrow
    GrowingSupports supports_;
    bool full_bonus_ = false, quarter_bonus_ = false;  ///< used by a wall
};

}  // namespace

GrownSupports grow_supports(SupportForest propagated, const Region& unsupported, const CavityBoundary& boundary,
                            std::uint64_t layer_seed, const Settings& settings) {
    if (unsupported.empty()) return {std::move(propagated)};
    return Grower(std::move(propagated), unsupported, boundary, layer_seed, settings).run();
}

}  // namespace ribvault
