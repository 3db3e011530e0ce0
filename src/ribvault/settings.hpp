// All settings of a run in one struct, checked once at the edge and passed whole.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>

#include "ribvault/exact/lattice.hpp"

namespace ribvault {

/// How supports propagate from layer to layer.
enum class Propagation {
    erode_straighten,  ///< Section 4.1: tips are eroded, chains straightened
    shrink             ///< a descent of the supports' whole length under the same limit (vault/shrink_supports.hpp)
};
/// Which unsupported point is next (Section 4.3); ties at random by the seed.
enum class Order {
    distance,  ///< the nearest to B_i
    doubling   ///< the nearest by its distance to B_i rounded down to ρ, 2ρ, 4ρ, ...: at random within such a band
};

/// Where equation (4)'s bonus counts a quarter only.
enum class QuarterBonus {
    nowhere,
    narrow,  ///< where what is unsupported is narrow: no disc of radius 3/4 of a support's width has room in its piece
    everywhere
};

/// What becomes of the gaps of Section 4.4, in which a branch stops one track width short of its junction.
enum class Gaps {
    proved,  ///< they stay where the print is supported with them (print/hold_print.hpp)
    paper,   ///< all of them; what then hangs is reported
    none     ///< none
};

/// Where supports stand.
enum class Support {
    internal,  ///< in the cavities of a hollow object
    external,  ///< outside a solid object (Section 6)
    both       ///< in the cavities and outside
};

/// What decides the geometry. Lengths in lattice units (10 nm); symbols are the paper's.
struct Settings {
    Unit layer_height = 20000;        ///< h
    Unit first_layer_height = 20000;  ///< height of layer 0
    Unit nozzle = 40000;              ///< d = 2r, the width of tracks
    /// Of the supports' tracks, d / 2 to d; d by default, as in the paper. No more: what is wider than 2 ρ would not
    /// vanish into the shell, which holds up no more than ρ beyond its edge.
    Unit support_width = 40000;
    Unit support_radius = 20000;      ///< ρ of equation (2); r by default (50 % overlap)
    int perimeters = 1;               ///< p
    int top_layers = 1;               ///< k above a layer
    int bottom_layers = 1;            ///< k below a layer

    Propagation propagation = Propagation::erode_straighten;
    Order order = Order::distance;
    Gaps gaps = Gaps::proved;
    Support support = Support::internal;
    /// Removal gap g in plane: no external track's edge comes nearer to the object. With 0 external walls may be rooted
    /// on it.
    Unit support_gap = 0;
    int support_gap_layers = 0;   ///< so many layers between an external support and what it holds up are left empty
    bool bed_only = false;  ///< external supports stand on the bed, nowhere on the object (pipeline/outside_room.hpp)
    /// Track that is left of a tree that stands free, on every layer down to what it stands on.
    Unit pillar_length = 400000;
    bool pillars = false;  ///< trees stand free where that takes less track down to the bed, in cavities too
                           ///< (vault/free_trees.hpp)
    /// A tree that stands free in a cavity and leans (Propagation::shrink; vault/lean_trees.hpp) keeps so much track,
    /// and no less than its height over the ratio.
    Unit leaning_length = 100000;
    int leaning_ratio = 10;
    bool trim = false;  ///< new walls end as early as what they are there for allows (vault/trim_walls.hpp)

    Unit erosion_step = 20000;     ///< how much a free tip loses per layer (Section 4.1); at most ρ keeps equation (1)
    bool straighten = true;        ///< Section 4.1, straightening operator
    Unit straighten_step = 20000;  ///< how far a vertex moves per layer
    bool branch_bonus = true;      ///< equation (4)
    Unit branch_bonus_length = 80000;  ///< 4r
    QuarterBonus quarter_bonus = QuarterBonus::nowhere;
    bool choose_bonus = false;  ///< quarter_bonus is what takes least (pipeline/choose_supports.hpp)
    int tries = 1;              ///< so many seeds from `seed` on are tried; the one that takes the least is used
    bool length_bound = false;  ///< the report gives a lower bound on the supports' length (vault/length_bound.hpp)
    int valence_limit = 4;             ///< the bonus counts for valence 1 .. valence_limit - 1
    std::uint64_t seed = 1;            ///< ties of Section 4.3

    int wall_lines = 1;                ///< tracks side by side in walls that are longer or taller than the next two
    Unit wall_lines_longer = 1000000;  ///< from the root to the farthest tip
    Unit wall_lines_taller = 1000000;  ///< what of the wall stands on this layer
    /// Trees that reach farther from their only root get a second one (vault/brace_trees.hpp); 0: none.
    Unit brace = 0;

    /// First pass of detection: spacing of the candidate points, d / 4. The paper's pixel is 0.05 mm; what lies between
    /// the points is found exactly by the second pass whatever the pitch, and 0.1 mm needs less material on the cube
    /// and the low poly bunny, as much on the kitten, more on the moai.
    Unit sampling_pitch = 10000;
    Unit slack = 100;  ///< the generator covers with radius r + ρ - slack, so that the proof seldom meets a tie
    Unit max_gap = 5000;         ///< open contours are closed over gaps up to this length

    /// r: half the width of the supports.
    Unit half_width() const { return support_width / 2; }
    /// r + ρ: how far from its middle a support holds up what lies on it.
    Unit reach_of_support() const { return half_width() + support_radius; }
    /// g + r: how near to the object the middle of a support outside may come.
    Unit standoff() const { return support_gap + half_width(); }
    bool inside() const { return support != Support::external; }
    /// Do external supports keep off the object, so that none is rooted on it?
    bool stands_off() const { return support_gap > 0 || support_gap_layers > 0 || bed_only; }
    /// With external supports, how far from O_i the object counts as held up: where they stand off, no track may come
    /// nearer than g + r.
    Unit reach_of_object() const { return stands_off() ? std::max(standoff(), support_radius) : support_radius; }
    /// Is what lies outside the outline of the layer below held up otherwise than what lies inside: by the object from
    /// farther off, or through a gap of layers?
    bool outside_apart() const { return outside() && (support_gap_layers > 0 || reach_of_object() > support_radius); }
    bool outside() const { return support != Support::internal; }
    Unit height_of(int layer) const { return layer == 0 ? first_layer_height : layer_height; }
    /// z of layer's upper side, over the bed.
    Unit top_of(int layer) const { return first_layer_height + layer * layer_height; }

    /// Throws Error (usage) naming the first setting that cannot be, and what it may be.
    void check() const;
};

/// Limits of a machine; axes in the order x, y, z, e. The defaults are those that PrusaSlicer 2.5 assumes for Marlin.
struct MotionLimits {
    std::array<double, 4> speed{500, 500, 12, 120};              ///< mm/s
    std::array<double, 4> acceleration{9000, 9000, 500, 10000};  ///< mm/s²
    std::array<double, 4> jerk{10, 10, 0.2, 2.5};                ///< mm/s: a change of speed that needs no time
    double print_acceleration = 1500;                            ///< mm/s², moves that extrude
    double retract_acceleration = 1500;                          ///< of the filament alone
    double travel_acceleration = 1500;
};

/// Whose G-code a printer understands, where they differ: limits of motion, heating, the first lines of a file.
enum class Flavour { marlin, klipper, reprapfirmware };

/// What decides the G-code but no geometry that is proved.
struct PrinterSettings {
    std::string name = "generic";     ///< of the profile
    Flavour flavour = Flavour::marlin;
    double filament_diameter = 1.75;  ///< mm
    int nozzle_temperature = 205;     ///< °C
    int bed_temperature = 60;         ///< °C; 0: not heated
    int first_layer_temperature = 0;  ///< °C, of the nozzle on layer 0; 0: as nozzle_temperature
    int first_layer_bed_temperature = 0;  ///< °C; 0: as bed_temperature
    int support_extruder = 0;         ///< the tool (T0, T1, ...) of external supports; all else is printed by T0
    int support_temperature = 0;      ///< °C, of that tool; 0: as nozzle_temperature
    double fan_percent = 100;         ///< from the second layer on
    double print_speed = 40;          ///< mm/s, perimeters and covers
    double support_speed = 60;        ///< mm/s
    double first_layer_speed = 20;    ///< mm/s
    double min_layer_time = 5;        ///< s: a layer that would take less is printed slower, so that it sets
    double min_print_speed = 10;      ///< mm/s: but not slower than this for that reason
    double travel_speed = 150;        ///< mm/s
    double retraction = 3;            ///< mm of filament
    double retraction_speed = 40;     ///< mm/s
    double retract_over = 30;         ///< mm: a travel with at most so much open air under it does not retract
    double longest_detour = 20;       ///< mm that a travel may be longer than straight to stay inside the shell
    double prime_surplus = 0.05;      ///< Section 5.1: share of the retraction pushed in addition before a support path
    double surplus_clearance = 1.0;   ///< mm: no surplus when a support path starts nearer to a perimeter
    double bed_x = 250, bed_y = 250, bed_z = 250;  ///< mm
    bool round_bed = false;           ///< a disc of diameter bed_x
    /// Mm: x and y of the front left corner of the bed, or of the square around it.
    std::array<double, 2> bed_corner{};
    /// X = y = 0 is the middle of the bed, as on most deltas; bed_corner does not count then.
    bool origin_at_centre = false;
    MotionLimits limits;              ///< for the time estimate, and written into the file when `write_limits`
    bool write_limits = false;
    std::string file_header;          ///< the very first lines of the file
    std::string start_gcode = "G28 ; home\n";
    std::string end_gcode = "G90\nG0 Z{park_z} F600 ; off the print\n";
    std::string thumbnails = "220x124";  ///< sizes of pictures in the file, W x H, separated by commas; empty: none

    std::array<double, 2> corner_of_bed() const {
        return origin_at_centre ? std::array<double, 2>{-bed_x / 2, -bed_y / 2} : bed_corner;
    }
    int nozzle_temperature_on(int layer) const {
        return layer == 0 && first_layer_temperature > 0 ? first_layer_temperature : nozzle_temperature;
    }
    int bed_temperature_on(int layer) const {
        return layer == 0 && first_layer_bed_temperature > 0 ? first_layer_bed_temperature : bed_temperature;
    }
};

}  // namespace ribvault
