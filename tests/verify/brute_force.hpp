// Equation (2) by branch and bound on distances, in doubles: slow, and independent of everything in
// src/ribvault/verify. M lies in K = {f <= 0} exactly when max f over M <= 0, and f and the distance to M are Lipschitz
// with constant 1.
#pragma once

#include "layers.hpp"

namespace ribvault::test {

enum class Truth {
    supported,
    unsupported,
    tie,  ///< the maximum is 0 within 1e-9 of the scale: supported, as discs are closed and small inputs keep apart
    open  ///< the budget ended between the two
};

/// X_int of docs/verifier.md. `scale`: the length whose multiples the input's coordinates are.
Truth brute_force_internal(const Layer& upper, const Layer& lower, const Settings& settings, double scale);
/// X_ext.
Truth brute_force_external(const Layer& upper, const Layer& lower, const Settings& settings, double scale);

}  // namespace ribvault::test
