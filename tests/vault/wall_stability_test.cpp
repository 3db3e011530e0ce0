// How slender walls are, and which of them are printed with several tracks.
#include "ribvault/vault/wall_stability.hpp"

#include <catch2/catch.hpp>

#include "grown_scene.hpp"
#include "ribvault/vault/shrink_supports.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

constexpr Unit mm = units_per_mm;

/// One wall of 10 mm along x; `standing`: layers of wall on its root and on its other end.
SupportForest wall(bool second_root, std::int32_t on_root, std::int32_t on_end) {
    SupportForest forest;
    const auto root = add_vertex({.at = {0, 0}, .root = true, .standing = on_root}, forest);
    const auto end = add_vertex({.at = {10 * mm, 0}, .root = second_root, .standing = on_end}, forest);
    add_edge(root, end, forest);
    return forest;
}

}  // namespace

TEST_CASE("a tall wall sways at its tip, where the way to the root is longest") {
    const SlenderPlace worst = most_slender(wall(false, 99, 99), {});  // 20 mm high
    CHECK(worst.ratio == Approx(10 / 0.4));
    CHECK(worst.at == Point{10 * mm, 0});
    CHECK(worst.standing == Approx(20.0 * mm));
    CHECK(worst.to_root == Approx(10.0 * mm));
}

TEST_CASE("between two roots a wall sways in the middle") {
    const SlenderPlace worst = most_slender(wall(true, 99, 99), {});
    CHECK(worst.ratio == Approx(5 / 0.4));
    CHECK(worst.at == Point{5 * mm, 0});
}

TEST_CASE("a low wall is held from below") { CHECK(most_slender(wall(false, 4, 4), {}).ratio == Approx(1 / 0.4)); }

TEST_CASE("a wall that is high at the root and low at the tip sways where both are equal") {
    // 10.2 mm at the root, 0.2 mm at the tip: 10.2 - t = t.
    const SlenderPlace worst = most_slender(wall(false, 50, 0), {});
    CHECK(worst.to_root == Approx(5.1 * mm));
    CHECK(worst.ratio == Approx(5.1 / 0.4));
}

TEST_CASE("a forest without walls is not slender") { CHECK(most_slender({}, {}).ratio == 0); }

TEST_CASE("a tree that stands free sways as a whole, over where it is narrowest") {
    const auto cross = [](Unit arm, std::int32_t standing) {
        SupportForest forest;
        const auto middle =
            add_vertex({.at = {0, 0}, .root = true, .free = true, .outside = true, .standing = standing}, forest);
        for (const Point end : {Point{arm, 0}, Point{0, arm}, Point{-arm, 0}, Point{0, -arm}})
            add_edge(middle, add_vertex({.at = end, .outside = true}, forest), forest);
        return forest;
    };
    // 20 mm high, a square on its tip: 1.414 mm and a track across.
    const SlenderPlace worst = most_slender(cross(mm, 99), {});
    CHECK(worst.ratio == Approx(20 / (std::sqrt(2.0) + 0.4)));
    CHECK(worst.standing == Approx(20.0 * mm));
    CHECK(worst.to_root == 0);
    CHECK(worst.at == Point{0, 0});
    SupportForest line = wall(false, 99, 99);
    line[0].free = true;
    CHECK(most_slender(line, {}).ratio == Approx(20 / 0.4));
    SupportForest dot;
    add_vertex({.at = {0, 0}, .root = true, .free = true, .outside = true, .standing = 99}, dot);
    CHECK(most_slender(dot, {}).ratio == Approx(20 / 0.4));
}

TEST_CASE("walls outside are as slender as walls in cavities") {
    SupportForest forest = wall(false, 99, 99);
    for (auto [v, end] = vertices(forest); v != end; ++v) forest[*v].outside = true;
    CHECK(most_slender(forest, {}).ratio == Approx(10 / 0.4));
}

namespace {
int marked(SupportForest& forest, const Settings& settings) {
    mark_wide_trees(forest, settings);
    return wide_trees(forest);
}
}  // namespace

TEST_CASE("long trees, tall trees and what grew out of them are wide, others are not") {
    Settings settings;
    SupportForest forest = wall(false, 0, 0);
    CHECK(marked(forest, settings) == 0);  // one line a wall
    settings.wall_lines = 2;
    CHECK(marked(forest, settings) == 0);  // exactly 10 mm is not longer
    settings.wall_lines_longer = 10 * mm - 1;
    CHECK(marked(forest, settings) == 1);
    CHECK((forest[0].wide && forest[1].wide && forest[*edges(forest).first].to_junction));
    settings.wall_lines_longer = 100 * mm;
    CHECK(marked(forest, settings) == 1);  // it was
    forest = wall(false, 50, 0);
    CHECK(marked(forest, settings) == 1);  // 10.2 mm stand on its root
    forest = wall(false, 49, 0);
    CHECK(marked(forest, settings) == 0);
    CHECK(most_slender(wall(false, 99, 99), settings).ratio == Approx(25));
}

TEST_CASE("wide trees are drawn back from their tips, along the longest way, and end as one track does") {
    Settings settings;
    settings.wall_lines = 3;  // 0.4 mm
    SupportForest forest;
    const auto add = [&](Unit x, Unit y, bool root) {
        return add_vertex({.at = {x, y}, .root = root, .wide = true}, forest);
    };
    const auto root = add(0, 0, true), joint = add(5 * mm, 0, false), end = add(5 * mm + 25000, 0, false);
    add_edge(root, joint, forest), add_edge(end, joint, forest);
    add_edge(joint, add(5 * mm, 30000, false), forest);  // two short branches, 0.25 and 0.3 mm
    SupportForest left = tapered_trees(forest, settings);
    REQUIRE(num_vertices(left) == 2);
    REQUIRE(num_edges(left) == 1);
    CHECK(left[0].at == Point{0, 0});
    CHECK(left[0].root);
    CHECK(left[1].at == Point{5 * mm - 10000, 0});

    add_edge(joint, add(5 * mm, -mm, false), forest);
    left = tapered_trees(forest, settings);
    CHECK(num_edges(left) == 2);
    CHECK(length(left) == Approx(6.0 * mm - 40000));

    forest[end].root = true;  // between roots a wall stays
    CHECK(length(tapered_trees(forest, settings)) == Approx(6.0 * mm - 40000 + 25000));
    for (auto [v, last] = vertices(forest); v != last; ++v) forest[*v].wide = false;
    CHECK(length(tapered_trees(forest, settings)) == Approx(length(forest)));
}

TEST_CASE("tips are drawn back by less where the ends above would be left without a wall in reach") {
    Settings settings;
    settings.wall_lines = 2;
    SupportForest forest = wall(false, 0, 0);  // from (0, 0) to (10, 0)
    forest[0].wide = forest[1].wide = true;
    const auto end_under = [&](Point above) {
        const SupportForest left = tapered_trees(forest, settings, {above});
        REQUIRE(num_edges(left) == 1);
        return left[1].at;
    };
    CHECK(end_under({5 * mm, 0}) == Point{10 * mm - 20000, 0});
    CHECK(end_under({10 * mm, 0}) == Point{10 * mm - 20000, 0});  // 0.2 mm from the end that is left
    CHECK(end_under({10 * mm + 1, 0}) == Point{10 * mm, 0});
    CHECK(end_under({10 * mm - 10000, 19000}) == Point{10 * mm - 10000, 0});
    CHECK(end_under({10 * mm, 30000}) == Point{10 * mm - 20000, 0});  // out of the whole wall's reach
    // Over the tip of a branch that is drawn back wholly: it stays, and so does the way to it.
    const std::size_t joint = 1, branch = add_vertex(forest);
    forest[branch].at = {10 * mm - 10000, 10000}, forest[branch].wide = true;
    add_edge(joint, branch, forest);
    CHECK(length(tapered_trees(forest, settings)) == Approx(10 * mm - 20000 + 14142).margin(2));
    CHECK(length(tapered_trees(forest, settings, {{10 * mm - 10000, 29000}})) == Approx(10 * mm + 14142).margin(2));
}

TEST_CASE("on the way down the ends of wide trees always have what is left of the next ones within reach") {
    Random g(2027);
    Settings settings;
    settings.wall_lines = 3;
    int layers = 0, far = 0;
    for (int k = 0; k < 12; ++k) {
        GrownScene scene(g);
        SupportForest forest = scene.forest;
        std::vector<Point> above;
        for (int layer = 0; layer < 12 && num_edges(forest) > 0; ++layer, ++layers) {
            for (auto [v, end] = vertices(forest); v != end; ++v) forest[*v].wide = true;
            const NearestSegment whole(centre_lines(forest)), drawn_back(centre_lines(tapered_trees(forest, settings)));
            const SupportForest left = tapered_trees(forest, settings, above);
            const NearestSegment walls(centre_lines(left));
            for (const Point p : above) {
                const auto in_reach = [&](const NearestSegment& by) {
                    return !by.empty() && by.nearest(p).distance.value() <= 20000.0 * 20000.0;
                };
                if (!in_reach(whole)) continue;  // what has shrunk to a dot
                REQUIRE(in_reach(walls));
                far += !in_reach(drawn_back);
            }
            above = ends_of_wide_trees(left);
            forest = shrink_supports(forest, scene.boundary, 20000).forest;
        }
    }
    CHECK(layers > 80);
    CHECK(far > 50);
}

TEST_CASE("of a tree that is all tip one line is printed, but where it stands free") {
    Settings settings;
    settings.wall_lines = 3;
    SupportForest forest = wall(false, 99, 99);
    CHECK(marked(forest, settings) == 1);
    forest[1].at.x = 40000;
    CHECK(marked(forest, settings) == 0);
    forest[1].at.x = 40001;
    CHECK(marked(forest, settings) == 1);
    forest[1].at.x = 40000, forest[0].free = true;
    CHECK(marked(forest, settings) == 1);
    const SupportForest left = tapered_trees(forest, settings);
    CHECK((num_vertices(left) == 1 && left[0].root));
}

TEST_CASE("a vertex between two others carries what stands there, and is wide when one of them is") {
    const SupportVertex a{.at = {0, 0}, .root = true, .wide = true, .standing = 10},
        b{.at = {10 * mm, 0}, .standing = 20};
    const SupportVertex middle = vertex_between(a, b, {5 * mm, 0});
    CHECK(middle.standing == 15);
    CHECK(middle.wide);
    CHECK_FALSE(middle.root);
}
