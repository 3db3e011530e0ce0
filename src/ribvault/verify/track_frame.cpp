#include "ribvault/verify/track_frame.hpp"

#include <algorithm>

namespace ribvault::verify {

bool about_where(const FrameStadium& f, double y, double grow, Stretch& stretch) {
    const double r = f.radius + grow;
    if (r <= 0) return false;
    stretch = {HUGE_VAL, -HUGE_VAL};
    const auto disc = [&](double cs, double cy) {
        const double h = y - cy, under = (r - h) * (r + h);
        if (under < 0) return;
        const double w = std::sqrt(under);
        stretch.lo = std::min(stretch.lo, cs - w), stretch.hi = std::max(stretch.hi, cs + w);
    };
    disc(f.as, f.ay), disc(f.bs, f.by);
    if (f.inverse_norm > 0 && f.dy != 0) {
        // Where the line meets the two sides of the strip, when that is beside the segment.
        const double length = std::sqrt(f.ds * f.ds + f.dy * f.dy);
        for (const double side : {-r, r}) {
            // Point p of the parallel line at parameter t: a + t d + side * normal, with p.y = y.
            const double t = (y - f.ay - side * f.ds / length) / f.dy;
            if (t < 0 || t > 1) continue;
            const double s = f.as + t * f.ds - side * f.dy / length;
            stretch.lo = std::min(stretch.lo, s), stretch.hi = std::max(stretch.hi, s);
        }
    }
    return stretch.lo <= stretch.hi;
}

bool certainly_inside(const FrameStadium& f, double y, double margin, Stretch& stretch) {
    if (!about_where(f, y, -2 * margin, stretch)) return false;
    const double reach = f.radius - margin;
    for (double give = 0; give <= 0.3; give = give == 0 ? 1e-9 : give * 1000) {
        const double by = give * (stretch.hi - stretch.lo);
        if (distance(f, stretch.lo + by, y) <= reach && distance(f, stretch.hi - by, y) <= reach) {
            stretch.lo += by, stretch.hi -= by;
            return true;
        }
    }
    return false;
}

}  // namespace ribvault::verify
