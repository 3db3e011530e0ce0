#include "ribvault/print/interleaved_layers.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <optional>

namespace ribvault {
namespace {

constexpr std::size_t levels_between = 4;
constexpr double most_steps = 1000;  // along one track: 1 m in cells of 1 mm

struct Cell {
    int x, y;
};

struct Span {
    int lo = std::numeric_limits<int>::max(), hi = std::numeric_limits<int>::min();
    void add(int v) { lo = std::min(lo, v), hi = std::max(hi, v); }
    bool near(int v) const { return lo - 1 <= v && v <= hi + 1; }
};

/// Calls visit(cell, length) along the tracks of a level, in steps of a cell, mm.
template <class Visit>
void walk(const LevelTracks& level, const Visit& visit) {
    for (const GcodeLayer* layer : level.entries)
        for (const GcodeTrack& t : layer->tracks) {
            const GcodePoint &a = layer->points[t.a], &b = layer->points[t.b];
            const double x = to_double(a.x), y = to_double(a.y), dx = to_double(b.x) - x, dy = to_double(b.y) - y;
            const double length = std::hypot(dx, dy), steps = std::clamp(std::ceil(length), 1.0, most_steps);
            for (double k = 0.5; k < steps; ++k)
                visit(Cell{static_cast<int>(std::floor(x + k / steps * dx)),
                           static_cast<int>(std::floor(y + k / steps * dy))},
                      length / steps);
        }
}

struct Extent {
    Span x, y;
    bool holds(const Extent& other) const {
        return x.near(other.x.lo) && x.near(other.x.hi) && y.near(other.y.lo) && y.near(other.y.hi);
    }
};

Extent extent_of(const LevelTracks& level) {
    Extent extent;
    for (const GcodeLayer* layer : level.entries)
        for (const GcodePoint& p : layer->points) {
            extent.x.add(static_cast<int>(std::floor(to_double(p.x))));
            extent.y.add(static_cast<int>(std::floor(to_double(p.y))));
        }
    return extent;
}

class Outline {
public:
    explicit Outline(const LevelTracks& level) {
        walk(level, [&](Cell c, double) { rows_[c.y].add(c.x), columns_[c.x].add(c.y); });
    }
    bool holds(Cell c) const { return within(rows_, c.y, c.x) && within(columns_, c.x, c.y); }

private:
    /// Of the spans at or next to `at`: tracks may be farther apart than a cell.
    static bool within(const std::map<int, Span>& spans, int at, int v) {
        const auto above = spans.lower_bound(at - 1);
        if (above != spans.end() && above->first <= at + 1) {
            for (auto near = above; near != spans.end() && near->first <= at + 1; ++near)
                if (near->second.near(v)) return true;
            return false;
        }
        return above != spans.end() && above != spans.begin() && above->second.near(v) &&
               std::prev(above)->second.near(v);
    }
    std::map<int, Span> rows_, columns_;
};

}  // namespace

int interleaved_layers(const std::vector<LevelTracks>& levels, Int128 reach) {
    std::vector<std::optional<Outline>> outlines(levels.size());
    const auto outline = [&](std::size_t k) -> const Outline& {
        return outlines[k] ? *outlines[k] : outlines[k].emplace(levels[k]);
    };
    int count = 0;
    std::optional<std::size_t> last;
    Extent below;
    for (std::size_t k = 0; k < levels.size(); ++k) {
        if (k > 2 * levels_between) outlines[k - 2 * levels_between].reset();
        const Extent extent = extent_of(levels[k]);
        const bool over = below.holds(extent);
        below = extent;
        if (k < 2 || over || !levels[k].by_distance) continue;
        double length = 0, beside = 0;
        walk(levels[k], [&](Cell c, double mm) {
            length += mm;
            if (outline(k - 1).holds(c)) return;
            for (std::size_t j = k - 1; j-- > 0 && levels[k].z - levels[j].z <= reach;)
                if (outline(j).holds(c)) {
                    beside += mm;
                    return;
                }
        });
        if (beside == 0 || 2 * beside < length) continue;
        count += last && k - *last <= levels_between;
        last = k;
    }
    return count;
}

}  // namespace ribvault
