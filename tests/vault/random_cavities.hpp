// Stacks of cavities that change slowly from layer to layer.
#pragma once

#include <random>
#include <vector>

#include "ribvault/slice/cavity.hpp"
#include "ribvault/slice/lattice_clip.hpp"

namespace ribvault::test {

inline Contour rectangle(Unit x0, Unit y0, Unit x1, Unit y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }
inline Contour reversed(Contour c) { return {c.rbegin(), c.rend()}; }
inline Contour disc(Point centre, double radius, int corners, double turn = 0) {
    Contour contour;
    for (int k = 0; k < corners; ++k) {
        const double angle = turn + 2 * M_PI * k / corners;
        contour.push_back({centre.x + round_to_lattice(radius * std::cos(angle)),
                           centre.y + round_to_lattice(radius * std::sin(angle))});
    }
    return contour;
}

/// Boxes (axis-parallel or not) and discs that move, grow and turn a little from layer to layer; some are islands.
class DriftingShapes {
public:
    DriftingShapes(std::mt19937_64& random, int solids, int islands, Unit size, Unit drift) {
        const auto uniform = [&](double lo, double hi) {
            return std::uniform_real_distribution<double>(lo, hi)(random);
        };
        const double s = static_cast<double>(size), d = static_cast<double>(drift);
        for (int k = 0; k < solids + islands; ++k) {
            const bool island = k >= solids;
            const int kind = static_cast<int>(uniform(0, 3));
            shapes_.push_back({island,
                               kind == 0 ? 24 : 4,
                               kind == 1,
                               {uniform(-s, s) / 2, uniform(-s, s) / 2},
                               {uniform(-d, d), uniform(-d, d)},
                               (island ? 0.15 : 0.6) * uniform(0.3, 1) * s,
                               uniform(-d, d) / 2,
                               kind == 2 ? uniform(0, 1) : 0,
                               kind == 2 ? uniform(-1, 1) * d / s : 0});
        }
    }

    Region at(int layer) const {
        Region solids, islands;
        for (const Shape& s : shapes_) {
            const double t = layer;
            const Point centre{round_to_lattice(s.at[0] + t * s.move[0]), round_to_lattice(s.at[1] + t * s.move[1])};
            const double radius = s.radius + t * s.growth;
            if (radius < 100) continue;
            const Unit half = round_to_lattice(radius * 0.7);
            Contour contour = s.axis_parallel
                                  ? rectangle(centre.x - half, centre.y - half, centre.x + half, centre.y + half)
                                  : disc(centre, radius, s.corners, s.turn + t * s.spin);
            (s.island ? islands : solids).push_back(std::move(contour));
        }
        return clip(ClipperLib::ctDifference, solids, islands);
    }

private:
    struct Shape {
        bool island;
        int corners;
        bool axis_parallel;
        double at[2], move[2], radius, growth, turn, spin;
    };
    std::vector<Shape> shapes_;
};

}  // namespace ribvault::test
