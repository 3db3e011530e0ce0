#include "ribvault/verify/lane_cover.hpp"

#include <algorithm>

namespace ribvault::verify {

namespace {

bool covers(const FrameStadium& f, double s, double y, double margin) { return distance(f, s, y) <= f.radius - margin; }

// The half disc beyond s = `from` (a: -1, b: +1) without what is within q of `from`, q = half (root of 2 - 1): it lies
// in the trapezium with the corners (q, +-half) and (half, +-q), whose slanted sides touch the circle.
bool cap_covered(double from, double direction, double half, double q, std::span<const FrameStadium> below,
                 double margin) {
    return std::any_of(below.begin(), below.end(), [&](const FrameStadium& f) {
        return covers(f, from + direction * half, -q, margin) && covers(f, from + direction * half, q, margin) &&
               covers(f, from + direction * q, -half, margin) && covers(f, from + direction * q, half, margin);
    });
}

// Sorted, overlapping ones as one.
void join(std::vector<Stretch>& stretches) {
    std::sort(stretches.begin(), stretches.end(), [](const Stretch& p, const Stretch& r) { return p.lo < r.lo; });
    std::size_t kept = 0;
    for (const Stretch s : stretches)
        if (kept > 0 && s.lo <= stretches[kept - 1].hi)
            stretches[kept - 1].hi = std::max(stretches[kept - 1].hi, s.hi);
        else
            stretches[kept++] = s;
    stretches.resize(kept);
}

}  // namespace

void uncovered_stretches(std::vector<Stretch>& covered, double from, double to, std::vector<Stretch>& gaps) {
    std::sort(covered.begin(), covered.end(), [](const Stretch& p, const Stretch& q) { return p.lo < q.lo; });
    double end = from;
    for (const Stretch& c : covered) {
        if (c.hi <= end) continue;
        if (c.lo > end) {
            gaps.push_back({end, std::min(c.lo, to)});
            if (c.lo >= to) return;
        }
        end = c.hi;
        if (end >= to) return;
    }
    gaps.push_back({end, to});
}

std::vector<Stretch> lane_gaps(const TrackFrame& frame, double half, std::span<const FrameStadium> below,
                               double margin) {
    const double q = half * 0.41421357;  // above half (root of 2 - 1)
    const double h = half * (1 + 0x1p-40);
    std::vector<Stretch> gaps{{-q, frame.length + q}}, next;
    std::vector<Stretch> covered;
    std::vector<std::vector<Stretch>> on_line;  // per line, per stadium; empty stretch: none
    for (const int lanes : {1, 2, 4}) {
        on_line.assign(static_cast<std::size_t>(lanes) + 1, {});
        for (int line = 0; line <= lanes; ++line)
            for (const FrameStadium& f : below) {
                Stretch stretch;
                const bool in = certainly_inside(f, h * (2.0 * line / lanes - 1), margin, stretch);
                on_line[static_cast<std::size_t>(line)].push_back(in ? stretch : Stretch{1, 0});
            }
        for (std::size_t lane = 0; lane < static_cast<std::size_t>(lanes); ++lane) {
            covered.clear();
            for (std::size_t i = 0; i < below.size(); ++i) {
                const Stretch &p = on_line[lane][i], &r = on_line[lane + 1][i];
                const Stretch both{std::max(p.lo, r.lo), std::min(p.hi, r.hi)};
                if (p.lo <= p.hi && r.lo <= r.hi && both.lo <= both.hi) covered.push_back(both);
            }
            for (const Stretch& gap : gaps) uncovered_stretches(covered, gap.lo, gap.hi, next);
        }
        // What is open in some lane stays open in all.
        join(next);
        std::swap(gaps, next);
        next.clear();
        if (gaps.empty()) break;
    }
    const double slack = 2 * margin;  // a neighbourhood of what is open
    for (Stretch& g : gaps) g.lo -= slack, g.hi += slack;
    if (!cap_covered(0, -1, h, q, below, margin)) gaps.push_back({-h - slack, -q + slack});
    if (!cap_covered(frame.length, 1, h, q, below, margin))
        gaps.push_back({frame.length + q - slack, frame.length + h + slack});
    join(gaps);
    return gaps;
}

}  // namespace ribvault::verify
