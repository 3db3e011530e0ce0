#include "ribvault/verify/outside_outline.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "ribvault/verify/exact_stadium.hpp"
#include "ribvault/verify/height_rows.hpp"
#include "ribvault/verify/winding.hpp"

namespace ribvault {
namespace {

using verify::RationalPoint;

Rational cross(const RationalPoint& a, const RationalPoint& b, const RationalPoint& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// A track in doubles: coordinates truncated once, so off by less than 2^-52 of their size.
struct Approximate {
    double ax, ay, bx, by;
    explicit Approximate(const PrintedTrack& t)
        : ax(t.a[0].get_d()), ay(t.a[1].get_d()), bx(t.b[0].get_d()), by(t.b[1].get_d()) {}
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
        const double margin = 2 * 0x1p-46 * largest_;  // twice what heights are off by
        rows_ = HeightRows(doubles_.size(), [&](std::size_t k) {
            const Approximate& e = doubles_[k];
            return std::pair(std::min(e.ay, e.by) - margin, std::max(e.ay, e.by) + margin);
        });
    }
    bool empty() const { return edges_.empty(); }
    const Millimetres& width() const { return narrowest_->width; }

    std::vector<PrintedTrack> outside(const PrintedLayer& upper) const {
        if (empty()) return upper.tracks;
        std::vector<PrintedTrack> result;
        for (const PrintedTrack& track : upper.tracks) add_outside(track, result);
        return result;
    }

private:
    void add_outside(const PrintedTrack& track, std::vector<PrintedTrack>& result) const {
        const Approximate t(track);
        const double c = std::max(largest_, t.size()), margin = 0x1p-46 * c;
        std::vector<Rational> cuts;
        if (track.a != track.b)
            rows_.visit(std::min(t.ay, t.by) - margin, std::max(t.ay, t.by) + margin, [&](std::uint32_t k) {
                if (may_meet(t, doubles_[k], c)) add_cuts(track, *edges_[k], cuts);
            });
        if (cuts.empty()) {
            const bool in =
                inside((t.ax + t.bx) / 2, (t.ay + t.by) / 2, [&] { return between(track, Rational(1, 2)); });
            if (!in) add(track, track.a, track.b, result);
            return;
        }
        std::sort(cuts.begin(), cuts.end());
        cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
        cuts.push_back(1);
        PrintedPoint from = track.a;
        Rational before = 0;
        for (const Rational& cut : cuts) {
            const PrintedPoint to = cut == 1 ? track.b : printed(between(track, cut));
            const RationalPoint middle = between(track, Rational((before + cut) / 2));
            if (!inside(middle[0].get_d(), middle[1].get_d(), [&] { return middle; })) add(track, from, to, result);
            from = to, before = cut;
        }
    }

    void add(const PrintedTrack& track, const PrintedPoint& from, const PrintedPoint& to,
             std::vector<PrintedTrack>& result) const {
        PrintedTrack piece = track;
        piece.a = from, piece.b = to, piece.outline = false;
        result.push_back(std::move(piece));
    }
    static PrintedPoint printed(const RationalPoint& p) { return {p[0], p[1]}; }
    /// The point at `s` of the way from a to b.
    static RationalPoint between(const PrintedTrack& track, const Rational& s) {
        const RationalPoint a = rational(track.a), b = rational(track.b);
        return {Rational(a[0] + s * (b[0] - a[0])), Rational(a[1] + s * (b[1] - a[1]))};
    }

    bool closed() const {
        std::vector<const PrintedPoint*> ends;
        for (const PrintedTrack* e : edges_) ends.push_back(&e->a), ends.push_back(&e->b);
        std::sort(ends.begin(), ends.end(), [](const PrintedPoint* p, const PrintedPoint* q) { return *p < *q; });
        for (std::size_t k = 0; k < ends.size();) {
            std::size_t same = k;
            while (same < ends.size() && *ends[same] == *ends[k]) ++same;
            if ((same - k) % 2 != 0) return false;
            k = same;
        }
        return true;
    }

    /// Sign of the turn a -> b -> p, 0 when doubles do not tell. Differences are off by 2^-50 c, so each product of two
    /// by 2^-50 c times the sum of the factors, and a rounding of 2^-52 of itself: 2^-48 c (the four lengths) is more
    /// than all.
    static int turn(double ax, double ay, double bx, double by, double px, double py, double c) {
        const double ux = bx - ax, uy = by - ay, vx = px - ax, vy = py - ay, d = ux * vy - uy * vx;
        const double error =
            0x1p-48 * c * (std::fabs(ux) + std::fabs(uy) + std::fabs(vx) + std::fabs(vy) + 0x1p-48 * c);
        return d > error ? 1 : d < -error ? -1 : 0;
    }

    static bool may_meet(const Approximate& s, const Approximate& e, double c) {
        const double margin = 0x1p-46 * c;
        if (std::max(s.ax, s.bx) + margin < std::min(e.ax, e.bx) ||
            std::min(s.ax, s.bx) > std::max(e.ax, e.bx) + margin ||
            std::max(s.ay, s.by) + margin < std::min(e.ay, e.by) ||
            std::min(s.ay, s.by) > std::max(e.ay, e.by) + margin)
            return false;
        if (turn(s.ax, s.ay, s.bx, s.by, e.ax, e.ay, c) * turn(s.ax, s.ay, s.bx, s.by, e.bx, e.by, c) > 0) return false;
        return turn(e.ax, e.ay, e.bx, e.by, s.ax, s.ay, c) * turn(e.ax, e.ay, e.bx, e.by, s.bx, s.by, c) <= 0;
    }

    /// Where along the track (0 to 1) it meets the edge; both ends of a common piece.
    static void add_cuts(const PrintedTrack& track, const PrintedTrack& edge, std::vector<Rational>& cuts) {
        const RationalPoint a = rational(track.a), b = rational(track.b), from = rational(edge.a),
                            to = rational(edge.b);
        const Rational ux = b[0] - a[0], uy = b[1] - a[1];
        const Rational c = cross(from, to, a), d = cross(from, to, b);
        const auto add = [&](const Rational& t) {
            if (t > 0 && t < 1) cuts.push_back(t);
        };
        if (c != d) {
            const Rational t = c / (c - d);
            const Rational e = cross(a, b, from), f = cross(a, b, to);
            if (sgn(e) * sgn(f) <= 0) add(t);
        } else if (c == 0) {
            const Rational uu = ux * ux + uy * uy;
            for (const RationalPoint* p : {&from, &to}) add(((*p)[0] - a[0]) * ux / uu + ((*p)[1] - a[1]) * uy / uu);
        }
    }

    /// Whether a ray to +x crosses an odd number of edges. A vertex on the ray counts as above it. (x, y) is within
    /// 2^-51 c of the point that `exact` gives, c being the largest coordinate.
    template <class Exact>
    bool inside(double x, double y, const Exact& exact) const {
        const double c = std::max({largest_, std::fabs(x), std::fabs(y)}), margin = 0x1p-50 * c;
        std::optional<RationalPoint> point;
        const auto p = [&]() -> const RationalPoint& { return point ? *point : point.emplace(exact()); };
        const auto above = [&](double approximate, const Millimetres& height) {
            if (approximate > y + margin) return true;
            if (approximate < y - margin) return false;
            return Rational(height) >= p()[1];
        };
        std::uint32_t crossed = 0;
        const auto cross_edge = [&](std::uint32_t k) {
            const Approximate& e = doubles_[k];
            if (std::max(e.ax, e.bx) < x - margin) return;
            const bool a_above = above(e.ay, edges_[k]->a[1]), b_above = above(e.by, edges_[k]->b[1]);
            const auto side = [&] {
                if (std::min(e.ax, e.bx) > x + margin) return b_above ? 1 : -1;
                const int sure = turn(e.ax, e.ay, e.bx, e.by, x, y, c);
                return sure != 0 ? sure : sgn(cross(rational(edges_[k]->a), rational(edges_[k]->b), p()));
            };
            if (verify::ray_crossing(a_above, b_above, side) != 0) ++crossed;
        };
        // The rows allow for errors of 2^-45 of the edges' largest coordinate, so y may be off by that.
        if (c <= 16 * largest_)
            rows_.visit(y, y, cross_edge);
        else
            for (std::uint32_t k = 0; k < edges_.size(); ++k) cross_edge(k);
        return crossed % 2 != 0;
    }

    std::vector<const PrintedTrack*> edges_;
    std::vector<Approximate> doubles_;
    HeightRows rows_;
    const PrintedTrack* narrowest_ = nullptr;
    double largest_ = 0;
};

}  // namespace

std::vector<PrintedTrack> extruded_outside(const PrintedLayer& upper, const PrintedLayer& lower) {
    return Outline(lower).outside(upper);
}

OutsideTracks tracks_outside(const PrintedLayer& upper, const PrintedLayer& lower) {
    const Outline outline(lower);
    OutsideTracks result;
    result.extruded = outline.outside(upper);
    result.stretches = result.extruded;
    if (!outline.empty())
        for (PrintedTrack& stretch : result.stretches) stretch.width = outline.width();
    return result;
}

std::vector<PrintedTrack> stretches_outside(const PrintedLayer& upper, const PrintedLayer& lower) {
    return std::move(tracks_outside(upper, lower).stretches);
}

}  // namespace ribvault
