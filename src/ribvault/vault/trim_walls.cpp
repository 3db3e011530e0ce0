#include "ribvault/vault/trim_walls.hpp"

namespace ribvault {

void trim_walls(GrowingSupports& supports, const UnsupportedCells& unsupported, const Settings& settings) {
    constexpr double resolution = 1000;  // units: 10 µm
    for (std::size_t k = supports.new_walls().size(); k-- > 0;) {
        const GrowingSupports::NewWall wall = supports.new_walls()[k];
        if (!supports.is_free(wall)) continue;
        const Segment whole = supports.segment_of(wall);
        Box reach;
        reach.add(whole.a), reach.add(whole.b);
        reach.grow(settings.nozzle / 2 + settings.support_radius);
        supports.remove(wall);
        if (unsupported.covered(reach, supports)) continue;
        double too_short = 0, enough = 1;  // shares of the whole
        while ((enough - too_short) * length(whole) > resolution) {
            const double middle = (too_short + enough) / 2;
            supports.restore(wall, whole, middle);
            (unsupported.covered(reach, supports) ? enough : too_short) = middle;
            supports.remove(wall);
        }
        supports.restore(wall, whole, enough);
    }
}

}  // namespace ribvault
