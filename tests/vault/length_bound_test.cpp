// No supports can be shorter than the bound says.
#include "ribvault/vault/length_bound.hpp"

#include <catch2/catch.hpp>

using namespace ribvault;

namespace {

constexpr Unit mm = units_per_mm;

Region square(Unit side) { return {{{0, 0}, {side, 0}, {side, side}, {0, side}}}; }
/// What lies at least `reach` from the sides of a square of 20 mm, times 1 / (2 reach), mm.
double bound_of(double reach) { return (20 - 2 * reach) * (20 - 2 * reach) / (2 * reach); }

}  // namespace

TEST_CASE("a flat roof needs its area over twice the reach, which grows from layer to layer") {
    const Settings settings;
    const Cavity roof = make_cavity(50, {}, settings);
    LengthBound bound;
    CHECK(bound.next(roof, {}, nullptr, settings) == 0);
    Region hanging = square(20 * mm);
    const Cavity* above = &roof;
    const Cavity box = make_cavity(49, square(20 * mm), settings);
    for (const double reach : {0.4, 0.6, 0.8, 1.0}) {
        const double length = bound.next(box, hanging, above, settings) / mm;
        CHECK(length <= bound_of(reach));
        CHECK(length == Approx(bound_of(reach)).epsilon(0.002));
        above = &box, hanging = {};
    }
    // A second roof, over a part only: the first one still asks for more.
    const double both = bound.next(box, square(5 * mm), &roof, settings) / mm;
    CHECK(both == Approx(bound_of(1.2)).epsilon(0.002));
    // Where the shell comes near, what hung there is held up for good.
    const Cavity narrow = make_cavity(44, square(mm), settings);
    CHECK(bound.next(narrow, {}, &box, settings) == 0);
    CHECK(bound.next(box, {}, &narrow, settings) == 0);
}

TEST_CASE("what lies near the shell needs nothing for sure") {
    const Settings settings;
    const Cavity roof = make_cavity(1, {}, settings), box = make_cavity(0, square(79000), settings);
    LengthBound bound;
    CHECK(bound.next(box, square(79000), &roof, settings) == 0);
}
