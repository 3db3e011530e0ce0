#include "ribvault/print/medial_tracks.hpp"

#include <catch2/catch.hpp>

using namespace ribvault;

namespace {
constexpr Unit d = 40000;
}

TEST_CASE("medial tracks: a place too narrow for a track has none") {
    CHECK(medial_tracks({{{0, 0}, {400000, 0}, {400000, 50}, {0, 50}}}, d, TrackKind::cover).empty());
    CHECK(medial_tracks({}, d, TrackKind::cover).empty());
}
