// Unsupported stretches of a centre line, with exact ends and without: the same stretches, their ends where they are
// said to be.
#include "ribvault/verify/centre_line.hpp"

#include <catch2/catch.hpp>
#include <numeric>
#include <random>

using namespace ribvault;
using namespace ribvault::verify;

namespace {

constexpr std::int64_t step = Millimetres::picometres_per_mm / 20;  // 50 µm: many ties

struct Scene {
    PrintedTrack track;
    std::vector<PrintedTrack> lower;

    std::vector<CentreGap> gaps(bool exact_ends) const {
        const std::vector<PreparedTrack> above = prepare({&track, 1}), below = prepare(lower);
        const double margin = margin_of(largest_coordinate(above, below, 0.2));
        const TrackFrame frame(above[0]);
        std::vector<Millimetres> radii;
        std::vector<FrameStadium> seen;
        for (std::size_t k = 0; k < lower.size(); ++k) {
            radii.push_back(half_plus(lower[k].width, Millimetres::of_picometres(4 * step)));
            seen.push_back(frame.see(below[k], below[k].half + 0.2));
        }
        std::vector<int> which(lower.size());
        std::iota(which.begin(), which.end(), 0);
        StageCounts stages;
        return centre_gaps(track, above[0], {lower, below, radii, which, seen}, margin, exact_ends, stages);
    }
};

/// As centre_gaps with exact ends: all stretches exactly, in exact order.
std::vector<std::array<QuadraticNumber, 2>> gaps_of(const Scene& scene) {
    std::vector<std::array<QuadraticNumber, 2>> covered, gaps;
    for (const PrintedTrack& t : scene.lower) {
        const Millimetres radius = half_plus(t.width, Millimetres::of_picometres(4 * step));
        if (auto stretch = exact_stretch(scene.track, t, Rational(radius))) covered.push_back(*stretch);
    }
    std::sort(covered.begin(), covered.end(), [](const auto& p, const auto& q) { return compare(p[0], q[0]) < 0; });
    const QuadraticNumber end{1, 0, 0};
    QuadraticNumber reached{0, 0, 0};
    covered.push_back({end, end});
    for (const auto& [from, to] : covered) {
        const QuadraticNumber next = compare(from, end) < 0 ? from : end;
        if (compare(reached, next) < 0) gaps.push_back({reached, next});
        if (compare(to, reached) > 0) reached = to;
    }
    return gaps;
}

/// A line over chains whose pieces share their ends, some of them twice, turned round and up to `apart` pm beside.
Scene random_scene(std::mt19937_64& random, std::int64_t jitter, std::int64_t apart) {
    const auto place = [&](std::int64_t lo, std::int64_t hi) {
        return Millimetres::of_picometres(std::uniform_int_distribution<std::int64_t>(lo, hi)(random) * step +
                                          std::uniform_int_distribution<std::int64_t>(-jitter, jitter)(random));
    };
    const auto beside = [&](const PrintedPoint& p) {
        std::uniform_int_distribution<std::int64_t> shift(-apart, apart);
        return PrintedPoint{Millimetres::of_picometres(p[0].picometres() + shift(random)),
                            Millimetres::of_picometres(p[1].picometres() + shift(random))};
    };
    Scene scene;
    scene.track.a = {place(0, 0), place(0, 0)}, scene.track.b = {place(60, 80), place(-10, 10)};
    scene.track.width = Millimetres::of_picometres(8 * step);
    for (int chain = 0; chain < 3; ++chain) {
        PrintedPoint at{place(0, 80), place(-12, 12)};
        for (int k = 0; k < 4; ++k) {
            const PrintedPoint to{place(0, 80), place(-12, 12)};
            scene.lower.push_back({at, to, scene.track.width});
            if (k != 2) scene.lower.push_back({beside(to), beside(at), scene.track.width});
            at = to;
        }
        scene.lower.push_back({at, at, scene.track.width});
    }
    if (random() % 2) std::shuffle(scene.lower.begin(), scene.lower.end(), random);
    return scene;
}

/// The gaps of a scene, asked for in both ways, are those that exact numbers give. In doubles their beginnings are
/// known to less than `widest` mm. Returns how many there are.
std::size_t check_gaps(const Scene& scene, double widest) {
    const std::vector<CentreGap> exact = scene.gaps(true), about = scene.gaps(false);
    const std::vector<std::array<QuadraticNumber, 2>> right = gaps_of(scene);
    REQUIRE(exact.size() == right.size());
    REQUIRE(exact.size() == about.size());
    const double length = prepare({&scene.track, 1})[0].length;
    // What doubles call inside a distance is off by a few of their last places.
    constexpr double rounding = 1e-13;
    for (std::size_t k = 0; k < exact.size(); ++k) {
        const double from = enclose(exact[k].from, 60)[0].get_d() * length,
                     to = enclose(exact[k].to, 60)[0].get_d() * length;
        CHECK(about[k].from_lo <= from + rounding);
        CHECK(from <= about[k].from_hi + rounding);
        CHECK(about[k].to_lo <= to + rounding);
        CHECK(to <= about[k].to_hi + rounding);
        CHECK(about[k].from_hi - about[k].from_lo < widest);
        CHECK(exact[k].from_lo <= from + rounding);
        CHECK(to <= exact[k].to_hi + rounding);
        CHECK(compare(exact[k].from, right[k][0]) == 0);
        CHECK(compare(exact[k].to, right[k][1]) == 0);
    }
    return exact.size();
}

/// A line on whose one side or other walls graze the limit, almost parallel, with short ones in between.
Scene grazing_scene(std::mt19937_64& random) {
    const auto pick = [&](std::int64_t lo, std::int64_t hi) {
        return std::uniform_int_distribution<std::int64_t>(lo, hi)(random);
    };
    const auto at = [](std::int64_t x, std::int64_t y) {
        return PrintedPoint{Millimetres::of_picometres(x), Millimetres::of_picometres(y)};
    };
    Scene scene;
    scene.track = {at(0, 0), at(1200 * step, 0), Millimetres::of_picometres(8 * step)};
    const std::int64_t limit = 8 * step;
    for (int k = 0; k < 2; ++k) {
        const std::int64_t x = pick(-100, 1100) * step, side = pick(0, 1) ? limit : -limit;
        scene.lower.push_back(
            {at(x, side + pick(-2, 2)), at(x + pick(1, 900) * step, side + pick(-2, 2)), scene.track.width});
    }
    for (int k = 0; k < 3; ++k) {
        const std::int64_t x = pick(0, 1200) * step, y = pick(-9, 9) * step;
        scene.lower.push_back(
            {at(x, y), at(x + pick(0, 1) * pick(-9, 9) * step, pick(-60, 60) * step), scene.track.width});
    }
    if (pick(0, 1)) std::shuffle(scene.lower.begin(), scene.lower.end(), random);
    return scene;
}

}  // namespace

TEST_CASE("ends of unsupported stretches lie where the doubles say, asked for exactly or not") {
    std::mt19937_64 random(5);
    std::size_t found = 0;
    for (int trial = 0; trial < 12000; ++trial) {
        const Scene scene = random_scene(random,
                                         trial % 3 == 0   ? 0
                                         : trial % 3 == 1 ? 1
                                                          : 1000,
                                         trial % 4 == 0 ? 0 : 4 + trial % 12);
        found += check_gaps(scene, 1e-3);
    }
    CHECK(found > 1000);
}

TEST_CASE("short stretches where others only graze the limit are seen, and the gaps beside them") {
    std::mt19937_64 random(8);
    std::size_t found = 0;
    for (int trial = 0; trial < 12000; ++trial) found += check_gaps(grazing_scene(random), 60);
    CHECK(found > 10000);
    // A wall comes within reach somewhere between 120 and 160 mm; before it does, another one crosses.
    const auto at = [](double x, std::int64_t y) {
        return PrintedPoint{Millimetres(Rational(x)), Millimetres::of_picometres(y)};
    };
    Scene scene;
    scene.track = {at(100, 0), at(160, 0), Millimetres::of_picometres(8 * step)};
    scene.lower = {{at(100, 0), at(120, 0), scene.track.width},
                   {at(136, -60 * step), at(136, 60 * step), scene.track.width},
                   {at(120, 8 * step + 1), at(160, 8 * step - 1), scene.track.width}};
    CHECK(check_gaps(scene, 60) == 2);
}
