#include "ribvault/vault/straighten_supports.hpp"

#include "ribvault/vault/segment_grid.hpp"
#include "ribvault/vault/wall_contacts.hpp"

namespace ribvault {
namespace {

struct Wall {
    std::size_t a, b;
    bool alive = true;
};

Point move_towards(Point from, double x, double y, Unit step) {
    const double dx = x - static_cast<double>(from.x), dy = y - static_cast<double>(from.y), d = std::hypot(dx, dy);
    const double share = d <= static_cast<double>(step) ? 1 : static_cast<double>(step) / d;
    Point to{from.x + round_to_lattice(share * dx), from.y + round_to_lattice(share * dy)};
    if (squared_length(to - from) > step * step) {  // only the rounding can have gone beyond the limit
        const double shorter = std::max(0.0, static_cast<double>(step) - 1) / d;
        to = {from.x + round_to_lattice(shorter * dx), from.y + round_to_lattice(shorter * dy)};
    }
    return to;
}

class Straightener {
public:
    Straightener(const SupportForest& forest, const std::vector<char>& pinned, const CavityBoundary& boundary,
                 Unit step)
        : forest_(forest),
          pinned_(pinned),
          boundary_(boundary),
          step_(step),
          place_(num_vertices(forest)),
          at_(num_vertices(forest)),
          grid_(bounding_box(forest), units_per_mm, 0) {
        for (std::size_t v = 0; v < place_.size(); ++v) place_[v] = forest[v].at;
        for (auto [e, end] = edges(forest); e != end; ++e) add_wall(source(*e, forest), target(*e, forest), false);
    }

    StraightenedSupports run() {
        for (std::size_t v = 0; v < place_.size(); ++v) {
            if (passes(v)) continue;
            for (std::size_t k = 0, n = at_[v].size(); k < n; ++k)  // what is added on the way needs no visit
                if (!seen_[at_[v][k]]) straighten_chain(v, at_[v][k]);
        }
        return finish();
    }

private:
    bool passes(std::size_t v) const { return out_degree(v, forest_) == 2 && !forest_[v].root && !pinned_[v]; }
    Segment segment(const Wall& w) const { return {place_[w.a], place_[w.b]}; }

    void add_wall(std::size_t a, std::size_t b, bool seen) {
        const auto id = static_cast<std::uint32_t>(walls_.size());
        walls_.push_back({a, b});
        at_[a].push_back(id);
        at_[b].push_back(id);
        seen_.push_back(seen);
        grid_.insert(id, segment(walls_.back()));
    }

    void straighten_chain(std::size_t start, std::uint32_t first) {
        chain_.assign(1, start);
        chain_walls_.clear();
        double total = 0;
        lengths_.assign(1, 0);
        for (std::uint32_t wall = first;;) {
            seen_[wall] = 1;
            chain_walls_.push_back(wall);
            const std::size_t v = walls_[wall].a == chain_.back() ? walls_[wall].b : walls_[wall].a;
            total += length(place_[v] - place_[chain_.back()]);
            chain_.push_back(v);
            lengths_.push_back(total);
            if (!passes(v)) break;
            wall = at_[v][0] == wall ? at_[v][1] : at_[v][0];
        }
        if (chain_.size() < 3 || place_[chain_.front()] == place_[chain_.back()]) return;

        const Point p0 = place_[chain_.front()], pn = place_[chain_.back()];
        targets_.assign(1, p0);
        bool arrives = true;
        for (std::size_t k = 1; k + 1 < chain_.size(); ++k) {
            const double share = lengths_[k] / total;
            const double x = static_cast<double>(p0.x) + share * static_cast<double>(pn.x - p0.x);
            const double y = static_cast<double>(p0.y) + share * static_cast<double>(pn.y - p0.y);
            const Point from = place_[chain_[k]];
            targets_.push_back(move_towards(from, x, y, step_));
            // The rounded chord point may be as much as one unit beyond the limit: then the chain arrives a layer
            // later.
            arrives = arrives && compare_distance(from, {p0, pn}, step_) <= 0 &&
                      std::hypot(x - static_cast<double>(from.x), y - static_cast<double>(from.y)) <=
                          static_cast<double>(step_);
        }
        targets_.push_back(pn);
        for (const std::uint32_t w : chain_walls_) walls_[w].alive = false;
        if (arrives) {
            moved_.assign(1, {p0, pn});
            arrives = !collides(moved_.front());
        }
        if (!arrives) keep_clear();
        for (const Segment& s : moved_)
            result_.left_cavity =
                result_.left_cavity || meets_shell(s, s.a == p0 && forest_[chain_.front()].root,
                                                   s.b == pn && forest_[chain_.back()].root, boundary_);
        if (arrives) {
            add_wall(chain_.front(), chain_.back(), true);
            return;
        }
        for (std::size_t k = 1; k + 1 < chain_.size(); ++k) place_[chain_[k]] = targets_[k];
        for (std::size_t k = 0; k + 1 < chain_.size(); ++k) add_wall(chain_[k], chain_[k + 1], true);
    }

    bool collides(const Segment& s) const {
        bool hit = false;
        grid_.visit(bounding_box(s),
                    [&](std::uint32_t w) { hit = hit || (walls_[w].alive && collide(s, segment(walls_[w]))); });
        return hit;
    }

    /// Lets every vertex go to its target but those whose walls would cross another wall: they stay, and so do their
    /// neighbours along such a wall, until nothing crosses. In the end that is the chain as it was, which crosses
    /// nothing.
    void keep_clear() {
        bool counted = false;
        for (bool again = true; again;) {
            again = false;
            moved_.clear();
            for (std::size_t k = 0; k + 1 < targets_.size(); ++k) moved_.push_back({targets_[k], targets_[k + 1]});
            for (std::size_t k = 0; k < moved_.size(); ++k) {
                bool hit = collides(moved_[k]);
                for (std::size_t j = k + 2; !hit && j < moved_.size(); ++j) hit = collide(moved_[k], moved_[j]);
                if (!hit) continue;
                for (const std::size_t v : {k, k + 1}) {
                    again = again || targets_[v] != place_[chain_[v]];
                    targets_[v] = place_[chain_[v]];
                }
                result_.blocked += !counted;
                counted = true;
            }
        }
        std::erase_if(moved_, [](const Segment& s) { return s.a == s.b; });
    }

    StraightenedSupports finish() {
        std::vector<std::int64_t> vertex(place_.size(), -1);
        const auto keep = [&](std::size_t v) {
            if (vertex[v] < 0) {
                vertex[v] = static_cast<std::int64_t>(add_vertex(forest_[v], result_.forest));
                result_.forest[static_cast<std::size_t>(vertex[v])].at = place_[v];
            }
            return static_cast<std::size_t>(vertex[v]);
        };
        // Two vertices that moved to the same lattice point become one: their wall has no length.
        std::vector<std::size_t> same(place_.size());
        for (std::size_t v = 0; v < same.size(); ++v) same[v] = v;
        const auto find = [&](std::size_t v) {
            while (same[v] != v) v = same[v];
            return v;
        };
        for (const Wall& w : walls_)
            if (w.alive && place_[w.a] == place_[w.b]) {
                const std::size_t a = find(w.a), b = find(w.b);
                if (a != b) (forest_[b].root ? same[a] : same[b]) = forest_[b].root ? b : a;
            }
        for (const Wall& w : walls_) {
            if (!w.alive || place_[w.a] == place_[w.b]) continue;
            const std::size_t a = keep(find(w.a)), b = keep(find(w.b));
            add_edge(a, b, result_.forest);
        }
        for (std::size_t v = 0; v < place_.size(); ++v)
            if (out_degree(v, forest_) == 0) keep(v);
        return std::move(result_);
    }

    const SupportForest& forest_;
    const std::vector<char>& pinned_;
    const CavityBoundary& boundary_;
    Unit step_;
    std::vector<Point> place_;
    std::vector<std::vector<std::uint32_t>> at_;
    std::vector<Wall> walls_;
    std::vector<char> seen_;
    SegmentGrid grid_;
    StraightenedSupports result_;
    std::vector<std::size_t> chain_;
    std::vector<std::uint32_t> chain_walls_;
    std::vector<double> lengths_;
    std::vector<Point> targets_;
    std::vector<Segment> moved_;
};

}  // namespace

StraightenedSupports straighten_supports(const SupportForest& forest, const std::vector<char>& pinned,
                                         const CavityBoundary& boundary, Unit step) {
    return Straightener(forest, pinned, boundary, step).run();
}

}  // namespace ribvault
