// Random small printed layers, most of them on a coarse lattice so that ties abound.
#pragma once

#include <random>

#include "printed_brute_force.hpp"
#include "printed_layers.hpp"

namespace ribvault::test {

using Random = std::mt19937_64;
using Unit64 = std::int64_t;
inline Unit64 pick(Random& g, Unit64 lo, Unit64 hi) { return std::uniform_int_distribution<Unit64>(lo, hi)(g); }

constexpr int digits = 24;                   // binary places of the brute force below the lattice
constexpr Unit64 one = Unit64{1} << digits;  // one lattice step is 1 mm
constexpr int jitter_digits = 12;            // points off the lattice leave it by multiples of 2^-12

struct Case {
    std::vector<GridTrack> upper, lower;
    bool on_lattice = true;
};

inline Case random_case(Random& g) {
    Case c;
    c.on_lattice = pick(g, 0, 3) != 0;
    const Unit64 span = pick(g, 1, 4);
    const auto coordinate = [&] {
        Unit64 a = pick(g, -span, span) * one;
        if (!c.on_lattice && pick(g, 0, 1)) a += pick(g, -3, 3) * (one >> jitter_digits);
        return a;
    };
    const auto random_track = [&](Unit64 half) {
        GridTrack t{coordinate(), coordinate(), coordinate(), coordinate(), half};
        if (pick(g, 0, 4) == 0) t.bx = t.ax, t.by = t.ay;
        return t;
    };
    for (Unit64 i = 0, n = pick(g, 1, 2); i < n; ++i) c.upper.push_back(random_track(pick(g, 1, 2) * one / 2));
    for (Unit64 i = 0, n = pick(g, 1, 5); i < n; ++i) {
        const Unit64 half = pick(g, 1, 3) * one;
        const GridTrack& follow =
            c.upper[static_cast<std::size_t>(pick(g, 0, static_cast<Unit64>(c.upper.size()) - 1))];
        switch (pick(g, 0, 4)) {
            case 0: {  // a shifted copy
                const Unit64 x = pick(g, -2, 2) * one / 2, y = pick(g, -2, 2) * one / 2;
                c.lower.push_back({follow.ax + x, follow.ay + y, follow.bx + x, follow.by + y, half});
                break;
            }
            case 1:  // turned round, or the first half of it
                c.lower.push_back(
                    {follow.bx, follow.by, (follow.ax + follow.bx) / 2, (follow.ay + follow.by) / 2, half});
                break;
            default:
                c.lower.push_back(random_track(half));
        }
    }
    return c;
}

// ρ is half a step, so a stadium of radius R is below is a track of width 2 R - 1. `grow` goes to every radius below.
inline PrintedLayer layer_of(const std::vector<GridTrack>& tracks, bool below, const Rational& grow) {
    PrintedLayer layer = printed({});
    const auto mm = [](Unit64 a) { return Rational(Rational(static_cast<long>(a)) / static_cast<long>(one)); };
    for (const GridTrack& t : tracks)
        layer.tracks.push_back(track(mm(t.ax), mm(t.ay), mm(t.bx), mm(t.by),
                                     below ? Rational(2 * mm(t.half) - 1 + 2 * grow) : Rational(2 * mm(t.half))));
    return layer;
}

}  // namespace ribvault::test
