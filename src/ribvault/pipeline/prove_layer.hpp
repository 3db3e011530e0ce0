// What is proved of a layer over those below it: equation (2) and, with external supports, what they stand on and hold
// up.
#pragma once

#include "ribvault/pipeline/sweep_layers.hpp"
#include "ribvault/verify/verdict.hpp"

namespace ribvault {

/// Equation (2) for `layer` over `below`, decided exactly (verify/verify_layer.hpp). With settings.bed_only also that
/// every point of its external supports lies within r + ρ of the centre line of an external support below: the object
/// holds up none of them. With settings.support_gap_layers > 0 what lies over the gap is no part of this: it is
/// prove_over_gap's. Layers are those of a sweep with the same settings.
LayerVerdict prove_layer(const LayerMaterial& layer, const LayerMaterial& below, const Settings& settings);

/// That what external supports hold up through a gap is held up: every point of layer j's shell lies within ρ
/// (settings.reach_of_object() with a removal gap) of the shell on one of the layers of the gap or on that of the
/// supports, `holding`, within r + ρ of the centre line of an external support there, or, over the cavity of layer j -
/// 1, is supported by equation (2). What is over the bed by no more than the gap is held up by that, but for what is
/// over a cavity.
LayerVerdict prove_over_gap(const OverGap& over, const LayerMaterial& holding, const Settings& settings);

/// Both hold.
void add_verdict(const LayerVerdict& more, LayerVerdict& verdict);
void add_verdict(const PrintVerdict& more, PrintVerdict& verdict);

}  // namespace ribvault
