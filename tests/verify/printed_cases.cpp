// Ties and near ties of equations (1) and (2) for printed layers, one by one, each with the stage that must decide it.
#include <catch2/catch.hpp>
#include <cmath>
#include <thread>

#include "printed_layers.hpp"
#include "ribvault/error.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

const Rational rho = q("1/5"), w = q("2/5");

enum Stage { intervals, rationals, algebraic_numbers };
Stage stage(const PrintedVerdict& v) {
    return v.stages.algebraic > 0 ? algebraic_numbers : v.stages.rational > 0 ? rationals : intervals;
}

PrintedVerdict verify(const PrintedLayer& upper, const PrintedLayer& lower, const Rational& r = rho) {
    const PrintedVerdict v = verify_printed(upper, lower, r);
    REQUIRE(v.supported == v.regions.empty());
    REQUIRE(v.centre_lines_supported == v.pieces.empty());
    for (const UnsupportedRegion& region : v.regions) {
        CHECK(region.witness_certified);
        CHECK(is_witness(region.witness, upper, lower, r));
        CHECK(region.witness_distance <= region.distance_hi);
        CHECK(region.distance_hi >= r.get_d());
        CHECK(region.distance_lo <= region.distance_hi);
        CHECK(region.area_lo <= region.area_hi);
        CHECK(region.area_hi > 0);
    }
    for (const UnsupportedPiece& p : v.pieces) {
        CHECK(p.from_mm <= p.to_mm);
        CHECK(p.distance_lo >= r.get_d());
        CHECK(p.distance_lo <= p.distance_hi);
    }
    return v;
}
/// (1) holds and (2) too.
void supported(const PrintedVerdict& v, Stage expected) {
    CHECK(v.centre_lines_supported);
    CHECK(v.supported);
    CHECK(stage(v) == expected);
}
/// (1) holds, (2) does not.
void overhangs(const PrintedVerdict& v, Stage expected) {
    CHECK(v.centre_lines_supported);
    CHECK(!v.supported);
    CHECK(stage(v) == expected);
}
void unsupported(const PrintedVerdict& v, Stage expected) {
    CHECK(!v.centre_lines_supported);
    CHECK(!v.supported);
    CHECK(stage(v) == expected);
}

}  // namespace

TEST_CASE("printed: a track end at distance exactly 1/5 is supported, moved by 10^-30 it is not") {
    // 3/25 and 4/25 are no binary floats: (3/25)^2 + (4/25)^2 = (1/5)^2 needs rationals. Off the tie, the round end of
    // the track crosses the one below at irrational points.
    const PrintedLayer below = printed({track(0, 0, -2, 0, w)});
    const auto above = [](const Rational& by) {
        return printed({track(Rational(q("3/25") + by), q("4/25"), q("-1"), q("1/10"), w)});
    };
    supported(verify(above(0), below), rationals);
    const PrintedVerdict v = verify(above(tiny(30)), below);
    CHECK(!v.supported);
    CHECK(v.centre_lines_supported);  // the centre line is within w/2 + ρ
    CHECK(stage(v) == algebraic_numbers);
    REQUIRE(v.regions.size() == 1);

    // The same for the centre line: the end at distance exactly w/2 + ρ = 2/5.
    const auto centre = [](const Rational& by) {
        return printed({track(Rational(q("6/25") + by), q("8/25"), q("-1"), q("1/10"), w)});
    };
    const PrintedVerdict tie = verify(centre(0), below), over = verify(centre(tiny(30)), below);
    CHECK(tie.centre_lines_supported);
    CHECK(tie.unsupported_length[0][1] == 0);
    CHECK(!over.centre_lines_supported);
    REQUIRE(over.pieces.size() == 1);
    CHECK(over.pieces[0].from_mm == 0);
    // Along the track, the angle between which and the radius has the cosine (3/5) cos + ..., about 10^-30 of length.
    CHECK(over.unsupported_length[0][0] > 1e-31);
    CHECK(over.unsupported_length[0][1] < 1e-29);
    CHECK(over.unsupported_length[0][1] <= over.unsupported_length[0][0] * (1 + 1e-8));
}

TEST_CASE("printed: three stadiums that meet in one point cover it, and miss it by 10^-40 without covering") {
    // Dilated discs of radius 2/5 about (2/5, 0) and (-6/25, +-8/25) pass through the origin from three sides.
    const auto below = [](const Rational& by) {
        return printed(
            {dot(Rational(q("2/5") + by), 0, w), dot(q("-6/25"), q("8/25"), w), dot(q("-6/25"), q("-8/25"), w)});
    };
    const PrintedLayer above = printed({dot(0, 0, q("1/20"))});
    supported(verify(above, below(0)), rationals);  // three ties at the dot's centre
    supported(verify(above, below(-tiny(40))), algebraic_numbers);
    const PrintedVerdict v = verify(above, below(tiny(40)));
    overhangs(v, algebraic_numbers);  // the origin itself is still on two circles
    REQUIRE(v.regions.size() == 1);
    // A dot beside it: its centre is held up with room to spare, the hole is inside its stadium.
    const PrintedLayer beside = printed({dot(q("1/100"), 0, q("1/20"))});
    supported(verify(beside, below(0)), intervals);
    overhangs(verify(beside, below(tiny(40))), algebraic_numbers);
}

TEST_CASE("printed: three slanted stadiums through one irrational point, and off it by 10^-40") {
    // Strips of half width 2/5 along (1, 1) and (1, -1), which meet at (x, 0), x = (2/5) root 2, and one disc of radius
    // 2/5 that reaches x exactly only for an irrational centre: a third track overlapping the first keeps the tie.
    const PrintedTrack up = track(-3, -3, 3, 3, w), down = track(-3, 3, 3, -3, w);
    const PrintedLayer above = printed({track(0, 0, q("1/4"), 0, q("1/5"))});
    supported(verify(above, printed({up, down, track(-2, -2, 5, 5, w)})), intervals);
    const PrintedLayer corner = printed({track(q("1/2"), 0, q("7/10"), 0, q("1/5"))});
    unsupported(verify(corner, printed({up, down, track(-2, -2, 5, 5, w)})), algebraic_numbers);
    // The dot that ends at the corner: its right end at (2/5) root 2 rounded down, then up, to 45 digits.
    mpz_class ten_45;
    mpz_ui_pow_ui(ten_45.get_mpz_t(), 10, 45);
    const mpz_class root_8 = sqrt(mpz_class(8 * ten_45 * ten_45));
    const Rational inside(root_8, mpz_class(5 * ten_45)), outside(mpz_class(root_8 + 1), mpz_class(5 * ten_45));
    const Rational half = q("1/10");
    const auto end_at = [&](const Rational& x) { return printed({dot(Rational(x - half), 0, Rational(2 * half))}); };
    CHECK(verify(end_at(inside), printed({up, down})).supported);
    const PrintedVerdict v = verify(end_at(outside), printed({up, down}));
    CHECK(!v.supported);
    CHECK(v.centre_lines_supported);
    REQUIRE(v.regions.size() == 1);
    CHECK(v.regions[0].area_hi < 1e-15);
}

TEST_CASE("printed: coincident, antiparallel and overlapping segments count once") {
    const std::vector<PrintedTrack> same{track(0, 0, 1, q("3/10"), w), track(1, q("3/10"), 0, 0, w),
                                         track(0, 0, 1, q("3/10"), w)};
    supported(verify(printed(same), printed(same)), intervals);
    supported(verify(printed(same), printed({same[1]})), intervals);
    const PrintedVerdict v = verify(printed(same), printed({track(0, 0, q("1/2"), q("3/20"), w), same[0]}));
    supported(v, intervals);
    // Half of it below: as much as w/2 + ρ beyond the end is held up. All three violate (1) by the same length.
    const PrintedVerdict half = verify(printed(same), printed({track(q("1/2"), q("3/20"), 0, 0, w)}));
    unsupported(half, algebraic_numbers);
    const double expected = std::sqrt(1.09) / 2 - 0.4;
    for (const auto& length : half.unsupported_length) {
        CHECK(length[0] <= expected * (1 + 1e-12));
        CHECK(length[1] >= expected * (1 - 1e-12));
        CHECK(length[1] - length[0] < 1e-9);
    }
    CHECK(half.regions.size() == 1);
}

TEST_CASE("printed: of many tracks each is judged, wherever it stands among them") {
    std::vector<PrintedTrack> rows;
    for (int k = 0; k < 700; ++k) rows.push_back(track(0, k, 1, k, w));
    for (const std::size_t missing : {0, 255, 256, 511, 512, 699}) {
        std::vector<PrintedTrack> below = rows;
        below.erase(below.begin() + static_cast<std::ptrdiff_t>(missing));
        const PrintedVerdict v = verify(printed(rows), printed(below));
        CHECK(!v.supported);
        for (std::size_t k = 0; k < rows.size(); ++k) CHECK((v.track_supported[k] != 0) == (k != missing));
        REQUIRE(v.pieces.size() == 1);
        CHECK(v.pieces[0].track == missing);
        REQUIRE(v.regions.size() == 1);
        CHECK(v.regions[0].tracks == std::vector<std::size_t>{missing});
    }
}

TEST_CASE("printed: tracks of length zero are dots") {
    const PrintedLayer below = printed({dot(0, 0, w)});
    supported(verify(below, below), intervals);
    supported(verify(printed({dot(q("3/25"), q("4/25"), w)}), below), rationals);
    overhangs(verify(printed({dot(q("3/25"), Rational(q("4/25") + tiny(30)), w)}), below), algebraic_numbers);
    const PrintedVerdict v = verify(printed({dot(q("6/25"), Rational(q("8/25") + tiny(30)), w)}), below);
    CHECK(!v.centre_lines_supported);
    REQUIRE(v.pieces.size() == 1);
    CHECK(v.pieces[0].from_mm == 0);
    CHECK(v.pieces[0].to_mm == 0);
    CHECK(v.unsupported_length[0][1] == 0);
    // Nothing below at all.
    const PrintedVerdict air = verify(below, printed({}));
    CHECK(!air.supported);
    REQUIRE(air.pieces.size() == 1);
    CHECK(std::isinf(air.pieces[0].distance_lo));
    CHECK(verify(printed({}), printed({})).supported);
}

TEST_CASE("printed: tangent arcs leave a cusp between them, however small") {
    // Discs of radius 2/5 about (-2/5, 0) and (2/5, 0) touch at the origin.
    const PrintedLayer touching = printed({dot(q("-2/5"), 0, w), dot(q("2/5"), 0, w)});
    overhangs(verify(printed({dot(0, 0, q("1/1000"))}), touching), rationals);  // the tie at the dot's centre
    const auto pressed = [](const Rational& by) {
        return printed({dot(Rational(q("-2/5") + by), 0, w), dot(Rational(q("2/5") - by), 0, w)});
    };
    supported(verify(printed({dot(0, 0, q("1/1000"))}), pressed(q("1/100000"))), intervals);
    // They overlap by 10^-30, so a dot of width 10^-15 lies in the lens of half height about 9 10^-16 ...
    CHECK(verify(printed({dot(0, 0, tiny(15))}), pressed(tiny(30))).supported);
    // ... and one of 10^-14 does not.
    CHECK(!verify(printed({dot(0, 0, tiny(14))}), pressed(tiny(30))).supported);
    // An arc of the material above inside one below of nearly the same radius, touching it: supported, then not.
    const PrintedLayer one = printed({dot(0, 0, w)});
    const auto inner = [](const Rational& by) {
        return printed({dot(Rational(tiny(20) + by), 0, Rational(q("4/5") - 2 * tiny(20)))});
    };
    supported(verify(inner(0), one), rationals);
    CHECK(!verify(inner(tiny(40)), one).supported);
}

TEST_CASE("printed: parallel tracks whose strips touch on a line cover it") {
    const PrintedLayer two = printed({track(-2, q("2/5"), 2, q("2/5"), w), track(2, q("-2/5"), -2, q("-2/5"), w)});
    const PrintedLayer between = printed({track(-1, 0, 1, 0, w)});
    supported(verify(between, two), rationals);
    const PrintedLayer apart =
        printed({track(-2, Rational(q("2/5") + tiny(30)), 2, Rational(q("2/5") + tiny(30)), w), two.tracks[1]});
    const PrintedVerdict v = verify(between, apart);
    CHECK(!v.supported);
    REQUIRE(!v.regions.empty());
    // The ends of the strips: a cusp there, inside the material above.
    CHECK(!verify(printed({track(-1, 0, q("2"), 0, w)}), two).supported);
}

TEST_CASE("printed: a hole of area 10^-20 mm² is found") {
    // Three discs through nearly one point: moved apart by 10^-10 they leave a triangle of about that size.
    const Rational by = tiny(10);
    const PrintedLayer below =
        printed({dot(Rational(q("2/5") + by), 0, w), dot(q("-6/25"), q("8/25"), w), dot(q("-6/25"), q("-8/25"), w)});
    const PrintedLayer above = printed({track(-1, 0, 1, 0, q("1/20"))});
    const PrintedLayer more = printed({below.tracks[0], below.tracks[1], below.tracks[2], track(q("1/2"), 0, 2, 0, w),
                                       track(q("-1/2"), 0, -2, 0, w)});
    const PrintedVerdict v = verify(above, more);
    CHECK(!v.supported);
    REQUIRE(v.regions.size() == 1);
    CHECK(v.regions[0].area_hi < 1e-9);
    CHECK(v.regions[0].distance_hi < 0.2 + 1e-3);
    CHECK(std::abs(v.regions[0].witness[0].get_d()) < 1e-9);
    // Without the gap it is closed.
    const PrintedLayer closed =
        printed({dot(q("2/5"), 0, w), below.tracks[1], below.tracks[2], more.tracks[3], more.tracks[4]});
    CHECK(verify(above, closed).supported);
}

TEST_CASE("printed: the place and the size of the coordinates make no difference") {
    const PrintedLayer below = printed({track(0, 0, -2, 0, w), dot(5, q("1/3"), q("0.449999"))});
    const PrintedLayer tie = printed({track(q("3/25"), q("4/25"), q("-1"), q("1/10"), w)});
    const PrintedLayer over = printed({track(Rational(q("3/25") + tiny(30)), q("4/25"), q("-1"), q("1/10"), w)});
    const auto moved = [](PrintedLayer layer, const Rational& scale, const Rational& x, const Rational& y) {
        for (PrintedTrack& t : layer.tracks) {
            for (auto* end : {&t.a, &t.b}) (*end)[0] = (*end)[0] * scale + x, (*end)[1] = (*end)[1] * scale + y;
            t.width = t.width * scale;
        }
        return layer;
    };
    for (const Rational& scale : {Rational(1), Rational(100000), q("1/100000"), Rational(tiny(40))})
        for (const Rational& place : {Rational(0), q("123456.789"), q("-98765.4321")}) {
            INFO("scale " << scale.get_str() << ", at " << place.get_str());
            const Rational y = place / 3;
            const PrintedLayer lower = moved(below, scale, place, y);
            const PrintedVerdict yes = verify(moved(tie, scale, place, y), lower, Rational(rho * scale));
            const PrintedVerdict no = verify(moved(over, scale, place, y), lower, Rational(rho * scale));
            CHECK(yes.supported);
            CHECK(!no.supported);
            CHECK(no.centre_lines_supported);
        }
}

TEST_CASE("printed: widths are each track's own, and ρ is any rational") {
    // Below 0.449999 / 2 + 1/5 = 0.4249995; a track of the same width above reaches it at an offset of exactly 1/5.
    const Rational wide = q("0.449999");
    const PrintedLayer below = printed({track(0, 0, 10, 0, wide)});
    supported(verify(printed({track(1, q("1/5"), 9, q("1/5"), wide)}), below), rationals);
    CHECK(!verify(printed({track(1, q("1/5"), 9, q("1/5"), q("0.45"))}), below).supported);
    CHECK(!verify(printed({track(1, Rational(q("1/5") + tiny(30)), 9, q("1/5"), wide)}), below).supported);
    // Thirds: no decimal, no binary float.
    supported(verify(printed({track(1, q("1/3"), 9, q("1/3"), wide)}), below, q("1/3")), rationals);
    CHECK_THROWS_AS(verify_printed(below, below, 0), Error);
    CHECK_THROWS_AS(verify_printed(below, printed({dot(0, 0, 0)}), rho), Error);
}

TEST_CASE("printed: lengths, distances and areas enclose what is known in closed form") {
    // A track along the x axis to 10 over one to 4: unsupported from 4.4 on, at most 6 - 0.2 = 5.8 from the material.
    const PrintedVerdict v = verify(printed({track(0, 0, 10, 0, w)}), printed({track(0, 0, 4, 0, w)}));
    unsupported(v, intervals);
    REQUIRE(v.pieces.size() == 1);
    CHECK(v.pieces[0].from_mm <= 4.4);
    CHECK(v.pieces[0].from_mm > 4.4 - 1e-12);
    CHECK(v.pieces[0].to_mm >= 10);
    CHECK(v.pieces[0].distance_lo <= 5.8);
    CHECK(v.pieces[0].distance_hi >= 5.8);
    CHECK(v.pieces[0].distance_hi - v.pieces[0].distance_lo < 1e-8);
    CHECK(v.unsupported_length[0][0] <= 5.6);
    CHECK(v.unsupported_length[0][1] >= 5.6);
    CHECK(v.unsupported_length[0][1] - v.unsupported_length[0][0] < 1e-8);
    // The stadium: the rectangle from 4 to 10 and a half disc, without what the disc of radius 0.4 about (4, 0) holds.
    REQUIRE(v.regions.size() == 1);
    const double pi = std::acos(-1.0);
    const double held = 0.16 * std::asin(0.5) + 0.2 * std::sqrt(0.16 - 0.04);  // of |y| <= 0.2, right of 4
    const double area = 6 * 0.4 + pi * 0.04 / 2 - held;
    CHECK(v.regions[0].area_lo <= area);
    CHECK(v.regions[0].area_hi >= area);
    CHECK(v.regions[0].area_lo > 0.8 * area);
    CHECK(v.regions[0].distance_lo <= 6);
    CHECK(v.regions[0].distance_hi >= 6);
    CHECK(v.regions[0].distance_hi - v.regions[0].distance_lo < 0.01);
    CHECK(v.regions[0].witness_distance > 5.9);
}

TEST_CASE("printed: tracks that are not judged are neither blamed nor material") {
    const PrintedLayer above = printed({track(0, 0, 1, 0, w), track(0, 5, 1, 5, w)}),
                       below = printed({above.tracks[0]});
    PrintedOptions options;
    options.judged = {1, 0};
    CHECK(verify_printed(above, below, rho, options).supported);
    options.judged = {0, 1};
    const PrintedVerdict v = verify_printed(above, below, rho, options);
    CHECK(!v.supported);
    CHECK(v.track_supported == std::vector<char>{1, 0});
    options.judged = {1};
    CHECK_THROWS_AS(verify_printed(above, below, rho, options), Error);
    PrintedOptions lines;
    lines.areas = false;
    CHECK(verify_printed(printed({track(0, q("1/4"), 1, q("1/4"), w)}), below, rho, lines).supported);
    CHECK(!verify_printed(printed({track(0, q("1/4"), 1, q("1/4"), w)}), below, rho).supported);
}

TEST_CASE("printed: the same verdict from several threads at once") {
    const auto below = printed(
        {dot(Rational(q("2/5") + tiny(40)), 0, w), dot(q("-6/25"), q("8/25"), w), dot(q("-6/25"), q("-8/25"), w)});
    const auto above = printed({dot(q("1/100"), 0, q("1/20"))});
    std::vector<std::thread> threads;
    std::array<bool, 4> wrong{};
    for (bool& bad : wrong)
        threads.emplace_back([&] {
            for (int i = 0; i < 20; ++i) {
                const PrintedVerdict v = verify_printed(above, below, rho);
                bad = bad || v.supported || !v.centre_lines_supported || v.regions.size() != 1;
            }
        });
    for (std::thread& t : threads) t.join();
    for (const bool bad : wrong) CHECK(!bad);
}
