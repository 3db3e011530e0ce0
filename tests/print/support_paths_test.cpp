#include "ribvault/print/support_paths.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <map>
#include <numeric>
#include <set>

#include "print/geometry.hpp"
#include "print/random_forest.hpp"
#include "ribvault/error.hpp"
#include "ribvault/print/order_paths.hpp"
#include "ribvault/slice/lattice_clip.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

constexpr Unit mm = units_per_mm;
const Unit nozzle = Settings{}.nozzle;

/// With the gaps of Section 4.4 as the paper has them, or as they are printed by default.
LayerPlan plan_of(const SupportForest& forest, Gaps gaps = Gaps::paper, Unit width = nozzle) {
    Settings settings;
    settings.gaps = gaps, settings.support_width = width;
    LayerPlan plan;
    append_support_paths(forest, settings, plan);
    return plan;
}

LayerPaths support_paths(const SupportForest& forest, Unit width = nozzle) {
    return order_paths(plan_of(forest, Gaps::paper, width), {});
}

/// The paths as they were planned, outwards from their junctions, before travel turns and sorts them.
std::vector<std::vector<Point>> planned(const SupportForest& forest, Gaps gaps = Gaps::paper, Unit width = nozzle) {
    std::vector<std::vector<Point>> all;
    for (const PlannedTrack& track : plan_of(forest, gaps, width).tracks) all.push_back(track.paths.at(0).points);
    return all;
}

std::vector<std::vector<Point>> points_of(const LayerPaths& layer) {
    std::vector<std::vector<Point>> all;
    for (const ToolPath& path : layer.paths) all.push_back(path.points);
    return all;
}

/// A forest from its vertices (the first is the root) and edges.
struct EdgeOf {
    std::size_t a, b;
    bool first_layer = false;
};
SupportForest forest_of(const std::vector<Point>& vertices, const std::vector<EdgeOf>& edges) {
    SupportForest forest(vertices.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) forest[i] = {vertices[i], i == 0};
    for (const EdgeOf& e : edges) add_edge(e.a, e.b, SupportEdge{e.first_layer}, forest);
    return forest;
}

/// The forest seen from its starting roots, built without the code under test.
struct Rooted {
    std::vector<long> parent;
    std::vector<bool> first_layer;
    std::vector<double> reach;
    std::map<Point, long> at;
    explicit Rooted(const SupportForest& f)
        : parent(num_vertices(f), -2), first_layer(num_vertices(f)), reach(num_vertices(f)) {
        for (std::size_t v = 0; v < num_vertices(f); ++v) at[f[v].at] = static_cast<long>(v);
        for (std::size_t v = 0; v < num_vertices(f); ++v)
            if (f[v].root && parent[v] == -2) hang(f, v, -1);
    }
    void hang(const SupportForest& f, std::size_t v, long p) {
        parent[v] = p;
        for (auto [e, end] = out_edges(v, f); e != end; ++e) {
            const std::size_t w = target(*e, f);
            if (static_cast<long>(w) == p) continue;
            first_layer[w] = f[*e].first_layer;
            hang(f, w, static_cast<long>(v));
            reach[v] = std::max(reach[v], reach[w] + length(f[w].at - f[v].at));
        }
    }
};

/// Everything that Section 4.4 asks of a layer's paths; `long_edges` when every edge is longer than two widths.
/// Returns how many paths are printed towards their junction.
int check_paths(const SupportForest& forest, const LayerPaths& layer, bool long_edges, Unit track = nozzle) {
    int turned = 0;
    const auto plan = planned(forest, Gaps::paper, track);
    const std::set<std::vector<Point>> outwards(plan.begin(), plan.end());
    const auto width = static_cast<double>(track);
    const Rooted rooted(forest);
    std::vector<int> printed_by(num_vertices(forest), -1);  // path that prints the end of the edge to the parent
    std::vector<int> passed(num_vertices(forest), 0);
    double sum = 0;
    std::vector<Segment> printed;
    for (std::size_t i = 0; i < layer.paths.size(); ++i) {
        ToolPath path = layer.paths[i];
        REQUIRE(path.kind == TrackKind::support);
        REQUIRE(path.width == track);
        REQUIRE_FALSE(path.closed);
        REQUIRE(path.points.size() >= 2);
        sum += length(path);
        // A path may be printed towards its junction; the rest looks at it outwards.
        const bool inwards = outwards.count(path.points) == 0;
        if (inwards) {
            std::reverse(path.points.begin(), path.points.end());
            REQUIRE(outwards.count(path.points) == 1);
            ++turned;
            for (std::size_t k = 1; k < path.points.size(); ++k)
                CHECK_FALSE(rooted.first_layer[rooted.at.at(path.points[k])]);
        }
        for (std::size_t k = 1; k < path.points.size(); ++k) {
            REQUIRE(path.points[k] != path.points[k - 1]);
            REQUIRE(rooted.at.count(path.points[k]) == 1);
            const long v = rooted.at.at(path.points[k]), parent = rooted.parent[v];
            REQUIRE(parent >= 0);
            REQUIRE(printed_by[v] == -1);
            printed_by[v] = static_cast<int>(i);
            if (k + 1 < path.points.size()) ++passed[v];
            if (k > 1) REQUIRE(forest[parent].at == path.points[k - 1]);
            if (k + 1 < path.points.size()) {
                const double onwards =
                    length(path.points[k + 1] - path.points[k]) + rooted.reach[rooted.at.at(path.points[k + 1])];
                CHECK(onwards == Approx(rooted.reach[v]).epsilon(1e-12));
            }
        }
        const long first = rooted.at.at(path.points[1]), parent = rooted.parent[first];
        const Point start = path.points[0];
        CHECK(distance(start, Segment{forest[parent].at, forest[first].at}) < 1);
        if (start == forest[parent].at) {
            const bool first_of_root = rooted.parent[parent] == -1 && passed[parent] == 0;
            if (first_of_root) ++passed[parent];
            CHECK((first_of_root || rooted.first_layer[first]));
        } else {
            if (long_edges) {
                CHECK(std::abs(length(start - forest[parent].at) - width) < 1);
                CHECK_FALSE(rooted.first_layer[first]);
            }
            double contact = INFINITY;
            for (const Segment& s : printed) contact = std::min(contact, distance(start, s));
            CHECK(contact < width + 1);
        }
        for (const Segment& s : segments(path)) printed.push_back(s);
    }
    CHECK(std::abs(sum + static_cast<double>(layer.gap_length) - length(forest)) <= 2 * layer.gaps + 1);
    CHECK(static_cast<double>(layer.gap_length) <= layer.gaps * width + 1);
    for (std::size_t v = 0; v < num_vertices(forest); ++v) {
        if (rooted.parent[v] < 0) {
            CHECK(passed[v] == (out_degree(v, forest) > 0 ? 1 : 0));
            continue;
        }
        const auto parent = static_cast<std::size_t>(rooted.parent[v]);
        const int parents_path = printed_by[parent];
        if (printed_by[v] >= 0 && parents_path >= 0) CHECK(parents_path <= printed_by[v]);
        if (printed_by[v] >= 0 && out_degree(v, forest) > 1) CHECK(passed[v] == 1);
        const double reach = rooted.reach[v] + length(forest[v].at - forest[parent].at);
        const bool starts_branch = reach < rooted.reach[parent];
        if (starts_branch && rooted.first_layer[v]) CHECK(printed_by[v] >= 0);
        if (long_edges) CHECK(printed_by[v] >= 0);
    }
    return turned;
}

}  // namespace

TEST_CASE("random forests with long edges: order, junctions, gaps, lengths") {
    std::mt19937_64 random(20190501);
    int turned = 0;
    for (int round = 0; round < 60; ++round) {
        const SupportForest forest = random_forest(random, 1 + round % 5, 5 + round, mm, 5 * mm, 0.2);
        const Unit width = round % 3 ? nozzle : 24000 + 100 * round;
        const LayerPaths layer = support_paths(forest, width);
        turned += check_paths(forest, layer, true, width);
        CHECK(layer.gap_length == layer.gaps * width);
    }
    CHECK(turned > 100);
}

TEST_CASE("random forests with edges shorter than the gap: still in contact, nothing lost, nothing twice") {
    std::mt19937_64 random(44);
    for (int round = 0; round < 60; ++round) {
        const SupportForest forest = random_forest(random, 1 + round % 3, 10 + 2 * round, 1, mm, round % 2 ? 0.0 : 0.3);
        check_paths(forest, support_paths(forest), false);
    }
}

TEST_CASE("same forest, same paths, however often") {
    std::mt19937_64 random(7);
    const SupportForest forest = random_forest(random, 12, 20, mm / 10, 3 * mm, 0.1);
    CHECK(points_of(support_paths(forest)) == points_of(support_paths(forest)));
}

TEST_CASE("a branch stops one track width short of the trunk, on its first layer it reaches the junction") {
    const std::vector<Point> vertices{{0, 0}, {5 * mm, 0}, {10 * mm, 0}, {5 * mm, 3 * mm}};
    const SupportForest forest = forest_of(vertices, {{0, 1}, {1, 2}, {1, 3}});
    const LayerPaths later = support_paths(forest);
    CHECK(planned(forest) ==
          std::vector<std::vector<Point>>{{{0, 0}, {5 * mm, 0}, {10 * mm, 0}}, {{5 * mm, 40000}, {5 * mm, 3 * mm}}});
    CHECK(later.gaps == 1);
    CHECK(later.gap_length == 40000);
    const SupportForest starting = forest_of(vertices, {{0, 1}, {1, 2}, {1, 3, true}});
    const LayerPaths first = support_paths(starting);
    CHECK(points_of(first).back() == std::vector<Point>{{5 * mm, 0}, {5 * mm, 3 * mm}});
    CHECK(planned(starting) ==
          std::vector<std::vector<Point>>{{{0, 0}, {5 * mm, 0}, {10 * mm, 0}}, {{5 * mm, 0}, {5 * mm, 3 * mm}}});
    CHECK(first.gaps == 0);
    CHECK(first.gap_length == 0);
}

TEST_CASE("a branch of exactly one width vanishes, a longer one or one on its first layer does not") {
    const auto with_branch = [](Unit reach, bool first_layer) {
        return support_paths(
            forest_of({{0, 0}, {5 * mm, 0}, {10 * mm, 0}, {5 * mm, reach}}, {{0, 1}, {1, 2}, {1, 3, first_layer}}));
    };
    CHECK(with_branch(40000, false).paths.size() == 1);
    CHECK(with_branch(40000, false).gap_length == 40000);
    CHECK(with_branch(10000, false).gap_length == 10000);
    CHECK(with_branch(10000, false).gaps == 1);
    CHECK(with_branch(40001, false).paths.size() == 2);
    CHECK(with_branch(40001, false).gap_length == 40000);
    CHECK(with_branch(10000, true).paths.size() == 2);
    CHECK(with_branch(10000, true).gaps == 0);
}

TEST_CASE("branches up to 3/2 widths long that are printed from their junction are taken along where they may be") {
    using Printed = std::array<std::size_t, 3>;  // bends, gaps, tracks
    // A trunk to (10, 0) and at (5, 0) the branch with these edges.
    const auto printed = [](std::vector<Point> branch, std::vector<EdgeOf> edges, Unit rho = 20000) {
        std::vector<Point> vertices{{0, 0}, {5 * mm, 0}, {10 * mm, 0}};
        vertices.insert(vertices.end(), branch.begin(), branch.end());
        edges.insert(edges.begin(), {{0, 1}, {1, 2}});
        SupportForest forest = forest_of(vertices, edges);
        Settings settings;
        settings.support_radius = rho;
        LayerPlan plan;
        append_support_paths(forest, settings, plan);
        return Printed{static_cast<std::size_t>(plan.bends), static_cast<std::size_t>(plan.gaps), plan.tracks.size()};
    };
    CHECK(printed({{5 * mm, 60000}}, {{1, 3, true}}) == Printed{1, 0, 1});
    CHECK(printed({{5 * mm, 60001}}, {{1, 3, true}}) == Printed{0, 0, 2});
    // With a smaller rho a wall that goes straight on above would hang over any bend.
    CHECK(printed({{5 * mm, 20000}}, {{1, 3, true}}, 14500) == Printed{1, 0, 1});
    CHECK(printed({{5 * mm, 20000}}, {{1, 3, true}}, 14400) == Printed{0, 0, 2});
    CHECK(printed({{5 * mm, 50000}}, {{1, 3}}) == Printed{0, 1, 2});  // it stops short of its junction
    CHECK(printed({{5 * mm, 30000}}, {{1, 3}}) == Printed{0, 1, 1});  // it vanishes in its gap
    // A branch of two walls, one that forks, and two branches at one place.
    CHECK(printed({{5 * mm, 20000}, {5 * mm + 10000, 30000}}, {{1, 3, true}, {3, 4}}) == Printed{1, 0, 1});
    CHECK(printed({{5 * mm, 20000}, {5 * mm + 10000, 30000}, {5 * mm - 10000, 30000}}, {{1, 3, true}, {3, 4}, {3, 5}})
              .front() == 0);
    CHECK(printed({{5 * mm, 30000}, {5 * mm, -30000}}, {{1, 3, true}, {1, 4, true}}) == Printed{1, 0, 1});
    CHECK(printed({{5 * mm, 30000}, {5 * mm, -70000}}, {{1, 3, true}, {1, 4, true}}) == Printed{0, 0, 3});
}

TEST_CASE("a branch that begins on a track is no dot, however short; what begins a width away or alone may be") {
    const auto on_track = [](Unit reach, bool first_layer) {
        const LayerPlan plan = plan_of(
            forest_of({{0, 0}, {5 * mm, 0}, {10 * mm, 0}, {5 * mm, reach}}, {{0, 1}, {1, 2}, {1, 3, first_layer}}));
        REQUIRE(plan.tracks.size() == 2);
        CHECK_FALSE(plan.tracks[0].paths.front().on_track);
        return plan.tracks[1].paths.front().on_track;
    };
    CHECK(on_track(1000, true));
    CHECK_FALSE(on_track(41000, false));
}

TEST_CASE("the gap is measured along a bent branch") {
    const auto paths = planned(forest_of(
        {{0, 0}, {5 * mm, 0}, {10 * mm, 0}, {5 * mm, 30000}, {6 * mm, 30000}}, {{0, 1}, {1, 2}, {1, 3}, {3, 4}}));
    REQUIRE(paths.size() == 2);
    CHECK(paths[1] == std::vector<Point>{{5 * mm + 10000, 30000}, {6 * mm, 30000}});
}

TEST_CASE("a branch from a junction inside a gap starts one width from the nearest printed centre line") {
    const SupportForest forest =
        forest_of({{0, 0}, {5 * mm, 0}, {10 * mm, 0}, {5 * mm, 15000}, {5 * mm, 4 * mm}, {6 * mm, 15000}},
                  {{0, 1}, {1, 2}, {1, 3}, {3, 4}, {3, 5}});
    const auto paths = planned(forest);
    REQUIRE(paths.size() == 3);
    CHECK(paths[1].front() == Point{5 * mm, 40000});
    CHECK(paths[2].front() == Point{5 * mm + 25000, 15000});
    CHECK(support_paths(forest).gap_length == 65000);
}

TEST_CASE("the trunk takes the longest way; ties go straight, then to the smaller index") {
    const auto trunk = [](const std::vector<Point>& vertices, const std::vector<EdgeOf>& edges) {
        return planned(forest_of(vertices, edges))[0].back();
    };
    const Point left{5 * mm, 5 * mm}, right{5 * mm, -5 * mm}, ahead{10 * mm, 0}, far{5 * mm, 6 * mm};
    CHECK(trunk({{0, 0}, {5 * mm, 0}, ahead, far}, {{0, 1}, {1, 2}, {1, 3}}) == far);
    CHECK(trunk({{0, 0}, {5 * mm, 0}, left, ahead, right}, {{0, 1}, {1, 2}, {1, 3}, {1, 4}}) == ahead);
    CHECK(trunk({{0, 0}, {5 * mm, 0}, left, right}, {{0, 1}, {1, 3}, {1, 2}}) == left);
    CHECK(trunk({{0, 0}, {5 * mm, 0}, right, left}, {{0, 1}, {1, 3}, {1, 2}}) == right);
}

TEST_CASE("a tree with several roots starts at the first and ends at the others") {
    SupportForest forest = forest_of({{0, 0}, {5 * mm, 0}, {10 * mm, 0}}, {{0, 1}, {1, 2}});
    forest[2].root = true;
    CHECK(planned(forest) == std::vector<std::vector<Point>>{{{0, 0}, {5 * mm, 0}, {10 * mm, 0}}});
}

TEST_CASE("several branches of one root: the first starts at it, the next one width away") {
    CHECK(planned(forest_of({{0, 0}, {0, 5 * mm}, {3 * mm, 0}}, {{0, 1}, {0, 2}})) ==
          std::vector<std::vector<Point>>{{{0, 0}, {0, 5 * mm}}, {{40000, 0}, {3 * mm, 0}}});
}

TEST_CASE("by default one path runs through a root of several walls, from the tip of the second longest way") {
    using Paths = std::vector<std::vector<Point>>;
    const auto plan = [](const std::vector<EdgeOf>& edges) {
        std::vector<Point> star{{0, 0}, {0, 5 * mm}, {3 * mm, 0}, {-2 * mm, 0}, {3 * mm, 2 * mm}};
        star.resize(edges.size() + 1);
        return plan_of(forest_of(star, edges), Gaps::proved);
    };
    const auto paths = [](const LayerPlan& plan) {
        Paths all;
        for (const PlannedTrack& track : plan.tracks) all.push_back(track.paths.at(0).points);
        return all;
    };
    const LayerPlan three = plan({{0, 1}, {0, 2}, {0, 3}});
    CHECK(paths(three) == Paths{{{3 * mm, 0}, {0, 0}, {0, 5 * mm}}, {{-40000, 0}, {-2 * mm, 0}}});
    CHECK(three.tracks[0].entry == Entry::either_end);
    CHECK(three.tracks[1].after == 0);
    CHECK(three.gaps == 1);
    // What leaves it is left aside on both sides of the root.
    const LayerPlan forked = plan({{0, 1}, {0, 2}, {2, 4}, {2, 3}});
    CHECK(paths(forked) ==
          Paths{{{0, 5 * mm}, {0, 0}, {3 * mm, 0}, {-2 * mm, 0}}, {{3 * mm, 40000}, {3 * mm, 2 * mm}}});
    CHECK(forked.tracks[1].after == 0);
    // A way on its first layer comes second; of two such each has its own path, from the root.
    const LayerPlan one_new = plan({{0, 1}, {0, 2, true}});
    CHECK(paths(one_new) == Paths{{{0, 5 * mm}, {0, 0}, {3 * mm, 0}}});
    CHECK(one_new.tracks[0].entry == Entry::fixed);
    const LayerPlan both_new = plan({{0, 1, true}, {0, 2, true}});
    CHECK(paths(both_new) == Paths{{{0, 0}, {0, 5 * mm}}, {{0, 0}, {3 * mm, 0}}});
}

TEST_CASE("a path through a root takes a short third wall along, and does not bend past the root of a longer one") {
    const auto tracks = [](Unit third, Gaps gaps, const std::vector<EdgeOf>& more = {}) {
        std::vector<Point> vertices{{0, 0}, {20000, 0}, {5 * mm, 0}, {-5 * mm, 0}, {0, third}};
        std::vector<EdgeOf> edges{{0, 1}, {1, 2}, {0, 3}, {0, 4, true}};
        for (const EdgeOf& e : more) vertices.push_back({20000, 30000}), edges.push_back(e);
        return planned(forest_of(vertices, edges), gaps);
    };
    const auto passes = [](const std::vector<Point>& path, Point p) {
        return std::find(path.begin(), path.end(), p) != path.end();
    };
    CHECK(tracks(-30000, Gaps::none).size() == 2);
    CHECK(passes(tracks(-30000, Gaps::none).front(), {0, 0}));
    REQUIRE(tracks(-30000, Gaps::proved).size() == 1);
    CHECK(passes(tracks(-30000, Gaps::proved).front(), {0, -30000}));
    // Beside it, 0.2 mm away, a branch that is taken along.
    const auto beside = tracks(-3 * mm, Gaps::proved, {{1, 5, true}});
    REQUIRE(beside.size() == 2);
    CHECK(passes(beside.front(), {20000, 30000}));
    CHECK(passes(beside.front(), {0, 0}));
    CHECK(beside.back().front() == Point{0, 0});
}

TEST_CASE("paths through roots print the same walls with fewer tracks") {
    std::mt19937_64 random(88);
    int saved = 0;
    for (int round = 0; round < 40; ++round) {
        const SupportForest forest = random_forest(random, 1 + round % 5, 5 + round, mm, 5 * mm, 0.2);
        const LayerPlan paper = plan_of(forest), proved = plan_of(forest, Gaps::proved);
        const auto track = [](const LayerPlan& plan) {
            double sum = 0;
            for (const PlannedTrack& t : plan.tracks) sum += length(t.paths.at(0));
            return sum + static_cast<double>(plan.gap_length);
        };
        CHECK(track(proved) == Approx(length(forest)).margin(2 * proved.gaps + 1));
        CHECK(track(paper) == Approx(length(forest)).margin(2 * paper.gaps + 1));
        REQUIRE(proved.tracks.size() <= paper.tracks.size());
        saved += static_cast<int>(paper.tracks.size() - proved.tracks.size());
        for (std::size_t t = 0; t < proved.tracks.size(); ++t)
            CHECK((proved.tracks[t].after == no_stop || proved.tracks[t].after < t));
    }
    CHECK(saved > 40);
}

TEST_CASE("trees follow each other without going back and forth") {
    SupportForest forest(6);
    for (std::size_t i = 0; i < 6; ++i) {
        const Unit x = std::array<Unit, 6>{9, 9, 1, 1, 4, 4}[i] * mm;
        forest[i] = {{x, i % 2 ? 2 * mm : 0}, i % 2 == 0};
        if (i % 2) add_edge(i - 1, i, forest);
    }
    const LayerPaths layer = support_paths(forest);
    REQUIRE(layer.paths.size() == 3);
    double travel = 0;
    for (std::size_t i = 1; i < 3; ++i)
        travel += length(layer.paths[i].points.front() - layer.paths[i - 1].points.back());
    CHECK(travel == 8 * mm);  // 1, 4, 9 or back, up one tree and down the next
}

TEST_CASE("an isolated root is a dot, taken in its turn") {
    SupportForest forest = forest_of({{9 * mm, 0}, {5 * mm, 0}, {6 * mm, 0}}, {{1, 2}});
    forest[1].root = true;
    const LayerPaths layer = support_paths(forest);
    REQUIRE(layer.paths.size() == 2);
    CHECK(std::count_if(layer.paths.begin(), layer.paths.end(),
                        [](const ToolPath& p) { return p.points.size() == 1; }) == 1);
}

namespace {

/// The area of the material of one path that lies in that of another: polygons with 256 corners around every disc, so
/// it is never smaller than the true area.
double overlap(const ToolPath& a, const ToolPath& b) {
    const auto material = [](const ToolPath& path) {
        Region region;
        for (const Segment& s : segments(path)) {
            Contour stadium;
            const double turn = std::atan2(static_cast<double>(s.b.y - s.a.y), static_cast<double>(s.b.x - s.a.x));
            const double pi = 3.14159265358979, r = static_cast<double>(path.width) / 2 / std::cos(pi / 256);
            for (int k = 0; k < 256; ++k) {
                const double angle = turn + pi / 2 + (k + 0.5) * pi / 128;
                const Point centre = k < 128 ? s.a : s.b;
                stadium.push_back(centre +
                                  Point{round_to_lattice(r * std::cos(angle)), round_to_lattice(r * std::sin(angle))});
            }
            region.push_back(std::move(stadium));
        }
        return region;
    };
    return signed_area(clip(ClipperLib::ctIntersection, material(a), material(b)));
}

}  // namespace

TEST_CASE("a branch overlaps its trunk by no more area than stopping one width short of it allows") {
    const double w = static_cast<double>(nozzle);
    for (int degrees = 30; degrees <= 150; degrees += 10) {
        const double angle = degrees * 3.14159265358979 / 180;
        const Point tip{5 * mm + round_to_lattice(4 * mm * std::cos(angle)),
                        round_to_lattice(4 * mm * std::sin(angle))};
        const auto paths = [&](bool first_layer) {
            return support_paths(
                       forest_of({{0, 0}, {5 * mm, 0}, {11 * mm, 0}, tip}, {{0, 1}, {1, 2}, {1, 3, first_layer}}))
                .paths;
        };
        const auto later = paths(false), first = paths(true);
        REQUIRE(later.size() == 2);
        // Side by side the two leave the junction at this angle: what they share lies between the branch's end, w along
        // it, and where their sides part, (w / 2) / tan(angle / 2) along it, never wider than w.
        const double steep = std::min(angle, 3.14159265358979 - angle);
        const double parting = w / 2 / std::tan(steep / 2);
        const double allowed = std::max(0.0, parting - w / 2) * w;
        INFO(degrees << " degrees: " << overlap(later[0], later[1]) / (w * w) << " w2, allowed " << allowed / (w * w));
        CHECK(overlap(later[0], later[1]) <= allowed + 0.001 * w * w);
        // On its first layer it reaches the junction, half of its end on the trunk.
        CHECK(overlap(first[0], first[1]) >= w * w / 2);
        CHECK(overlap(first[0], first[1]) <= allowed + 2.5 * w * w);
    }
}

TEST_CASE("an empty forest has no paths; an edge of no length is no path and no gap") {
    CHECK(support_paths(SupportForest{}).paths.empty());
    const LayerPaths layer =
        support_paths(forest_of({{0, 0}, {mm, 0}, {mm, 0}, {2 * mm, 0}}, {{0, 1}, {1, 2}, {1, 3}}));
    CHECK(layer.paths.size() == 1);
    CHECK(layer.gaps == 0);
}

TEST_CASE("a cycle, a doubled edge and a tree without root are refused with layer and place") {
    LayerPlan layer;
    layer.layer = 12;
    const auto refused = [&](const SupportForest& forest, const char* what) {
        CHECK_THROWS_WITH(append_support_paths(forest, Settings{}, layer),
                          Catch::Contains("layer 12") && Catch::Contains(what) && Catch::Contains("1.0"));
    };
    refused(forest_of({{0, 0}, {mm, 0}, {mm, mm}}, {{0, 1}, {1, 2}, {2, 0}}), "cycle");
    refused(forest_of({{0, 0}, {mm, 0}}, {{0, 1}, {0, 1}}), "cycle");
    SupportForest rootless = forest_of({{0, mm}, {mm, 0}}, {{0, 1}});
    rootless[0].root = false;
    refused(rootless, "no root");
    SupportForest isolated(1);
    isolated[0].at = {mm, mm};
    refused(isolated, "no root");
}
