// C_i lies inside the true erosion, whatever Clipper rounds, over any number of covers.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <random>

#include "ribvault/exact/nearest_segment.hpp"
#include "ribvault/exact/point_location.hpp"
#include "ribvault/slice/cavity.hpp"

using namespace ribvault;

namespace {

using Random = std::mt19937_64;
double draw(Random& g, double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(g); }

Contour blob(Random& g, double radius, int corners, double roughness) {
    Contour c;
    for (int k = 0; k < corners; ++k) {
        const double angle = 2 * M_PI * k / corners, r = radius * (1 + draw(g, -roughness, roughness));
        c.push_back({round_to_lattice(r * std::cos(angle)), round_to_lattice(r * std::sin(angle))});
    }
    return c;
}

/// How far, in units, the cavity comes nearer to the outline than the perimeters allow; 0 when nowhere.
double intrusion(const Region& cavity, const Region& outline, Unit depth) {
    const NearestSegment inner(edges_of(cavity)), outer(edges_of(outline));
    const PointLocation inside(edges_of(outline), units_per_mm);
    double worst = 0;
    const auto check = [&](Point p, const NearestSegment& tree) {
        const Segment& s = tree.segments()[tree.nearest(p).index];
        if (compare_distance(p, s, depth) < 0)
            worst = std::max(worst, static_cast<double>(depth) - std::sqrt(squared_distance(p, s).value()));
    };
    for (const Segment& e : inner.segments()) {
        check(e.a, outer);
        if (inside.locate(e.a) != Side::inside) worst = std::max(worst, 1e9);
    }
    for (const Segment& e : outer.segments()) check(e.a, inner);
    return worst;
}

}  // namespace

TEST_CASE("a cavity keeps at least the perimeters' width from the outline of every slice that bounds it") {
    std::uint64_t cases = 300;
    if (const char* more = std::getenv("RIBVAULT_HOSTILE_CASES")) cases = std::strtoull(more, nullptr, 10);
    double worst = 0;
    std::uint64_t cavities = 0;
    for (std::uint64_t seed = 0; seed < cases; ++seed) {
        Random g(seed);
        Settings s;
        s.nozzle = 2 * static_cast<Unit>(draw(g, 1000, 30000));
        s.perimeters = static_cast<int>(draw(g, 1, 4));
        const int covers = static_cast<int>(draw(g, 0, 30)), corners = static_cast<int>(draw(g, 3, 200));
        const double radius = draw(g, 3e5, 3e6), roughness = draw(g, 0, 1) < 0.5 ? draw(g, 0, 0.5) : draw(g, 0, 0.01);
        std::vector<Slice> slices;
        Region region;
        for (int k = 0; k <= covers; ++k) {
            slices.push_back({k, nullptr, {blob(g, radius, corners, roughness)}});
            if (draw(g, 0, 1) < 0.5) {
                Contour hole = blob(g, radius * 0.2, 3 + corners / 4, roughness);
                slices.back().rounded.push_back({hole.rbegin(), hole.rend()});
            }
            const Region eroded = erode_slice(slices.back(), s);
            region = k == 0 ? eroded : intersect(region, eroded);
        }
        const Cavity cavity = make_cavity(0, region, s);
        if (cavity.region.empty()) continue;
        ++cavities;
        for (const Slice& slice : slices) {
            const double by = intrusion(cavity.region, slice.rounded, s.perimeters * s.nozzle);
            worst = std::max(worst, by);
            INFO("seed " << seed << ", " << covers << " covers, " << corners << " corners");
            CHECK(by == 0);
        }
    }
    std::cout << "erosion: " << cavities << " cavities, deepest intrusion " << worst << " units\n";
    CHECK(cavities > 0);
}
