// The frame of one track, and where stadiums certainly cover a line of it. Doubles with margins; light.
#pragma once

#include <cmath>

#include "ribvault/verify/prepared_tracks.hpp"

namespace ribvault::verify {

/// A stadium below, seen from a track above: s along its centre line from a, y to the left. mm.
struct FrameStadium {
    double as = 0, ay = 0, bs = 0, by = 0;
    double ds = 0, dy = 0, inverse_norm = 0;
    double radius = 0;  ///< half width plus ρ
};

struct Stretch {
    double lo = 0, hi = 0;
};

/// Frame of a track. `wide_enough`: its direction is so certain that within half + length of it places across are right
/// within the margin. The direction is off by 2^-50 c / length, so by less than 2^-10 margin * (half + length) / length
/// across: half <= 255 length suffices.
struct TrackFrame {
    double ax = 0, ay = 0, ux = 1, uy = 0, length = 0;
    bool wide_enough = false;
    explicit TrackFrame(const PreparedTrack& t)
        : ax(t.ax), ay(t.ay), length(t.length), wide_enough(t.inverse_norm > 0 && t.half <= 255 * t.length) {
        if (t.inverse_norm > 0) ux = t.dx / t.length, uy = t.dy / t.length;
    }
    FrameStadium see(const PreparedTrack& t, double radius) const {
        FrameStadium f;
        f.as = (t.ax - ax) * ux + (t.ay - ay) * uy, f.ay = (t.ay - ay) * ux - (t.ax - ax) * uy;
        f.bs = (t.bx - ax) * ux + (t.by - ay) * uy, f.by = (t.by - ay) * ux - (t.bx - ax) * uy;
        f.ds = f.bs - f.as, f.dy = f.by - f.ay;
        f.inverse_norm = t.inverse_norm;
        f.radius = radius;
        return f;
    }
};

inline double distance(const FrameStadium& f, double s, double y) {
    return std::sqrt(squared_distance_to(s - f.as, y - f.ay, f.ds, f.dy, f.inverse_norm));
}

/// About where the line at y enters and leaves the stadium with its radius changed by `grow`: no certainty about
/// either. False when it seems to miss it.
bool about_where(const FrameStadium& f, double y, double grow, Stretch& stretch);

/// A stretch of the line at y that is certainly inside the stadium, nearly all of it. Stadiums are convex, so its ends
/// are all that needs a look. False when none was found.
bool certainly_inside(const FrameStadium& f, double y, double margin, Stretch& stretch);

}  // namespace ribvault::verify
