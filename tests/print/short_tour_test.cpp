#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>
#include <random>

#include "ribvault/print/short_tour.hpp"

using namespace ribvault;

namespace {

constexpr Unit mm = units_per_mm;

struct Problem {
    std::vector<Contour> rings;
    std::vector<TourStop> stops;
};

Problem random_problem(std::mt19937_64& random, std::size_t n, double share_after) {
    std::uniform_int_distribution<Unit> place(0, 50 * mm);
    std::uniform_int_distribution<int> kind(0, 2);
    const auto point = [&] { return Point{place(random), place(random)}; };
    Problem p;
    p.rings.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        TourStop stop;
        stop.entry = static_cast<Entry>(kind(random));
        stop.first = stop.last = point();
        if (stop.entry == Entry::anywhere)
            p.rings[i] = {stop.first, stop.first + Point{mm, 0}, stop.first + Point{mm, mm}, stop.first + Point{0, mm}};
        else
            stop.last = point();
        stop.ring = &p.rings[i];
        if (i > 0 && std::bernoulli_distribution(share_after)(random))
            stop.after = std::uniform_int_distribution<std::size_t>(0, i - 1)(random);
        p.stops.push_back(stop);
    }
    return p;
}

Point in(const TourStop& s, std::size_t way) {
    return s.entry == Entry::anywhere ? (*s.ring)[way] : way == 0 ? s.first : s.last;
}
Point out(const TourStop& s, std::size_t way) {
    return s.entry == Entry::anywhere ? (*s.ring)[way] : way == 0 ? s.last : s.first;
}
std::size_t ways(const TourStop& s) {
    return s.entry == Entry::fixed ? 1 : s.entry == Entry::either_end ? 2 : s.ring->size();
}

double travel(const Problem& p, const std::vector<Visit>& tour, Point from, std::optional<Point> to) {
    double sum = 0;
    for (const Visit& v : tour) sum += length(in(p.stops[v.stop], v.way) - from), from = out(p.stops[v.stop], v.way);
    return to ? sum + length(*to - from) : sum;
}

void check_tour(const Problem& p, const std::vector<Visit>& tour) {
    REQUIRE(tour.size() == p.stops.size());
    std::vector<char> seen(tour.size());
    for (const Visit& v : tour) {
        REQUIRE_FALSE(seen[v.stop]);
        REQUIRE(v.way < ways(p.stops[v.stop]));
        if (p.stops[v.stop].after != no_stop) REQUIRE(seen[p.stops[v.stop].after]);
        seen[v.stop] = 1;
    }
}

/// The shortest of all tours.
double shortest(const Problem& p, Point from, std::optional<Point> to) {
    std::vector<std::size_t> order(p.stops.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    double best = INFINITY;
    do {
        bool allowed = true;
        for (std::size_t k = 0; k < order.size() && allowed; ++k) {
            const std::size_t after = p.stops[order[k]].after;
            allowed = after == no_stop || std::find(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(k),
                                                    after) != order.begin() + static_cast<std::ptrdiff_t>(k);
        }
        if (!allowed) continue;
        // Least travel to be at each way's exit of the stop before.
        std::vector<std::pair<Point, double>> here{{from, 0}};
        for (std::size_t s : order) {
            std::vector<std::pair<Point, double>> next;
            for (std::size_t w = 0; w < ways(p.stops[s]); ++w) {
                double least = INFINITY;
                for (const auto& [at, cost] : here) least = std::min(least, cost + length(in(p.stops[s], w) - at));
                next.emplace_back(out(p.stops[s], w), least);
            }
            here = std::move(next);
        }
        for (const auto& [at, cost] : here) best = std::min(best, cost + (to ? length(*to - at) : 0));
    } while (std::next_permutation(order.begin(), order.end()));
    return best;
}

/// Always to the nearest start that may come next.
double greedy(const Problem& p, Point from) {
    std::vector<char> done(p.stops.size());
    double sum = 0;
    for (std::size_t k = 0; k < p.stops.size(); ++k) {
        double nearest = INFINITY;
        Visit best;
        for (std::size_t s = 0; s < p.stops.size(); ++s) {
            if (done[s] || (p.stops[s].after != no_stop && !done[p.stops[s].after])) continue;
            for (std::size_t w = 0; w < ways(p.stops[s]); ++w)
                if (const double d = length(in(p.stops[s], w) - from); d < nearest) nearest = d, best = {s, w};
        }
        sum += nearest, done[best.stop] = 1, from = out(p.stops[best.stop], best.way);
    }
    return sum;
}

}  // namespace

TEST_CASE("small tours: allowed, and close to the shortest of all") {
    std::mt19937_64 random(1);
    double sum = 0, best = 0;
    for (int round = 0; round < 60; ++round) {
        const Problem p = random_problem(random, 1 + static_cast<std::size_t>(round) % 6, round % 2 ? 0.5 : 0.0);
        const std::optional<Point> to = round % 3 ? std::nullopt : std::optional(Point{50 * mm, 0});
        const auto tour = short_tour(p.stops, {0, 0}, to);
        check_tour(p, tour);
        const double optimum = shortest(p, {0, 0}, to);
        CHECK(travel(p, tour, {0, 0}, to) >= optimum - 1);
        sum += travel(p, tour, {0, 0}, to), best += optimum;
    }
    CHECK(sum < 1.06 * best);
}

TEST_CASE("large tours: allowed, shorter than going to the nearest, the same every time") {
    std::mt19937_64 random(2);
    for (const std::size_t n : {50u, 200u, 399u, 800u})
        for (const double share_after : {0.0, 0.7}) {
            const Problem p = random_problem(random, n, share_after);
            const auto tour = short_tour(p.stops, {0, 0}, std::nullopt),
                       again = short_tour(p.stops, {0, 0}, std::nullopt);
            check_tour(p, tour);
            CHECK(std::equal(tour.begin(), tour.end(), again.begin(),
                             [](Visit a, Visit b) { return a.stop == b.stop && a.way == b.way; }));
            INFO(n << " stops: " << travel(p, tour, {0, 0}, std::nullopt) / greedy(p, {0, 0}));
            CHECK(travel(p, tour, {0, 0}, std::nullopt) < (n <= 400 ? 0.96 : 0.99) * greedy(p, {0, 0}));
        }
}

TEST_CASE("no stops, no tour") { CHECK(short_tour({}, {0, 0}, Point{1, 1}).empty()); }
