#include "ribvault/pipeline/kept_supports.hpp"

#include "ribvault/pipeline/packed_values.hpp"

namespace ribvault {
namespace {

struct PackedEdge {
    std::uint64_t a, b;
    SupportEdge edge;
};

}  // namespace

std::string packed_supports(const LayerSupports& supports) {
    std::vector<SupportVertex> all;
    std::vector<PackedEdge> walls;
    const SupportForest& forest = supports.forest;
    for (auto [v, end] = vertices(forest); v != end; ++v) all.push_back(forest[*v]);
    for (auto [e, end] = edges(forest); e != end; ++e)
        walls.push_back({source(*e, forest), target(*e, forest), forest[*e]});
    std::string bytes;
    pack(bytes, all);
    pack(bytes, walls);
    pack(bytes, supports.unsupported);
    pack(bytes, std::vector<int>{supports.blocked, supports.braces});
    return bytes;
}

LayerSupports unpacked_supports(const std::string& bytes) {
    LayerSupports supports;
    std::vector<SupportVertex> all;
    std::vector<PackedEdge> walls;
    std::vector<int> counts;
    std::string_view rest = bytes;
    unpack(rest, all);
    unpack(rest, walls);
    unpack(rest, supports.unsupported);
    unpack(rest, counts);
    for (const SupportVertex& vertex : all) add_vertex(vertex, supports.forest);
    for (const PackedEdge& wall : walls) add_edge(wall.a, wall.b, wall.edge, supports.forest);
    supports.blocked = counts[0], supports.braces = counts[1];
    return supports;
}

}  // namespace ribvault
