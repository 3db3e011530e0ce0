#include "ribvault/pipeline/choose_supports.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>

#include "ribvault/error.hpp"
#include "ribvault/pipeline/layer_front.hpp"
#include "ribvault/pipeline/thread_limit.hpp"

namespace ribvault {
namespace {

struct Sweep {
    Settings settings;
    SupportForest forest;
    double length = 0;  ///< lattice units
};

void step(Sweep& sweep, const Token& token) {
    sweep.forest = next_supports(sweep.forest, token, sweep.settings).forest;
    for (auto [e, end] = edges(sweep.forest); e != end; ++e)
        sweep.length += length(sweep.forest[source(*e, sweep.forest)].at - sweep.forest[target(*e, sweep.forest)].at);
}

}  // namespace

std::vector<Candidate> sweep_candidates(const Slicer& slicer, const Settings& settings, int threads, const std::function<bool()>& stop, const OutsideRoom* room,
                                        const std::function<void(int, int)>& progress) {
    namespace tbb = oneapi::tbb;
    std::vector<Sweep> sweeps;
    for (int k = 0; k < settings.tries; ++k)
        for (const bool narrow : {true, false}) {
            if (narrow != settings.narrow_bonus && !(settings.choose_bonus && settings.branch_bonus)) continue;
            sweeps.push_back({settings, {}, 0});
            sweeps.back().settings.narrow_bonus = narrow;
            sweeps.back().settings.seed = settings.seed + static_cast<std::uint64_t>(k);
        }
    if (sweeps.size() < 2) return {};

    const std::size_t limit = thread_limit(threads);
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, limit);
    LayerFront front(slicer, settings, nullptr, stop, room);
    int done = 0;
    const auto sweep = [&](TokenPtr token) {
        if (token->layer >= 0) {
            tbb::parallel_for(std::size_t{0}, sweeps.size(), [&](std::size_t k) { step(sweeps[k], *token); });
            progress(++done, slicer.layer_count());
        }
        front.remove(token);
    };
    tbb::parallel_pipeline(front.window(limit), front.filter() & tbb::make_filter<TokenPtr, void>(tbb::filter_mode::serial_in_order, sweep));
    if (stop()) throw Error(ErrorKind::interrupted, "interrupted; nothing was written");

    std::vector<Candidate> candidates;
    for (const Sweep& s : sweeps) candidates.push_back({s.settings.narrow_bonus, s.settings.seed, s.length / units_per_mm});
    const auto least = std::min_element(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) { return a.length_mm < b.length_mm; });
    std::rotate(candidates.begin(), least, least + 1);
    return candidates;
}

}  // namespace ribvault
