#include "ribvault/mesh/orient_mesh.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace ribvault {

std::size_t orient_consistently(Mesh& mesh) {
    struct Side {
        std::array<int, 2> ends;
        int triangle;
        bool forward;  ///< the triangle runs from the smaller to the larger index
    };
    const int n = static_cast<int>(mesh.triangles.cols());
    std::vector<Side> sides;
    sides.reserve(3 * static_cast<std::size_t>(n));
    for (int t = 0; t < n; ++t)
        for (int k = 0; k < 3; ++k) {
            const int a = mesh.triangles(k, t), b = mesh.triangles((k + 1) % 3, t);
            sides.push_back({{std::min(a, b), std::max(a, b)}, t, a < b});
        }
    std::sort(sides.begin(), sides.end(), [](const Side& s, const Side& t) {
        return s.ends != t.ends ? s.ends < t.ends : s.triangle < t.triangle;
    });

    struct Neighbour {
        int triangle = -1;
        bool same = false;  ///< both run through the edge in the same direction, so one must be turned
    };
    std::vector<std::array<Neighbour, 3>> neighbours(static_cast<std::size_t>(n));
    std::vector<int> count(static_cast<std::size_t>(n), 0);
    const auto link = [&](int t, Neighbour other) {
        const auto index = static_cast<std::size_t>(t);
        neighbours[index][static_cast<std::size_t>(count[index]++)] = other;
    };
    for (std::size_t k = 0; k < sides.size();) {
        std::size_t end = k;
        while (end < sides.size() && sides[end].ends == sides[k].ends) ++end;
        if (end - k == 2) {
            const bool same = sides[k].forward == sides[k + 1].forward;
            link(sides[k].triangle, {sides[k + 1].triangle, same});
            link(sides[k + 1].triangle, {sides[k].triangle, same});
        }
        k = end;
    }

    std::size_t turned = 0;
    std::vector<char> seen(static_cast<std::size_t>(n), 0), turn(static_cast<std::size_t>(n), 0);
    std::vector<int> part;
    for (int first = 0; first < n; ++first) {
        if (seen[static_cast<std::size_t>(first)]) continue;
        seen[static_cast<std::size_t>(first)] = 1;
        part.assign(1, first);
        std::size_t turns = 0;
        for (std::size_t next = 0; next < part.size(); ++next) {
            const auto t = static_cast<std::size_t>(part[next]);
            for (int k = 0; k < count[t]; ++k) {
                const Neighbour& other = neighbours[t][static_cast<std::size_t>(k)];
                const auto u = static_cast<std::size_t>(other.triangle);
                if (seen[u]) continue;
                seen[u] = 1;
                turn[u] = (turn[t] != 0) != other.same;
                turns += turn[u] != 0;
                part.push_back(other.triangle);
            }
        }
        const bool majority = 2 * turns > part.size();
        for (const int t : part)
            if ((turn[static_cast<std::size_t>(t)] != 0) != majority) {
                std::swap(mesh.triangles(1, t), mesh.triangles(2, t));
                ++turned;
            }
    }
    return turned;
}

}  // namespace ribvault
