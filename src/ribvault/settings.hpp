// All settings of a run in one struct, checked once at the edge and passed whole.
#pragma once

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

/// What decides the geometry. Lengths in lattice units (10 nm); symbols are the paper's.
struct Settings {
    Unit layer_height = 20000;        ///< h
    Unit first_layer_height = 20000;  ///< height of layer 0
    Unit nozzle = 40000;              ///< d = 2r, the width of every track
    Unit support_radius = 20000;      ///< ρ of equation (2); r by default (50 % overlap)
    int perimeters = 1;               ///< p
    int top_layers = 1;               ///< k above a layer
    int bottom_layers = 1;            ///< k below a layer

    Propagation propagation = Propagation::erode_straighten;
    Order order = Order::distance;
    bool trim = false;  ///< new walls end as early as what they are there for allows (vault/trim_walls.hpp)

    Unit erosion_step = 20000;     ///< how much a free tip loses per layer (Section 4.1); at most ρ keeps equation (1)
    bool straighten = true;        ///< Section 4.1, straightening operator
    Unit straighten_step = 20000;  ///< how far a vertex moves per layer
    bool branch_bonus = true;      ///< equation (4)
    Unit branch_bonus_length = 80000;  ///< 4r
    int valence_limit = 4;             ///< the bonus counts for valence 1 .. valence_limit - 1
    std::uint64_t seed = 1;            ///< ties of Section 4.3

    /// First pass of detection: spacing of the candidate points, d / 4. The paper's pixel is 0.05 mm; what lies between the
    /// points is found exactly by the second pass whatever the pitch, and 0.1 mm needs less material on the cube and the low
    /// poly bunny, as much on the kitten, more on the moai.
    Unit sampling_pitch = 10000;
    Unit slack = 100;            ///< the generator covers with radius r + ρ - slack, so that the proof seldom meets a tie
    Unit max_gap = 5000;         ///< open contours are closed over gaps up to this length

    /// Throws Error (usage) naming the first setting that cannot be, and what it may be.
    void check() const;
};

/// What decides the G-code but no geometry that is proved.
struct PrinterSettings {
    double filament_diameter = 1.75;  ///< mm
    int nozzle_temperature = 205;     ///< °C
    int bed_temperature = 60;         ///< °C
    double print_speed = 40;          ///< mm/s, perimeters and covers
    double support_speed = 60;        ///< mm/s
    double first_layer_speed = 20;    ///< mm/s
    double travel_speed = 150;        ///< mm/s
    double retraction = 3;            ///< mm of filament
    double retraction_speed = 40;     ///< mm/s
    double retract_over = 1.5;        ///< mm: shorter travels do not retract
    double prime_surplus = 0.05;      ///< Section 5.1: share of the retraction pushed in addition before a support path
    double surplus_clearance = 1.0;   ///< mm: no surplus when a support path starts nearer to a perimeter
    double bed_x = 250, bed_y = 250, bed_z = 250;  ///< mm
};

}  // namespace ribvault
