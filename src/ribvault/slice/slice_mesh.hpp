// From a placed mesh to exact slices.
#pragma once

#include <cstdint>
#include <vector>

#include "ribvault/mesh/mesh.hpp"
#include "ribvault/settings.hpp"
#include "ribvault/slice/slice.hpp"

namespace ribvault {

/// One closing of an open contour, mm on the bed: from (x, y) straight over `length`.
struct GapClosing {
    int layer = 0;
    double x = 0, y = 0;
    double length = 0;
};

/// Slices a mesh at the middle planes of its layers: z_0 = h_0 / 2, z_i = h_0 + (i - 1/2) h (MODEL: O_i).
///
/// Exact: coordinates are the mesh's doubles under an exact rational placement, slice vertices the rational points
/// where mesh edges cross the plane. A vertex on the plane counts as above it, so a plane through vertices, edges or
/// faces gives the limit of the slices just below; no plane is moved. Solid is where the winding number is not zero.
/// A slice with slits or slivers up to 0.4 µm wide is the one without them (slice/slivers.hpp), on the lattice.
class Slicer {
public:
    /// Keeps a reference to the mesh. Time and memory linear in triangles and in how often planes cross them.
    Slicer(const Mesh& mesh, const Placement& placement, const Settings& settings);

    /// Layers are the planes z_i up to the top of the mesh; in the top face it is what lies just below that counts.
    int layer_count() const { return layers_; }
    /// z_i in mm, exact.
    Rational plane_height(int layer) const;

    /// O_i. Open contours are closed over gaps up to settings.max_gap, each reported in `closings`.
    /// Throws Error (bad_geometry) naming the layer and the worst places when wider gaps remain. Thread safe.
    Slice slice(int layer, std::vector<GapClosing>* closings = nullptr) const;

    /// The gaps of one layer that are wider than settings.max_gap, with their widths. Thread safe.
    std::vector<GapClosing> open_gaps(int layer) const;

private:
    struct Contours;
    Contours trace(int layer) const;

    const Mesh& mesh_;
    Placement placement_;
    Settings settings_;
    long grid_bits_ = 0;  ///< coordinates are multiples of 2^-grid_bits_
    int layers_ = 0;
    std::vector<std::int32_t> planes_below_;     ///< per vertex: how many planes lie at or below it
    std::vector<std::int32_t> edge_of_;          ///< 3 per triangle: number of the mesh edge from corner k to k + 1
    std::vector<std::array<std::int32_t, 2>> edge_ends_;
    std::vector<std::uint32_t> layer_starts_, layer_triangles_;  ///< which triangles cross each plane
};

/// Throws one Error (bad_geometry) with the number of gaps wider than settings.max_gap over all layers and the worst of
/// them. For meshes known to be open, before a run.
void require_closed_contours(const Slicer& slicer, const Settings& settings);

}  // namespace ribvault
