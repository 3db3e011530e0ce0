#include "ribvault/verify/centre_line.hpp"

#include <algorithm>

#include "ribvault/verify/exact_stadium.hpp"

namespace ribvault::verify {

namespace {

using Stretch2 = std::array<QuadraticNumber, 2>;

void unite(std::optional<Stretch2>& all, Stretch2 with) {
    if (!all) {
        all = std::move(with);
        return;
    }
    if (compare(with[0], (*all)[0]) < 0) (*all)[0] = std::move(with[0]);
    if (compare(with[1], (*all)[1]) > 0) (*all)[1] = std::move(with[1]);
}

/// An end of a covered stretch, or of the track: in mm along it, between two doubles, and exactly when asked.
struct End {
    double lo = -HUGE_VAL, hi = HUGE_VAL;
    int stadium = -1;  ///< index into Below::which; -1: an end of the track
    int side = 0;      ///< 0: where the stretch begins, 1: where it ends
    std::optional<QuadraticNumber> exact;
};

struct Covered {
    End from, to;
};

class Line {
public:
    Line(const PrintedTrack& track, const PreparedTrack& prepared, const Below& below, double margin)
        : track_(track),
          prepared_(prepared),
          below_(below),
          margin_(margin),
          in_doubles_(prepared.inverse_norm > 0 && prepared.length > 64 * margin) {}

    std::vector<CentreGap> gaps(bool exact_ends, StageCounts& stages);

private:
    const QuadraticNumber& exact(End& e) {
        if (!e.exact) {
            const auto stretch = exact_of(e.stadium);
            e.exact = (*stretch)[static_cast<std::size_t>(e.side)];  // certainly inside somewhere: there is one
        }
        if (!e.exact->rational()) algebraic_ = true;
        return *e.exact;
    }
    std::optional<Stretch2> exact_of(int i) {
        const auto k = static_cast<std::size_t>(below_.which[static_cast<std::size_t>(i)]);
        return exact_stretch(track_, below_.tracks[k], below_.radii[k]);
    }
    int order(End& p, End& q) {
        if (p.hi < q.lo) return -1;
        if (p.lo > q.hi) return 1;
        if (p.stadium == q.stadium && p.side == q.side && p.lo == q.lo && p.hi == q.hi) return 0;
        exactly_ = true;
        return compare(exact(p), exact(q));
    }
    bool covered_by(int i, Covered& covered);
    bool certainly_apart(const FrameStadium& f) const;
    CentreGap gap_between(End from, End& to, bool exact_ends);
    std::optional<std::vector<CentreGap>> gaps_in_doubles(std::vector<Covered>& all, End& begin, End& end,
                                                          bool exact_ends);
    std::vector<CentreGap> gaps_in_order(std::vector<Covered>& all, End& begin, End& end, bool exact_ends);

    const PrintedTrack& track_;
    const PreparedTrack& prepared_;
    const Below& below_;
    double margin_;
    bool in_doubles_, exactly_ = false, algebraic_ = false;
};

// Segments whose ends are farther than the margin from each other cross in doubles when they cross.
bool Line::certainly_apart(const FrameStadium& f) const {
    const double length = prepared_.length, reach = f.radius + margin_;
    FrameStadium self;
    self.bs = self.ds = length, self.inverse_norm = prepared_.inverse_norm;
    if (distance(f, 0, 0) <= reach || distance(f, length, 0) <= reach || distance(self, f.as, f.ay) <= reach ||
        distance(self, f.bs, f.by) <= reach)
        return false;
    if ((f.ay > 0) == (f.by > 0)) return true;
    const double at = f.as - f.ay / f.dy * f.ds;
    return at < 0 || at > length;
}

bool Line::covered_by(int i, Covered& covered) {
    const FrameStadium& f = below_.seen[static_cast<std::size_t>(i)];
    covered = {};
    covered.from.stadium = covered.to.stadium = i;
    covered.to.side = 1;
    if (in_doubles_) {
        if (certainly_apart(f)) return false;
        Stretch in, out;
        if (certainly_inside(f, 0, margin_, in) && about_where(f, 0, 2 * margin_, out) && out.lo <= in.lo &&
            out.hi >= in.hi && distance(f, out.lo, 0) >= f.radius + margin_ &&
            distance(f, out.hi, 0) >= f.radius + margin_) {
            covered.from.lo = out.lo, covered.from.hi = in.lo;
            covered.to.lo = in.hi, covered.to.hi = out.hi;
            return true;
        }
    }
    exactly_ = true;
    const std::optional<Stretch2> stretch = exact_of(i);
    if (!stretch) return false;
    covered.from.exact = (*stretch)[0], covered.to.exact = (*stretch)[1];
    if (in_doubles_)
        for (End* e : {&covered.from, &covered.to}) {
            const std::array<Rational, 2> t = enclose(*e->exact, 60);
            e->lo = t[0].get_d() * prepared_.length, e->hi = t[1].get_d() * prepared_.length;
            e->lo -= margin_ + std::abs(e->lo) * 0x1p-40, e->hi += margin_ + std::abs(e->hi) * 0x1p-40;
        }
    return true;
}

CentreGap Line::gap_between(End from, End& to, bool exact_ends) {
    if (in_doubles_ && !exact_ends) return {{}, {}, from.lo, from.hi, to.lo, to.hi};
    CentreGap gap{exact(from), exact(to)};
    const std::array<Rational, 2> begin = enclose(gap.from, 60), end = enclose(gap.to, 60);
    gap.from_lo = begin[0].get_d() * prepared_.length, gap.from_hi = begin[1].get_d() * prepared_.length;
    gap.to_lo = end[0].get_d() * prepared_.length, gap.to_hi = end[1].get_d() * prepared_.length;
    return gap;
}

/// How far the line is covered: the farthest of ends that doubles do not tell apart, between lo and hi. Tracks below
/// that follow each other share a disc, in which their stretches end at the same point: which of them it is seldom
/// matters.
struct Reached {
    double lo, hi;
    std::vector<End*> ends;

    explicit Reached(End& end) : lo(end.lo), hi(end.hi), ends{&end} {}
    void extend(End& to) {
        if (to.hi < lo) return;
        if (to.lo > hi) ends.clear();
        ends.push_back(&to);
        lo = std::max(lo, to.lo), hi = std::max(hi, to.hi);
    }
};

// By increasing lower bounds of where they begin: when one certainly begins beyond what is covered so far, so do all
// after it. Where doubles do not tell two ends apart, these are compared exactly; nothing when what they cover or leave
// open may be as short as that.
std::optional<std::vector<CentreGap>> Line::gaps_in_doubles(std::vector<Covered>& all, End& begin, End& end,
                                                            bool exact_ends) {
    std::sort(all.begin(), all.end(), [](const Covered& p, const Covered& q) { return p.from.lo < q.from.lo; });
    std::vector<CentreGap> found;
    Reached reached(begin);
    const auto farthest = [&] {
        End* most = reached.ends.front();
        if (!exact_ends) return End{.lo = reached.lo, .hi = reached.hi, .exact = {}};
        for (End* e : reached.ends)
            if (e != most && compare(exact(*e), exact(*most)) > 0) most = e;
        return *most;
    };
    const auto reaches = [&](End& p) {
        return std::any_of(reached.ends.begin(), reached.ends.end(), [&](End* e) { return order(*e, p) >= 0; });
    };
    // After a gap, the first to begin of those that doubles do not tell apart, `next` being one with the least lower
    // bound; nothing when one of them may end before the others begin: then another gap may follow at once.
    const auto first = [&](std::vector<Covered>::iterator next) -> End* {
        End* least = &next->from;
        for (auto c = next + 1; c != all.end() && c->from.lo <= next->from.hi; ++c) {
            if (c->to.lo < next->from.hi) return nullptr;
            if (exact_ends && order(c->from, *least) < 0) least = &c->from;
        }
        return least;
    };
    for (auto next = all.begin(); next != all.end(); ++next) {
        Covered& c = *next;
        if (c.from.lo > end.hi) break;
        if (c.from.hi >= end.lo && order(c.from, end) >= 0) continue;
        if (c.from.lo > reached.hi) {
            End* const begins = first(next);
            if (!begins) return std::nullopt;
            found.push_back(gap_between(farthest(), *begins, exact_ends));
        } else if (c.from.hi >= reached.lo && !reaches(c.from))
            return std::nullopt;
        reached.extend(c.to);
    }
    if (reached.lo > end.hi || (reached.hi >= end.lo && reaches(end))) return found;
    found.push_back(gap_between(farthest(), end, exact_ends));
    return found;
}

std::vector<CentreGap> Line::gaps_in_order(std::vector<Covered>& all, End& begin, End& end, bool exact_ends) {
    std::sort(all.begin(), all.end(), [&](Covered& p, Covered& q) { return order(p.from, q.from) < 0; });
    std::vector<CentreGap> found;
    End reached = begin;
    for (Covered& c : all) {
        if (order(c.from, end) >= 0) break;
        if (order(c.from, reached) > 0) found.push_back(gap_between(reached, c.from, exact_ends));
        if (order(c.to, reached) > 0) reached = c.to;
    }
    if (order(reached, end) < 0) found.push_back(gap_between(reached, end, exact_ends));
    return found;
}

std::vector<CentreGap> Line::gaps(bool exact_ends, StageCounts& stages) {
    std::vector<Covered> all;
    Covered covered;
    for (std::size_t i = 0; i < below_.which.size(); ++i)
        if (covered_by(static_cast<int>(i), covered)) all.push_back(covered);
    End begin, end;
    begin.exact = QuadraticNumber{0, 0, 0}, end.exact = QuadraticNumber{1, 0, 0};
    end.side = 1;
    if (in_doubles_) begin.lo = begin.hi = 0, end.lo = prepared_.length - margin_, end.hi = prepared_.length + margin_;
    std::optional<std::vector<CentreGap>> found;
    if (in_doubles_) found = gaps_in_doubles(all, begin, end, exact_ends);
    if (!found) found = gaps_in_order(all, begin, end, exact_ends);
    ++(algebraic_ ? stages.algebraic : exactly_ ? stages.rational : stages.interval);
    return *std::move(found);
}

bool dot_covered(const PrintedTrack& dot, const PreparedTrack& prepared, const Below& below, double margin,
                 StageCounts& stages) {
    bool exactly = false, covered = false;
    for (const int i : below.which) {
        const auto k = static_cast<std::size_t>(i);
        const double d = centre_distance(below.prepared[k], prepared.ax, prepared.ay), r = below.radii[k].get_d();
        if (d > r + margin) continue;
        covered = d < r - margin;
        if (!covered) exactly = true, covered = compare_distance(rational(dot.a), below.tracks[k], below.radii[k]) <= 0;
        if (covered) break;
    }
    ++(exactly ? stages.rational : stages.interval);
    return covered;
}

}  // namespace

// With p = a - c, u = b - a and the segment below from c along v of squared length n: within R of c where
// u^2 t^2 + 2 (u.p) t + p^2 <= R^2; within R of the segment's inner points where 0 <= (p + t u).v <= n and
// |cross(v, p + t u)| <= R sqrt(n).
std::optional<std::array<QuadraticNumber, 2>> exact_stretch(const PrintedTrack& track, const PrintedTrack& below,
                                                            const Rational& radius) {
    const RationalPoint a = rational(track.a), b = rational(track.b), c = rational(below.a), d = rational(below.b);
    const Rational ux = b[0] - a[0], uy = b[1] - a[1], uu = ux * ux + uy * uy;
    std::optional<Stretch2> all;
    const auto disc = [&](const RationalPoint& centre) {
        const Rational px = a[0] - centre[0], py = a[1] - centre[1], up = ux * px + uy * py;
        const Rational under = up * up - uu * (px * px + py * py - radius * radius);
        if (under < 0) return;
        const Rational middle = -up / uu, root = 1 / uu;
        unite(all, {quadratic(middle, Rational(-root), under), quadratic(middle, root, under)});
    };
    disc(c);
    const Rational vx = d[0] - c[0], vy = d[1] - c[1], n = vx * vx + vy * vy;
    if (n == 0) return all;
    disc(d);
    const Rational px = a[0] - c[0], py = a[1] - c[1];
    const Rational pv = px * vx + py * vy, uv = ux * vx + uy * vy;
    const Rational turn = vx * py - vy * px, change = vx * uy - vy * ux;
    std::optional<QuadraticNumber> lo, hi;
    const auto clip = [&](QuadraticNumber from, QuadraticNumber to) {
        if (!lo || compare(from, *lo) > 0) lo = std::move(from);
        if (!hi || compare(to, *hi) < 0) hi = std::move(to);
    };
    if (uv == 0) {
        if (pv < 0 || pv > n) return all;
    } else {
        const Rational t0 = -pv / uv, t1 = (n - pv) / uv;
        clip({std::min(t0, t1), 0, 0}, {std::max(t0, t1), 0, 0});
    }
    if (change == 0) {
        if (turn * turn > radius * radius * n) return all;
    } else {
        const Rational middle = -turn / change, half = abs(Rational(radius / change));
        clip(quadratic(middle, Rational(-half), n), quadratic(middle, half, n));
    }
    if (compare(*lo, *hi) <= 0) unite(all, {*lo, *hi});
    return all;
}

std::vector<CentreGap> centre_gaps(const PrintedTrack& track, const PreparedTrack& prepared, const Below& below,
                                   double margin, bool exact_ends, StageCounts& stages) {
    if (track.a != track.b) return Line(track, prepared, below, margin).gaps(exact_ends, stages);
    if (dot_covered(track, prepared, below, margin, stages)) return {};
    return {{{0, 0, 0}, {0, 0, 0}}};
}

}  // namespace ribvault::verify
