#include "ribvault/print/medial_tracks.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

using namespace ribvault;

namespace {
constexpr Unit d = 40000;
}

TEST_CASE("medial tracks: a place too narrow for a track has none") {
    CHECK(medial_tracks({{{0, 0}, {400000, 0}, {400000, 50}, {0, 50}}}, d, TrackKind::cover).empty());
    CHECK(medial_tracks({}, d, TrackKind::cover).empty());
}

TEST_CASE("medial tracks: a place that grows too wide for a track has one up to there") {
    // From d / 4 to 2 d wide along one edge of the axis.
    const Region wedge{{{0, -5000}, {400000, -40000}, {400000, 40000}, {0, 5000}}};
    const std::vector<PlannedTrack> tracks = medial_tracks(wedge, d, TrackKind::cover);
    REQUIRE(tracks.size() == 1);
    Unit from = 400000, to = 0, narrowest = d, widest = d;
    for (const ToolPath& path : tracks[0].paths) {
        narrowest = std::min(narrowest, path.width), widest = std::max(widest, path.width);
        for (Point p : path.points) from = std::min(from, p.x), to = std::max(to, p.x);
    }
    CHECK(narrowest == d / 2);
    CHECK(widest >= 3 * d / 2 - d / 10);
    // Half its width is 5000 + 0.0875 x; the disc that touches both sides is hardly smaller.
    CHECK(std::abs(from - 57000) < 1000);
    CHECK(std::abs(to - 287000) < 2000);
}

TEST_CASE("medial tracks: an axis whose branches are all short is a track along the longest") {
    // Narrow on the left; on the right a corner, and another on the way to it.
    const Region strip{
        {{0, 0}, {17300, 11500}, {69000, 42200}, {108500, 63400}, {80000, 108000}, {57100, 108000}, {-22900, 28000}}};
    double along = 0;
    for (const PlannedTrack& track : medial_tracks(strip, 2 * d, TrackKind::cover))
        for (const ToolPath& path : track.paths) along += length(path);
    CHECK(along > 2 * d);
}
