#include "result_json.hpp"

#include <filesystem>

namespace ribvault::steps {
namespace {

const char* name_of(TrackKind kind) {
    switch (kind) {
        case TrackKind::outer_perimeter: return "outer perimeter";
        case TrackKind::inner_perimeter: return "inner perimeter";
        case TrackKind::cover: return "cover";
        case TrackKind::support: return "support";
        case TrackKind::thin_wall: return "thin wall";
        case TrackKind::skirt: return "skirt";
        case TrackKind::external_support: return "external support";
    }
    return "";
}

Json flat(const std::vector<Point>& points) {
    Json list = Json::array();
    for (const Point p : points) list.push_back(p.x), list.push_back(p.y);
    return list;
}

}  // namespace

Json json_of(Point p) { return {p.x, p.y}; }

Json json_of(const std::vector<Segment>& segments) {
    Json list = Json::array();
    for (const Segment& s : segments) list.push_back({s.a.x, s.a.y, s.b.x, s.b.y});
    return list;
}

Json json_of(const Region& region) {
    Json list = Json::array();
    for (const Contour& contour : region) list.push_back(flat(contour));
    return list;
}

Json json_of(const SupportForest& forest) {
    Json points = Json::array(), walls = Json::array();
    for (auto [v, end] = vertices(forest); v != end; ++v)
        points.push_back({forest[*v].at.x, forest[*v].at.y, forest[*v].root ? 1 : 0});
    for (auto [e, end] = edges(forest); e != end; ++e)
        walls.push_back({source(*e, forest), target(*e, forest), forest[*e].first_layer ? 1 : 0});
    return {{"vertices", points}, {"edges", walls}};
}

Json json_of(const std::vector<ToolPath>& paths) {
    Json list = Json::array();
    for (const ToolPath& path : paths)
        list.push_back({{"kind", name_of(path.kind)},
                        {"width", path.width},
                        {"closed", path.closed},
                        {"points", flat(path.points)}});
    return list;
}

Json result_head(const std::string& kind, const Options& options, const Settings& s) {
    return {{"schema", "ribvault-" + kind + "/1"},
            {"model", std::filesystem::path(options.model).filename().string()},
            {"units_per_mm", units_per_mm},
            {"settings",
             {{"layer_height", s.layer_height},
              {"nozzle", s.nozzle},
              {"support_radius", s.support_radius},
              {"erosion_step", s.erosion_step},
              {"straighten_step", s.straighten_step},
              {"straighten", s.straighten},
              {"branch_bonus", s.branch_bonus ? s.branch_bonus_length : 0},
              {"valence_limit", s.valence_limit},
              {"top_layers", s.top_layers},
              {"bottom_layers", s.bottom_layers},
              {"seed", s.seed}}}};
}

}  // namespace ribvault::steps
