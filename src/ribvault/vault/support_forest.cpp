#include "ribvault/vault/support_forest.hpp"

#include <algorithm>

namespace ribvault {

SupportVertex vertex_between(const SupportVertex& a, const SupportVertex& b, Point at) {
    const double whole = length(b.at - a.at), share = whole > 0 ? std::min(1.0, length(at - a.at) / whole) : 0;
    const auto standing = static_cast<std::int32_t>(a.standing + share * (b.standing - a.standing));
    return {.at = at, .wide = a.wide || b.wide, .standing = standing};
}

double length(const SupportForest& forest) {
    double sum = 0;
    for (auto [e, end] = edges(forest); e != end; ++e)
        sum += length(forest[source(*e, forest)].at - forest[target(*e, forest)].at);
    return sum;
}

std::vector<Segment> centre_lines(const SupportForest& forest) {
    std::vector<Segment> lines;
    lines.reserve(num_vertices(forest));
    for (auto [e, end] = edges(forest); e != end; ++e)
        lines.push_back({forest[source(*e, forest)].at, forest[target(*e, forest)].at});
    for (auto [v, end] = vertices(forest); v != end; ++v)
        if (out_degree(*v, forest) == 0) lines.push_back({forest[*v].at, forest[*v].at});
    return lines;
}

Box bounding_box(const SupportForest& forest) {
    Box box;
    for (auto [v, end] = vertices(forest); v != end; ++v) box.add(forest[*v].at);
    if (box.empty()) box.add({0, 0});
    return box;
}

}  // namespace ribvault
