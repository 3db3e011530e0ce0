// Growing covers all of the unsupported region, inside the cavity, nearest points first, under equation (4).
#include "ribvault/vault/grow_supports.hpp"

#include <catch2/catch.hpp>

#include "grown_scene.hpp"
#include "within.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

const CavityBoundary room = prepare_boundary({rectangle(-1000000, 0, 1000000, 2000000)});

/// One candidate alone: the region is a few units around p.
SupportForest grown_at(Point p, const SupportForest& forest, const Settings& settings) {
    return grow_supports(forest, {rectangle(p.x - 10, p.y - 10, p.x + 10, p.y + 10)}, room, 1, settings).forest;
}

/// A trunk with a junction p[1] of the given valence at (0, 400000), and far from it the inner part of a wall, p[2], at
/// the given distance to the right of p (Figure 15).
constexpr Point p{105000, 405000};  // a point of the candidates' lattice
SupportForest figure_15(int valence, Unit to_wall) {
    ForestPlan plan{{{0, 0}, {0, 400000}}, {0}, {{0, 1}}};
    const Point ends[] = {{-300000, 700000}, {0, 1000000}, {-400000, 400000}, {-300000, 100000}};
    for (int k = 1; k < valence; ++k) {
        plan.vertices.push_back(ends[k - 1]);
        plan.walls.push_back({1, plan.vertices.size() - 1});
    }
    plan.roots.push_back(plan.vertices.size());
    plan.vertices.push_back({p.x + to_wall, 0});
    plan.vertices.push_back({p.x + to_wall, 1200000});
    plan.walls.push_back({plan.vertices.size() - 2, plan.vertices.size() - 1});
    return forest_of(plan);
}
constexpr Point junction{0, 400000};

bool to_junction(const SupportForest& forest) { return has_wall(forest, p, junction); }
bool to_wall(const SupportForest& forest, Unit distance) { return has_wall(forest, p, {p.x + distance, p.y}); }

}  // namespace

TEST_CASE("everything unsupported lies within r + ρ of a wall, the walls inside the cavity") {
    Random g(91);
    for (int k = 0; k < 40; ++k) {
        GrownScene scene(g);
        if (scene.cavity.region.empty()) continue;
        Point bad;
        INFO("scene " << k);
        const bool covered = within(scene.cavity.deep, centre_lines(scene.forest), 40000, bad);
        INFO("not covered about " << text(bad));
        REQUIRE(covered);
        REQUIRE(forest_fault(scene.forest) == "");
        REQUIRE(placement_fault(scene.forest, scene.boundary) == "");
        REQUIRE(leaving_wall(scene.forest, scene.boundary) == "");
        REQUIRE(crossings(scene.forest).count == 0);
    }
}

TEST_CASE("a coarse lattice of candidates and a small ρ cover everything as well") {
    Random g(92);
    for (int k = 0; k < 12; ++k) {
        GrownScene scene(g, 300000);
        Settings settings;
        settings.sampling_pitch = 40000;
        settings.support_radius = 7000;
        settings.branch_bonus = k % 2;
        const Cavity cavity = make_cavity(0, scene.cavity.region, settings);
        const SupportForest forest = grow_supports({}, cavity.deep, scene.boundary, 3, settings).forest;
        Point bad;
        const bool covered = within(cavity.deep, centre_lines(forest), 27000, bad);
        INFO("scene " << k << ", not covered about " << text(bad));
        REQUIRE(covered);
        REQUIRE(forest_fault(forest) == "");
        REQUIRE(crossings(forest).count == 0);
    }
}

TEST_CASE("nothing is added where nothing is unsupported or walls already reach") {
    const SupportForest wall = forest_of({{{0, 0}, {0, 500000}}, {0}, {{0, 1}}});
    CHECK(num_edges(grow_supports(wall, {}, room, 1, Settings{}).forest) == 1);
    CHECK(num_edges(grow_supports(wall, {rectangle(-39000, 100000, 39000, 400000)}, room, 1, Settings{}).forest) == 1);
    CHECK(num_edges(grow_supports(wall, {rectangle(-39000, 100000, 41000, 400000)}, room, 1, Settings{}).forest) > 1);
}

TEST_CASE("candidates are taken in order of their distance to the shell") {
    Settings settings;
    settings.branch_bonus = false;
    // Slanted sides, so that the feet of walls on other walls do not lie on the candidates' lattice.
    const CavityBoundary slanted =
        prepare_boundary({{{-1000000, 0}, {1000000, 137000}, {900000, 2100000}, {-1100000, 1950000}}});
    const SupportForest forest =
        grow_supports({}, {rectangle(-900000, 200000, 800000, 1850000)}, slanted, 5, settings).forest;
    std::vector<SquaredDistance> distances;
    for (auto [v, end] = vertices(forest); v != end; ++v) {
        const Point at = forest[*v].at;
        const auto on_lattice = [](Unit u) { return (u - 5000) % 10000 == 0; };
        if (!forest[*v].root && on_lattice(at.x) && on_lattice(at.y))
            distances.push_back(slanted.edges.nearest(at).distance);
    }
    REQUIRE(distances.size() > 500);
    for (std::size_t k = 1; k < distances.size() / 2; ++k) REQUIRE(compare(distances[k - 1], distances[k]) <= 0);
    CHECK(distances.front().value() < distances[distances.size() / 2].value());
}

TEST_CASE("a wall goes to the nearest point of shell or wall") {
    Settings plain;
    plain.branch_bonus = false;
    const SupportForest wall = forest_of({{{0, 0}, {0, 900000}}, {0}, {{0, 1}}});
    const Point near_wall{105000, 405000}, near_shell{405000, 105000};
    CHECK(has_wall(grown_at(near_wall, wall, plain), near_wall, {0, 405000}));
    CHECK(num_edges(grown_at(near_wall, wall, plain)) == 3);  // the wall is split
    const SupportForest to_shell = grown_at(near_shell, wall, plain);
    CHECK(has_wall(to_shell, near_shell, {405000, 0}));
    CHECK(component_count(to_shell) == 2);
}

TEST_CASE("equation (4), Figure 15: a junction counts 4r nearer") {
    const Settings settings;
    // p[1] lies 105 119 units away, p[2] 60 000: with the bonus p[1] is nearer.
    CHECK(to_junction(grown_at(p, figure_15(2, 60000), settings)));
    CHECK(to_junction(grown_at(p, figure_15(3, 60000), settings)));
    // 41 000 and 105 119 - 80 000 = 25 119.
    CHECK(to_junction(grown_at(p, figure_15(2, 41000), settings)));
    Settings no_bonus;
    no_bonus.branch_bonus = false;
    CHECK(to_wall(grown_at(p, figure_15(2, 60000), no_bonus), 60000));
}

TEST_CASE("equation (4): a junction of valence 4 attracts no more") {
    Settings settings;
    CHECK(to_wall(grown_at(p, figure_15(4, 60000), settings), 60000));
    settings.valence_limit = 5;
    CHECK(to_junction(grown_at(p, figure_15(4, 60000), settings)));
    settings.valence_limit = 2;
    CHECK(to_wall(grown_at(p, figure_15(2, 60000), settings), 60000));
}

TEST_CASE("equation (4): equal after the bonus, the nearer one is kept") {
    // The junction lies 60 000 + 80 000 from a point whose distance to the wall is 60 000: on one line.
    for (const Unit off : {-1, 0, 1}) {
        const Point q{145000, 405000};
        const SupportForest forest =
            forest_of({{{q.x - 140000 - off, 0}, {q.x - 140000 - off, q.y}, {q.x + 60000, 0}, {q.x + 60000, 1200000}},
                       {0, 2},
                       {{0, 1}, {2, 3}}});
        const SupportForest grown = grown_at(q, forest, Settings{});
        INFO("off by " << off);
        CHECK(has_wall(grown, q, off < 0 ? Point{q.x - 140000 - off, q.y} : Point{q.x + 60000, q.y}));
    }
}

TEST_CASE("a junction behind another wall is not reached through it") {
    const SupportForest barred =
        forest_of({{{0, 0}, {0, 400000}, {60000, 0}, {60000, 900000}}, {0, 2}, {{0, 1}, {2, 3}}});
    const SupportForest grown = grown_at(p, barred, Settings{});
    CHECK(has_wall(grown, p, {60000, p.y}));
    CHECK(crossings(grown).count == 0);
}

TEST_CASE("ties are broken by the seed: the same seed gives the same bytes, another one other supports") {
    const auto grown = [](std::uint64_t seed) {
        std::string bytes;
        for (const Segment& s : centre_lines(
                 grow_supports({}, {rectangle(-900000, 20000, 900000, 1980000)}, room, seed, Settings{}).forest))
            bytes += text(s);
        return bytes;
    };
    const std::string first = grown(1);
    CHECK(first == grown(1));
    CHECK(first != grown(2));
    CHECK(grown(2) != grown(3));
}

TEST_CASE("a quarter of the bonus counts nowhere, in narrow places or everywhere") {
    const auto walls = [](const SupportForest& forest) {
        std::vector<std::pair<Point, Point>> all;
        for (auto [e, end] = edges(forest); e != end; ++e)
            all.push_back({forest[source(*e, forest)].at, forest[target(*e, forest)].at});
        return all;
    };
    Settings whole;
    whole.branch_bonus_length = 160000;  // so that a third would grow other walls than a quarter
    Settings quarter = whole, third = whole, narrow = whole, everywhere = whole;
    quarter.branch_bonus_length /= 4, third.branch_bonus_length /= 3;
    narrow.quarter_bonus = QuarterBonus::narrow, everywhere.quarter_bonus = QuarterBonus::everywhere;
    // On either side of twice 3/4 d = 0.6 mm, far enough from the shell and long enough for many walls.
    const Region band{rectangle(-900000, 500000, 900000, 559000)}, roof{rectangle(-900000, 500000, 900000, 561500)};
    const auto grown = [&](const Region& region, const Settings& settings) {
        return walls(grow_supports({}, region, room, 1, settings).forest);
    };
    for (const Region& region : {band, roof}) {
        CHECK(grown(region, whole) != grown(region, quarter));
        CHECK(grown(region, third) != grown(region, quarter));
        CHECK(grown(region, everywhere) == grown(region, quarter));
    }
    CHECK(grown(band, narrow) == grown(band, quarter));
    CHECK(grown(roof, narrow) == grown(roof, whole));
    // Which of the two counted for a wall.
    const auto used = [](const Region& region, const Settings& settings) {
        const GrownSupports supports = grow_supports({}, region, room, 1, settings);
        return std::pair(supports.full_bonus, supports.quarter_bonus);
    };
    const Region both{band[0], rectangle(-900000, 1000000, 900000, 1061500)};
    CHECK(used(both, whole) == std::pair(true, false));
    CHECK(used(both, everywhere) == std::pair(false, true));
    CHECK(used(both, narrow) == std::pair(true, true));
    CHECK(used(band, narrow) == std::pair(false, true));
    CHECK(used(roof, narrow).first);
    CHECK(used({}, whole) == std::pair(false, false));
    whole.branch_bonus = narrow.branch_bonus = everywhere.branch_bonus = false;
    CHECK(grown(band, narrow) == grown(band, whole));
    CHECK(grown(band, everywhere) == grown(band, whole));
}
