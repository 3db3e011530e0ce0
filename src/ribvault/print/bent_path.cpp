#include "ribvault/print/bent_path.hpp"

#include <algorithm>
#include <cmath>

namespace ribvault {
namespace {

Point point_at(const PathCorners& corners, double along) {
    const auto next = std::lower_bound(corners.along.begin(), corners.along.end(), along);
    if (next == corners.along.end()) return corners.at.back();
    const auto k = static_cast<std::size_t>(next - corners.along.begin());
    if (*next == along || k == 0) return corners.at[k];
    const double before = corners.along[k - 1];
    return part_way(corners.at[k - 1], corners.at[k], (along - before) / (*next - before));
}

/// In the order in which one meets them going from a to b.
void sort_along(std::vector<Point>& tips, Point a, Point b) {
    const auto along = [&](Point p) { return (p.x - a.x) * (b.x - a.x) + (p.y - a.y) * (b.y - a.y); };
    std::sort(tips.begin(), tips.end(),
              [&](Point p, Point q) { return along(p) != along(q) ? along(p) < along(q) : p < q; });
}

}  // namespace

std::vector<Bend> bends_of(const PathCorners& corners, double gap, const std::vector<SideBranches>& beside,
                           double least, double most) {
    std::vector<Bend> bends;
    for (std::size_t k = 0; k < beside.size(); ++k) {
        const SideBranches& here = beside[k];
        if (here.tips.empty()) continue;
        const auto room_to = [&](const SideBranches& other) {
            return std::abs(other.along - here.along) / (other.tips.empty() ? 1 : 2);
        };
        const double wanted = std::clamp(here.longest, least, most);
        double before = std::min(wanted, here.along - gap), after = std::min(wanted, corners.along.back() - here.along);
        if (k > 0) before = std::min(before, room_to(beside[k - 1]));
        if (k + 1 < beside.size()) after = std::min(after, room_to(beside[k + 1]));
        if (std::min(before, after) < wanted / 2) continue;
        bends.push_back({k, here.along - before, here.along + after, here.tips});
        sort_along(bends.back().tips, point_at(corners, bends.back().from), point_at(corners, bends.back().to));
    }
    return bends;
}

std::vector<Point> bent_path(const PathCorners& corners, double gap, const std::vector<Bend>& bends) {
    std::vector<Point> points;
    const auto go_to = [&](Point p) {
        if (points.empty() || points.back() != p) points.push_back(p);
    };
    const auto follow = [&](double from, double to) {
        go_to(point_at(corners, from));
        const auto after = std::upper_bound(corners.along.begin(), corners.along.end(), from);
        for (auto k = static_cast<std::size_t>(after - corners.along.begin()); k < corners.at.size(); ++k) {
            if (corners.along[k] >= to) break;
            go_to(corners.at[k]);
        }
        go_to(point_at(corners, to));
    };
    double from = gap;
    for (const Bend& bend : bends) {
        follow(from, bend.from);
        std::for_each(bend.tips.begin(), bend.tips.end(), go_to);
        from = bend.to;
    }
    follow(from, corners.along.back());
    return points;
}

}  // namespace ribvault
