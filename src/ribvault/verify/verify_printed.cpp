#include "ribvault/verify/verify_printed.hpp"

#include <CGAL/FPU.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <tuple>

#include "ribvault/error.hpp"
#include "ribvault/verify/lane_cover.hpp"
#include "ribvault/verify/printed_pair.hpp"

namespace ribvault {

using namespace verify;

namespace {

void check(const PrintedLayer& upper, const PrintedLayer& lower, const Rational& rho, const PrintedOptions& options) {
    if (rho <= 0) throw Error(ErrorKind::usage, "the verifier needs a positive support radius");
    if (!options.judged.empty() && options.judged.size() != upper.tracks.size())
        throw Error(ErrorKind::usage, "the verifier needs one entry of `judged` for each track above, or none");
    for (const PrintedLayer* layer : {&upper, &lower})
        for (const PrintedTrack& t : layer->tracks)
            if (t.width <= Millimetres())
                throw Error(ErrorKind::usage, "the track of line " + std::to_string(t.line) +
                                                  " has no positive width, so it is no material");
}

/// What judging a run of tracks has found, but for what is kept by track.
struct Found {
    bool centre_lines_supported = true, supported = true;
    std::vector<UnsupportedPiece> pieces;
    std::vector<OpenPart> open;  ///< what violates (2)
    StageCounts stages;
};

/// Decides one track after the other. Of `verdict` only what is kept by track is written: several judges may decide
/// different tracks at once.
class Judge {
public:
    Judge(const PrintedPair& pair, const PrintedOptions& options, PrintedVerdict& verdict)
        : pair_(pair), options_(options), verdict_(verdict) {}
    void judge(int track);
    Found found;

private:
    bool follows_one();
    bool wanted() const { return options_.regions || options_.stretches; }  ///< all of what is open
    bool exact_ends() const { return options_.lengths || options_.regions; }
    void report_gap(const CentreGap& gap);
    std::vector<OpenPart> parts_of(const std::vector<Stretch>& gaps, const std::vector<CentreGap>& centre) const;
    bool uncovered(OpenPart& part);
    bool violates(std::vector<OpenPart> parts, bool known);

    const PrintedPair& pair_;
    const PrintedOptions& options_;
    PrintedVerdict& verdict_;
    std::size_t track_ = 0;
    std::vector<int> near_;
    std::vector<FrameStadium> seen_;
};

// Into how many parts a track can be cut at points that have whole numbers of 10 nm from its ends; 0: not finely.
std::int64_t lattice_parts(const PrintedTrack& track, double length) {
    constexpr std::int64_t lattice = Millimetres::picometres_per_mm / units_per_mm;
    constexpr double fine = 1e-4;  // mm
    for (const PrintedPoint& end : {track.a, track.b})
        if (!end[0].whole() || !end[1].whole()) return 0;
    const std::int64_t most =
        std::gcd(track.b[0].picometres() - track.a[0].picometres(), track.b[1].picometres() - track.a[1].picometres());
    return most % lattice == 0 && length * lattice <= fine * static_cast<double>(most) ? most / lattice : 0;
}

// At least this stretch as a track of its own. It ends where numbers are short, if there are such places nearby.
PrintedTrack piece_of(const PrintedTrack& whole, const PreparedTrack& prepared, const Stretch& stretch) {
    PrintedTrack piece = whole;
    if (prepared.inverse_norm <= 0) return piece;
    const double lo = std::clamp(stretch.lo / prepared.length, 0.0, 1.0),
                 hi = std::clamp(stretch.hi / prepared.length, 0.0, 1.0);
    const std::int64_t parts = lattice_parts(whole, prepared.length);
    const auto n = static_cast<double>(parts);
    const auto first = static_cast<std::int64_t>(std::floor(lo * n)),
               last = static_cast<std::int64_t>(std::ceil(hi * n));
    for (const std::size_t c : {0, 1}) {
        if (parts > 0) {
            const std::int64_t from = whole.a[c].picometres(), step = (whole.b[c].picometres() - from) / parts;
            piece.a[c] = Millimetres::of_picometres(from + first * step);
            piece.b[c] = Millimetres::of_picometres(from + last * step);
        } else {
            const Rational from(whole.a[c]), d = Rational(whole.b[c]) - from;
            piece.a[c] = Rational(from + d * Rational(lo)), piece.b[c] = Rational(from + d * Rational(hi));
        }
    }
    return piece;
}

// How much farther the track's ends are from a segment below than R - w/2 allows, R being that one's stadium's radius.
double excess(const PrintedPair& pair, const PreparedTrack& t, const PreparedTrack& below) {
    const double reach = below.half + pair.rho_approx - t.half;
    if (reach < 0) return reach < -pair.margin ? HUGE_VAL : 0;
    return std::max(centre_distance(below, t.ax, t.ay), centre_distance(below, t.bx, t.by)) - reach;
}

// When both ends of the track lie within R - w/2 of one segment below, R being its stadium's radius, then so does all
// of it, and its stadium lies in that one. Ties included.
bool Judge::follows_one() {
    const PreparedTrack& t = pair_.above[track_];
    const PrintedTrack& exact = pair_.upper[track_];
    std::vector<int> undecided;
    for (const int k : near_) {
        const auto i = static_cast<std::size_t>(k);
        if (std::abs(excess(pair_, t, pair_.below[i])) <= pair_.margin) undecided.push_back(k);
    }
    for (const int k : undecided) {
        const auto i = static_cast<std::size_t>(k);
        const Rational reach = Rational(pair_.radii[i]) - Rational(exact.width) / 2;
        if (reach < 0 || compare_distance(rational(exact.a), pair_.lower[i], reach) > 0 ||
            compare_distance(rational(exact.b), pair_.lower[i], reach) > 0)
            continue;
        ++found.stages.rational;
        return true;
    }
    return false;
}

void Judge::report_gap(const CentreGap& gap) {
    const PrintedTrack& exact = pair_.upper[track_];
    const PreparedTrack& t = pair_.above[track_];
    UnsupportedPiece piece;
    piece.track = track_;
    piece.from_start = piece.to_end = true;
    std::array<double, 2>& total = verdict_.unsupported_length[track_];
    if (exact.a != exact.b) {
        // Lengths from squared ones: s = sqrt(t^2 |b - a|^2). Truncated quotients are below, the next double is above.
        const RationalPoint a = rational(exact.a), b = rational(exact.b);
        const Rational ux = b[0] - a[0], uy = b[1] - a[1], uu = ux * ux + uy * uy;
        const auto down = [&](const Rational& a) {
            return a <= 0 ? 0 : enclose(QuadraticNumber{0, a, uu}, 80)[0].get_d();
        };
        const auto up = [&](const Rational& a) {
            return a <= 0 ? 0 : std::nextafter(enclose(QuadraticNumber{0, a, uu}, 80)[1].get_d(), HUGE_VAL);
        };
        piece.from_start = sign(gap.from) == 0;
        piece.to_end = compare(gap.to, QuadraticNumber{1, 0, 0}) == 0;
        // Stretches shorter than their ends' digits need more of these.
        for (unsigned bits = 256;; bits *= 2) {
            const std::array<Rational, 2> from = enclose(gap.from, bits), to = enclose(gap.to, bits);
            const Rational least = to[0] - from[1], most = to[1] - from[0];
            if (least <= 0 || most - least > least * power_of_two(-190)) continue;
            piece.length = {enclose(quadratic(0, least, uu), bits)[0], enclose(quadratic(0, most, uu), bits)[1]};
            piece.from_mm = down(from[0]), piece.to_mm = up(to[1]);
            total[0] = std::nextafter(total[0] + down(least), 0),
            total[1] = std::nextafter(total[1] + up(most), HUGE_VAL);
            break;
        }
    }
    const Farthest far = farthest_on_line(t, piece.from_mm, std::min(piece.to_mm, t.length), pair_.lower_tracks());
    piece.distance_lo = std::max(far.lo, pair_.rho_approx), piece.distance_hi = std::max(far.hi, piece.distance_lo);
    piece.worst = {far.x, far.y};
    found.pieces.push_back(piece);
}

// The gaps in parts of a few widths, each with a stretch of the centre line that is known to be open.
std::vector<OpenPart> Judge::parts_of(const std::vector<Stretch>& gaps, const std::vector<CentreGap>& centre) const {
    const PreparedTrack& t = pair_.above[track_];
    std::vector<OpenPart> parts;
    for (const Stretch& gap : gaps) {
        const int n = std::max(
            1, static_cast<int>(std::min(1e5, std::ceil((gap.hi - gap.lo) / (6 * t.half + 64 * pair_.margin)))));
        const double step = (gap.hi - gap.lo) / n;
        for (int i = 0; i < n; ++i) {
            OpenPart part;
            part.track = static_cast<int>(track_);
            part.stretch = {gap.lo + i * step - pair_.margin, gap.lo + (i + 1) * step + pair_.margin};
            for (const CentreGap& c : centre) {
                const double from = c.from_hi + pair_.margin, to = c.to_lo - pair_.margin;
                if (std::max(from, part.stretch.lo) < std::min(to, part.stretch.hi)) part.gap = c;
            }
            parts.push_back(std::move(part));
        }
    }
    return parts;
}

bool Judge::uncovered(OpenPart& part) {
    const auto local = std::make_shared<LocalProblem>();
    build_part_problem(pair_, part, *local);
    part.found = find_uncovered(local->problem, {&local->window, 1}, found.stages);
    if (part.found) part.local = local;
    return part.found.has_value();
}

// (2) fails when a corner of what is not supported lies in the window of some part. Which parts hold some of it takes
// another look, at the part as a track of its own: a part in the middle may have no corner.
bool Judge::violates(std::vector<OpenPart> parts, bool known) {
    for (std::size_t i = 0; i < parts.size() && !known; ++i) known = uncovered(parts[i]);
    if (!known || !wanted()) return known;
    for (OpenPart& part : parts) {
        if (!part.gap) {
            part.piece = piece_of(pair_.upper[track_], pair_.above[track_], part.stretch);
            if (!uncovered(part)) continue;
        }
        found.open.push_back(std::move(part));
    }
    return true;
}

void Judge::judge(int index) {
    track_ = static_cast<std::size_t>(index);
    const PreparedTrack& t = pair_.above[track_];
    // A stadium below that contains the track's contains its middle.
    const auto follows = [&](int k) {
        return excess(pair_, t, pair_.below[static_cast<std::size_t>(k)]) < -pair_.margin;
    };
    if (pair_.grid.any_at((t.ax + t.bx) / 2, (t.ay + t.by) / 2, follows)) {
        ++found.stages.interval;
        return;
    }
    pair_.grid.near(t, t.half + 2 * window_slack(pair_.margin), near_);
    if (follows_one()) return;
    const TrackFrame frame(t);
    seen_.clear();
    for (const int k : near_) {
        const PreparedTrack& b = pair_.below[static_cast<std::size_t>(k)];
        seen_.push_back(frame.see(b, b.half + pair_.rho_approx));
    }
    const double slack = 2 * pair_.margin;
    std::vector<Stretch> gaps{{-t.half - slack, t.length + t.half + slack}};
    if (frame.wide_enough) gaps = lane_gaps(frame, t.half, seen_, pair_.margin);
    if (gaps.empty()) {
        ++found.stages.interval;
        return;
    }
    const Below below{pair_.lower, pair_.below, pair_.radii, near_, seen_};
    const std::vector<CentreGap> centre =
        centre_gaps(pair_.upper[track_], t, below, pair_.margin, exact_ends(), found.stages);
    if (!centre.empty()) found.centre_lines_supported = false;
    if (options_.lengths)
        for (const CentreGap& gap : centre) report_gap(gap);
    if (!options_.areas) {
        if (!centre.empty()) found.supported = false, verdict_.track_supported[track_] = 0;
        return;
    }
    std::vector<OpenPart> parts = parts_of(gaps, centre);
    // Stretches of the centre line too short for doubles to place them: one will do to refute the track.
    const auto has_gap = [](const OpenPart& p) { return p.gap.has_value(); };
    if (wanted() && !centre.empty() && std::none_of(parts.begin(), parts.end(), has_gap))
        parts.push_back(
            {index, {centre.front().from_lo - slack, centre.front().to_hi + slack}, centre.front(), {}, {}});
    if (violates(std::move(parts), !centre.empty())) found.supported = false, verdict_.track_supported[track_] = 0;
}

/// Per track above: the first judged one that is the same, the other way round apart; itself where there is none.
std::vector<std::size_t> first_alike(const PrintedPair& pair, const std::vector<char>& judged) {
    std::vector<std::size_t> first(pair.upper.size()), order;
    std::iota(first.begin(), first.end(), std::size_t{0});
    for (const std::size_t k : first)
        if (judged.empty() || judged[k]) order.push_back(k);
    const auto key = [&](std::size_t k) {
        const PreparedTrack& t = pair.above[k];
        return std::tuple{t.ax, t.ay, t.bx, t.by, t.half};
    };
    std::stable_sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return key(i) < key(j); });
    for (std::size_t k = 1; k < order.size(); ++k) {
        const std::size_t candidate = first[order[k - 1]];
        const PrintedTrack &p = pair.upper[candidate], &q = pair.upper[order[k]];
        if (key(candidate) == key(order[k]) && p.a == q.a && p.b == q.b && p.width == q.width)
            first[order[k]] = candidate;
    }
    return first;
}

/// What was found of tracks is said of those that are the same, too.
void repeat(const std::vector<std::size_t>& first, PrintedVerdict& verdict) {
    std::vector<std::vector<std::size_t>> again(first.size());
    for (std::size_t k = 0; k < first.size(); ++k) {
        if (first[k] == k) continue;
        again[first[k]].push_back(k);
        verdict.track_supported[k] = verdict.track_supported[first[k]];
        verdict.unsupported_length[k] = verdict.unsupported_length[first[k]];
    }
    for (std::size_t i = 0, n = verdict.pieces.size(); i < n; ++i)
        for (const std::size_t k : again[verdict.pieces[i].track]) {
            verdict.pieces.push_back(verdict.pieces[i]);
            verdict.pieces.back().track = k;
        }
    std::stable_sort(verdict.pieces.begin(), verdict.pieces.end(),
                     [](const UnsupportedPiece& p, const UnsupportedPiece& q) { return p.track < q.track; });
    for (std::size_t i = 0, n = verdict.stretches.size(); i < n; ++i)
        for (const std::size_t k : again[verdict.stretches[i].track])
            verdict.stretches.push_back({k, verdict.stretches[i].from_mm, verdict.stretches[i].to_mm});
    for (UnsupportedRegion& region : verdict.regions) {
        for (std::size_t i = 0, n = region.tracks.size(); i < n; ++i)
            region.tracks.insert(region.tracks.end(), again[region.tracks[i]].begin(), again[region.tracks[i]].end());
        std::sort(region.tracks.begin(), region.tracks.end());
    }
}

constexpr std::size_t tracks_of_a_run = 256;  ///< judged by one thread

void prepare_pair(const PrintedLayer& upper, const PrintedLayer& lower, const Rational& rho, PrintedPair& pair) {
    pair.upper = upper.tracks, pair.lower = lower.tracks;
    pair.above = prepare(upper.tracks), pair.below = prepare(lower.tracks);
    pair.rho = rho, pair.rho_approx = rho.get_d();
    const Millimetres reach(rho);
    pair.radii.reserve(lower.tracks.size());
    for (const PrintedTrack& t : lower.tracks) pair.radii.push_back(half_plus(t.width, reach));
    pair.margin = margin_of(largest_coordinate(pair.above, pair.below, pair.rho_approx));
    pair.grid = TrackGrid(pair.below, pair.rho_approx + 4 * pair.margin);
}

}  // namespace

PrintedVerdict verify_printed(const PrintedLayer& upper, const PrintedLayer& lower, const Rational& rho,
                              const PrintedOptions& options) {
    check(upper, lower, rho, options);
    PrintedVerdict verdict;
    verdict.unsupported_length.assign(upper.tracks.size(), {0, 0});
    verdict.track_supported.assign(upper.tracks.size(), 1);
    PrintedPair pair;
    {
        const CGAL::Protect_FPU_rounding<true> upward;
        prepare_pair(upper, lower, rho, pair);
    }
    // Others ask for little, and of tracks that are all different.
    const std::vector<std::size_t> first =
        options.regions ? first_alike(pair, options.judged) : std::vector<std::size_t>();
    const std::size_t runs = upper.tracks.size() / tracks_of_a_run + 1;
    std::vector<Found> found(runs);
    const auto judge_run = [&](std::size_t run) {
        const CGAL::Protect_FPU_rounding<true> upward;
        Judge judge(pair, options, verdict);
        for (std::size_t i = run * tracks_of_a_run; i < std::min((run + 1) * tracks_of_a_run, upper.tracks.size()); ++i)
            if ((options.judged.empty() || options.judged[i]) && (first.empty() || first[i] == i))
                judge.judge(static_cast<int>(i));
        found[run] = std::move(judge.found);
    };
    // Whoever waits here takes on nothing else meanwhile: the caller may hold what others wait for.
    if (runs == 1)
        judge_run(0);
    else
        oneapi::tbb::this_task_arena::isolate([&] { oneapi::tbb::parallel_for(std::size_t{0}, runs, judge_run); });
    std::vector<OpenPart> open;
    for (Found& f : found) {
        verdict.centre_lines_supported = verdict.centre_lines_supported && f.centre_lines_supported;
        verdict.supported = verdict.supported && f.supported;
        verdict.stages += f.stages;
        std::move(f.pieces.begin(), f.pieces.end(), std::back_inserter(verdict.pieces));
        std::move(f.open.begin(), f.open.end(), std::back_inserter(open));
    }
    if (options.stretches)
        for (const OpenPart& part : open)
            verdict.stretches.push_back({static_cast<std::size_t>(part.track), part.stretch.lo, part.stretch.hi});
    if (options.regions && options.areas) {
        const CGAL::Protect_FPU_rounding<true> upward;
        verdict.regions = describe_regions(pair, open, options);
    }
    if (!first.empty()) repeat(first, verdict);
    return verdict;
}

}  // namespace ribvault
