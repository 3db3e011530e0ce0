// Extrusions gathered into layers by their heights.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "ribvault/print/gcode_heights.hpp"

namespace ribvault {

/// An extrusion as it stands in the file.
struct Extrusion {
    std::array<Decimal, 3> from, to;     ///< mm on the bed; equal: a dot
    double length_mm = 0;                ///< along it; 0 for a dot
    double pushed = 0;                   ///< mm of filament, or mm³
    bool volumetric = false;
    bool chord = false;
    int tool = 0;
    std::uint16_t feature = 0;
    std::optional<std::int64_t> width;   ///< 1e-9 mm, where the file says it
    std::optional<std::int64_t> height;  ///< 1e-9 mm, where the file says it
    double pushed_step = 0, length_step = 0;  ///< the last decimals that the file writes of E and of places
    int over_raft = 0;                   ///< 1: of the first layer over a raft, 2: of the second
    std::uint32_t line = 0;
};

/// Layers come from where material is pushed out, not from comments: all level extrusions at one z are a layer, in
/// whatever order the file has them (objects printed one after the other share layers). Z-hops push nothing and are
/// none.
///
/// A path that climbs while it extrudes (a spiral vase, a seam that ramps up) belongs to the layer of level extrusions
/// that it climbs to; where that is more than one height over the last, layers of one height are counted on from the
/// last, and what is left belongs to it. A path that as a whole climbs no more than 0.005 mm over a layer belongs to
/// that one.
class LayerCollector {
public:
    void extrude(const Extrusion& e);
    /// A travel: what comes next is another path.
    void end_path();
    /// All so far was start G-code. Its length, mm.
    double set_aside();
    bool empty() const { return groups_.empty() && over_raft_.empty() && climbing_.empty(); }

    /// The layers by z and height, their widths, what is below each. The collector is empty afterwards.
    ///
    /// The first layer over a raft is printed higher than the rest stands over it, which presses it down (CuraEngine's
    /// "Initial Layer Z Overlap"): where the file says no heights, its top is one layer below the second's, when that
    /// moves it by no more than 0.3 mm. Heights: see resolve_heights. Widths that the file does not say: pushed volume
    /// over length times height, the rectangle of the same cross-section, to 1 µm: narrower than the round-edged track
    /// that is printed by 0.21 times the height. Volumes of stretches below 0.25 mm are pooled where they may be
    /// equally wide for what the file rounds, with what comes after or, at the end of a path, before. A width has as
    /// few decimals as may be for what E is rounded by. Where a climb ends less than a layer over the last turn, its
    /// height is the mean of both.
    ///
    /// A path shorter than a quarter of the disc of its volume, which does not begin or end on another track, is a dot
    /// drawn out a little: what lies on it finds that disc, which is less than the rectangle. It must itself be held up
    /// as wide as the rectangle where a nozzle lays so wide a track (hints.widest_track). What is wider than this is no
    /// wider than the disc, and holds up what one of the widest does.
    void finish(GcodePrint& print, const LayerHints& hints);

private:
    struct Flow {
        double length = 0, pushed = 0;
        float step = 0;  ///< of the last decimal of `pushed`
        std::uint32_t path = 0;
        std::optional<std::int64_t> height;  ///< 1e-9 mm, where it is not the layer's
        int tool = 0;
        std::uint16_t feature = 0;
        bool volumetric = false;
        bool with_previous = false;  ///< the end of a path, pooled with the flow before
    };
    struct Climb {
        Extrusion extrusion;
        std::int64_t width;   ///< or minus its flow's number, see width_of
        bool continues;
        std::uint64_t path;
    };

    std::int64_t width_of(const Extrusion& e);
    void close_flow();
    bool is_whole_path(std::size_t flow) const;
    static bool may_be_as_wide(const Flow& a, const Flow& b, double length_step);
    void file(GcodeLayer& layer, const Extrusion& e, std::int64_t width, bool continues);
    GcodeLayer& group(const Extrusion& e);
    void file_level_end();
    void press_on_raft(const LayerHints& hints);
    void file_climbs(const LayerHints& hints);
    void resolve_widths(GcodePrint& print, GcodeLayer& layer, const LayerHints& hints) const;

    LayerGroups groups_;
    LayerGroups over_raft_;                   ///< of the first layer over a raft
    std::optional<Int128> second_over_raft_;  ///< the lowest top of the layer over that
    GcodeLayer* last_group_ = nullptr;
    LayerKey last_key_{0, -1};
    bool last_over_raft_ = false;
    std::vector<Climb> climbing_;
    std::size_t level_from_ = 0;     ///< climbing_ from here on is level: known only when the path climbs on or ends
    bool climbed_ = false;           ///< in this path
    std::uint64_t paths_ = 0;  ///< that have ended
    bool in_path_ = false;
    std::vector<Flow> flows_;
    bool flow_open_ = false;
    double length_step_ = 0;  ///< mm; of the last decimal of places
};

/// The rule for `below` (1e-9 mm throughout; all heights are positive). An entry with top z and height h has its bottom
/// at z - h. Directly below are all entries whose top is at that bottom, to within 0.005 mm (slicers round), and those
/// that reach past it but not to z (layers of other heights in between: supports, combined infill). Where there is
/// none, the nearest below counts unless a whole layer of air is between (`under_air`, `air_layers`); below the lowest
/// layer, and below every entry whose bottom is no higher than the lowest's, is the bed.
void find_layers_below(std::vector<GcodeLayer>& layers);

}  // namespace ribvault
