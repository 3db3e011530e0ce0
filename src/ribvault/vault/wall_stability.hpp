// How steady the walls of a layer stand, and which of them are printed with several tracks side by side (beyond the
// paper).
#pragma once

#include "ribvault/settings.hpp"
#include "ribvault/vault/support_forest.hpp"

namespace ribvault {

/// How wide the wall through this vertex is printed, in lattice units: wide trees as settings.wall_lines tracks side by
/// side (print/wide_walls.hpp), all others as one. The same for all vertices of a tree.
inline Unit wall_width(const SupportVertex& v, const Settings& settings) {
    return v.wide ? settings.wall_lines * settings.support_width : settings.support_width;
}

/// Where a wall sways most easily. A place of a wall is held from below by what the wall stands on and from the side by
/// the nearest root; the nearer of the two decides. The root of a tree that stands free is where its walls hold each
/// other, but nothing holds the tree: it sways as a whole too, over where it is narrowest.
struct SlenderPlace {
    double ratio = 0;     ///< free height over width: min(standing, to root) / width; of a whole tree standing / extent
    double standing = 0;  ///< lattice units: height of the wall from the bottom of this layer up
    double to_root = 0;   ///< lattice units: along the wall to the nearest root; 0 of a whole tree that stands free
    Point at;             ///< of a whole tree its root
};
/// The place of the greatest ratio, in cavities and outside; all zero without walls. Exact up to double arithmetic.
SlenderPlace most_slender(const SupportForest& forest, const Settings& settings);

/// Marks the trees (SupportVertex::wide; their walls have no gaps at junctions, SupportEdge::to_junction) that reach
/// farther from their roots than settings.wall_lines_longer, that carry more than settings.wall_lines_taller, or that
/// grew out of such a tree; not those of which tapered_trees would leave nothing. Does nothing with one line a wall.
void mark_wide_trees(SupportForest& forest, const Settings& settings);

/// The forest as it is printed: the tips of wide trees are drawn back, along the longest way to each place, by as much
/// as the tracks around them add to its reach beyond one track, (wall_lines - 1) d / 2. So wide walls end where walls
/// of one line do, and what holds up the tip of those holds up theirs. Roots, and walls between roots, stay.
/// Tips are drawn back by less where otherwise nothing would be left within ρ of one of the points `above`, the ends of
/// the wide trees above as they are printed: as walls shrink, merge and turn, the places that are drawn back to may
/// move by more than the walls do.
SupportForest tapered_trees(const SupportForest& forest, const Settings& settings,
                            const std::vector<Point>& above = {});
/// Of tapered trees.
std::vector<Point> ends_of_wide_trees(const SupportForest& forest);

/// How many trees are marked.
int wide_trees(const SupportForest& forest);

}  // namespace ribvault
