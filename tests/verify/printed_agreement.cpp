// A hundred thousand small printed layers, most of them full of ties, against the subdivision in integers.
#include <catch2/catch.hpp>
#include <cmath>
#include <iostream>

#include "random_printed_layers.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

/// What the brute force says of radii below changed by grow * 10^-30, far below its resolution, from its answers for
/// the radii themselves and for radii smaller by one of its units. An extreme between the two is exactly 0 on the
/// coarse lattice: a tie, which is lost when radii shrink. Off the lattice it is left open.
enum class Expected { yes, no, open };
Expected expected(Printed truth, Printed smaller, bool on_lattice, int grow) {
    if (truth == Printed::unsupported) return Expected::no;
    if (grow < 0) {
        if (smaller == Printed::supported) return Expected::yes;
        return smaller == Printed::unsupported && on_lattice ? Expected::no : Expected::open;
    }
    return truth == Printed::supported || (truth == Printed::tie && on_lattice) ? Expected::yes : Expected::open;
}

struct Tally {
    int yes = 0, no = 0, ties = 0, open = 0, open_yes = 0, broken = 0, witnesses = 0;
    void add(Printed p) {
        ++(p == Printed::supported ? yes : p == Printed::unsupported ? no : p == Printed::tie ? ties : open);
    }
};
void print(const char* what, const Tally& t) {
    std::cout << what << ": supported " << t.yes << ", unsupported " << t.no << ", ties " << t.ties
              << ", broken by 10^-30 " << t.broken << ", left open by the brute force " << t.open
              << " (verdict: supported " << t.open_yes << "); ";
}

// Length of a centre line outside all stadiums below, by sampling; off by less than a step for each end of a stretch.
double sampled_length(const PrintedTrack& t, const PrintedLayer& lower, double rho, int samples) {
    const double ax = t.a[0].get_d(), ay = t.a[1].get_d(), dx = t.b[0].get_d() - ax, dy = t.b[1].get_d() - ay;
    int out = 0;
    for (int i = 0; i < samples; ++i) {
        const double s = (i + 0.5) / samples, x = ax + s * dx, y = ay + s * dy;
        bool in = false;
        for (const PrintedTrack& b : lower.tracks) {
            const double bx = b.a[0].get_d(), by = b.a[1].get_d(), ux = b.b[0].get_d() - bx, uy = b.b[1].get_d() - by;
            const double n = ux * ux + uy * uy;
            const double p = n > 0 ? std::min(1.0, std::max(0.0, ((x - bx) * ux + (y - by) * uy) / n)) : 0;
            in = in || std::hypot(bx + p * ux - x, by + p * uy - y) <= b.width.get_d() / 2 + rho;
        }
        out += !in;
    }
    return std::hypot(dx, dy) * out / samples;
}

}  // namespace

TEST_CASE("printed verdicts agree with the subdivision in integers on random small layers", "[agreement]") {
    const Rational rho = q("1/2");
    Tally lines, areas;
    StageCounts stages;
    int lengths = 0;
    for (std::uint64_t seed = 0; seed < 100000; ++seed) {
        Random g(seed);
        const Case c = random_case(g);
        const Printed by_lines = printed_lines(c.upper, c.lower, c.on_lattice ? digits : jitter_digits - 1);
        const Printed by_areas = printed_areas(c.upper, c.lower);
        lines.add(by_lines), areas.add(by_areas);
        const int grow = seed % 2 == 0 ? 0 : static_cast<int>(pick(g, -1, 1));
        const PrintedLayer upper = layer_of(c.upper, false, 0), lower = layer_of(c.lower, true, tiny(30) * grow);
        PrintedOptions options;
        options.regions = seed % 8 == 0 || by_areas == Printed::open;
        const PrintedVerdict v = verify_printed(upper, lower, rho, options);
        stages += v.stages;
        lines.open_yes += by_lines == Printed::open && v.centre_lines_supported;
        areas.open_yes += by_areas == Printed::open && v.supported;
        INFO("seed " << seed << ", radii changed by " << grow << " 10^-30");
        Printed fewer_lines = by_lines, fewer_areas = by_areas;
        if (grow < 0) {
            std::vector<GridTrack> smaller = c.lower;
            for (GridTrack& t : smaller) --t.half;
            fewer_lines = printed_lines(c.upper, smaller, c.on_lattice ? digits : jitter_digits - 1);
            fewer_areas = printed_areas(c.upper, smaller);
        }
        const Expected e1 = expected(by_lines, fewer_lines, c.on_lattice, grow);
        const Expected e2 = expected(by_areas, fewer_areas, c.on_lattice, grow);
        lines.broken += e1 == Expected::no && by_lines != Printed::unsupported;
        areas.broken += e2 == Expected::no && by_areas != Printed::unsupported;
        if (e1 != Expected::open) CHECK(v.centre_lines_supported == (e1 == Expected::yes));
        if (e2 != Expected::open) CHECK(v.supported == (e2 == Expected::yes));
        if (v.supported) CHECK(v.centre_lines_supported);
        if (options.regions) {
            CHECK(v.supported == v.regions.empty());
            for (const UnsupportedRegion& r : v.regions) {
                CHECK(r.witness_certified);
                CHECK(is_witness(r.witness, upper, lower, rho));
                CHECK(r.area_hi > 0);
                ++areas.witnesses;
            }
        }
        if (seed % 50 == 0 && !v.centre_lines_supported)
            for (std::size_t i = 0; i < upper.tracks.size(); ++i) {
                const double length = std::hypot(Rational(upper.tracks[i].b[0] - upper.tracks[i].a[0]).get_d(),
                                                 Rational(upper.tracks[i].b[1] - upper.tracks[i].a[1]).get_d());
                const double sampled = sampled_length(upper.tracks[i], lower, 0.5, 4000), slack = 12 * length / 4000;
                CHECK(v.unsupported_length[i][0] <= sampled + slack);
                CHECK(v.unsupported_length[i][1] >= sampled - slack);
                CHECK(v.unsupported_length[i][1] - v.unsupported_length[i][0] <= 1e-7 * (1 + length));
                ++lengths;
            }
    }
    print("printed, equation (1)", lines);
    print("equation (2)", areas);
    std::cout << "witnesses checked " << areas.witnesses << ", lengths " << lengths << "; decided by intervals "
              << stages.interval << ", rationals " << stages.rational << ", algebraic numbers " << stages.algebraic
              << "\n";
    CHECK(areas.yes > 10000);
    CHECK(areas.no > 10000);
    CHECK(areas.broken > 500);
    CHECK(lines.broken > 300);
}
