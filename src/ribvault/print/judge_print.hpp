// Equation (2) for the print of a layer over the print below it, and again after that one was changed.
#pragma once

#include <functional>
#include <vector>

#include "ribvault/settings.hpp"
#include "ribvault/verify/verdict.hpp"
#include "ribvault/verify/verify_printed.hpp"

namespace ribvault {

/// What of `above`, the print of layer i + 1, the print of layer i holds up, decided exactly and for all of it. Without
/// external supports `above` outside the outline of the layer below is not judged (verify/outside_outline.hpp); with
/// such that stand off it is not judged either, for there the object holds up more than what is within ρ of it, or what
/// holds up lies farther down (settings.outside_apart()).
///
/// A change of the layer below needs no look at all of `above`: whether a track is held up depends on nothing but the
/// tracks below that come within half its width + ρ of its centre line. When those are the same as before, so is the
/// answer. Precondition: `above`, the last layer below and `settings` outlive it.
class PrintJudgement {
public:
    PrintJudgement(const PrintedLayer& above, const PrintedLayer& below, const Settings& settings);
    /// All of `above`, over what `holding` makes of a layer below.
    using Holding = std::function<std::vector<PrintedTrack>(const PrintedLayer& below)>;
    PrintJudgement(const PrintedLayer& above, const PrintedLayer& below, const Settings& settings, Holding holding);

    /// Brings everything up to date with `below` in place of the layer that was there. What changed is found here, by
    /// comparing all tracks of both.
    void change_below(const PrintedLayer& below);

    /// Where something of `above` inside the outline is not held up, by increasing track.
    const std::vector<OpenStretch>& open() const { return open_; }
    bool supported(std::size_t track) const { return supported_[track] != 0; }

    /// The verdict. With external supports that do not stand off all of `above` must be held up, and nothing is told
    /// apart as external; otherwise external_mm is what outside the outline is farther than ρ.
    PrintVerdict verdict() const;

    const PrintedLayer& above() const { return *above_; }

private:
    void look_at_all();
    std::vector<PrintedTrack> material_below() const;
    void look(const std::vector<std::size_t>& which, std::vector<PrintedTrack> lower);

    const PrintedLayer* above_;
    const PrintedLayer* below_;
    const Settings* settings_;
    Holding holding_;                    ///< or the layer below with `outside_`
    std::vector<PrintedTrack> outside_;  ///< of `above`, outside the outline; counts as held up
    std::vector<PrintedTrack> lower_;    ///< everything that holds `above` up
    std::vector<char> supported_;        ///< by track above
    std::vector<OpenStretch> open_;
    StageCounts stages_;
};

/// PrintJudgement(above, below, settings).verdict().
PrintVerdict judge_print(const PrintedLayer& above, const PrintedLayer& below, const Settings& settings);

bool is_external_support(const PrintedTrack& track);
/// A layer's tracks as they count for what lies on them: with a removal gap the object's are as much wider as it holds
/// up what is within it (Settings::reach_of_object).
std::vector<PrintedTrack> counted_below(std::vector<PrintedTrack> tracks, const Settings& settings);

/// The place of a stretch of `track` as a segment of the lattice.
Segment place_of(const PrintedTrack& track, const OpenStretch& stretch);

}  // namespace ribvault
