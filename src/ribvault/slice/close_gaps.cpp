#include "ribvault/slice/close_gaps.hpp"

#include <algorithm>
#include <limits>

namespace ribvault {
namespace {

double approximate_distance(const ExactPoint& a, const ExactPoint& b) {
    return std::hypot(approximate(a.x()) - approximate(b.x()), approximate(a.y()) - approximate(b.y()));
}

}  // namespace

ClosedGaps close_gaps(std::vector<ExactContour> chains, int layer, Unit max_gap) {
    const double limit = to_mm(max_gap);
    const ExactKernel::FT exact_limit =
        ExactKernel::FT(static_cast<double>(max_gap)) / ExactKernel::FT(static_cast<double>(units_per_mm));
    struct Pair {
        double distance;
        std::size_t from, to;  // the end of one chain, the start of another
    };
    std::vector<Pair> pairs;
    for (std::size_t a = 0; a < chains.size(); ++a)
        for (std::size_t b = 0; b < chains.size(); ++b) {
            const double d = approximate_distance(chains[a].back(), chains[b].front());
            if (d > limit * 1.001 + 1e-9) continue;
            if (CGAL::squared_distance(chains[a].back(), chains[b].front()) <= exact_limit * exact_limit)
                pairs.push_back({d, a, b});
        }
    std::sort(pairs.begin(), pairs.end(), [](const Pair& p, const Pair& q) {
        return std::tie(p.distance, p.from, p.to) < std::tie(q.distance, q.from, q.to);
    });
    constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    std::vector<std::size_t> next(chains.size(), none), previous(chains.size(), none);
    ClosedGaps result;
    for (const Pair& p : pairs) {
        if (next[p.from] != none || previous[p.to] != none) continue;
        next[p.from] = p.to, previous[p.to] = p.from;
        if (p.distance > 0) {
            const ExactPoint& at = chains[p.from].back();
            result.closings.push_back({layer, approximate(at.x()), approximate(at.y()), p.distance});
        }
    }
    std::vector<char> used(chains.size(), 0);
    const auto append = [&](ExactContour& contour, std::size_t k) {
        used[k] = 1;
        contour.insert(contour.end(), chains[k].begin(), chains[k].end());
    };
    for (std::size_t k = 0; k < chains.size(); ++k)
        if (previous[k] == none)
            for (std::size_t c = k; c != none; c = next[c]) used[c] = 1;  // part of a chain that stays open
    for (std::size_t k = 0; k < chains.size(); ++k) {
        if (used[k]) continue;
        ExactContour contour;
        for (std::size_t c = k; !used[c]; c = next[c]) append(contour, c);
        result.contours.push_back(std::move(contour));
    }
    for (std::size_t a = 0; a < chains.size(); ++a) {
        if (next[a] != none) continue;
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t b = 0; b < chains.size(); ++b)
            if (previous[b] == none)
                nearest = std::min(nearest, approximate_distance(chains[a].back(), chains[b].front()));
        const ExactPoint& at = chains[a].back();
        result.open.push_back({layer, approximate(at.x()), approximate(at.y()), nearest});
    }
    return result;
}

}  // namespace ribvault
