#include "ribvault/verify/prepared_tracks.hpp"

#include <algorithm>
#include <cfloat>
#include <cmath>

namespace ribvault::verify {

PreparedTrack prepared_track(double ax, double ay, double bx, double by, double half) {
    PreparedTrack t;
    t.ax = ax, t.ay = ay, t.bx = bx, t.by = by, t.half = half;
    t.dx = bx - ax, t.dy = by - ay;
    const double norm = t.dx * t.dx + t.dy * t.dy;
    t.length = std::sqrt(norm);
    t.inverse_norm = norm > DBL_MIN ? 1 / norm : 0;
    return t;
}

std::vector<PreparedTrack> prepare(std::span<const PrintedTrack> tracks) {
    std::vector<PreparedTrack> prepared;
    prepared.reserve(tracks.size());
    for (const PrintedTrack& t : tracks)
        prepared.push_back(
            prepared_track(t.a[0].get_d(), t.a[1].get_d(), t.b[0].get_d(), t.b[1].get_d(), t.width.get_d() / 2));
    return prepared;
}

double largest_coordinate(const std::vector<PreparedTrack>& upper, const std::vector<PreparedTrack>& lower,
                          double rho) {
    double c = std::max(2 * rho, 0x1p-900);
    for (const auto* tracks : {&upper, &lower})
        for (const PreparedTrack& t : *tracks)
            c = std::max({c, std::abs(t.ax), std::abs(t.ay), std::abs(t.bx), std::abs(t.by), 4 * t.half});
    return c * (1 + 0x1p-40);
}

TrackGrid::TrackGrid(std::span<const PreparedTrack> tracks, double reach) : tracks_(tracks), reach_(reach) {
    if (tracks.empty()) return;
    double hi_x = -HUGE_VAL, hi_y = -HUGE_VAL, widest = 0;
    lo_x_ = lo_y_ = HUGE_VAL;
    for (const PreparedTrack& t : tracks) {
        lo_x_ = std::min({lo_x_, t.ax, t.bx}), hi_x = std::max({hi_x, t.ax, t.bx});
        lo_y_ = std::min({lo_y_, t.ay, t.by}), hi_y = std::max({hi_y, t.ay, t.by});
        widest = std::max(widest, t.half + reach);
    }
    lo_x_ -= widest, lo_y_ -= widest, hi_x += widest, hi_y += widest;
    const double extent = std::max(hi_x - lo_x_, hi_y - lo_y_);
    const double most = std::min(512.0, 4 + 3 * std::sqrt(static_cast<double>(tracks.size())));
    cell_ = std::max(1.5 * widest, extent / most);
    columns_ = static_cast<int>((hi_x - lo_x_) / cell_) + 1, rows_ = static_cast<int>((hi_y - lo_y_) / cell_) + 1;
    starts_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_) + 1, 0);
    for (const PreparedTrack& t : tracks)
        visit_cells(t, t.half + reach, [&](std::size_t cell) { ++starts_[cell + 1]; });
    for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
    members_.resize(starts_.back());
    std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
    for (std::size_t i = 0; i < tracks.size(); ++i)
        visit_cells(tracks[i], tracks[i].half + reach,
                    [&](std::size_t cell) { members_[next[cell]++] = static_cast<int>(i); });
}

int TrackGrid::column(double x) const {
    return static_cast<int>(std::clamp((x - lo_x_) / cell_, 0.0, columns_ - 1.0));
}
int TrackGrid::row(double y) const {
    return static_cast<int>(std::clamp((y - lo_y_) / cell_, 0.0, rows_ - 1.0));
}

// Row by row, what of the centre line is within `radius` of the row, and `radius` on both sides. A thousandth of a cell
// more is far above all roundings.
template <class Visit>
void TrackGrid::visit_cells(const PreparedTrack& t, double radius, const Visit& visit) const {
    const double r = radius + 0.001 * cell_;
    if (std::max(t.ax, t.bx) + r < lo_x_ || std::max(t.ay, t.by) + r < lo_y_ ||
        std::min(t.ax, t.bx) - r > lo_x_ + columns_ * cell_ || std::min(t.ay, t.by) - r > lo_y_ + rows_ * cell_)
        return;
    const int last = row(std::max(t.ay, t.by) + r);
    for (int j = row(std::min(t.ay, t.by) - r); j <= last; ++j) {
        double x0 = std::min(t.ax, t.bx), x1 = std::max(t.ax, t.bx);
        if (std::abs(t.dy) > cell_) {
            const double s0 = (lo_y_ + j * cell_ - r - t.ay) / t.dy, s1 = (lo_y_ + (j + 1) * cell_ + r - t.ay) / t.dy;
            const double from = std::max(0.0, std::min(s0, s1)), to = std::min(1.0, std::max(s0, s1));
            const double u = t.ax + from * t.dx, w = t.ax + to * t.dx;
            x0 = std::min(u, w), x1 = std::max(u, w);
        }
        const int end = column(x1 + r);
        for (int i = column(x0 - r); i <= end; ++i)
            visit(static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(i));
    }
}

void TrackGrid::near(const PreparedTrack& t, double radius, std::vector<int>& found) const {
    found.clear();
    if (tracks_.empty()) return;
    visit_cells(t, radius, [&](std::size_t cell) {
        found.insert(found.end(), members_.begin() + starts_[cell], members_.begin() + starts_[cell + 1]);
    });
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
}

void TrackGrid::near(double x, double y, double half, std::vector<int>& found) const {
    PreparedTrack point;
    point.ax = point.bx = x, point.ay = point.by = y;
    near(point, half, found);
}

// Rings of cells about the point. A track that is in no cell of the rings 0 to n - 1 is farther than (n - 1) cells from
// the cell of the (clamped) point in one coordinate, so its stadium is at least n - 1 cells + reach away.
int TrackGrid::nearest(double x, double y, double& distance) const {
    distance = HUGE_VAL;
    int best = -1;
    if (tracks_.empty()) return best;
    const int ci = column(x), cj = row(y);
    const auto visit = [&](int i, int j) {
        const std::size_t cell =
            static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(i);
        for (std::uint32_t k = starts_[cell]; k < starts_[cell + 1]; ++k) {
            const PreparedTrack& t = tracks_[static_cast<std::size_t>(members_[k])];
            const double d = centre_distance(t, x, y) - t.half;
            if (d < distance) distance = d, best = members_[k];
        }
    };
    const int most = std::max({ci, columns_ - 1 - ci, cj, rows_ - 1 - cj});
    for (int n = 0; n <= most; ++n) {
        if (best >= 0 && distance < (n - 1) * cell_) break;
        for (int j = std::max(0, cj - n); j <= std::min(rows_ - 1, cj + n); ++j) {
            const bool whole = j == cj - n || j == cj + n;
            for (int i = whole ? std::max(0, ci - n) : ci - n; i <= std::min(columns_ - 1, ci + n);
                 i += whole ? 1 : 2 * n)
                if (i >= 0) visit(i, j);
            if (n == 0) break;
        }
    }
    return best;
}

}  // namespace ribvault::verify
