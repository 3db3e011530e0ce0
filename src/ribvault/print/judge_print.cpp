#include "ribvault/print/judge_print.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <tuple>

#include "ribvault/print/printed_tracks.hpp"
#include "ribvault/print/tool_path.hpp"
#include "ribvault/verify/outside_outline.hpp"
#include "ribvault/verify/prepared_tracks.hpp"

namespace ribvault {
namespace {

Point lattice(const PrintedPoint& p) {
    return {round_to_lattice(p[0].get_d() * units_per_mm), round_to_lattice(p[1].get_d() * units_per_mm)};
}

/// All of a track that a verdict depends on.
auto key(const PrintedTrack& t) { return std::tie(t.a, t.b, t.width, t.outline); }
bool earlier(const PrintedTrack& s, const PrintedTrack& t) { return key(s) < key(t); }
bool same(const PrintedTrack& s, const PrintedTrack& t) { return key(s) == key(t); }

/// The tracks that one of the two has more often than the other. Most are the same at the beginning and at the end.
std::vector<PrintedTrack> difference(const std::vector<PrintedTrack>& one, const std::vector<PrintedTrack>& other) {
    const auto [from, begin] = std::mismatch(one.begin(), one.end(), other.begin(), other.end(), same);
    const auto [to, end] = std::mismatch(one.rbegin(), std::make_reverse_iterator(from), other.rbegin(),
                                         std::make_reverse_iterator(begin), same);
    std::vector<PrintedTrack> left(from, to.base()), right(begin, end.base()), result;
    std::sort(left.begin(), left.end(), earlier);
    std::sort(right.begin(), right.end(), earlier);
    std::set_symmetric_difference(left.begin(), left.end(), right.begin(), right.end(), std::back_inserter(result),
                                  earlier);
    return result;
}

/// Indices (increasing) of at least those of `tracks` whose stadium comes within ρ of the stadium of one of `others`.
std::vector<std::size_t> those_near(const std::vector<PrintedTrack>& tracks, const std::vector<PrintedTrack>& others,
                                    double rho) {
    const std::vector<verify::PreparedTrack> here = verify::prepare(tracks), there = verify::prepare(others);
    const double margin = verify::margin_of(verify::largest_coordinate(here, there, rho));
    const verify::TrackGrid grid(there, rho + 4 * margin);
    std::vector<std::size_t> near;
    std::vector<int> found;
    for (std::size_t k = 0; k < here.size(); ++k) {
        grid.near(here[k], here[k].half + 4 * margin, found);
        if (!found.empty()) near.push_back(k);
    }
    return near;
}

std::vector<PrintedTrack> chosen(const std::vector<PrintedTrack>& tracks, const std::vector<std::size_t>& which) {
    std::vector<PrintedTrack> result;
    result.reserve(which.size());
    for (const std::size_t k : which) result.push_back(tracks[k]);
    return result;
}

Enclosure sum(const std::vector<std::array<double, 2>>& lengths) {
    Enclosure total;
    for (const auto& [lo, hi] : lengths) total += {lo, hi};
    return total;
}

}  // namespace

bool is_external_support(const PrintedTrack& track) {
    return track.feature == static_cast<int>(TrackKind::external_support);
}

std::vector<PrintedTrack> counted_below(std::vector<PrintedTrack> tracks, const Settings& settings) {
    const Rational wider = 2 * Rational(printed_length(settings.reach_of_object() - settings.support_radius));
    if (settings.outside() && wider != 0)
        for (PrintedTrack& t : tracks)
            if (!is_external_support(t)) t.width = Rational(Rational(t.width) + wider);
    return tracks;
}

Segment place_of(const PrintedTrack& track, const OpenStretch& stretch) {
    const Segment whole{lattice(track.a), lattice(track.b)};
    const double l = length(whole);
    const auto at = [&](double mm) {
        return part_way(whole.a, whole.b, l > 0 ? std::clamp(mm * units_per_mm / l, 0.0, 1.0) : 0);
    };
    return {at(stretch.from_mm), at(stretch.to_mm)};
}

PrintJudgement::PrintJudgement(const PrintedLayer& above, const PrintedLayer& below, const Settings& settings)
    : above_(&above), below_(&below), settings_(&settings) {
    if (!settings.outside() || settings.outside_apart()) outside_ = stretches_outside(above, below);
    look_at_all();
}

PrintJudgement::PrintJudgement(const PrintedLayer& above, const PrintedLayer& below, const Settings& settings,
                               Holding holding)
    : above_(&above), below_(&below), settings_(&settings), holding_(std::move(holding)) {
    look_at_all();
}

void PrintJudgement::look_at_all() {
    lower_ = material_below();
    supported_.assign(above_->tracks.size(), 1);
    std::vector<std::size_t> all(above_->tracks.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    look(all, lower_);
}

void PrintJudgement::change_below(const PrintedLayer& below) {
    below_ = &below;
    std::vector<PrintedTrack> now = material_below();
    std::swap(lower_, now);
    const std::vector<PrintedTrack> changed = difference(lower_, now);
    if (changed.empty()) return;
    if (!holding_ && std::any_of(changed.begin(), changed.end(), [](const PrintedTrack& t) { return t.outline; })) {
        const StageCounts before = stages_;
        *this = PrintJudgement(*above_, below, *settings_);
        stages_ += before;
        return;
    }
    const double rho = to_mm(settings_->support_radius);
    const std::vector<std::size_t> again = those_near(above_->tracks, changed, rho);
    look(again, chosen(lower_, those_near(lower_, chosen(above_->tracks, again), rho)));
}

std::vector<PrintedTrack> PrintJudgement::material_below() const {
    if (holding_) return holding_(*below_);
    std::vector<PrintedTrack> lower = below_->tracks;
    lower.insert(lower.end(), outside_.begin(), outside_.end());
    return lower;
}

/// Judges these tracks above (indices, increasing) anew over `lower`, which has all that comes near them.
void PrintJudgement::look(const std::vector<std::size_t>& which, std::vector<PrintedTrack> lower) {
    PrintedOptions options;
    options.regions = options.lengths = false, options.stretches = true;
    PrintedLayer upper, below;
    upper.tracks = chosen(above_->tracks, which), below.tracks = std::move(lower);
    const PrintedVerdict verdict = verify_printed(upper, below, printed_length(settings_->support_radius), options);
    stages_ += verdict.stages;
    std::erase_if(open_, [&](const OpenStretch& s) { return std::binary_search(which.begin(), which.end(), s.track); });
    for (std::size_t k = 0; k < which.size(); ++k) supported_[which[k]] = verdict.track_supported[k];
    for (const OpenStretch& stretch : verdict.stretches)
        open_.push_back({which[stretch.track], stretch.from_mm, stretch.to_mm});
    std::stable_sort(open_.begin(), open_.end(),
                     [](const OpenStretch& a, const OpenStretch& b) { return a.track < b.track; });
}

PrintVerdict PrintJudgement::verdict() const {
    PrintVerdict verdict;
    verdict.supported = std::all_of(supported_.begin(), supported_.end(), [](char yes) { return yes != 0; });
    verdict.stages = stages_;
    if (!verdict.supported) {
        std::vector<std::size_t> hanging;
        for (std::size_t k = 0; k < supported_.size(); ++k)
            if (!supported_[k]) hanging.push_back(k);
        PrintedOptions options;
        options.areas = options.regions = false;
        PrintedLayer upper, lower;
        upper.tracks = chosen(above_->tracks, hanging), lower.tracks = lower_;
        verdict.unsupported_mm =
            sum(verify_printed(upper, lower, printed_length(settings_->support_radius), options).unsupported_length);
    }
    if (!open_.empty()) {
        const Segment place = place_of(above_->tracks[open_.front().track], open_.front());
        verdict.place = {to_mm((place.a.x + place.b.x) / 2), to_mm((place.a.y + place.b.y) / 2)};
    }
    if (holding_ || settings_->support_gap_layers > 0) return verdict;
    if (!outside_.empty()) {
        PrintedLayer upper;
        upper.tracks = outside_;
        PrintedOptions options;
        options.areas = options.regions = false;
        const PrintedVerdict hangs = verify_printed(upper, *below_, printed_length(settings_->support_radius), options);
        verdict.external_mm = sum(hangs.unsupported_length);
        verdict.external_hangs = !hangs.centre_lines_supported;
        verdict.stages += hangs.stages;
    }
    return verdict;
}

PrintVerdict judge_print(const PrintedLayer& above, const PrintedLayer& below, const Settings& settings) {
    return PrintJudgement(above, below, settings).verdict();
}

}  // namespace ribvault
