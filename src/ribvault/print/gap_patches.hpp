// Patches beside a removal gap: what belongs to the object keeps within its slice and off the supports, what belongs to
// these keeps off the object.
#pragma once

#include <optional>
#include <vector>

#include "ribvault/exact/nearest_segment.hpp"
#include "ribvault/exact/point_location.hpp"
#include "ribvault/print/lay_patches.hpp"
#include "ribvault/print/place_dot.hpp"
#include "ribvault/settings.hpp"
#include "ribvault/slice/cavity.hpp"

namespace ribvault {

/// Adds to a layer's patches. All of it proposes; the print is judged afterwards.
class GapPatches {
public:
    /// `beside`: what lies outside the slice, with `beside.walls`, where supports may stand. `walls_below_gap`: the
    /// same under the gap of layers (print/hold_print.hpp). `tracks` are those of `plan`, without patches. All must
    /// outlive the object.
    GapPatches(const Cavity& beside, const Region* walls_below_gap, const LayerPlan& plan, const PlanTracks& tracks,
               std::vector<Patch>& patches, const Settings& settings);

    /// May a support's patch lie there: where walls may, and off the object's patches?
    bool may_stand(const Segment& s) const;

    /// Does a centre line of the object's nowhere leave its slice, so that its track stands out by no more than r?
    bool runs_in_object(const Segment& s) const;

    /// Under a stretch that hangs: the object's edge, where it is not printed (but for its corners) and so fails to
    /// hold up what it should; else a support where one may stand. `again`: that has not helped, and the object is
    /// printed at its very edge, though that stands into the gap. Says no when nothing can be done so.
    bool add(const Segment& hanging, bool again);

    /// Where walls must keep off what is right under a stretch: patches at the nearest places where they need not, as
    /// far as these can hold up all that a track over there would: within ρ. Says no when none can.
    bool add_support(const Segment& hanging);

    /// The place nearest to p where walls may run, if within reach. Else `beyond` is by how much every such place is
    /// farther than that: what is less than so far from p has none either.
    std::optional<Point> place_for_wall(Point p, Unit reach, double* beyond = nullptr) const;

    /// Supports where they may stand and hold up what hangs, its rim included, though they cannot hold up the whole
    /// stretch. `material`: what is there and may hold it up, as wide as it counts.
    bool add_under_rim(const HangingStretch& hanging, const std::vector<Lane>& material);

    /// With a gap of layers, under what hangs over the object: the object's, where that is within reach of the slice's
    /// edge. Not where the edge is printed and only a rounded corner lets something hang that supports farther down can
    /// hold up.
    void add_to_object(const Segment& hanging);

private:
    /// A region with what it takes to look things up in it.
    struct Place {
        explicit Place(const Region& region) : Place(region, edges_of(region)) {}
        Place(const Region& region, std::vector<Segment> edges)
            : edges(std::move(edges)), location(edges_of(region), units_per_mm) {}
        const Segment& nearest_edge(Point p) const { return edges.segments()[edges.nearest(p).index]; }
        bool holds(Point p) const { return location.locate(p) == Side::inside; }
        NearestSegment edges;
        PointLocation location;
    };
    /// The edge of the slice next to a point, and from there the way into the slice.
    struct Edge {
        Point foot, inwards;
        Point shifted(Unit by) const;  ///< the foot, so far inwards
    };

    Unit apart() const { return settings_.support_gap + settings_.support_width; }
    bool in_air(Point p) const { return air_.holds(p); }
    Edge edge_beside(Point p) const;
    double room_around(const Segment& patch) const;
    bool keeps_off_supports(const Segment& patch) const { return room_around(patch) >= static_cast<double>(apart()); }
    bool is_within(Point p, Unit depth) const;
    Point nearest_of_slice(Point p) const;
    Point place_in_object(Point p) const;
    bool is_printed(Point p, Unit beyond) const;
    bool supports_reach_rim(Point p) const;
    void add_along_slice(const Segment& s, int depth);
    bool add_object(const Segment& hanging, Unit reach, bool at_edge = false);

    const LayerPlan& plan_;
    const PlanTracks& tracks_;
    std::vector<Patch>& patches_;
    const Settings& settings_;
    Place walls_, air_;  ///< where supports may stand; what lies outside the slice, its edges the slice's
    const Region* walls_below_gap_;
    std::optional<Place> below_gap_;  ///< of it, once it is asked for
};

}  // namespace ribvault
