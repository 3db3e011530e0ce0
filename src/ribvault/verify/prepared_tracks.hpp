// Tracks in doubles, and which of them come near a place: what keeps rational numbers off the hot path. Light.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "ribvault/verify/printed_layer.hpp"

namespace ribvault::verify {

/// A track in doubles, mm or lattice units. Every number is within 2^-50 of the largest coordinate of all.
struct PreparedTrack {
    double ax = 0, ay = 0, bx = 0, by = 0;
    double dx = 0, dy = 0, length = 0, inverse_norm = 0;  ///< b - a; inverse_norm 0: a point as far as doubles tell
    double half = 0;                                      ///< half the width
};

PreparedTrack prepared_track(double ax, double ay, double bx, double by, double half);
std::vector<PreparedTrack> prepare(std::span<const PrintedTrack> tracks);

/// Squared distance of v to the segment from the origin to d; `inverse_norm`: of d, 0 for a point.
inline double squared_distance_to(double vx, double vy, double dx, double dy, double inverse_norm) {
    double along = (vx * dx + vy * dy) * inverse_norm;
    along = along > 0 ? along : 0;
    along = along < 1 ? along : 1;
    const double ex = vx - along * dx, ey = vy - along * dy;
    return ex * ex + ey * ey;
}

/// Squared distance of (x, y) to the centre line.
inline double squared_centre_distance(const PreparedTrack& t, double x, double y) {
    return squared_distance_to(x - t.ax, y - t.ay, t.dx, t.dy, t.inverse_norm);
}
inline double centre_distance(const PreparedTrack& t, double x, double y) {
    return std::sqrt(squared_centre_distance(t, x, y));
}

/// An upper bound of every |coordinate|, width and ρ of two layers; at least the smallest positive double that keeps
/// margins positive.
double largest_coordinate(const std::vector<PreparedTrack>& upper, const std::vector<PreparedTrack>& lower, double rho);

/// The margin for a largest coordinate c. Coordinates are off by 2^-52 c (Rational::get_d truncates), so differences
/// by 2^-50 c, and a point at the clamped parameter t of a segment by 2^-49 c whatever the error of t, which moves a
/// distance in second order only (an error of t by 2^-50 (|v| + |d|) / |d| moves the foot by 2^-49 c). Unit vectors and
/// rotated coordinates add a few 2^-50 c. All distances, and places along a track, are right within 2^-45 c under any
/// rounding mode: 2^-40 c is thirty times that.
inline double margin_of(double c) { return c * 0x1p-40; }

/// Tracks in square cells. Found again from any box or stadium near them.
class TrackGrid {
public:
    TrackGrid() = default;
    /// Enters every track dilated by its half width + `reach`. The tracks must stay where they are while the grid is
    /// used.
    TrackGrid(std::span<const PreparedTrack> tracks, double reach);

    /// Indices (increasing) of at least every track whose stadium, dilated by `reach`, comes within `radius` of the
    /// centre line of `t`.
    void near(const PreparedTrack& t, double radius, std::vector<int>& found) const;

    /// The same for the square of half side `half` about (x, y).
    void near(double x, double y, double half, std::vector<int>& found) const;

    /// Whether `test` holds for an index of some, among them at least every track whose stadium, dilated by `reach`,
    /// contains (x, y).
    template <class Test>
    bool any_at(double x, double y, const Test& test) const {
        if (tracks_.empty()) return false;
        const std::size_t cell =
            static_cast<std::size_t>(row(y)) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column(x));
        for (std::uint32_t k = starts_[cell]; k < starts_[cell + 1]; ++k)
            if (test(members_[k])) return true;
        return false;
    }

    /// The least distance of (x, y) to the stadium of a track (negative inside), and which track; -1 when there is
    /// none.
    int nearest(double x, double y, double& distance) const;

private:
    struct Range {
        int lo, hi;
    };
    int column(double x) const;
    int row(double y) const;
    template <class Visit>
    void visit_cells(const PreparedTrack& t, double radius, const Visit& visit) const;

    std::span<const PreparedTrack> tracks_;
    double lo_x_ = 0, lo_y_ = 0, cell_ = 1, reach_ = 0;
    int columns_ = 0, rows_ = 0;
    std::vector<std::uint32_t> starts_;
    std::vector<int> members_;
};

}  // namespace ribvault::verify
