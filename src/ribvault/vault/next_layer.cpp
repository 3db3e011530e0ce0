#include "ribvault/vault/next_layer.hpp"

#include <algorithm>

#include "ribvault/slice/lattice_clip.hpp"
#include "ribvault/vault/brace_trees.hpp"
#include "ribvault/vault/copy_supports.hpp"
#include "ribvault/vault/detect_unsupported.hpp"
#include "ribvault/vault/erode_supports.hpp"
#include "ribvault/vault/free_trees.hpp"
#include "ribvault/vault/grow_supports.hpp"
#include "ribvault/vault/growing_supports.hpp"
#include "ribvault/vault/lean_trees.hpp"
#include "ribvault/vault/shrink_supports.hpp"
#include "ribvault/vault/straighten_supports.hpp"
#include "ribvault/vault/wall_stability.hpp"

namespace ribvault {

namespace {

/// Straightening may have moved walls over the boundary; dots stay what they are.
SupportForest clip_again(const SupportForest& forest, const CavityBoundary& boundary) {
    SupportForest clipped = copy_supports(forest, boundary, true).forest;
    for (auto [v, end] = vertices(forest); v != end; ++v)
        if (out_degree(*v, forest) == 0 && !forest[*v].free) add_vertex(forest[*v], clipped);
    if (boundary.free_trees) root_trees(clipped);
    return clipped;
}

/// What of a region a wall can hold up that runs in `walls`.
Region within_reach(const Region& region, const Region& walls, const Settings& settings) {
    if (region.empty() || walls.empty()) return {};
    const double slack = static_cast<double>(settings.slack);
    return clip(
        ClipperLib::ctIntersection, region,
        offset(walls, static_cast<double>(settings.reach_of_support()) - 3 * slack, ClipperLib::jtRound, slack));
}

/// What of the layer above neither the supports nor the shell hold up; where the object holds up none, what the
/// supports do not of those outside.
Region unsupported_pieces(const CopiedSupports& copied, const SupportForest& propagated, const Cavity& cavity,
                          const Settings& settings) {
    if (!cavity.on_bed) return unsupported_walls(copied.inherited, propagated, &cavity.deep, settings);
    std::vector<Segment> inside, outside;
    for (std::size_t k = 0; k < copied.inherited.size(); ++k)
        (copied.inherited_outside[k] ? outside : inside).push_back(copied.inherited[k]);
    Region unsupported = unsupported_walls(inside, propagated, &cavity.deep, settings);
    const Region more = unsupported_walls(outside, propagated, nullptr, settings);
    unsupported.insert(unsupported.end(), more.begin(), more.end());
    return unsupported;
}

/// Trees that where walls may run has cut to less than they need to stand free get it back.
void mend_free_trees(SupportForest& forest, const CavityBoundary& boundary, const Settings& settings) {
    std::vector<std::size_t> roots;
    for (auto [v, end] = vertices(forest); v != end; ++v)
        if (forest[*v].free) roots.push_back(*v);
    if (roots.empty()) return;
    GrowingSupports supports(std::move(forest), boundary.location.box(), boundary, settings);
    for (const std::size_t root : roots) supports.mend_free_tree(root);
    forest = supports.take();
}

}  // namespace

LayerSupports next_layer(SupportForest& above, const Cavity& cavity, const Region& overhang, const Settings& settings) {
    LayerSupports result;
    std::vector<char> continues(num_edges(above), 0);
    if (!cavity.region.empty() && (num_vertices(above) > 0 || !overhang.empty())) {
        CavityBoundary boundary = prepare_boundary(cavity);
        boundary.free_trees = cavity.outside || settings.pillars;
        // A cavity's floor is not known here; it is no lower than this.
        if (!cavity.outside) boundary.layers_below = std::max(0, cavity.layer - settings.bottom_layers);
        const bool shell_holds_tracks = boundary.rooted && settings.support_radius >= settings.half_width();
        CopiedSupports copied = copy_supports(above, boundary, shell_holds_tracks);
        if (settings.pillars && !cavity.outside && settings.propagation == Propagation::shrink &&
            settings.erosion_step > 0 && boundary.has_shell())
            boundary.leaning = {settings.leaning_length,
                                static_cast<double>(settings.layer_height) / settings.leaning_ratio};
        if (boundary.free_trees) root_trees(copied.forest);
        if (boundary.leaning)
            lean_where_cheaper(copied.forest, boundary, settings.erosion_step);
        else if (settings.pillars)
            free_where_cheaper(copied.forest, boundary.layers_below, settings.erosion_step, [&](std::size_t) {
                return static_cast<double>(settings.pillar_length) * boundary.layers_below;
            });
        for (auto [v, end] = vertices(copied.forest); v != end; ++v) ++copied.forest[*v].standing;
        SupportForest propagated;
        const auto note_continued = [&](const std::vector<char>& survives) {
            for (std::size_t e = 0; e < copied.origin.size(); ++e)
                if (survives[e] && copied.origin[e] >= 0) continues[static_cast<std::size_t>(copied.origin[e])] = 1;
        };
        ErodedSupports eroded;
        if (settings.propagation == Propagation::shrink) {
            ShrunkSupports shrunk = shrink_supports(copied.forest, boundary, settings.erosion_step,
                                                    settings.pillar_length, cavity.outside ? 0 : settings.brace);
            note_continued(shrunk.survives);
            propagated = shrunk.left_cavity ? clip_again(shrunk.forest, boundary) : std::move(shrunk.forest);
        } else {
            eroded = erode_supports(copied.forest, settings.erosion_step, settings.pillar_length);
            note_continued(eroded.survives);
            propagated = std::move(eroded.forest);
        }
        if (settings.propagation == Propagation::erode_straighten && settings.straighten) {
            StraightenedSupports straightened =
                straighten_supports(propagated, eroded.pinned, boundary, settings.straighten_step);
            result.blocked = straightened.blocked;
            propagated =
                straightened.left_cavity ? clip_again(straightened.forest, boundary) : std::move(straightened.forest);
        }
        if (boundary.free_trees) centre_free_trees(propagated);
        if (boundary.free_trees && !boundary.rooted) mend_free_trees(propagated, boundary, settings);
        result.unsupported = unsupported_pieces(copied, propagated, cavity, settings);
        result.unsupported.insert(result.unsupported.end(), overhang.begin(), overhang.end());
        if (cavity.walls) result.unsupported = within_reach(result.unsupported, *cavity.walls, settings);
        const std::uint64_t layer_seed =
            settings.seed * 0x9e3779b97f4a7c15ULL + static_cast<std::uint64_t>(cavity.layer);
        GrownSupports grown = grow_supports(std::move(propagated), result.unsupported, boundary, layer_seed, settings);
        result.forest = std::move(grown.forest);
        result.full_bonus = grown.full_bonus, result.quarter_bonus = grown.quarter_bonus;
        if (!cavity.outside) {
            result.braces = brace_trees(result.forest, boundary, settings.brace);
            mark_wide_trees(result.forest, settings);
        }
    }
    if (cavity.outside)  // where walls have one line, also those that came out of a cavity
        for (auto [v, end] = vertices(result.forest); v != end; ++v)
            result.forest[*v].outside = true, result.forest[*v].wide = false;
    std::size_t index = 0;
    for (auto [e, end] = edges(above); e != end; ++e, ++index) above[*e].first_layer = !continues[index];
    return result;
}

}  // namespace ribvault
