#include "ribvault/pipeline/choose_supports.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>

#include "ribvault/error.hpp"
#include "ribvault/pipeline/layer_front.hpp"
#include "ribvault/pipeline/thread_limit.hpp"

namespace ribvault {
namespace {

/// How much track a tip takes beyond its wall, in widths of a track: what closes gaps, and patches. With 3/2 to 5/2 the
/// way that extrudes least was found on twelve of the fourteen models of experiments/README.md, on the others one that
/// extrudes 0.14 % more at most.
constexpr double cost_of_tip = 2;
constexpr std::size_t most_kept = 12;  ///< sweeps on disk at a time: about as much as their layers' G-code each

struct Sweep {
    Settings settings;
    /// Of the last layer; shared by sweeps with the same seed that have come to the same so far.
    std::shared_ptr<LayerSupports> supports;
    double length = 0;  ///< lattice units
    std::size_t tips = 0;
};

/// Ends of walls that are no root; of a tree that stands free all but one, for it has one path fewer.
std::size_t tips_of(const SupportForest& forest) {
    std::size_t tips = 0, free = 0;
    for (auto [v, end] = vertices(forest); v != end; ++v) {
        tips += out_degree(*v, forest) == 1 && (!forest[*v].root || forest[*v].free);
        free += forest[*v].free && out_degree(*v, forest) > 0;
    }
    return tips - free;
}

/// The sweeps with the same seed that have come to the same supports on all layers so far.
std::vector<std::vector<std::size_t>> alike(const std::vector<Sweep>& sweeps) {
    std::vector<std::vector<std::size_t>> groups;
    for (std::size_t k = 0; k < sweeps.size(); ++k) {
        const auto same = [&](const std::vector<std::size_t>& group) {
            return sweeps[group.front()].supports == sweeps[k].supports;
        };
        const auto group = std::find_if(groups.begin(), groups.end(), same);
        (group == groups.end() ? groups.emplace_back() : *group).push_back(k);
    }
    return groups;
}

/// `next` is what one sweep made of supports that another one has too: whether the other makes the same of them.
bool same_next(const LayerSupports& next, QuarterBonus other) {
    if (other == QuarterBonus::narrow) return !next.full_bonus && !next.quarter_bonus;
    return other == QuarterBonus::nowhere ? !next.quarter_bonus : !next.full_bonus;
}

/// The next layer of the sweeps of a group that are alike, made once for all that come to the same. Enters for each in
/// `finished` the layer before it, which is complete now, if it is to be kept.
void step(std::vector<Sweep>& sweeps, const std::vector<std::size_t>& group, const Token& token, bool keep,
          std::vector<std::string>& finished) {
    const std::shared_ptr<LayerSupports> above = sweeps[group.front()].supports;
    const auto waits = [&](std::size_t k) { return sweeps[k].supports == above; };
    for (const std::size_t first : group) {
        if (!waits(first)) continue;
        const auto next = std::make_shared<LayerSupports>(next_supports(above->forest, token, sweeps[first].settings));
        const double longer = length(next->forest);
        const std::size_t tips = tips_of(next->forest);
        for (const std::size_t k : group) {
            Sweep& sweep = sweeps[k];
            if (!waits(k) || (k != first && !same_next(*next, sweep.settings.quarter_bonus))) continue;
            sweep.supports = next;
            sweep.length += longer, sweep.tips += tips;
        }
    }
    // What ends on the layer above does not depend on what is grown below it.
    if (!keep) return;
    const std::string packed = packed_supports(*above);
    for (const std::size_t k : group) finished[k] = packed;
}

/// Does it, and without what was kept so far where the temporary folder is full: the best sweep can be made again.
void while_there_is_room(std::optional<KeptSupports>& kept, const std::function<void()>& keep) {
    try {
        keep();
    } catch (const Error& e) {
        if (e.kind() != ErrorKind::cannot_write) throw;
        kept.reset();
    }
}

}  // namespace

Chosen sweep_candidates(const Slicer& slicer, const Settings& settings, int threads, const std::function<bool()>& stop,
                        const OutsideRoom* room, const std::function<void(int, int)>& progress) {
    namespace tbb = oneapi::tbb;
    std::vector<Sweep> sweeps;
    std::vector<QuarterBonus> bonuses{settings.quarter_bonus};
    if (settings.choose_bonus && settings.branch_bonus && settings.branch_bonus_length > 0)
        bonuses = {QuarterBonus::narrow, QuarterBonus::everywhere, QuarterBonus::nowhere};
    for (int k = 0; k < settings.tries; ++k) {
        const auto top = std::make_shared<LayerSupports>();
        for (const QuarterBonus bonus : bonuses) {
            sweeps.push_back({settings, top});
            sweeps.back().settings.quarter_bonus = bonus;
            sweeps.back().settings.seed = settings.seed + static_cast<std::uint64_t>(k);
        }
    }
    if (sweeps.size() < 2) return {};

    const std::size_t limit = thread_limit(threads);
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, limit);
    LayerFront front(slicer, settings, nullptr, stop, room);
    Chosen chosen;
    if (sweeps.size() <= most_kept)
        while_there_is_room(chosen.supports, [&] { chosen.supports.emplace(sweeps.size()); });
    std::vector<std::string> finished(sweeps.size());
    int done = 0;
    const auto sweep = [&](TokenPtr token) {
        if (token->layer >= 0) {
            const bool keep = chosen.supports && done > 0;
            // Whoever waits here takes on no other layer meanwhile: this stage is what the rest waits for.
            tbb::this_task_arena::isolate([&] {
                const std::vector<std::vector<std::size_t>> groups = alike(sweeps);
                tbb::parallel_for(std::size_t{0}, groups.size(),
                                  [&](std::size_t g) { step(sweeps, groups[g], *token, keep, finished); });
            });
            if (keep) while_there_is_room(chosen.supports, [&] { chosen.supports->add(finished); });
            progress(++done, slicer.layer_count());
        }
        front.remove(token);
    };
    tbb::parallel_pipeline(front.window(limit),
                           front.filter() & tbb::make_filter<TokenPtr, void>(tbb::filter_mode::serial_in_order, sweep));
    end_if(stop);

    for (const Sweep& s : sweeps) {
        const double cost =
            s.length + cost_of_tip * static_cast<double>(settings.support_width) * static_cast<double>(s.tips);
        chosen.candidates.push_back(
            {s.settings.quarter_bonus, s.settings.seed, s.length / units_per_mm, s.tips, cost / units_per_mm});
    }
    const auto least = std::min_element(chosen.candidates.begin(), chosen.candidates.end(),
                                        [](const Candidate& a, const Candidate& b) { return a.cost_mm < b.cost_mm; });
    chosen.sweep = static_cast<std::size_t>(least - chosen.candidates.begin());
    std::rotate(chosen.candidates.begin(), least, least + 1);
    if (chosen.supports)
        while_there_is_room(chosen.supports, [&] {
            // Under layer 0 nothing continues.
            for (std::size_t k = 0; k < sweeps.size(); ++k) finished[k] = packed_supports(*sweeps[k].supports);
            chosen.supports->add(finished);
            chosen.supports->finish();
        });
    return chosen;
}

}  // namespace ribvault
