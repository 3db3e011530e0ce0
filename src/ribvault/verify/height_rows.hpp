// Things in rows by the heights that they reach.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace ribvault {

/// Finds what reaches a height without a look at all the rest. Doubles: allow for rounding in the ranges given.
class HeightRows {
public:
    HeightRows() = default;
    /// `range(k)` is the pair of the lowest and the highest place of thing k.
    template <class Range>
    HeightRows(std::size_t count, const Range& range) {
        if (count == 0) return;
        double top = -HUGE_VAL, sum = 0;
        low_ = HUGE_VAL;
        for (std::size_t k = 0; k < count; ++k) {
            const auto [lo, hi] = range(k);
            low_ = std::min(low_, lo), top = std::max(top, hi), sum += hi - lo;
        }
        // Rows about as high as the things are, so that few are in more than two.
        const double most = static_cast<double>(std::min<std::size_t>(count, 4096));
        rows_ =
            static_cast<int>(std::clamp((top - low_) * static_cast<double>(count) / std::max(sum, 1e-300), 1.0, most));
        inverse_ = rows_ / std::max(top - low_, 1e-300);
        starts_.assign(static_cast<std::size_t>(rows_) + 1, 0);
        for (std::size_t k = 0; k < count; ++k) lowest_row_.push_back(row(range(k).first));
        const auto enter = [&](const auto& put) {
            for (std::size_t k = 0; k < count; ++k) {
                const auto [lo, hi] = range(k);
                for (int r = row(lo), end = row(hi); r <= end; ++r)
                    put(static_cast<std::size_t>(r), static_cast<std::uint32_t>(k));
            }
        };
        enter([&](std::size_t r, std::uint32_t) { ++starts_[r + 1]; });
        for (std::size_t r = 1; r < starts_.size(); ++r) starts_[r] += starts_[r - 1];
        members_.resize(starts_.back());
        std::vector<std::uint32_t> next(starts_.begin(), starts_.end() - 1);
        enter([&](std::size_t r, std::uint32_t k) { members_[next[r]++] = k; });
    }

    /// Calls visit(k) once for each of those that come between the heights, and for others.
    template <class Visit>
    void visit(double from, double to, const Visit& visit) const {
        if (rows_ == 0) return;
        const int first = row(from), last = row(to);
        for (int r = first; r <= last; ++r)
            for (std::uint32_t i = starts_[static_cast<std::size_t>(r)]; i < starts_[static_cast<std::size_t>(r) + 1];
                 ++i)
                if (r == first || lowest_row_[members_[i]] == r) visit(members_[i]);
    }
    bool empty() const { return rows_ == 0; }

private:
    int row(double y) const { return static_cast<int>(std::clamp((y - low_) * inverse_, 0.0, rows_ - 1.0)); }

    double low_ = 0, inverse_ = 0;
    int rows_ = 0;
    std::vector<std::uint32_t> starts_, members_;
    std::vector<int> lowest_row_;  ///< by thing
};

}  // namespace ribvault
