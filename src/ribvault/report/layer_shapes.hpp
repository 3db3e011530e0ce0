// What one layer looks like: the geometry that layers files and run pages carry.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "ribvault/slice/slice.hpp"
#include "ribvault/vault/support_forest.hpp"

namespace ribvault {

/// Layer i in lattice units, every coordinate a whole number of micrometres: for pictures and measurements, not for
/// proofs.
struct LayerShapes {
    Region slice;                        ///< O_i
    Region cavity;                       ///< C_i; the shell B_i is slice without cavity
    std::vector<SupportVertex> vertices; ///< of S_i: place, root and wide
    std::vector<std::array<std::uint32_t, 2>> edges;  ///< of S_i: indices into vertices
    /// What of layer i + 1 detection (Section 4.2) found: all that neither the shell nor the walls copied from above
    /// hold up. Of a wall that is not held up along its whole length it is the whole track: more than needed, never
    /// less.
    Region unsupported;
    std::vector<Segment> patches;  ///< as LayerReport::patches
};

/// Rounds to 1 µm. `unsupported` may overlap itself; the result does not.
LayerShapes shapes_of(const Slice& slice, const Region& cavity, const SupportForest& forest, const Region& unsupported,
                      const std::vector<Segment>& patches);

/// The members "slice" to "patch_tracks" of a layers file's line (docs/layers-file.md), and "wide" where there are wide
/// trees, without braces; mm.
std::string shapes_json(const LayerShapes& shapes);

/// The same as bytes for the run page (report/packed.hpp), rounded to 0.01 mm.
std::string packed_shapes(const LayerShapes& shapes);

}  // namespace ribvault
