// Short tracks under what would hang, printed with the tracks that they touch rather than on their own.
#pragma once

#include <functional>
#include <vector>

#include "ribvault/exact/nearest_segment.hpp"
#include "ribvault/print/layer_plan.hpp"

namespace ribvault {

/// A short track, or a dot (both ends equal), under what would hang.
struct Patch {
    Segment segment;
    TrackKind kind = TrackKind::support;
};

/// The centre lines of a plan with the places they come from.
class PlanTracks {
public:
    struct Place {
        std::size_t track, path, step;  ///< step k leads from point k of the path to the next
    };
    explicit PlanTracks(const LayerPlan& plan);

    const NearestSegment& segments() const { return segments_; }
    Place place(std::uint32_t segment) const { return places_[segment]; }

private:
    std::vector<Place> places_;
    NearestSegment segments_;
};

/// Adds patches to `plan`, the tracks `on`. Whatever happens, the material includes the stadium of every patch and, but
/// for lattice rounding of the points at which spurs leave (0.7 units), everything that was there.
///
/// A patch that is no dot is a track of its own. A dot on the centre line of a track at least as wide needs nothing. A
/// dot costs as much material as π/4 of a width of track, and a travel. So a dot for whose kind there is a track close
/// by is joined to the nearest, in the first of these ways that is open:
/// * beyond the open end of a track, which goes on to the dot, unless the track must begin there (Entry::fixed);
/// * beside a support, which goes to the dot and back on its way (a spur);
/// * beside another track: a track of its own from there to the dot (ToolPath::on_track, unless it leaves a narrower
///   strip, where its rounded end needs filament too).
/// Where what leads to an earlier dot is nearer, it goes on to this one too.
/// Where the way is longer than a dot is worth, or leads where `open` says that tracks of its kind must not, it stays a
/// dot. Returns the length of track that the patches add, dots as none. Steps are at least shortest_step long.
Unit lay_patches(const std::vector<Patch>& patches, const PlanTracks& on, LayerPlan& plan, Unit width,
                 const std::function<bool(TrackKind, const Segment&)>& open = nullptr);

}  // namespace ribvault
