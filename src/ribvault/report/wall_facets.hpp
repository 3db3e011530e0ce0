// How append_walls() lays out its facets; the writers of other formats rely on it.
#pragma once

#include <cstddef>

namespace ribvault {

inline constexpr std::size_t stl_facet_bytes = 50;  ///< normal, three corners, two bytes that mean nothing
inline constexpr std::size_t facets_per_wall = 20;  ///< a six-sided prism: 12 on its sides, 4 above, 4 below
inline constexpr std::size_t corners_per_wall = 12;

}  // namespace ribvault
