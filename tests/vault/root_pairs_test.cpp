// Which roots go towards each other: neighbours along the shell, as long as that pays, and never in a ring.
#include "ribvault/vault/root_pairs.hpp"

#include <catch2/catch.hpp>

#include "random_cavities.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

constexpr Unit mm = units_per_mm;
constexpr std::size_t none = no_root;

CavityBoundary square() { return prepare_boundary({rectangle(0, 0, 20 * mm, 20 * mm)}); }

TreeRoot on_floor(double x, double trunk, std::size_t tree, Vec away = {0, 1}) {
    return {{round_to_lattice(x * mm), 0}, trunk * mm, tree, away};
}

using Pairs = std::vector<std::size_t>;

}  // namespace

TEST_CASE("neighbours pair up, the closest first, each with one") {
    const std::vector<TreeRoot> roots{on_floor(5, 3, 0), on_floor(6, 3, 1), on_floor(6.8, 3, 2), on_floor(8.2, 3, 3)};
    CHECK(pair_roots(roots, square(), 2 * mm) == Pairs{none, 2, 1, none});
    const std::vector<TreeRoot> comb{on_floor(5, 3, 0), on_floor(6, 3, 1), on_floor(7, 3, 2), on_floor(8, 3, 3)};
    CHECK(pair_roots(comb, square(), 2 * mm) == Pairs{1, 0, 3, 2});
}

TEST_CASE("roots farther apart than the limit, or than twice the shorter trunk, stay apart") {
    CHECK(pair_roots({on_floor(5, 9, 0), on_floor(7, 9, 1)}, square(), 2 * mm) == Pairs{1, 0});
    CHECK(pair_roots({on_floor(5, 9, 0), on_floor(7.00001, 9, 1)}, square(), 2 * mm) == Pairs{none, none});
    CHECK(pair_roots({on_floor(5, 9, 0), on_floor(6, 0.5, 1)}, square(), 2 * mm) == Pairs{1, 0});
    CHECK(pair_roots({on_floor(5, 9, 0), on_floor(6, 0.49, 1)}, square(), 2 * mm) == Pairs{none, none});
    CHECK(pair_roots({on_floor(5, 9, 0)}, square(), 2 * mm) == Pairs{none});
    CHECK(pair_roots({}, square(), 2 * mm).empty());
}

TEST_CASE("the way from root to root is along the shell") {
    // Around a corner, and over the place where the contour begins.
    const std::vector<TreeRoot> corner{on_floor(0.5, 3, 0), {{0, 50000}, 3 * mm, 1, {1, 1}}};
    CHECK(pair_roots(corner, square(), mm) == Pairs{1, 0});
    // On both sides of a partition 0.8 mm wide.
    const CavityBoundary rooms = prepare_boundary(
        {rectangle(0, 0, 10 * mm, 20 * mm), rectangle(10 * mm + 80000, 0, 20 * mm, 20 * mm)});
    const std::vector<TreeRoot> apart{{{10 * mm, 10 * mm}, 3 * mm, 0, {1, 9}},
                                      {{10 * mm + 80000, 10 * mm}, 3 * mm, 1, {1, 9}}};
    CHECK(pair_roots(apart, rooms, 2 * mm) == Pairs{none, none});
}

TEST_CASE("trunks that lead apart stay apart, unless they have the same root already") {
    const auto pair = [](Vec one, Vec other, double gap) {
        return pair_roots({on_floor(5, 3, 0, one), on_floor(5 + gap, 3, 1, other)}, square(), 2 * mm)[0] == 1;
    };
    CHECK(pair({-1, 4}, {1, 4}, 1));
    CHECK(pair({-10, 18}, {10, 18}, 1));        // 58°
    CHECK_FALSE(pair({-10, 17}, {10, 17}, 1));  // 61°
    CHECK(pair({-1, 0}, {1, 0}, 0));
}

TEST_CASE("pairs never close a ring of trees") {
    // Trees 0 and 1 have two roots each, side by side: one pair makes them one tree, a second one would make a ring.
    const std::vector<TreeRoot> both{on_floor(5, 3, 0), on_floor(6, 3, 1), on_floor(10, 3, 0), on_floor(11.1, 3, 1)};
    CHECK(pair_roots(both, square(), 2 * mm) == Pairs{1, 0, none, none});
    CHECK(pair_roots({on_floor(5, 3, 7), on_floor(6, 3, 7)}, square(), 2 * mm) == Pairs{none, none});
}
