// Paths as segments.
#include "ribvault/print/tool_path.hpp"

#include <catch2/catch.hpp>

using namespace ribvault;

namespace {

/// The ends of the segments, one after the other.
std::vector<Point> ends(bool closed, std::vector<Point> points) {
    std::vector<Segment> segments;
    append_segments({TrackKind::support, 40000, closed, std::move(points)}, segments);
    std::vector<Point> ends;
    for (const Segment& s : segments) ends.insert(ends.end(), {s.a, s.b});
    return ends;
}

}  // namespace

TEST_CASE("a path is as many segments as it has steps, a ring one more, a dot one of no length") {
    const Point a{0, 0}, b{10, 0}, c{10, 10};
    CHECK(ends(false, {a, b, c}) == std::vector<Point>{a, b, b, c});
    CHECK(ends(true, {a, b, c}) == std::vector<Point>{a, b, b, c, c, a});
    for (const bool closed : {false, true}) {
        CHECK(ends(closed, {a}) == std::vector<Point>{a, a});
        CHECK(ends(closed, {}).empty());
    }
}
