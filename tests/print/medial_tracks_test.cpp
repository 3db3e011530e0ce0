#include "ribvault/print/medial_tracks.hpp"

#include <catch2/catch.hpp>

using namespace ribvault;

namespace {
constexpr Unit d = 40000;
}

TEST_CASE("medial tracks: a border with vertices a lattice unit off its lines gives one straight track") {
    Contour rough;
    for (Unit x = 0; x < 400000; x += 10000) rough.push_back({x, x / 10000 % 2});
    for (Unit x = 400000; x > 0; x -= 10000) rough.push_back({x, 32000 + x / 10000 % 2});
    rough.push_back({0, 32000});
    const std::vector<PlannedTrack> tracks = medial_tracks({rough}, d, TrackKind::thin_wall);
    REQUIRE(tracks.size() == 1);
    for (const ToolPath& path : tracks[0].paths) CHECK(path.points.size() <= 3);
}

TEST_CASE("medial tracks: what is narrower than the dropped vertices has none") {
    CHECK(medial_tracks({{{0, 0}, {400000, 0}, {400000, 50}, {0, 50}}}, d, TrackKind::cover).empty());
    CHECK(medial_tracks({}, d, TrackKind::cover).empty());
}
