#include "ribvault/report/boundary_path.hpp"

#include <algorithm>
#include <catch2/catch.hpp>

#include "ribvault/verify/verify_printed.hpp"

using namespace ribvault;

namespace {

PrintedTrack track(Rational ax, Rational ay, Rational bx, Rational by) {
    return {{ax, ay}, {bx, by}, Rational(2, 5), 0, 1, false};
}

RegionBoundary boundary_of(std::vector<PrintedTrack> above, std::vector<PrintedTrack> below) {
    const PrintedVerdict verdict = verify_printed({std::move(above)}, {std::move(below)}, Rational(1, 5));
    REQUIRE(verdict.regions.size() == 1);
    return verdict.regions.front().boundary;
}

}  // namespace

TEST_CASE("a dot in the air is a circle of three arcs") {
    const RegionBoundary boundary = boundary_of({track(1, 2, 1, 2)}, {});
    CHECK(boundary_data(boundary, YAxis::up) == "M1.2 2A.2 .2 0 0 1 .9 2.173A.2 .2 0 0 1 .9 1.827A.2 .2 0 0 1 1.2 2Z");
    CHECK(boundary_data(boundary, YAxis::down) ==
          "M1.2 -2A.2 .2 0 0 0 .9 -2.173A.2 .2 0 0 0 .9 -1.827A.2 .2 0 0 0 1.2 -2Z");
}

TEST_CASE("a track in the air is two lines and two half circles") {
    const std::string data = boundary_data(boundary_of({track(0, 0, 3, 0)}, {}), YAxis::up);
    CHECK(std::count(data.begin(), data.end(), 'L') == 2);
    CHECK(std::count(data.begin(), data.end(), 'A') == 4);  // each half circle in two
    CHECK(std::count(data.begin(), data.end(), 'Z') == 1);
    CHECK(data.find("L3 -.2") != std::string::npos);
}

TEST_CASE("what hangs over an end is bounded by the dilated end, run through the other way round") {
    // The track below ends at x = 1; dilated its end is a circle of radius 0.4, inside of which nothing hangs.
    const std::string data = boundary_data(boundary_of({track(0, 0, 3, 0)}, {track(0, 0, 1, 0)}), YAxis::up);
    CHECK(data.find("A.4 .4 0 0 0 ") != std::string::npos);
    CHECK(data.find("A.2 .2 0 0 1 ") != std::string::npos);
}

TEST_CASE("a region smaller than the picture's numbers leaves a path all the same") {
    const std::string data = boundary_data(
        boundary_of({track(0, 0, Rational(1, 1000000), 0)}, {track(Rational(-2, 10), 0, Rational(-2, 10), 0)}),
        YAxis::up);
    CHECK(data.front() == 'M');
    CHECK(data.back() == 'Z');
}
