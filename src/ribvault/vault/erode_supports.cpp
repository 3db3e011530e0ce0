#include "ribvault/vault/erode_supports.hpp"

#include <algorithm>

#include "ribvault/vault/free_trees.hpp"

namespace ribvault {

namespace {

class Erosion {
public:
    explicit Erosion(const SupportForest& forest)
        : forest_(forest), at_(num_vertices(forest)), lost_branch_(num_vertices(forest), false) {
        for (auto [v, end] = vertices(forest); v != end; ++v) place_.push_back(forest[*v].at);
        for (auto [e, end] = edges(forest); e != end; ++e) {
            const std::size_t a = source(*e, forest), b = target(*e, forest);
            at_[a].push_back(static_cast<std::uint32_t>(walls_.size()));
            at_[b].push_back(static_cast<std::uint32_t>(walls_.size()));
            walls_.push_back({a, b});
        }
    }

    bool is_tip(std::size_t v) const { return at_[v].size() == 1 && !forest_[v].root; }

    /// Takes so much from the path at a tip, up to the next junction or root.
    void draw_back(std::size_t tip, double left) {
        std::size_t v = tip;
        std::uint32_t wall = at_[tip][0];
        while (true) {
            const std::size_t next = walls_[wall].a == v ? walls_[wall].b : walls_[wall].a;
            const double l = length(forest_[next].at - forest_[v].at);
            if (l > left) {
                // One unit short of the limit, so that the rounding to the lattice stays within it.
                place_[v] = part_way(forest_[v].at, forest_[next].at, left > 1 ? (left - 1) / l : 0);
                return;
            }
            walls_[wall].alive = false;
            left -= l;
            if (forest_[next].root || at_[next].size() != 2) {
                lost_branch_[next] = true;
                return;
            }
            wall = at_[next][0] == wall ? at_[next][1] : at_[next][0];
            v = next;
        }
    }

    /// What is left, and all roots.
    ErodedSupports result() const {
        ErodedSupports left;
        std::vector<std::int64_t> vertex(place_.size(), -1);
        const auto keep = [&](std::size_t v) {
            if (vertex[v] < 0) {
                vertex[v] = static_cast<std::int64_t>(add_vertex(forest_[v], left.forest));
                left.forest[static_cast<std::size_t>(vertex[v])].at = place_[v];
                left.pinned.push_back(lost_branch_[v]);
            }
            return static_cast<std::size_t>(vertex[v]);
        };
        for (const Wall& wall : walls_) {
            left.survives.push_back(wall.alive && !used_up(wall));
            if (!left.survives.back()) continue;
            const std::size_t a = keep(wall.a), b = keep(wall.b);
            add_edge(a, b, left.forest);
        }
        for (std::size_t v = 0; v < place_.size(); ++v)
            if (forest_[v].root) keep(v);
        return left;
    }

private:
    struct Wall {
        std::size_t a, b;
        bool alive = true;
    };
    /// Its tip came to lie on its neighbour; a wall that had no length before still joins two parts.
    bool used_up(const Wall& wall) const {
        return place_[wall.a] == place_[wall.b] && forest_[wall.a].at != forest_[wall.b].at;
    }

    const SupportForest& forest_;
    std::vector<Wall> walls_;
    std::vector<std::vector<std::uint32_t>> at_;  ///< walls, by vertex
    std::vector<Point> place_;                    ///< of the vertices now
    std::vector<char> lost_branch_;
};

}  // namespace

ErodedSupports erode_supports(const SupportForest& forest, Unit step, Unit pillar_length) {
    Erosion erosion(forest);
    SpareLengths lengths = spare_lengths(forest, pillar_length);
    for (std::size_t tip = 0; step > 0 && tip < num_vertices(forest); ++tip) {
        if (!erosion.is_tip(tip)) continue;
        double& spare = lengths.of(tip);
        if (spare <= 0) continue;
        const double by = std::min(static_cast<double>(step), spare);
        spare -= by;  // at least what goes
        erosion.draw_back(tip, by);
    }
    return erosion.result();
}

}  // namespace ribvault
