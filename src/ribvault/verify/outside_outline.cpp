#include "ribvault/verify/outside_outline.hpp"

#include <algorithm>
#include <cmath>

namespace ribvault {
namespace {

using RationalPoint = std::array<Rational, 2>;

Rational cross(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// A track in doubles: coordinates truncated once, so off by less than 2^-52 of their size.
struct Approximate {
    double ax, ay, bx, by;
    explicit Approximate(const PrintedTrack& t) : ax(t.a[0].get_d()), ay(t.a[1].get_d()), bx(t.b[0].get_d()), by(t.b[1].get_d()) {}
    double size() const { return std::max({std::fabs(ax), std::fabs(ay), std::fabs(bx), std::fabs(by)}); }
};

class Outline {
public:
    explicit Outline(const PrintedLayer& lower) {
        for (const PrintedTrack& t : lower.tracks) {
            if (!t.outline || t.a == t.b) continue;
            edges_.push_back(&t);
            doubles_.emplace_back(t);
            if (!narrowest_ || t.width < narrowest_->width) narrowest_ = &t;
        }
        if (!closed()) edges_.clear(), doubles_.clear();
        for (const Approximate& e : doubles_) largest_ = std::max(largest_, e.size());
    }
    bool empty() const { return edges_.empty(); }
    const Rational& width() const { return narrowest_->width; }

    void add_outside(const PrintedTrack& track, std::vector<PrintedTrack>& result) const {
        const Approximate t(track);
        const double c = std::max(largest_, t.size());
        std::vector<Rational> cuts{0, 1};
        for (std::size_t k = 0; k < edges_.size(); ++k)
            if (may_meet(t, doubles_[k], c)) add_cuts(track, *edges_[k], cuts);
        std::sort(cuts.begin(), cuts.end());
        cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
        const auto at = [&](const Rational& s) -> RationalPoint {
            if (s == 0) return track.a;
            if (s == 1) return track.b;
            return {track.a[0] + s * (track.b[0] - track.a[0]), track.a[1] + s * (track.b[1] - track.a[1])};
        };
        if (track.a == track.b) cuts = {0, 0};
        for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
            if (inside(at((cuts[k] + cuts[k + 1]) / 2))) continue;
            PrintedTrack piece = track;
            piece.a = at(cuts[k]), piece.b = at(cuts[k + 1]), piece.width = width(), piece.outline = false;
            result.push_back(std::move(piece));
        }
    }

private:
    bool closed() const {
        std::vector<const RationalPoint*> ends;
        for (const PrintedTrack* e : edges_) ends.push_back(&e->a), ends.push_back(&e->b);
        std::sort(ends.begin(), ends.end(), [](const RationalPoint* p, const RationalPoint* q) { return *p < *q; });
        for (std::size_t k = 0; k < ends.size();) {
            std::size_t same = k;
            while (same < ends.size() && *ends[same] == *ends[k]) ++same;
            if ((same - k) % 2 != 0) return false;
            k = same;
        }
        return true;
    }

    /// Sign of the turn a -> b -> p, 0 when doubles do not tell. Differences are off by 2^-50 c, so each product of two by
    /// 2^-50 c times the sum of the factors, and a rounding of 2^-52 of itself: 2^-48 c (the four lengths) is more than all.
    static int turn(double ax, double ay, double bx, double by, double px, double py, double c) {
        const double ux = bx - ax, uy = by - ay, vx = px - ax, vy = py - ay, d = ux * vy - uy * vx;
        const double error = 0x1p-48 * c * (std::fabs(ux) + std::fabs(uy) + std::fabs(vx) + std::fabs(vy) + 0x1p-48 * c);
        return d > error ? 1 : d < -error ? -1 : 0;
    }

    static bool may_meet(const Approximate& s, const Approximate& e, double c) {
        const double margin = 0x1p-46 * c;
        if (std::max(s.ax, s.bx) + margin < std::min(e.ax, e.bx) || std::min(s.ax, s.bx) > std::max(e.ax, e.bx) + margin ||
            std::max(s.ay, s.by) + margin < std::min(e.ay, e.by) || std::min(s.ay, s.by) > std::max(e.ay, e.by) + margin)
            return false;
        if (turn(s.ax, s.ay, s.bx, s.by, e.ax, e.ay, c) * turn(s.ax, s.ay, s.bx, s.by, e.bx, e.by, c) > 0) return false;
        return turn(e.ax, e.ay, e.bx, e.by, s.ax, s.ay, c) * turn(e.ax, e.ay, e.bx, e.by, s.bx, s.by, c) <= 0;
    }

    /// Where along the track (0 to 1) it meets the edge; both ends of a common piece.
    static void add_cuts(const PrintedTrack& track, const PrintedTrack& edge, std::vector<Rational>& cuts) {
        const Rational ux = track.b[0] - track.a[0], uy = track.b[1] - track.a[1];
        const Rational c = cross(edge.a, edge.b, track.a), d = cross(edge.a, edge.b, track.b);
        const auto add = [&](const Rational& t) {
            if (t > 0 && t < 1) cuts.push_back(t);
        };
        if (c != d) {
            const Rational t = c / (c - d);
            const Rational e = cross(track.a, track.b, edge.a), f = cross(track.a, track.b, edge.b);
            if (sgn(e) * sgn(f) <= 0) add(t);
        } else if (c == 0) {
            const Rational uu = ux * ux + uy * uy;
            if (uu == 0) return;
            for (const RationalPoint* p : {&edge.a, &edge.b}) add(((*p)[0] - track.a[0]) * ux / uu + ((*p)[1] - track.a[1]) * uy / uu);
        }
    }

    /// Odd number of edges crossed by the ray to +x. A vertex on the ray counts as above it.
    bool inside(const RationalPoint& p) const {
        const double x = p[0].get_d(), y = p[1].get_d(), c = std::max({largest_, std::fabs(x), std::fabs(y)}), margin = 0x1p-50 * c;
        const auto above = [&](double approximate, const Rational& exact) {
            if (approximate > y + margin) return true;
            if (approximate < y - margin) return false;
            return exact >= p[1];
        };
        bool odd = false;
        for (std::size_t k = 0; k < edges_.size(); ++k) {
            const Approximate& e = doubles_[k];
            const bool up = above(e.by, edges_[k]->b[1]);
            if (above(e.ay, edges_[k]->a[1]) == up) continue;
            if (std::max(e.ax, e.bx) < x - margin) continue;
            int side = std::min(e.ax, e.bx) > x + margin ? (up ? 1 : -1) : turn(e.ax, e.ay, e.bx, e.by, x, y, c);
            if (side == 0) side = sgn(cross(edges_[k]->a, edges_[k]->b, p));
            if (side == (up ? 1 : -1)) odd = !odd;
        }
        return odd;
    }

    std::vector<const PrintedTrack*> edges_;
    std::vector<Approximate> doubles_;
    const PrintedTrack* narrowest_ = nullptr;
    double largest_ = 0;
};

}  // namespace

std::vector<PrintedTrack> stretches_outside(const PrintedLayer& upper, const PrintedLayer& lower) {
    const Outline outline(lower);
    if (outline.empty()) return upper.tracks;
    std::vector<PrintedTrack> result;
    for (const PrintedTrack& track : upper.tracks) outline.add_outside(track, result);
    return result;
}

}  // namespace ribvault
