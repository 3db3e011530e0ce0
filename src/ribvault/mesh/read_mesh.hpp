// A mesh file in any of the usual formats as welded triangles.
#pragma once

#include <filesystem>

#include "ribvault/mesh/mesh.hpp"

namespace ribvault {

/// Reads STL (binary, ASCII, binary whose header says "solid"), OBJ, OFF, PLY (ASCII, binary of either byte order) or
/// 3MF (every build item, in millimetres). The format is told by the content, and by the extension where that does not
/// decide.
///
/// Vertices with exactly equal coordinates are one (-0 counts as 0), unused ones are gone, a polygon is the fan from
/// its first corner (for a plane polygon, convex or not, slices by winding number do not see the difference),
/// triangles with two equal corners are dropped and counted. Binary coordinates are exact; decimals become the nearest
/// double. 3MF transforms and units other than millimetres are evaluated in doubles.
///
/// Throws Error, unreadable: missing, empty, truncated, in no known format, an index out of range; bad_geometry: a
/// coordinate that is not finite, no triangles, all points in one plane x, y or z = constant. The message names the
/// file and the line, byte or triangle. Memory stays proportional to the file's size, whatever counts it declares (3MF
/// instances: to what they expand to, at most 100 million triangles).
Mesh read_mesh(const std::filesystem::path& file);

}  // namespace ribvault
