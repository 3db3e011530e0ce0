// Equation (2) for one pair of layers, decided exactly.
#pragma once

#include <vector>

#include "ribvault/exact/lattice.hpp"
#include "ribvault/settings.hpp"
#include "ribvault/verify/verdict.hpp"

namespace ribvault {

struct ExactPolygons;  // slice/exact_polygons.hpp

/// One layer as the verifier sees it. It does not own what it points to.
struct LayerGeometry {
    const ExactPolygons* outline = nullptr;  ///< O_i, exact, mm; regularised polygons (no two share an edge)
    const Region* cavity = nullptr;          ///< C_i, lattice; its interior is the empty inside. May be empty, not null
    std::vector<Segment> tracks;             ///< S_i: centre lines, lattice; a point is a segment with equal ends
};

/// Decides BS_{i+1} inside (BS_i)^{ρ↑} (MODEL, equation (2)) for `upper` = layer i + 1 over `lower` = layer i, with
/// ρ = settings.support_radius and r = settings.half_width(), half the width of the tracks S_i. No sampling and no
/// tolerance: "supported" is a proof, and every "unsupported" names a point (docs/verifier.md has the argument). What
/// hangs outside O_i by more than ρ is `external` and does not make `supported` false, unless settings.outside(): then
/// tracks hold it up as well as what is inside, and what they do not is not supported. With a removal gap g "supported"
/// says that every point outside O_i is within r + ρ of a track or within settings.reach_of_object() = max(ρ, g + r) of
/// O_i: no track may stand nearer.
/// `external` is all the same what is farther than ρ, unless something is farther than that reach: then it is what is.
/// Everything else that is not held up is `internal`. A cavity whose contours cross, or that is not in the interior of
/// its slice, gives `malformed` and not supported.
///
/// Precondition: the pointers are valid, ρ > 0, support_width > 0 and even, lattice points within lattice_bound. Throws
/// Error (usage) otherwise.
/// May be called from several threads at once on shared input.
///
///     LayerGeometry below{slices[i].exact.get(), &cavities[i], centre_lines(forests[i])};
///     LayerGeometry above{slices[i + 1].exact.get(), &cavities[i + 1], centre_lines(forests[i + 1])};
///     const LayerVerdict verdict = verify_layer(i + 1, above, below, settings);
///     if (!verdict.supported && verdict.internal) report(verdict.internal->witness);
LayerVerdict verify_layer(int upper_layer, const LayerGeometry& upper, const LayerGeometry& lower,
                          const Settings& settings);

}  // namespace ribvault
