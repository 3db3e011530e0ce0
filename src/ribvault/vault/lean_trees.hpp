// Thrifty strategy with pillars: trees that stand free in a cavity lean towards what is nearest to them, so that the
// shell carries them in the end, not the floor.
#pragma once

#include <vector>

#include "ribvault/vault/moving_supports.hpp"

namespace ribvault {

/// Has trees that are rooted on the shell stand free where that takes less track until they have come to the shell
/// again (free_where_cheaper). Preconditions: every tree has one root; boundary.leaning.
void lean_where_cheaper(SupportForest& forest, const CavityBoundary& boundary, Unit step);

/// Of what moves together from one layer to the next, the trees that stand free. One that has more track than it is to
/// keep (Leaning::track) shrinks from all its tips, no further than to that (zipping up a narrow corner may take a
/// little more). Any other goes, one step a layer, to what is nearest to it: the shell, on which it is rooted once it
/// is there, or another tree, which it then is a part of.
class LeaningTrees {
public:
    /// `supports` must outlive this. Preconditions: supports.boundary.leaning; every tree has one root.
    explicit LeaningTrees(MovingSupports& supports);

    /// Leads every tree that is short enough one step on. To be called once, before anything has moved. A tree that
    /// stands free has no root from then on.
    void lead();
    /// To be called when the trees have been led and no walls will be added: what they are now is what `change` counts.
    void measure();
    /// May the walls of v's tree become longer by this, lattice units, in all? Those of a tree with a root may. If they
    /// may, it counts as done.
    bool change(std::size_t v, double by);

private:
    static constexpr std::size_t none = MovingSupports::none;

    struct Tree {
        std::vector<std::size_t> nodes;
        double track = 0;
        int standing = 0;
        bool free = false, rooted = false;  ///< before and after it was led
        bool joined = false;  ///< by another one
    };
    struct Target {
        double distance;   ///< lattice units
        std::size_t head;  ///< the vertex of the tree that is nearest to it
        Point at;
        std::size_t wall;  ///< of another tree; none: the shell
    };
    std::vector<Tree> trees() const;
    Target nearest_target(const Tree& tree) const;
    /// Says whether the trees became one.
    bool join_wall(const Target& target);
    void root_on_shell(const Target& target);
    void approach(const Target& target);

    MovingSupports& supports_;
    const Leaning& leaning_;
    std::vector<std::size_t> tree_;  ///< by node the number of its tree: before `lead`, or since `measure`
    std::vector<char> was_free_;  ///< by node: its tree stood free before
    /// By tree; measured.
    std::vector<double> track_, least_;
};

}  // namespace ribvault
