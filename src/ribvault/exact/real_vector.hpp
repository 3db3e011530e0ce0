// Vectors of the plane in machine numbers, for what is ours to place. Nothing here decides.
#pragma once

#include <cmath>

#include "ribvault/exact/lattice.hpp"

namespace ribvault {

struct Vec {
    double x = 0, y = 0;
};
inline Vec vec(Point p) { return {static_cast<double>(p.x), static_cast<double>(p.y)}; }
inline Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y}; }
inline Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y}; }
inline Vec operator*(double t, Vec a) { return {t * a.x, t * a.y}; }
inline double dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y; }
inline double norm(Vec a) { return std::sqrt(dot(a, a)); }
inline Point rounded(Vec a) { return {round_to_lattice(a.x), round_to_lattice(a.y)}; }

}  // namespace ribvault
