#include "ribvault/vault/zip_corners.hpp"

#include <algorithm>
#include <cmath>

#include "ribvault/vault/wall_contacts.hpp"

namespace ribvault {
namespace {

constexpr double zip_share = 0.9;  ///< of the shorter wall at a corner that is zipped up, at most
constexpr double wide_corner = 2 * M_PI / 3, narrow_corner = M_PI / 9;  ///< 120° and 20°

/// The walls on both sides of a corner that may be zipped up.
std::optional<std::pair<std::uint32_t, std::uint32_t>> narrowest_corner(const MovingSupports& supports, std::size_t v) {
    const MovingSupports::Node& node = supports.nodes[v];
    if (node.walls.size() < (node.root ? 2u : 3u)) return {};
    std::vector<std::pair<double, std::uint32_t>> around;
    for (const std::uint32_t w : node.walls) {
        const Vec d = vec(supports.nodes[supports.other(w, v)].at) - vec(node.at);
        around.push_back({std::atan2(d.y, d.x), w});
    }
    std::sort(around.begin(), around.end());
    double narrowest = node.root || node.walls.size() > 3 ? wide_corner : narrow_corner;
    std::size_t best = around.size();
    for (std::size_t k = 0; k < around.size(); ++k) {
        const bool last = k + 1 == around.size();
        const double angle = around[last ? 0 : k + 1].first - around[k].first + (last ? 2 * M_PI : 0);
        if (angle < narrowest) narrowest = angle, best = k;
    }
    if (best == around.size()) return {};
    return std::pair(around[best].second, around[(best + 1) % around.size()].second);
}

/// What is at a share of the way from v to the other end of a wall, before anything moved.
Point place_before(const MovingSupports& supports, std::uint32_t w, std::size_t v, double share) {
    const Segment& was = supports.walls[w].was;
    return supports.walls[w].a == v ? part_way(was.a, was.b, share) : part_way(was.b, was.a, share);
}

}  // namespace

void zip_corners(MovingSupports& supports) {
    const std::size_t n = supports.nodes.size();
    std::vector<char> zipped(supports.walls.size(), 0);  // once: its other points have moved by then
    for (std::size_t v = 0; v < n; ++v) {
        if (supports.nodes[v].gone || supports.nodes[v].stays) continue;
        const std::optional<std::pair<std::uint32_t, std::uint32_t>> corner = narrowest_corner(supports, v);
        if (!corner || zipped[corner->first] || zipped[corner->second]) continue;
        const auto [w1, w2] = *corner;
        const std::size_t a = supports.other(w1, v), b = supports.other(w2, v);
        const Vec here = vec(supports.nodes[v].at), da = vec(supports.nodes[a].at) - here,
                  db = vec(supports.nodes[b].at) - here;
        const double la = norm(da), lb = norm(db);
        if (std::min(la, lb) < 8) continue;
        // What lies as far from v on both walls meets in the middle: as far out as neither moves by more than a
        // step.
        const auto meeting = [&](double reach) {
            return rounded(here + (reach / 2) * ((1 / la) * da + (1 / lb) * db));
        };
        const auto moved = [&](double reach) {
            const Vec p = vec(meeting(reach));
            return std::max(norm(p - vec(place_before(supports, w1, v, reach / la))),
                            norm(p - vec(place_before(supports, w2, v, reach / lb))));
        };
        const double most = static_cast<double>(supports.step) - 2;
        double reach = zip_share * std::min(la, lb);
        if (moved(reach) > most) {
            double low = 0;
            for (double high = reach; high - low > 1;) {
                const double middle = (low + high) / 2;
                (moved(middle) > most ? high : low) = middle;
            }
            reach = low;
        }
        if (reach < 4) continue;
        const Point from_a = place_before(supports, w1, v, reach / la),
                    from_b = place_before(supports, w2, v, reach / lb), p = meeting(reach);
        if (p == supports.nodes[v].at || p == supports.nodes[a].at || p == supports.nodes[b].at) continue;
        const double saved = la + lb - norm(vec(supports.nodes[a].at) - vec(p)) -
                             norm(vec(supports.nodes[b].at) - vec(p)) - norm(vec(p) - here);
        if (saved <= 1) continue;
        // The corner is empty between the two walls, but another wall may reach into it.
        bool free = true;
        for (const Segment stretch :
             {Segment{p, supports.nodes[a].at}, Segment{p, supports.nodes[b].at}, Segment{supports.nodes[v].at, p}}) {
            supports.visit_walls(bounding_box(stretch), [&](std::uint32_t k) {
                if (free && supports.walls[k].alive && k != w1 && k != w2)
                    free = !collide(stretch, supports.segment(supports.walls[k]));
            });
        }
        if (!free) continue;
        const std::size_t joint = supports.nodes.size();
        SupportVertex middle = vertex_between(supports.nodes[v].was, supports.nodes[a].was, from_a);
        const SupportVertex beside = vertex_between(supports.nodes[v].was, supports.nodes[b].was, from_b);
        middle.standing = std::max(middle.standing, beside.standing), middle.wide = middle.wide || beside.wide;
        supports.nodes.push_back({p, false, {from_a, from_b}, {w1, w2}, middle});
        for (const std::uint32_t w : {w1, w2}) {
            zipped[w] = 1;
            if (supports.walls[w].origin != MovingSupports::none)
                supports.stems.push_back({supports.walls[w].origin, supports.walls.size()});
            (supports.walls[w].a == v ? supports.walls[w].a : supports.walls[w].b) = joint;
            std::erase(supports.nodes[v].walls, w);
        }
        supports.add_wall(v, joint, MovingSupports::none);
    }
}

}  // namespace ribvault
