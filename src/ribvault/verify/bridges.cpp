#include "ribvault/verify/bridges.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace ribvault {
namespace {

constexpr double straight_mm = 0.01;
using Vector = std::array<double, 2>;

Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1]}; }
double cross(const Vector& a, const Vector& b) { return a[0] * b[1] - a[1] * b[0]; }
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1]; }
double norm(const Vector& a) { return std::hypot(a[0], a[1]); }

Vector place(const PrintedPoint& p) { return {p[0].get_d(), p[1].get_d()}; }

double length(const PrintedTrack& t) { return norm(minus(place(t.b), place(t.a))); }

Vector along(const PrintedTrack& t, double mm) {
    const Vector a = place(t.a), d = minus(place(t.b), a);
    const double whole = norm(d);
    if (whole == 0) return a;
    return {a[0] + mm / whole * d[0], a[1] + mm / whole * d[1]};
}

/// All points in order along the straight line from the first to the last, to within straight_mm.
bool is_straight(const std::vector<Vector>& points) {
    const Vector d = minus(points.back(), points.front());
    const double whole = norm(d);
    if (whole == 0) return false;
    double before = 0;
    for (const Vector& p : points) {
        const Vector q = minus(p, points.front());
        const double at = dot(q, d) / whole;
        if (std::abs(cross(q, d)) > straight_mm * whole || at < before - straight_mm) return false;
        before = at;
    }
    return true;
}

}  // namespace

std::vector<Bridge> find_bridges(const PrintedLayer& upper, const std::vector<char>& continues,
                                 const std::vector<char>& judged, const PrintedVerdict& verdict,
                                 const Rational& longest) {
    std::vector<Bridge> bridges;
    const auto& pieces = verdict.pieces;
    const auto joined = [&](std::size_t track) { return track < upper.tracks.size() && continues[track] != 0; };
    const auto is_judged = [&](std::size_t track) { return judged.empty() || judged[track] != 0; };
    for (std::size_t first = 0, last = 0; first < pieces.size(); first = last + 1) {
        last = first;
        std::vector<Vector> points{along(upper.tracks[pieces[first].track], pieces[first].from_mm)};
        Rational most = pieces[first].length[1];
        while (last + 1 < pieces.size() && pieces[last + 1].track == pieces[last].track + 1 &&
               joined(pieces[last + 1].track) && pieces[last].to_end && pieces[last + 1].from_start) {
            ++last;
            points.push_back(place(upper.tracks[pieces[last].track].a));
            most += pieces[last].length[1];
        }
        points.push_back(along(upper.tracks[pieces[last].track], pieces[last].to_mm));
        const std::size_t before = pieces[first].track, after = pieces[last].track + 1;
        const bool held_before = !pieces[first].from_start || (joined(before) && before > 0 && is_judged(before - 1));
        const bool held_after = !pieces[last].to_end || (joined(after) && is_judged(after));
        if (!held_before || !held_after || most > longest || !is_straight(points)) continue;
        Bridge bridge;
        for (std::size_t k = first; k <= last; ++k) bridge.pieces.push_back(k);
        bridge.length_mm = std::nextafter(most.get_d(), HUGE_VAL);
        bridges.push_back(std::move(bridge));
    }
    return bridges;
}

PrintedLayer take_out_bridges(const PrintedLayer& upper, const std::vector<char>& continues,
                              const PrintedVerdict& verdict, const std::vector<Bridge>& bridges) {
    struct Cut {
        double from, to;  // mm along the track
    };
    std::vector<std::vector<Cut>> cuts(upper.tracks.size());
    for (const Bridge& bridge : bridges) {
        for (const std::size_t k : bridge.pieces) {
            const UnsupportedPiece& p = verdict.pieces[k];
            const double width = upper.tracks[p.track].width.get_d();
            cuts[p.track].push_back({p.from_mm - width, p.to_mm + width});
        }
        // One width beyond a joint belongs to the neighbour.
        const auto beyond = [&](std::size_t track, bool at_start, double width) {
            const double whole = length(upper.tracks[track]);
            cuts[track].push_back(at_start ? Cut{-1, width} : Cut{whole - width, whole + 1});
        };
        const UnsupportedPiece &first = verdict.pieces[bridge.pieces.front()],
                               &last = verdict.pieces[bridge.pieces.back()];
        const double w0 = upper.tracks[first.track].width.get_d(), w1 = upper.tracks[last.track].width.get_d();
        if (first.from_mm < w0 && first.track > 0 && continues[first.track] != 0)
            beyond(first.track - 1, false, w0 - first.from_mm);
        const double left = length(upper.tracks[last.track]) - last.to_mm;
        if (left < w1 && last.track + 1 < upper.tracks.size() && continues[last.track + 1] != 0)
            beyond(last.track + 1, true, w1 - left);
    }
    PrintedLayer result;
    for (std::size_t k = 0; k < upper.tracks.size(); ++k) {
        const PrintedTrack& t = upper.tracks[k];
        if (cuts[k].empty()) {
            result.tracks.push_back(t);
            continue;
        }
        std::sort(cuts[k].begin(), cuts[k].end(), [](const Cut& a, const Cut& b) { return a.from < b.from; });
        const double whole = length(t);
        const auto at = [&](double mm) {
            const Rational share = whole > 0 ? Rational(std::clamp(mm / whole, 0.0, 1.0)) : Rational(0);
            const std::array<Rational, 2> a = rational(t.a), b = rational(t.b);
            return PrintedPoint{Rational(a[0] + share * (b[0] - a[0])), Rational(a[1] + share * (b[1] - a[1]))};
        };
        double done = 0;
        cuts[k].push_back({whole, whole});
        for (const Cut& cut : cuts[k]) {
            if (cut.from > done) {
                PrintedTrack part = t;
                if (done > 0) part.a = at(done);
                if (cut.from < whole) part.b = at(cut.from);
                result.tracks.push_back(std::move(part));
            }
            done = std::max(done, cut.to);
        }
    }
    return result;
}

}  // namespace ribvault
