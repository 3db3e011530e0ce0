// Everything a run has to say about itself: input, settings, every layer, the proof.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "ribvault/mesh/examine_mesh.hpp"
#include "ribvault/print/track_settings.hpp"
#include "ribvault/settings.hpp"
#include "ribvault/slice/slice_mesh.hpp"
#include "ribvault/verify/verdict.hpp"

namespace ribvault {

/// One layer as printed. docs/report-schema.md says how each number is measured.
struct LayerReport {
    int layer = 0;
    double z_mm = 0;                       ///< z_i, the plane of the slice
    double shell_area_mm2 = 0;             ///< area(B_i): perimeters and covers
    double shell_volume_mm3 = 0;           ///< its area times the layer's height
    double support_length_mm = 0;          ///< centre lines of S_i, through their junctions
    double support_length_bound_mm = 0;    ///< no internal supports here could be shorter; 0 where not asked for
    double support_printed_length_mm = 0;  ///< the same without the gaps of Section 4.4
    double support_volume_mm3 = 0;  ///< of internal supports: printed length times d times the layer's height, and dots
    double external_support_printed_length_mm = 0;  ///< of external supports alone
    double external_support_volume_mm3 = 0;
    int gaps = 0;                          ///< branches that stop short of their junction
    double perimeter_length_mm = 0;
    double cover_length_mm = 0;
    double thin_wall_length_mm = 0;  ///< tracks of their own width where the slice is narrower than one track
    int thin_places = 0;             ///< places too narrow for any track
    double thin_area_mm2 = 0;        ///< their area
    double unfilled_area_mm2 = 0;    ///< of the shell inside the perimeters, between all tracks
    double filament_mm = 0;          ///< pushed along all tracks of the layer
    double extruded_mm3 = 0;         ///< the same as volume, skirt and brim included
    double prime_surplus_mm3 = 0;    ///< Section 5.1
    int travels = 0;                 ///< the way from the layer below included
    double travel_mm = 0;
    double open_air_mm = 0;          ///< of the travels over the cavity
    int retractions = 0;
    int detours = 0;                 ///< travels that go around to stay inside the shell
    double print_seconds = 0;        ///< estimated, acceleration-limited
    int trees = 0;           ///< connected components of S_i
    int wide_trees = 0;      ///< of these, printed with several tracks side by side
    int braces = 0;          ///< walls added here that give a long tree its second root
    double slenderness = 0;  ///< greatest free height over width of its walls (vault/wall_stability.hpp)
    double slender_standing_mm = 0,
           slender_to_root_mm = 0;  ///< there: the wall's height above the layer, the way to a root
    std::array<double, 2> slender_at{0, 0};                  ///< there, mm
    LayerVerdict verdict;    ///< equation (2) for this layer over the one below; layer 0 lies on the bed
    PrintVerdict print;      ///< the same for what is extruded
    int closed_gaps = 0;  ///< branches printed up to their junction because a gap would have let something above hang
    int bends = 0;        ///< places where a support's path takes short branches along (print/bent_path.hpp)
    int patches = 0;      ///< short tracks under what open places, vanished roots and bends let hang
    bool patch_in_gap = false;  ///< an external support is nearer than the removal gap to a patch of the object, here
                                ///< or on a layer of the gap above
    double patch_length_mm = 0;
    std::vector<GapClosing> closings;
    bool slivers_removed = false;  ///< slice/slivers.hpp
    bool empty = false;  ///< nothing is printed on it but skirt and brim
};

/// Sums over the layers.
struct RunTotals {
    double shell_volume_mm3 = 0;
    double support_volume_mm3 = 0;
    double external_support_volume_mm3 = 0;
    double external_support_printed_length_mm = 0;
    double material_mm3 = 0;  ///< shell and supports
    double support_length_mm = 0;
    double support_length_bound_mm = 0;
    double support_printed_length_mm = 0;
    double perimeter_length_mm = 0;
    double cover_length_mm = 0;
    double thin_wall_length_mm = 0;
    long thin_places = 0;
    double thin_area_mm2 = 0;
    double unfilled_area_mm2 = 0;
    double filament_mm = 0;
    double extruded_mm3 = 0;
    double prime_surplus_mm3 = 0;
    long travels = 0;
    double travel_mm = 0;
    double open_air_mm = 0;
    long retractions = 0;
    long detours = 0;
    double print_seconds = 0;
    double slenderness = 0;     ///< the greatest of all layers
    int slenderest_layer = 0;   ///< the lowest layer that has it; 0 without walls
    long wide_trees = 0;
    long braces = 0;
    long gaps = 0;
    long closed_gaps = 0;
    long bends = 0;
    long patches = 0;
    double patch_length_mm = 0;
    long closings = 0;
    long layers_with_slivers_removed = 0;
};

struct ExternalOverhang {
    int layer = 0;  ///< the layer that hangs outside the one below
    double area_lo_mm2 = 0, area_hi_mm2 = 0;
};

struct VerdictSummary {
    bool proved = false;  ///< every layer is; external overhangs are not counted against it
    int layers_proved = 0;
    std::vector<int> layers_refuted;
    std::vector<ExternalOverhang> external_overhangs;
    std::vector<int> layers_with_patches_in_gap;
    StageCounts stages;
    bool print_proved = false;  ///< what is extruded satisfies (2) on every layer, inside the outline below
    std::vector<int> print_layers_refuted;
    Enclosure print_unsupported_mm, print_external_mm;  ///< of lengths of centre lines, sums over the layers
    /// Layers whose print hangs outside the outline of the print below though the slice does not hang outside the slice
    /// below: that is too narrow there for a closed perimeter. None with external supports, where all is judged.
    std::vector<int> layers_over_narrow_places;
    StageCounts print_stages;
};

/// What differs between two runs of the same job.
struct MachineFacts {
    int threads = 0;
    double seconds = 0;                           ///< the whole run, wall clock
    double peak_memory_mb = 0;                    ///< 1 MB = 1e6 bytes
    std::map<std::string, double> stage_seconds;  ///< busy time of each stage, summed over threads
};

/// One way to grow the supports, and what it takes over all layers.
struct Candidate {
    QuarterBonus quarter_bonus = QuarterBonus::nowhere;
    std::uint64_t seed = 1;
    double length_mm = 0;  ///< of all tracks
    std::size_t tips = 0;  ///< ends of walls that are no root, of a tree that stands free all but one
    double cost_mm = 0;    ///< what is compared (pipeline/choose_supports.hpp)
};

struct RunReport {
    std::string version;     ///< of the program
    std::string input_path;  ///< as the user wrote it
    MeshFacts input;
    Placement placement;
    Settings settings;
    TrackSettings tracks;
    PrinterSettings printer;
    /// Swept before the run, the one used first; empty when nothing was left to choose.
    std::vector<Candidate> candidates;
    std::vector<LayerReport> layers;
    RunTotals totals;
    VerdictSummary verdict;
    MachineFacts machine;
};

/// Puts the layers in order, from layer 0, and fills totals and verdict from them. Without layers nothing is proved.
void sum_up(RunReport& report);

/// Peak resident memory of this process so far, in MB (1e6 bytes).
double peak_memory_mb();

/// The report as JSON, schema "ribvault-run/1" (docs/report-schema.md, docs/run-report.schema.json), one line a layer.
/// Equal reports give equal text; what differs between runs of the same job stands in the last member, "machine",
/// alone. Text that is not UTF-8 (a file name) has U+FFFD in its place. Numbers that are not finite become null.
std::string to_json(const RunReport& report);

}  // namespace ribvault
