// Bridges: straight spans over air between two ends that are held up.
#pragma once

#include <cstddef>
#include <vector>

#include "ribvault/verify/verify_printed.hpp"

namespace ribvault {

/// One span: consecutive pieces of `verdict.pieces`, of one path.
struct Bridge {
    std::vector<std::size_t> pieces;  ///< indices into PrintedVerdict::pieces
    double length_mm = 0;             ///< along the path, rounded up
};

/// The pieces that violate equation (1), joined over the joints of a path, which are a bridge: no longer than `longest`
/// mm (exactly where lengths are rational; an irrational one within 2^-180 of the limit counts as longer), straight to
/// within 0.01 mm, and on both sides the path goes on with material that is held up. `continues` says of each track of
/// `upper` whether it starts where the one before it ended, without a travel; a path's free end bridges nothing.
std::vector<Bridge> find_bridges(const PrintedLayer& upper, const std::vector<char>& continues,
                                 const std::vector<char>& judged, const PrintedVerdict& verdict,
                                 const Rational& longest);

/// What is left of the tracks above when bridges are taken out, each with one track width at both its ends.
PrintedLayer take_out_bridges(const PrintedLayer& upper, const std::vector<char>& continues,
                              const PrintedVerdict& verdict, const std::vector<Bridge>& bridges);

}  // namespace ribvault
