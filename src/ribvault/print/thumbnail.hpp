// A small picture of the model in the G-code, as slicers write them.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace ribvault {

using Corner = std::array<double, 3>;  ///< x, y, z in mm

/// Sizes from text like "220x124, 16x16" (the format that PrusaSlicer may add, "/PNG", is left out);
/// "none" or nothing: no sizes. Throws Error (usage) for other text, and for sides above 1000.
std::vector<std::array<int, 2>> thumbnail_sizes(const std::string& text);

/// The triangles (three corners each) seen from the front left, from above, as PNG; transparent background.
std::string thumbnail_png(const std::vector<std::array<Corner, 3>>& triangles, int width, int height);

/// Comments `; thumbnail begin WxH N`, the PNG in base64 in lines of 78 characters (N in all), `; thumbnail end`.
std::string thumbnail_comments(const std::string& png, int width, int height);

}  // namespace ribvault
