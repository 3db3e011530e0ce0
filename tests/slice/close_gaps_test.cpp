// Open contours: closed over gaps up to max_gap, refused beyond it, with layer and place.
#include "ribvault/slice/close_gaps.hpp"

#include <catch2/catch.hpp>

#include "exact_areas.hpp"
#include "ribvault/error.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

constexpr Unit mm = units_per_mm;

/// A cube of 10 mm whose side at x = 10 stands off by `gap` on layers of 0.2 mm: two gaps on each.
Mesh loose_side(double gap, double x = 10) {
    std::vector<Triangle> triangles;
    for (Triangle t : box({x - 10, 0, 0}, {x, 10, 10})) {
        const bool side = t[0][0] == x && t[1][0] == x && t[2][0] == x;
        if (side)
            for (Corner& c : t) c[0] += gap;
        triangles.push_back(t);
    }
    return weld(triangles);
}

Settings gaps_up_to(const char* length) {
    Settings settings = layers_of("0.2");
    settings.max_gap = parse_length(length, "");
    return settings;
}

template <class Call>
std::string refusal(const Call& call) {
    try {
        call();
    } catch (const Error& error) {
        CHECK(error.kind() == ErrorKind::bad_geometry);
        return error.what();
    }
    return "accepted";
}

}  // namespace

TEST_CASE("gaps below max-gap are closed and reported with layer, place and length") {
    const Mesh mesh = loose_side(0.03125);
    const Slicer slicer(mesh, Placement{}, gaps_up_to("0.05"));
    std::vector<GapClosing> closings;
    const Slice slice = slicer.slice(17, &closings);
    CHECK(area_of(*slice.exact) == 100 + Rational(5, 16));
    REQUIRE(closings.size() == 2);
    for (const GapClosing& gap : closings) {
        CHECK(gap.layer == 17);
        CHECK(gap.length == 0.03125);
        CHECK((gap.x == 10 || gap.x == 10.03125));
        CHECK((gap.y == 0 || gap.y == 10));
    }
    CHECK(closings[0].y != closings[1].y);
    CHECK(slicer.open_gaps(17).empty());
    CHECK_NOTHROW(require_closed_contours(slicer, gaps_up_to("0.05")));
}

TEST_CASE("a gap of exactly max-gap is closed, a wider one is not") {
    const Mesh mesh = loose_side(0.03125);
    CHECK(area_of(*Slicer(mesh, Placement{}, gaps_up_to("0.03125")).slice(3).exact) == 100 + Rational(5, 16));
    CHECK(refusal([&] { Slicer(mesh, Placement{}, gaps_up_to("0.03124")).slice(3); }) != "accepted");
    const Mesh closed = loose_side(0);
    std::vector<GapClosing> closings;
    CHECK(area_of(*Slicer(closed, Placement{}, gaps_up_to("0")).slice(3, &closings).exact) == 100);
    CHECK(closings.empty());
}

TEST_CASE("wider gaps are refused, naming number, width, layer and place, and what to do") {
    const Mesh mesh = loose_side(0.25);
    const Settings settings = gaps_up_to("0.05");
    const Slicer slicer(mesh, Placement{}, settings);
    const std::string one = refusal([&] { slicer.slice(17); });
    INFO(one);
    for (const char* part :
         {"2 gaps wider than 0.05 mm on layer 17", "0.25 mm wide on layer 17 at (10", "0) mm", "--max-gap"})
        CHECK(one.find(part) != std::string::npos);
    const std::string all = refusal([&] { require_closed_contours(slicer, settings); });
    INFO(all);
    for (const char* part :
         {"100 gaps wider than 0.05 mm on all layers together", "0.25 mm wide on layer 0 at (", "; ..."})
        CHECK(all.find(part) != std::string::npos);
    const std::vector<GapClosing> open = slicer.open_gaps(5);
    REQUIRE(open.size() == 2);
    CHECK(open[0].length == 0.25);
    CHECK(open[0].layer == 5);
}

TEST_CASE("the worst gaps are named first") {
    const Mesh far = loose_side(0.25), near = loose_side(0.5, 40);
    Mesh both;
    both.vertices.resize(3, far.vertices.cols() + near.vertices.cols());
    both.vertices << far.vertices, near.vertices;
    both.triangles.resize(3, far.triangles.cols() + near.triangles.cols());
    both.triangles << far.triangles, (near.triangles.array() + static_cast<int>(far.vertices.cols())).matrix();
    const std::string text = refusal([&] { Slicer(both, Placement{}, gaps_up_to("0.05")).slice(2); });
    INFO(text);
    CHECK(text.find("4 gaps") != std::string::npos);
    const std::size_t wide = text.find("0.5 mm wide"), less = text.find("0.25 mm wide");
    CHECK(wide < less);
    CHECK(less != std::string::npos);
}

TEST_CASE("chains are joined at their nearest ends first, a tie of 3-4-5 included") {
    // An end at the origin, 5 units of length from one start and 6 from another.
    const auto p = [](int x, int y) { return ExactPoint(x, y); };
    const std::vector<ExactContour> chains{
        {p(100, 0), p(50, 50), p(0, 0)}, {p(3, 4), p(60, 60), p(100, 3)}, {p(0, 6), p(200, 200)}};
    const ClosedGaps five = close_gaps(chains, 7, 5 * mm);
    REQUIRE(five.contours.size() == 1);
    CHECK(five.contours[0].size() == 6);
    REQUIRE(five.closings.size() == 2);
    CHECK(five.closings[0].length == 3);
    CHECK(five.closings[1].length == 5);
    CHECK(five.closings[1].layer == 7);
    CHECK(five.closings[1].x == 0);
    REQUIRE(five.open.size() == 1);
    CHECK(five.open[0].x == 200);
    CHECK(five.open[0].length == Approx(std::hypot(200, 194)));

    const ClosedGaps less = close_gaps(chains, 7, 5 * mm - 1);
    CHECK(less.contours.empty());
    CHECK(less.closings.size() == 1);
    CHECK(less.open.size() == 2);
    CHECK(close_gaps({}, 0, mm).contours.empty());
}

TEST_CASE("a chain whose ends meet or nearly meet is closed with itself, in its direction") {
    const auto p = [](int x, int y) { return ExactPoint(x, y); };
    const ClosedGaps itself = close_gaps({{p(0, 0), p(9, 0), p(9, 9), p(0, 1)}}, 0, mm);
    REQUIRE(itself.contours.size() == 1);
    CHECK(itself.contours[0].front() == p(0, 0));
    CHECK(itself.closings.size() == 1);
    CHECK(itself.open.empty());
    // Where they meet nothing is closed.
    const ClosedGaps met = close_gaps({{p(0, 0), p(9, 0), p(9, 9), p(0, 0)}}, 0, mm);
    CHECK(met.contours.size() == 1);
    CHECK(met.closings.empty());
    CHECK(met.open.empty());
    // Two starts at one place: material lies to the left of both chains, so they cannot follow one another.
    const ClosedGaps apart = close_gaps({{p(0, 0), p(9, 0)}, {p(0, 0), p(0, 9)}}, 0, mm);
    CHECK(apart.contours.empty());
    CHECK(apart.open.size() == 2);
}
