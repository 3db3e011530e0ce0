#include "ribvault/vault/length_bound.hpp"

#include <algorithm>

#include "ribvault/slice/lattice_clip.hpp"

namespace ribvault {
namespace {

constexpr std::size_t kept = 16;  ///< roofs that are followed down; any subset gives a bound
constexpr Unit margin = 300;

}  // namespace

double LengthBound::next(const Cavity& cavity, const Region& overhang, const Cavity* above, const Settings& settings) {
    for (Hanging& h : hanging_) ++h.layers;
    if (above && !overhang.empty())
        hanging_.push_back({clip(ClipperLib::ctDifference, overhang, offset(above->region, margin)), 1});
    std::vector<std::pair<double, std::size_t>> bounds;
    for (std::size_t k = 0; k < hanging_.size(); ++k) {
        Hanging& h = hanging_[k];
        const auto reach = static_cast<double>(settings.half_width() + h.layers * settings.support_radius);
        h.region = clip(ClipperLib::ctIntersection, h.region,
                        offset(cavity.region, -reach - margin, ClipperLib::jtRound, margin / 3.0));
        bounds.emplace_back(std::max(0.0, signed_area(h.region)) / (2 * reach), k);
    }
    std::sort(bounds.rbegin(), bounds.rend());
    std::deque<Hanging> best;
    for (const auto& [bound, k] : bounds)
        if (bound > 0 && best.size() < kept) best.push_back(std::move(hanging_[k]));
    hanging_ = std::move(best);
    return bounds.empty() ? 0 : bounds.front().first;
}

}  // namespace ribvault
