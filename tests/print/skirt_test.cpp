#include <catch2/catch.hpp>

#include "print/geometry.hpp"
#include "ribvault/print/skirt.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {
constexpr Unit mm = units_per_mm;
const Region two{{{0, 0}, {10 * mm, 0}, {10 * mm, 10 * mm}, {0, 10 * mm}},
                 {{4 * mm, 4 * mm}, {4 * mm, 6 * mm}, {6 * mm, 6 * mm}, {6 * mm, 4 * mm}},
                 {{20 * mm, 0}, {25 * mm, 0}, {25 * mm, 5 * mm}, {20 * mm, 5 * mm}}};
}  // namespace

TEST_CASE("no skirt and no brim unless asked for") {
    CHECK(skirt_and_brim(two, {}, {}).empty());
    CHECK(reach_of_skirt_and_brim({}, {}) == 0);
}

TEST_CASE("brim: loops around every island from the outside in, the last touches it, none in holes") {
    TrackSettings tracks;
    tracks.brim_width = 2 * mm;
    const std::vector<ToolPath> brim = skirt_and_brim(two, {}, tracks);
    CHECK(brim.size() == 10);  // five loops, two islands
    for (const ToolPath& loop : brim) {
        CHECK(loop.kind == TrackKind::skirt);
        const double far = distance(segments(loop), segments(two));
        const double k = std::round(far / 40000 - 0.5);
        CHECK(std::abs(far - (k + 0.5) * 40000) < 1100);  // arcs in steps of 10 micrometres
        for (Point p : loop.points) CHECK(winding_number(two, p) == 0);
    }
    CHECK(distance(segments(brim.back()), segments(two)) < 20100);
    CHECK(reach_of_skirt_and_brim({}, tracks) == 2 * mm);
}

TEST_CASE("a brim narrower than half a track is one loop; loops around a fine outline have no fine chords") {
    TrackSettings tracks;
    tracks.brim_width = 100;
    CHECK(skirt_and_brim(two, {}, tracks).size() == 2);
    CHECK(reach_of_skirt_and_brim({}, tracks) == 40000);
    Contour round;
    for (int k = 0; k < 6000; ++k)  // chords of 10 µm
        round.push_back({round_to_lattice(10 * mm * std::cos(k * std::acos(-1.0) / 3000)),
                         round_to_lattice(10 * mm * std::sin(k * std::acos(-1.0) / 3000))});
    const std::vector<ToolPath> loops = skirt_and_brim({round}, {}, tracks);
    REQUIRE(loops.size() == 1);
    CHECK(loops[0].points.size() < 200);
    CHECK(std::abs(length(loops[0]) / mm - 20.4 * std::acos(-1.0)) < 0.05);
    for (Point p : loops[0].points) CHECK(std::abs(std::hypot(p.x, p.y) - 1020000) < 1100);
}

TEST_CASE("skirt: loops around everything at its distance") {
    TrackSettings tracks;
    tracks.skirt_loops = 2;
    const std::vector<ToolPath> skirt = skirt_and_brim(two, {}, tracks);
    REQUIRE(skirt.size() == 2);
    CHECK(std::abs(distance(segments(skirt[1]), segments(two)) - 320000) < 1100);
    CHECK(std::abs(distance(segments(skirt[0]), segments(two)) - 360000) < 1100);
    CHECK(reach_of_skirt_and_brim({}, tracks) == 380000);
    for (Point p : {Point{mm, mm}, Point{22 * mm, mm}}) CHECK(winding_number({skirt[1].points}, p) == 1);
}
