// Thrifty strategy: roots become one, of neighbouring trees or of one tree.
#pragma once

#include <cstddef>
#include <vector>

#include "ribvault/vault/moving_supports.hpp"

namespace ribvault {

/// Roots that go towards each other along the shell (vault/root_pairs.hpp).
class RootMeetings {
public:
    /// `supports` must outlive this. Roots that can be at the same place become one, others are paired. Call it before
    /// anything else has moved but what was cut or led (vault/lean_trees.hpp).
    explicit RootMeetings(MovingSupports& supports);

    /// Is the root in v to go towards another?
    bool has(std::size_t v) const { return v < partner_.size() && partner_[v] != MovingSupports::none; }
    /// The root goes towards its partner, or both become one in the middle between them. Did it move? Precondition:
    /// has(v).
    bool approach(std::size_t v);

private:
    void pair_roots();
    /// Where the walls of a vertex lead, as the sum of unit vectors.
    Vec away_from(std::size_t v) const;
    /// The longest way from a root to the first junction or the tip.
    double trunk_of(std::size_t root) const;
    double trunk_of(std::size_t v, std::uint32_t w) const;
    /// v's root and its partner become one in the middle between them, if they may.
    bool meet(std::size_t v);

    MovingSupports& supports_;
    std::vector<std::size_t> partner_;  ///< of a root, the one it goes towards; none
};

/// Roots on the shell that have come to the same place, with walls to the same vertex, become one, and the walls one:
/// braced trees, which are not cut, would have it twice from there on.
void unite_roots_in_place(MovingSupports& supports);

}  // namespace ribvault
