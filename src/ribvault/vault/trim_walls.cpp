#include "ribvault/vault/trim_walls.hpp"

#include <cstdint>

namespace ribvault {

void trim_walls(GrowingSupports& supports, const UnsupportedCells& unsupported, const Settings& settings) {
    constexpr double resolution = 1000;  // units: 10 µm
    for (std::size_t k = supports.new_walls().size(); k-- > 0;) {
        const GrowingSupports::NewWall wall = supports.new_walls()[k];
        if (!supports.is_free(wall)) continue;
        const Segment whole = supports.segment_of(wall);
        Box reach;
        reach.add(whole.a), reach.add(whole.b);
        reach.grow(settings.reach_of_support());
        supports.remove(wall);
        const std::vector<std::size_t> open = unsupported.uncovered(reach, supports);
        if (open.empty()) continue;
        std::int64_t parts = 1;
        while (length(whole) / static_cast<double>(parts) > resolution) parts *= 2;
        const auto share = [&](std::int64_t n) { return static_cast<double>(n) / static_cast<double>(parts); };
        const auto covers = [&](std::int64_t n, std::size_t cell) {
            supports.restore(wall, whole, share(n));
            const bool covered = unsupported.covered(cell, reach, supports);
            supports.remove(wall);
            return covered;
        };
        // Longer walls cover more: each cell asks for no less than those before it, and most for no more.
        std::int64_t least = 0;
        for (const std::size_t cell : open) {
            if (least > 0 && covers(least, cell)) continue;
            std::int64_t too_few = least, enough = parts;
            while (enough - too_few > 1) {
                const std::int64_t middle = (too_few + enough) / 2;
                (covers(middle, cell) ? enough : too_few) = middle;
            }
            least = enough;
        }
        supports.restore(wall, whole, share(least));
    }
}

}  // namespace ribvault
