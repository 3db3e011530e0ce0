// New walls end where bisection over all of the region ends them, and what was covered stays covered.
#include "ribvault/vault/trim_walls.hpp"

#include <catch2/catch.hpp>

#include "grown_scene.hpp"
#include "within.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

std::string walls(const SupportForest& forest) {
    std::string all;
    for (const Segment& s : centre_lines(forest)) all += text(s) + '\n';
    return all;
}

bool covers_all(const GrowingSupports& supports, const UnsupportedCells& unsupported, const Box& everywhere) {
    return unsupported.uncovered(everywhere, supports).empty();
}

/// As trim_walls, looking at the whole region for every length it tries.
void trim_slowly(GrowingSupports& supports, const UnsupportedCells& unsupported, const Box& everywhere) {
    for (std::size_t k = supports.new_walls().size(); k-- > 0;) {
        const GrowingSupports::NewWall wall = supports.new_walls()[k];
        if (!supports.is_free(wall)) continue;
        const Segment whole = supports.segment_of(wall);
        supports.remove(wall);
        if (covers_all(supports, unsupported, everywhere)) continue;
        double too_short = 0, enough = 1;
        while ((enough - too_short) * length(whole) > 1000) {
            const double middle = (too_short + enough) / 2;
            supports.restore(wall, whole, middle);
            (covers_all(supports, unsupported, everywhere) ? enough : too_short) = middle;
            supports.remove(wall);
        }
        supports.restore(wall, whole, enough);
    }
}

}  // namespace

TEST_CASE("walls are trimmed to what bisection over the whole region gives") {
    Random g(17);
    double before = 0, after = 0;
    for (int k = 0; k < 12; ++k) {
        const GrownScene scene(g, 250000);
        if (scene.cavity.deep.empty()) continue;
        const Settings settings;
        const UnsupportedCells unsupported(scene.cavity.deep, settings);
        const Box everywhere = bounding_box(scene.cavity.deep);
        GrowingSupports fast({}, scene.boundary.location.box(), scene.boundary, settings);
        for (const UnsupportedCells::Cell& cell : unsupported.cells())
            for (Unit bit = 0; bit < 64; ++bit) {
                const Point p = unsupported.pixel(cell, bit);
                const Unit covered = settings.reach_of_support() / 2;
                if ((cell.pixels >> bit & 1) && !fast.covers(p, covered))
                    fast.add_wall(p, settings.branch_bonus_length);
            }
        REQUIRE(covers_all(fast, unsupported, everywhere));
        GrowingSupports slow = fast;
        GrowingSupports untrimmed = fast;
        trim_walls(fast, unsupported, settings);
        trim_slowly(slow, unsupported, everywhere);
        CHECK(covers_all(fast, unsupported, everywhere));
        const SupportForest trimmed = fast.take();
        CHECK(walls(trimmed) == walls(slow.take()));
        before += length(untrimmed.take()), after += length(trimmed);
    }
    CHECK(after > 0);
    CHECK(after < 0.95 * before);
}
