// The supports of one layer while walls are added to them: coverage, nearest wall, splitting (Section 4.3).
#pragma once

#include <limits>
#include <optional>

#include "ribvault/settings.hpp"
#include "ribvault/vault/cavity_boundary.hpp"
#include "ribvault/vault/segment_grid.hpp"
#include "ribvault/vault/support_forest.hpp"

namespace ribvault {

class GrowingSupports {
public:
    GrowingSupports(SupportForest forest, const Box& cavity_box, const CavityBoundary& boundary, const Settings& settings);

    /// Is p within `radius` (units, at most r + ρ) of a wall? Nothing is within a negative radius.
    bool covers(Point p, double radius) const;

    /// Adds the wall that Section 4.3 gives to p: to the nearest point of B_i ∪ S_i under equation (4).
    /// Precondition: p lies strictly inside the cavity. Postcondition: covers(p, 0) up to rounding.
    void add_wall(Point p);

    /// The supports; invalidates the object.
    SupportForest take() { return std::move(forest_); }
    int added() const { return added_; }

private:
    struct Wall {
        std::size_t a, b;
        bool alive;
    };
    Segment segment(std::uint32_t w) const { return {forest_[walls_[w].a].at, forest_[walls_[w].b].at}; }
    void enter(std::size_t a, std::size_t b);
    void connect(std::size_t a, std::size_t b);
    bool free_way(Point from, std::size_t to) const;
    std::size_t split(std::uint32_t wall, Point near);

    SupportForest forest_;
    const CavityBoundary& boundary_;
    const Settings& settings_;
    std::vector<Wall> walls_;
    SegmentGrid grid_;
    int added_ = 0;
};

}  // namespace ribvault
