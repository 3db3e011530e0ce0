#include "ribvault/verify/track_cover.hpp"

#include <CGAL/box_intersection_d.h>

#include <algorithm>

#include "ribvault/verify/point_signs.hpp"

namespace ribvault::verify {

namespace {

using TrackBox = CGAL::Box_intersection_d::Box_with_info_d<double, 2, int>;

TrackBox box_of(std::span<const Vertex> vertices, const Edge& e, double grow, int index) {
    const Vertex &a = vertices[e.a], &b = vertices[e.b];
    return TrackBox(CGAL::Bbox_2(std::min(a.cx, b.cx) - grow, std::min(a.cy, b.cy) - grow, std::max(a.cx, b.cx) + grow,
                                 std::max(a.cy, b.cy) + grow),
                    index);
}

}  // namespace

std::vector<Edge> uncovered_tracks(std::span<const Vertex> vertices, std::span<const Edge> above,
                                   std::span<const Edge> below, double rho, StageCounts& stages) {
    CoverProblem problem;
    problem.vertices = vertices;
    std::vector<TrackBox> upper, lower;
    for (std::size_t i = 0; i < above.size(); ++i) upper.push_back(box_of(vertices, above[i], 0, static_cast<int>(i)));
    for (std::size_t i = 0; i < below.size(); ++i)
        lower.push_back(box_of(vertices, below[i], rho, static_cast<int>(i)));
    std::vector<char> settled(above.size(), 0);
    const auto meet = [&](const TrackBox& u, const TrackBox& l) {
        if (settled[u.info()]) return;
        const Edge &track = above[u.info()], &under = below[l.info()];
        Stage stage = Stage::interval;
        for (const int end : {track.a, track.b}) {
            Located v = located(problem, {Candidate::Kind::vertex, end, 0, {}, {}, 0});
            if (side_of_stadium(v, {under.a, under.b, rho}, Stage::rational) == Side::outside) return;
            stage = std::max(stage, v.stage);
        }
        settled[u.info()] = 1;
        ++(stage == Stage::interval ? stages.interval : stages.rational);
    };
    CGAL::box_intersection_d(upper.begin(), upper.end(), lower.begin(), lower.end(), meet);
    std::vector<Edge> left;
    for (std::size_t i = 0; i < above.size(); ++i)
        if (!settled[i]) left.push_back(above[i]);
    return left;
}

}  // namespace ribvault::verify
