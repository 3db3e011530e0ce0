// Patches under what hangs though all tracks of a layer are printed: where they go, round by round.
#pragma once

#include <optional>
#include <set>
#include <span>
#include <tuple>
#include <vector>

#include "ribvault/exact/point_location.hpp"
#include "ribvault/print/gap_patches.hpp"
#include "ribvault/print/judge_print.hpp"
#include "ribvault/print/lay_patches.hpp"
#include "ribvault/print/place_dot.hpp"

namespace ribvault {

/// The track as a lane, on the lattice.
Lane lane_of(const PrintedTrack& track);

/// A stretch of a track of the layer above that is not held up.
struct HangingTrack {
    const PrintedTrack* track = nullptr;
    OpenStretch stretch;
    bool over_gap = false, inside = false, on_supports = false;  ///< of the part that was judged (PrintPart)
    Segment place() const { return place_of(*track, stretch); }
    HangingStretch stretch_of_lane() const;
};

/// All of it proposes; the print is judged afterwards. Deterministic.
class PrintPatches {
public:
    /// `plan`: the layer without patches. `beside`: what lies outside the slice, nullptr where no support may stand
    /// there; with a removal gap it says where walls may (GapPatches). `walls_below_gap`: the same under the gap of
    /// layers. `object_over_gap`: what holds up with the patches what hangs over the gap. All but the plan must outlive
    /// the object.
    PrintPatches(LayerPlan plan, const Cavity* beside, const Region* walls_below_gap,
                 std::span<const PrintedTrack> object_over_gap, const Settings& settings);
    PrintPatches(const PrintPatches&) = delete;
    PrintPatches& operator=(const PrintPatches&) = delete;

    /// Patches under what hangs; `late`: dots near the tracks have been tried in vain.
    void add(const std::vector<HangingTrack>& open, bool late);
    /// With a gap of layers: patches of the object under what hangs outside within reach of the slice. Precondition:
    /// `beside` has walls.
    void add_to_object(const std::vector<HangingTrack>& open);

    const LayerPlan& plan() const { return plan_; }
    const std::vector<Patch>& patches() const { return patches_; }
    /// Lays all patches in a copy of plan(). How much track they add, lattice units; dots count as none.
    Unit lay(LayerPlan& plan) const;

private:
    std::vector<HangingTrack> farthest_first(const std::vector<HangingTrack>& open) const;
    Point nearest_material(Point p, std::size_t patches) const;
    std::vector<Lane> material_near(const Segment& stretch, Unit wider = 0, bool of_supports = false) const;
    std::optional<PlacedDot> place(const HangingTrack& hanging) const;
    bool hangs_inside(const HangingTrack& hanging) const;
    bool needs_support(const HangingTrack& hanging) const;
    void add_support(const HangingTrack& hanging, bool late);
    Point towards_support(Point p, Unit by) const;
    std::vector<Lane> material_under(const HangingTrack& hanging) const;
    bool patch_at_gap(const HangingTrack& hanging, bool again);
    void drop_repeated(std::size_t before);
    std::optional<Segment> place_under(const HangingTrack& hanging, bool late, std::size_t before);
    bool held_since(std::size_t before, const Segment& s) const;
    Segment lowered(const Segment& s, std::size_t before) const;
    Unit step() const { return settings_.support_radius - 2; }
    bool may_stand_outside(const Segment& s) const;

    const LayerPlan plan_;
    const PlanTracks tracks_;
    const PointLocation outline_;
    const Cavity* beside_;
    const std::span<const PrintedTrack> object_over_gap_;
    const Settings& settings_;
    std::vector<Patch> patches_;
    std::set<std::tuple<TrackKind, Point, Point>> laid_;  ///< patches_
    std::vector<Point> tried_;
    NearestSegment supports_;                ///< of the plan's tracks the external supports, with a removal gap
    std::optional<GapPatches> gap_patches_;  ///< with a removal gap
};

}  // namespace ribvault
