// Geometry as JSON: whole numbers of lattice units, so that a drawing sees exactly what was computed.
#pragma once

#include <nlohmann/json.hpp>

#include "ribvault/print/tool_path.hpp"
#include "run.hpp"

namespace ribvault::steps {

using Json = nlohmann::ordered_json;

/// [x, y]
Json json_of(Point p);
/// [ax, ay, bx, by] each
Json json_of(const std::vector<Segment>& segments);
/// Contours, each [x0, y0, x1, y1, ...]; outer ones counter-clockwise, holes clockwise.
Json json_of(const Region& region);
/// {"vertices": [[x, y, is root], ...], "edges": [[a, b, first layer], ...]}
Json json_of(const SupportForest& forest);
/// In printing order: {"kind", "width", "closed", "points": [x0, y0, ...]}
Json json_of(const std::vector<ToolPath>& paths);

/// The head of a result file: "schema" (`kind`/version), model, settings; coordinates and lengths are lattice units
/// unless a name ends in _mm.
Json result_head(const std::string& kind, const Options& options, const Settings& settings);

}  // namespace ribvault::steps
