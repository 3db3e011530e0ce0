#include "ribvault/verify/exact_stadium.hpp"

namespace ribvault::verify {

Rational squared_distance(const RationalPoint& p, const RationalPoint& a, const RationalPoint& b) {
    const Rational vx = p[0] - a[0], vy = p[1] - a[1], dx = b[0] - a[0], dy = b[1] - a[1];
    const Rational ahead = vx * dx + vy * dy, norm = dx * dx + dy * dy;
    if (ahead <= 0) return vx * vx + vy * vy;
    if (ahead >= norm) {
        const Rational wx = p[0] - b[0], wy = p[1] - b[1];
        return wx * wx + wy * wy;
    }
    const Rational turn = dx * vy - dy * vx;
    return turn * turn / norm;
}

int compare_distance(const RationalPoint& p, const PrintedTrack& track, const Rational& radius) {
    return cmp(squared_distance(p, rational(track.a), rational(track.b)), Rational(radius * radius));
}

}  // namespace ribvault::verify
