// What may not change a verdict: where the layers lie, how they are turned, in which pieces and in which order tracks
// come. For tracks of any direction, where no arrangement with rational coefficients exists.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <iostream>
#include <random>

#include "layers.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

using Random = std::mt19937_64;
Unit pick(Random& g, Unit lo, Unit hi) { return std::uniform_int_distribution<Unit>(lo, hi)(g); }

struct Plain {
    Contour frame;
    Region cavity_above, cavity_below;
    std::vector<Segment> above, below;
    Settings how;
};

Plain random_layers(Random& g) {
    Plain p;
    const Unit step = pick(g, 0, 1) ? 12 : 2520, half = pick(g, 2, 5);
    p.how = settings(pick(g, 1, 2) * step, pick(g, 1, 3) * step);
    p.frame = square(30 * step);
    p.cavity_below = {square(pick(g, 3, 9) * step)};
    switch (pick(g, 0, 2)) {
        case 0: p.cavity_above = {square(20 * step)}; break;
        case 1: p.cavity_above = {square(20 * step), reversed(square(pick(g, 1, 3) * step))}; break;
        default: p.cavity_above = {square(pick(g, 2, 8) * step)};
    }
    const auto point = [&] { return Point{pick(g, -half, half) * step, pick(g, -half, half) * step}; };
    for (Unit n = pick(g, 1, 7); n > 0; --n)
        p.below.push_back({p.below.empty() || pick(g, 0, 1) ? point() : p.below.back().b, point()});
    for (Unit n = pick(g, 0, 2); n > 0; --n) {
        const Segment& f = p.below[static_cast<std::size_t>(pick(g, 0, static_cast<Unit>(p.below.size()) - 1))];
        const Point by{pick(g, -2, 2) * step, pick(g, -2, 2) * step};
        p.above.push_back(pick(g, 0, 1) ? Segment{f.a + by, f.b + by} : Segment{point(), point()});
    }
    return p;
}

template <class F>
Plain mapped(Plain p, const F& f, bool mirror) {
    for (Contour* c : {&p.frame})
        for (Point& q : *c) q = f(q);
    if (mirror) p.frame = reversed(p.frame);
    for (Region* r : {&p.cavity_above, &p.cavity_below})
        for (Contour& c : *r) {
            for (Point& q : c) q = f(q);
            if (mirror) c = reversed(c);
        }
    for (auto* tracks : {&p.above, &p.below})
        for (Segment& s : *tracks) s = {f(s.a), f(s.b)};
    return p;
}

/// Tracks cut at lattice points, turned round, repeated, extended by pieces of themselves and shuffled: the same sets.
Plain rearranged(Plain p, Random& g) {
    for (auto* tracks : {&p.above, &p.below}) {
        std::vector<Segment> result;
        for (const Segment& s : *tracks) {
            const Point d = s.b - s.a;
            bool cut = false;
            for (const Unit n : {2, 3, 4, 6})
                if (!cut && d.x % n == 0 && d.y % n == 0 && pick(g, 0, 1)) {
                    const Point at{s.a.x + d.x / n, s.a.y + d.y / n};
                    // Overlapping pieces below; above a track is one stadium and its pieces are others.
                    result.push_back({s.a, at});
                    result.push_back(pick(g, 0, 1) ? Segment{at, s.b} : Segment{s.b, s.a});
                    cut = true;
                }
            if (!cut) result.push_back(s);
            if (pick(g, 0, 2) == 0) result.push_back({s.b, s.a});
            if (pick(g, 0, 3) == 0) result.push_back({s.a, s.a});
        }
        std::shuffle(result.begin(), result.end(), g);
        *tracks = result;
    }
    return p;
}

LayerVerdict decide(const Plain& p) {
    return verify(layer({p.frame}, p.cavity_above, p.above), layer({p.frame}, p.cavity_below, p.below), p.how);
}

}  // namespace

TEST_CASE("a verdict does not depend on place, turn or the pieces that tracks come in", "[agreement]") {
    std::uint64_t count = 1000;
    if (const char* more = std::getenv("RIBVAULT_HOSTILE_CASES")) count = std::strtoull(more, nullptr, 10);
    int supported = 0, refuted = 0;
    StageCounts stages;
    for (std::uint64_t seed = 0; seed < count; ++seed) {
        Random g(seed);
        const Plain p = random_layers(g);
        const LayerVerdict verdict = decide(p);
        REQUIRE(verdict.malformed == "");
        (verdict.supported ? supported : refuted)++;
        INFO("seed " << seed);
        const auto same = [&](const Plain& q, const char* what) {
            const LayerVerdict other = decide(q);
            INFO(what);
            stages += other.stages;
            CHECK(other.malformed == "");
            CHECK(other.supported == verdict.supported);
            if (verdict.internal && other.internal) {
                CHECK(verdict.internal->area_lo <= other.internal->area_hi);
                CHECK(other.internal->area_lo <= verdict.internal->area_hi);
            }
        };
        same(rearranged(p, g), "in pieces");
        same(mapped(p, [](Point q) { return Point{-q.y, q.x}; }, false), "a quarter turn");
        same(mapped(p, [](Point q) { return Point{q.y, q.x}; }, true), "mirrored");
        const Point away{pick(g, -1, 1) * 900000000 + pick(g, -999, 999),
                         pick(g, -1, 1) * 900000000 + pick(g, -999, 999)};
        same(mapped(rearranged(p, g), [&](Point q) { return q + away; }, false), "moved");
    }
    std::cout << "invariance: supported " << supported << ", not " << refuted << "; decided by intervals "
              << stages.interval << ", rationals " << stages.rational << ", algebraic numbers " << stages.algebraic
              << "\n";
    CHECK(supported > 100);
    CHECK(refuted > 100);
}
