// Geometry as the data of SVG paths: mm, y downwards, three decimals at most, relative where that is shorter.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "ribvault/vault/support_forest.hpp"

namespace ribvault {

/// A number with at most three decimals and no more characters than it needs: .4, -1.25, 20.
std::string svg_number(double value);

/// Closed contours.
std::string region_data(const Region& region);

/// All tracks of a forest, one polyline per branch-free chain; an isolated vertex is a line of no length, which round
/// line ends make a disc.
std::string track_data(const SupportForest& forest);

/// The same of the trees whose vertices are `drawn`. Precondition: of a tree all are, or none.
std::string track_data(const SupportForest& forest, const std::function<bool(const SupportVertex&)>& drawn);

/// An open line through points; one point is a line of no length.
void append_line(std::string& data, const std::vector<Point>& points);

/// Appends a line of no length at a point.
void append_dot(std::string& data, Point at);

}  // namespace ribvault
