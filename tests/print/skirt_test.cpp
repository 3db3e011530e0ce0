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

TEST_CASE("where islands are too near for a loop of each, one brim track of its own width runs between them") {
    TrackSettings tracks;
    tracks.brim_width = 4 * mm;
    const auto island = [](Unit x) -> Contour {
        return {{x, 0}, {x + 6 * mm, 0}, {x + 6 * mm, 12 * mm}, {x, 12 * mm}};
    };
    for (const Unit gap : {30000, 45000, 50000, 60000, 90000, 130000, 210000}) {
        double printed = 0;
        const std::vector<ToolPath> brim = skirt_and_brim({island(0), island(6 * mm + gap)}, {}, tracks);
        for (const ToolPath& path : brim)
            for (const Segment& s : segments(path)) {
                if (std::min(s.a.x, s.b.x) < 6 * mm || std::max(s.a.x, s.b.x) > 6 * mm + gap) continue;
                const auto [lo, hi] = std::minmax(s.a.y, s.b.y);
                const Unit along = std::min(hi, 10 * mm) - std::max(lo, 2 * mm);
                printed += static_cast<double>(std::max<Unit>(0, along)) * static_cast<double>(path.width);
            }
        const double share = printed / static_cast<double>(8 * mm * gap);
        INFO("gap " << gap << ": " << share << " of the room between the islands");
        CHECK(share <= 1);
        CHECK(share > 0.85);
    }
    // A slot of an island is no gap.
    Contour plate{{0, 0}, {10 * mm, 0}, {10 * mm, 10 * mm}, {0, 10 * mm}};
    const Contour slot{{2 * mm, 2 * mm}, {2 * mm, 8 * mm}, {250000, 8 * mm}, {250000, 2 * mm}};
    CHECK(skirt_and_brim({plate, slot}, {}, tracks).size() == 10);
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

TEST_CASE("a skirt keeps its distance from the brim, and goes around supports that stand beside the object") {
    TrackSettings tracks;
    tracks.skirt_loops = 1, tracks.brim_width = 2 * mm;
    const auto skirt = [&](const std::vector<Segment>& supports) {
        return skirt_and_brim(two, {}, tracks, supports).front();
    };
    CHECK(std::abs(distance(segments(skirt({})), segments(two)) - (200000 + 320000)) < 1100);
    CHECK(reach_of_skirt_and_brim({}, tracks) == 200000 + 340000);
    const Point far{-30 * mm, 5 * mm};
    CHECK(winding_number({skirt({}).points}, far) == 0);
    const ToolPath around = skirt({{far, far + Point{0, mm}}});
    CHECK(winding_number({around.points}, far) == 1);
    // Half a track of the support, the brim, the distance and half a track of the skirt.
    CHECK(std::abs(distance(segments(around), std::vector<Segment>{{far, far + Point{0, mm}}}) -
                   (20000 + 200000 + 320000)) < 1100);
}
