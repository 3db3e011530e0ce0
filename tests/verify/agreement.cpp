// Thousands of small layers, most of them full of ties, against the brute force.
#include <algorithm>
#include <catch2/catch.hpp>
#include <iostream>
#include <random>

#include "brute_force.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

using Random = std::mt19937_64;
Unit pick(Random& g, Unit lo, Unit hi) { return std::uniform_int_distribution<Unit>(lo, hi)(g); }

/// Scale of the coordinates, and how far points may leave the coarse lattice.
struct Grain {
    Unit scale;
    Unit jitter;
};
Point point(Random& g, Unit half, Grain grain) {
    return {pick(g, -half, half) * grain.scale + pick(g, -grain.jitter, grain.jitter),
            pick(g, -half, half) * grain.scale + pick(g, -grain.jitter, grain.jitter)};
}

// A simple polygon: random lattice points in order of angle about the origin, one per direction.
Contour star(Random& g, Unit half, Grain grain) {
    for (;;) {
        std::vector<Point> points;
        for (int i = 0, n = static_cast<int>(pick(g, 3, 9)); i < n; ++i) points.push_back(point(g, half, grain));
        std::erase_if(points, [](Point p) { return p == Point{}; });
        const auto cross = [](Point p, Point q) { return p.x * q.y - p.y * q.x; };
        const auto lower = [](Point p) { return p.y < 0 || (p.y == 0 && p.x < 0); };
        std::sort(points.begin(), points.end(),
                  [&](Point p, Point q) { return lower(p) != lower(q) ? lower(q) : cross(p, q) > 0; });
        Contour c;
        for (const Point p : points)
            if (c.empty() || lower(c.back()) != lower(p) || cross(c.back(), p) != 0) c.push_back(p);
        bool around = c.size() >= 3;
        for (std::size_t i = 0; around && i < c.size(); ++i) around = cross(c[i], c[(i + 1) % c.size()]) > 0;
        if (around) return c;
    }
}

struct Pair {
    Layer upper, lower;
    Settings how;
    double scale;
};

Pair internal_pair(Random& g) {
    const Unit scale = 1000;
    const Unit jitters[] = {0, 0, 0, 1, 300};
    const Grain grain{scale, jitters[pick(g, 0, 4)]};
    const Settings how = settings(pick(g, 1, 2) * scale, pick(g, 1, 3) * scale);
    const Unit half = pick(g, 2, 6);
    const Contour frame = square(20 * scale);
    Pair pair{{}, {}, how, static_cast<double>(scale)};
    const Contour below = pick(g, 0, 1) ? square(half * scale) : star(g, half, grain);
    Region above;
    switch (pick(g, 0, 3)) {
        case 0:
            break;  // a full roof
        case 1:
            above = {star(g, half, grain)};
            break;
        case 2:
            above = {square(pick(g, 1, half) * scale)};
            break;
        default:
            above = {square(15 * scale)};  // tracks only
    }
    const auto tracks = [&](int n) {
        std::vector<Segment> list;
        while (static_cast<int>(list.size()) < n) {
            const Point a = list.empty() || pick(g, 0, 1) ? point(g, half, grain) : list[pick(g, 0, list.size() - 1)].b;
            list.push_back({a, pick(g, 0, 5) ? point(g, half, grain) : a});
        }
        return list;
    };
    std::vector<Segment> lower = tracks(static_cast<int>(pick(g, 0, 5))),
                         upper = tracks(static_cast<int>(pick(g, 0, 2)));
    // Some lower tracks become two that overlap, so that boundaries coincide.
    for (std::size_t i = 0, n = lower.size(); i < n; ++i)
        if (const Segment t = lower[i]; pick(g, 0, 4) == 0) {
            const Point d = t.b - t.a;
            lower[i].a = t.a - d;
            lower.push_back({t.b, t.a - d - d});
        }
    // Half of the upper tracks follow a lower one at a distance that is often a tie.
    if (!lower.empty())
        for (Segment& t : upper)
            if (pick(g, 0, 1)) {
                const Segment& follow = lower[pick(g, 0, lower.size() - 1)];
                const Point by{pick(g, -2, 2) * scale, pick(g, -2, 2) * scale};
                t = {follow.a + by, follow.b + by};
            }
    pair.upper = layer({frame}, above, upper);
    pair.lower = layer({frame}, {below}, lower);
    return pair;
}

Pair external_pair(Random& g) {
    const Unit scale = 1000;
    const Unit jitters[] = {0, 0, 1, 300};
    const Grain grain{scale, jitters[pick(g, 0, 3)]};
    const Contour below = star(g, pick(g, 3, 6), grain);
    Contour above = pick(g, 0, 2) ? below : star(g, pick(g, 2, 5), grain);
    if (pick(g, 0, 1)) {
        const Point by{pick(g, -2, 2) * scale, pick(g, -2, 2) * scale};
        for (Point& p : above) p = p + by;
    }
    return {layer({above}, {}), layer({below}, {}), settings(scale, pick(g, 1, 3) * scale), static_cast<double>(scale)};
}

struct Tally {
    int supported = 0, unsupported = 0, ties = 0, open = 0, open_supported = 0, open_unsupported = 0, uncertified = 0;
    StageCounts stages;
};

void agree(const Pair& pair, bool internal, std::uint64_t seed, Tally& tally) {
    const LayerVerdict verdict = verify(pair.upper, pair.lower, pair.how);
    INFO("seed " << seed);
    REQUIRE(verdict.malformed == "");
    const Truth truth = internal ? brute_force_internal(pair.upper, pair.lower, pair.how, pair.scale)
                                 : brute_force_external(pair.upper, pair.lower, pair.how, pair.scale);
    const std::optional<Unsupported>& found = internal ? verdict.internal : verdict.external;
    tally.stages += verdict.stages;
    ++(truth == Truth::supported     ? tally.supported
       : truth == Truth::unsupported ? tally.unsupported
       : truth == Truth::tie         ? tally.ties
                                     : tally.open);
    if (found) {
        CHECK(found->area_hi > 0);
        CHECK(found->area_lo <= found->area_hi);
        if (!found->witness_certified) ++tally.uncertified;
        if (found->witness_certified) CHECK(found->witness_distance >= to_mm(pair.how.support_radius) * (1 - 1e-12));
    }
    if (truth == Truth::open) ++(found ? tally.open_unsupported : tally.open_supported);
    if (truth == Truth::unsupported) CHECK(found.has_value());
    if (truth == Truth::supported || truth == Truth::tie) CHECK(!found.has_value());
}

void print(const char* what, const Tally& t) {
    std::cout << what << ": supported " << t.supported << ", unsupported " << t.unsupported << ", ties " << t.ties
              << ", left open by the brute force " << t.open << " (supported " << t.open_supported
              << ", unsupported with witness " << t.open_unsupported << "), witness not certified " << t.uncertified
              << "; decided by intervals " << t.stages.interval << ", rationals " << t.stages.rational
              << ", algebraic numbers " << t.stages.algebraic << "\n";
}

}  // namespace

TEST_CASE("internal verdicts agree with the brute force on random small layers", "[agreement]") {
    Tally tally;
    for (std::uint64_t seed = 0; seed < 16000; ++seed) {
        Random g(seed);
        agree(internal_pair(g), true, seed, tally);
    }
    print("internal", tally);
    CHECK(tally.uncertified == 0);
    CHECK(tally.supported + tally.ties > 1000);
    CHECK(tally.unsupported > 1000);
    CHECK(tally.ties > 100);
}

TEST_CASE("external verdicts agree with the brute force on random small layers", "[agreement]") {
    Tally tally;
    for (std::uint64_t seed = 0; seed < 6000; ++seed) {
        Random g(seed + 1000000);
        agree(external_pair(g), false, seed, tally);
    }
    print("external", tally);
    CHECK(tally.uncertified == 0);
    CHECK(tally.ties > 100);
}

TEST_CASE("taking away or shortening one track below changes the verdict exactly when the brute force says so",
          "[agreement]") {
    Tally tally;
    int flipped = 0;
    for (std::uint64_t seed = 0; tally.supported + tally.unsupported + tally.ties + tally.open < 3000; ++seed) {
        Random g(seed + 2000000);
        Pair pair = internal_pair(g);
        if (pair.lower.tracks.empty() || !verify(pair.upper, pair.lower, pair.how).supported) continue;
        std::vector<Segment>& tracks = pair.lower.tracks;
        const std::size_t i = static_cast<std::size_t>(pick(g, 0, static_cast<Unit>(tracks.size()) - 1));
        if (pick(g, 0, 1))
            tracks.erase(tracks.begin() + static_cast<std::ptrdiff_t>(i));
        else
            tracks[i].b = {(tracks[i].a.x + tracks[i].b.x) / 2, (tracks[i].a.y + tracks[i].b.y) / 2};
        const int before = tally.unsupported;
        agree(pair, true, seed, tally);
        flipped += tally.unsupported > before;
    }
    print("mutation", tally);
    CHECK(flipped > 50);
}
