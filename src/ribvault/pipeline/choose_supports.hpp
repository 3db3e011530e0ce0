// Choices whose price is known only at the bed: made by sweeping the supports alone, with every choice, before the run.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "ribvault/pipeline/kept_supports.hpp"
#include "ribvault/pipeline/sweep_layers.hpp"
#include "ribvault/report/run_report.hpp"

namespace ribvault {

struct Chosen {
    /// The best first, the others in the order in which they were tried; empty where nothing is open.
    std::vector<Candidate> candidates;
    /// What the sweeps made, unless they were too many or there was no place for it on disk.
    std::optional<KeptSupports> supports;
    std::size_t sweep = 0;                  ///< the best one's place in `supports`
};

/// Sweeps all layers with every combination that `settings` leaves open (choose_bonus: a quarter of the bonus in narrow
/// places, everywhere or nowhere; tries: as many seeds from settings.seed on); the first that costs least is the best:
/// track, and twice its width for each tip. Nothing is printed or proved meanwhile; slices and cavities are made
/// once for all of them. At most a window of layers is alive at any time. The result does not depend on `threads`.
/// `progress(done, layers)` as layers are done.
///
/// Throws as sweep_layers does. `room` as there.
Chosen sweep_candidates(const Slicer& slicer, const Settings& settings, int threads, const std::function<bool()>& stop,
                        const OutsideRoom* room, const std::function<void(int, int)>& progress);

}  // namespace ribvault
