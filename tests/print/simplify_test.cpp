// Simplified outlines stay within the tolerance and lose no contour.
#include "ribvault/print/simplify.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "ribvault/exact/predicates.hpp"

using namespace ribvault;

namespace {

/// A wavy ring of n vertices about (0, 0).
Contour wavy(std::mt19937& random, std::size_t n, Unit radius, Unit noise) {
    Contour ring;
    for (std::size_t k = 0; k < n; ++k) {
        const double angle = 2 * M_PI * static_cast<double>(k) / static_cast<double>(n);
        const double r = static_cast<double>(radius + std::uniform_int_distribution<Unit>(-noise, noise)(random));
        ring.push_back({round_to_lattice(r * std::cos(angle)), round_to_lattice(r * std::sin(angle))});
    }
    return ring;
}

double distance(Point p, const Contour& ring) {
    double least = HUGE_VAL;
    for (std::size_t k = 0; k < ring.size(); ++k)
        least = std::min(least, std::sqrt(squared_distance(p, Segment{ring[k], ring[(k + 1) % ring.size()]}).value()));
    return least;
}

}  // namespace

TEST_CASE("vertices go that are within the tolerance, in whatever order the contour begins") {
    std::mt19937 random(3);
    for (const Unit noise : {Unit{0}, Unit{100}, Unit{2000}}) {
        Contour ring = wavy(random, 700, 1000000, noise);
        const Region simple = simplify({ring}, 500);
        REQUIRE(simple.size() == 1);
        CHECK(simple[0].size() < (noise < 2000 ? 150u : 700u));
        for (const Point p : ring) CHECK(distance(p, simple[0]) <= 500);
        for (const Point p : simple[0]) CHECK(std::count(ring.begin(), ring.end(), p) == 1);
        std::rotate(ring.begin(), ring.begin() + 321, ring.end());
        CHECK(simplify({ring}, 500) == simple);
        CHECK(simplify({ring}, 0) == Region{ring});
    }
}

TEST_CASE("corners stay, and so does what is smaller than the tolerance") {
    const Contour square{{0, 0}, {50000, 3}, {100000, 0}, {100000, 100000}, {0, 100000}, {-2, 40000}},
        speck{{20000, 20000}, {20000, 20100}, {20100, 20000}};
    const Region simple = simplify({square, speck}, 500);
    REQUIRE(simple.size() == 2);
    CHECK(simple[0].size() == 5);  // begins at the leftmost vertex, whatever it is
    CHECK(simple[1] == speck);
    CHECK(signed_area(simple) > 0);
}
