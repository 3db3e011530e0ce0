// The supports as solids, to look at in any viewer.
#pragma once

#include <cstdint>
#include <string>

#include "ribvault/settings.hpp"
#include "ribvault/vault/support_forest.hpp"

namespace ribvault {

/// Appends to `facets` the walls of one layer as binary STL triangles (50 bytes each): for every edge of S_i a closed
/// box as wide as the wall is printed (wall_width) along the edge, from z = bottom to top. Ends are cut square; what
/// has no length (dots) is left out. Of several tracks side by side the print leaves out what lies in the shell; the
/// boxes do not. Coordinates are the lattice's in mm, rounded once to the floats of the format.
void append_walls(const SupportForest& forest, Unit bottom, Unit top, const Settings& settings, std::string& facets);

/// The 84 bytes before `facets` triangles in a binary STL file.
std::string stl_header(std::uint32_t facets);

/// The same triangles as a 3MF package with one object (none when there are no walls), in millimetres; each wall is
/// closed by its vertex numbers, as the format asks. Precondition: `facets` comes from append_walls. Throws Error
/// (cannot_write) when it cannot be packed.
std::string walls_3mf(const std::string& facets);

}  // namespace ribvault
