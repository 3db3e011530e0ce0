#include "ribvault/print/nearest_order.hpp"

#include <limits>
#include <numeric>

namespace ribvault {

std::vector<std::size_t> nearest_order(const std::vector<PathEnds>& groups, Point from) {
    std::vector<std::size_t> left(groups.size()), order;
    std::iota(left.begin(), left.end(), std::size_t{0});
    order.reserve(groups.size());
    while (!left.empty()) {
        std::size_t nearest = 0;
        Unit nearest_square = std::numeric_limits<Unit>::max();
        for (std::size_t i = 0; i < left.size(); ++i) {
            const Point d = groups[left[i]].start - from;
            const Unit square = d.x * d.x + d.y * d.y;
            if (square < nearest_square || (square == nearest_square && left[i] < left[nearest]))
                nearest = i, nearest_square = square;
        }
        order.push_back(left[nearest]);
        from = groups[left[nearest]].end;
        left[nearest] = left.back();
        left.pop_back();
    }
    return order;
}

Point nozzle_after(const LayerPaths& layer) { return layer.paths.empty() ? Point{} : end_of(layer.paths.back()); }

}  // namespace ribvault
