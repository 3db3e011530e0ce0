// Extrusions gathered into layers by their heights.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <vector>

#include "ribvault/print/gcode_print.hpp"

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
    std::uint32_t line = 0;
};

/// What is not in the file's moves, for finish().
struct LayerHints {
    std::optional<std::int64_t> layer_height, first_layer_height;  ///< 1e-9 mm
    std::optional<double> nozzle;                                  ///< diameter of the widest, mm
    std::vector<double> filaments;                                 ///< diameters, mm, at least one; one a tool
    bool volumetric = false;                                       ///< E is mm³ in all of the file
};

/// Layers come from where material is pushed out, not from comments: all level extrusions at one z are a layer, in
/// whatever order the file has them (objects printed one after the other share layers). Z-hops push nothing and are
/// none.
///
/// A path that climbs while it extrudes (a spiral vase, a seam that ramps up) belongs to the layer of level extrusions
/// that it climbs to, at most one height below it; where there is none, layers of one height are counted on from the
/// last. A path that as a whole climbs no more than 0.005 mm over a layer belongs to that one.
class LayerCollector {
public:
    void extrude(const Extrusion& e);
    /// A travel: what comes next is another path.
    void end_path();
    /// All so far was start G-code. Its length, mm.
    double set_aside();
    bool empty() const { return groups_.empty() && climbing_.empty(); }

    /// The layers by z and height, their widths, what is below each. The collector is empty afterwards.
    ///
    /// Heights: as the file says, except for bridges, which it describes as round threads, and ironing, which it
    /// describes by what it adds: theirs is their layer's. Where it does not say: the distance to the next lower layer;
    /// for the lowest one the first layer's height that the file names, else the distance to z = 0 unless that is more
    /// than 0.5 mm and two layer heights. A distance, or a height in the file that is one, of more than 1.25 times two
    /// layers or the nozzle is no height: slicers do not say that there is air. Such a layer has the height that the
    /// file or the option names, else the median of all, and air below it. When a file
    /// says no heights at all, tops up to 0.005 mm over another are one layer with it. Widths that the file does not
    /// say: pushed volume over length times height, the rectangle of the same cross-section, to 1 µm: narrower than the
    /// round-edged track that is printed by 0.21 times the height. Volumes of stretches below 0.25 mm are pooled, as E
    /// is rounded.
    void finish(GcodePrint& print, const LayerHints& hints);

private:
    struct Flow {
        double length = 0, pushed = 0;
        bool volumetric = false;
        int tool = 0;
        std::uint16_t feature = 0;
    };
    struct Key {
        Int128 z;
        std::int64_t height;  ///< 0: the file does not say
        friend auto operator<=>(const Key&, const Key&) = default;
    };
    struct Climb {
        Extrusion extrusion;
        std::int64_t width;   ///< or minus its flow's number, see width_of
        bool continues;
        std::uint64_t path;
    };
    using Groups = std::map<Key, GcodeLayer>;

    std::int64_t width_of(const Extrusion& e);
    void file(GcodeLayer& layer, const Extrusion& e, std::int64_t width, bool continues);
    GcodeLayer& group(Key key);
    void file_level_end();
    void file_climbs(const LayerHints& hints);
    void merge_rounded();
    void resolve_heights(GcodePrint& print, const LayerHints& hints);
    void resolve_widths(GcodePrint& print, GcodeLayer& layer, const LayerHints& hints) const;

    Groups groups_;
    GcodeLayer* last_group_ = nullptr;
    Key last_key_{0, -1};
    std::vector<Climb> climbing_;
    std::size_t level_from_ = 0;     ///< climbing_ from here on is level: known only when the path climbs on or ends
    bool climbed_ = false;           ///< in this path
    std::uint64_t paths_ = 0;  ///< that have ended
    bool in_path_ = false;
    std::vector<Flow> flows_;
    bool flow_open_ = false;
};

/// The rule for `below` (1e-9 mm throughout). An entry with top z and height h has its bottom at z - h. Directly below
/// are all entries whose top is at that bottom, to within 0.005 mm (slicers round), and those that reach past it but
/// not to z (layers of other heights in between: supports, combined infill). Where there is none, the nearest below
/// counts unless a whole layer of air is between (`under_air`, `air_layers`); below the lowest layer, and below every
/// entry whose bottom is no higher than the lowest's, is the bed.
void find_layers_below(std::vector<GcodeLayer>& layers);

}  // namespace ribvault
