// How little track any supports could do with: a lower bound on the length of S_i, whatever the method.
#pragma once

#include <deque>

#include "ribvault/settings.hpp"
#include "ribvault/slice/cavity.hpp"

namespace ribvault {

/// Fed with the layers from the top. Let V be what of the shell of layer m lies over the cavities of all layers from m
/// - 1 down to i, farther than R = r + (m - i) ρ from each of their shells. Under equation (2) every point of V stands
/// on a chain of points, one a layer, each within ρ of the one above; none of them can lie in a shell, so the last lies
/// in area(S_i), and V lies within R of the centre lines of S_i. A tree of length l has at most 2 R l + π R² within R,
/// and the disc around its root, which lies on the shell, holds nothing of V. So the trees of S_i are together at least
/// |V| / (2 R) long. The bound is the greatest over m. It knows nothing of how walls must hang together, so it is far
/// from what can be reached where what hangs is narrow; it is 0 where all of it lies near the shell.
///
/// Regions are Clipper's, taken 3 µm smaller than they are, which is more than its rounding: not exact, but no greater
/// than the true bound. Holds for trees with a root on the shell, so for internal supports only.
class LengthBound {
public:
    /// The bound for S_i in lattice units. `cavity` is C_i; `overhang` is overhang_over_cavity(C_i, ...); `above` is
    /// C_{i+1}, nullptr at the top.
    double next(const Cavity& cavity, const Region& overhang, const Cavity* above, const Settings& settings);

private:
    struct Hanging {
        Region region;  ///< V
        int layers = 0;  ///< m - i
    };
    std::deque<Hanging> hanging_;
};

}  // namespace ribvault
