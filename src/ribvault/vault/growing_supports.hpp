// The supports of one layer while walls are added to them: coverage, nearest wall, splitting (Section 4.3).
#pragma once

#include <optional>

#include "ribvault/settings.hpp"
#include "ribvault/vault/cavity_boundary.hpp"
#include "ribvault/vault/segment_grid.hpp"
#include "ribvault/vault/support_forest.hpp"

namespace ribvault {

class GrowingSupports {
public:
    GrowingSupports(SupportForest forest, const Box& cavity_box, const CavityBoundary& boundary,
                    const Settings& settings);

    /// Is p within `radius` (at most r + ρ) of a wall? Exact. Nothing is within a negative radius.
    bool covers(Point p, Unit radius) const;
    /// Does one wall cover all within `size` of p, with this radius? In doubles: with a `size` that is a unit too great
    /// (UnsupportedCells::half_diagonal), far more than they are off, yes is certain.
    bool covers_around(Point p, double size, Unit radius) const;

    /// Adds the wall that Section 4.3 gives to p: to the nearest point of B_i ∪ S_i under equation (4) with this bonus.
    /// Precondition: p lies strictly inside the cavity. Postcondition: covers(p, 0) up to rounding.
    ///
    /// Where trees may stand free and a wall would take more track down to the bed than a pillar does, p gets a pillar:
    /// a cross of as much track as a pillar keeps at first. Outside p may also lie between the object and the region
    /// that a removal gap leaves: the wall goes to the point of the region nearest to it.
    void add_wall(Point p, Unit bonus);

    /// Mends the free tree with this root if where walls may run has cut it to less than half a pillar: it joins the
    /// nearest wall of another tree where that takes less track down to the bed than a pillar, or goes on as a pillar
    /// itself, with arms where there is room. What has shrunk to a point beside another tree is left out: its place is
    /// printed already. The root's number stays.
    void mend_free_tree(std::size_t root);

    /// A wall that add_wall added, from its new vertex to where it joined.
    struct NewWall {
        std::size_t vertex, joint;
        std::uint32_t index;
    };
    const std::vector<NewWall>& new_walls() const { return new_walls_; }
    /// Is the wall there, and nothing joined to its new vertex?
    bool is_free(const NewWall& wall) const {
        return walls_[wall.index].alive && out_degree(wall.vertex, forest_) == 1;
    }
    Segment segment_of(const NewWall& wall) const { return {forest_[wall.joint].at, forest_[wall.vertex].at}; }
    void remove(const NewWall& wall) {
        walls_[wall.index].alive = false;
        remove_edge(wall.vertex, wall.joint, forest_);
    }
    /// Puts it back, shortened to a share of `whole`.
    void restore(const NewWall& wall, const Segment& whole, double share) {
        Wall& restored = walls_[wall.index];
        restored.place.a = forest_[wall.vertex].at = part_way(whole.a, whole.b, share);
        restored.alive = true;
        add_edge(wall.vertex, wall.joint, forest_);
    }

    /// The supports; invalidates the object.
    SupportForest take();
    int added() const { return added_; }

private:
    struct Wall {
        std::size_t a, b;
        Segment place;  ///< from a to b
        bool alive;
    };
    const Segment& segment(std::uint32_t w) const { return walls_[w].place; }
    void enter(std::size_t a, std::size_t b);
    void connect(std::size_t a, std::size_t b);
    void add_tip(Point p, std::size_t joint);
    /// Does a wall meet the way elsewhere than at its end? Walls for which skip(index) holds do not count.
    template <class Skip>
    bool walls_bar(const Segment& way, Skip&& skip) const;
    /// Does an edge of the boundary? `at_root`: the way ends in a root on the shell and may meet the boundary there.
    bool edge_bars(const Segment& way, bool at_root) const;
    bool free_way(Point from, std::size_t to) const;
    Unit pillar_length() const { return boundary_.leaning ? boundary_.leaning->length : settings_.pillar_length; }
    /// `to` lies on that wall; `own`: the vertex at `from`, if there is one.
    bool free_way(Point from, Point to, std::uint32_t wall, std::size_t own = no_vertex) const;
    double longest_wall() const;                                    ///< that takes less track than a pillar
    /// `from`: the vertex at p, if there is one, and `own` what of the vertices is of its tree.
    std::optional<std::uint32_t> nearest_wall(Point p, const SquaredDistance& limit, SquaredDistance& distance,
                                              std::size_t from = no_vertex, const std::vector<char>& own = {}) const;
    bool runs_along(std::size_t vertex, Point arm) const;
    std::optional<Point> place_inside(Point p) const;
    void add_pillar(Point p);
    std::size_t split(std::uint32_t wall, Point near);

    static constexpr std::size_t no_vertex = static_cast<std::size_t>(-1);
    std::vector<NewWall> new_walls_;
    std::vector<std::size_t> left_out_;  ///< vertices of trees that mend_free_tree left out
    std::size_t inherited_vertices_ = 0;
    SupportForest forest_;
    const CavityBoundary& boundary_;
    const Settings& settings_;
    std::vector<Wall> walls_;
    SegmentGrid grid_;
    int added_ = 0;
};

}  // namespace ribvault
