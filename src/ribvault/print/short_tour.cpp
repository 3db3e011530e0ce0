#include "ribvault/print/short_tour.hpp"

#include <algorithm>
#include <cmath>

namespace ribvault {
namespace {

constexpr std::size_t neighbours = 8, longest_run = 3, sampled_entries = 24, most_for_all_pairs = 400;
constexpr int most_rounds = 8;

double distance(Point a, Point b) {
    const double x = static_cast<double>(a.x - b.x), y = static_cast<double>(a.y - b.y);
    return std::sqrt(x * x + y * y);
}

class Tour {
public:
    Tour(const std::vector<TourStop>& stops, Point from, std::optional<Point> to)
        : stops_(stops), from_(from), to_(to) {
        start();
        near_.resize(stops_.size());
    }

    void improve() {
        if (order_.empty()) return;
        find_neighbours();
        for (int round = 0; round < most_rounds; ++round) {
            bool better = false;
            for (std::size_t s = 0; s < stops_.size(); ++s) {
                better |= change_way(position_[s]);
                better |= move_run(s);
                for (std::size_t other : near_[s]) better |= reverse_between(s, other);
            }
            if (!better) break;
        }
    }

    std::vector<Visit> take() { return std::move(order_); }

private:
    using Index = std::ptrdiff_t;

    Point in(Visit v) const {
        const TourStop& s = stops_[v.stop];
        if (s.entry == Entry::anywhere) return (*s.ring)[v.way];
        return v.way == 0 ? s.first : s.last;
    }
    Point out(Visit v) const {
        const TourStop& s = stops_[v.stop];
        if (s.entry == Entry::anywhere) return (*s.ring)[v.way];
        return v.way == 0 ? s.last : s.first;
    }
    bool can_turn(Visit v) const {
        const TourStop& s = stops_[v.stop];
        return s.entry != Entry::fixed || s.first == s.last;
    }
    Visit turned(Visit v) const { return stops_[v.stop].entry == Entry::either_end ? Visit{v.stop, 1 - v.way} : v; }
    std::size_t ways(std::size_t stop) const {
        const TourStop& s = stops_[stop];
        return s.entry == Entry::fixed ? 1 : s.entry == Entry::either_end ? 2 : s.ring->size();
    }
    std::size_t way_step(std::size_t stop) const {
        return stops_[stop].entry == Entry::anywhere ? 1 + ways(stop) / sampled_entries : 1;
    }

    Index size() const { return static_cast<Index>(order_.size()); }
    Visit at(Index k) const { return order_[static_cast<std::size_t>(k)]; }
    Index position(std::size_t stop) const { return static_cast<Index>(position_[stop]); }
    /// Where the nozzle leaves for position k.
    Point left_at(Index k) const { return k < 0 ? from_ : out(at(k)); }
    /// Travel from a point to where position k begins; after the last one to the tour's end.
    double to_position(Point p, Index k) const {
        return k < size() ? distance(p, in(at(k))) : to_ ? distance(p, *to_) : 0;
    }

    void start() {
        const std::size_t n = stops_.size();
        std::vector<std::vector<std::size_t>> followers(n);
        std::vector<std::size_t> open;
        for (std::size_t s = 0; s < n; ++s)
            if (stops_[s].after == no_stop)
                open.push_back(s);
            else
                followers[stops_[s].after].push_back(s);
        Point here = from_;
        while (!open.empty()) {
            std::size_t best = 0;
            Visit visit{open[0], 0};
            double nearest = std::numeric_limits<double>::infinity();
            for (std::size_t k = 0; k < open.size(); ++k)
                for (std::size_t way = 0, end = ways(open[k]), step = way_step(open[k]); way < end; way += step) {
                    const double d = distance(here, in({open[k], way}));
                    if (d < nearest || (d == nearest && open[k] < visit.stop))
                        nearest = d, best = k, visit = {open[k], way};
                }
            order_.push_back(visit);
            here = out(visit);
            open[best] = open.back();
            open.pop_back();
            for (std::size_t s : followers[visit.stop]) open.push_back(s);
        }
        position_.resize(n);
        number(0, size());
    }

    void number(Index begin, Index end) {
        for (Index k = begin; k < end; ++k) position_[at(k).stop] = static_cast<std::size_t>(k);
    }

    void find_neighbours() {
        const std::size_t n = stops_.size();
        if (n > most_for_all_pairs) {
            for (std::size_t s = 0; s < n; ++s)
                for (Index k = position(s) - 4; k <= position(s) + 4; ++k)
                    if (k >= 0 && k < size() && k != position(s)) near_[s].push_back(at(k).stop);
            return;
        }
        std::vector<std::pair<double, std::size_t>> all;
        for (std::size_t s = 0; s < n; ++s) {
            const Visit v = order_[position_[s]];
            all.clear();
            for (std::size_t t = 0; t < n; ++t) {
                if (t == s) continue;
                const Visit w = order_[position_[t]];
                all.emplace_back(std::min({distance(in(v), in(w)), distance(in(v), out(w)), distance(out(v), in(w)),
                                           distance(out(v), out(w))}),
                                 t);
            }
            const std::size_t count = std::min(neighbours, all.size());
            std::partial_sort(all.begin(), all.begin() + static_cast<Index>(count), all.end());
            for (std::size_t k = 0; k < count; ++k) near_[s].push_back(all[k].second);
        }
    }

    bool change_way(std::size_t k) {
        const Index i = static_cast<Index>(k);
        const Visit now = order_[k];
        const auto cost = [&](Visit v) { return distance(left_at(i - 1), in(v)) + to_position(out(v), i + 1); };
        Visit best = now;
        double least = cost(now) - 1;
        for (std::size_t way = 0, end = ways(now.stop); way < end; ++way)
            if (const double c = cost({now.stop, way}); c < least) least = c, best = {now.stop, way};
        order_[k] = best;
        return best.way != now.way;
    }

    /// Joins the two stops' exits, or their entries, by turning around what lies between.
    bool reverse_between(std::size_t s, std::size_t t) {
        const auto [i, j] = std::minmax({position(s), position(t)});  // a list: values, not references to what is gone
        return reverse(i + 1, j) || reverse(i, j - 1);
    }

    bool reverse(Index a, Index b) {
        if (a >= b || !can_turn(at(a)) || !can_turn(at(b))) return false;
        const double gain = distance(left_at(a - 1), in(at(a))) + to_position(out(at(b)), b + 1) -
                            distance(left_at(a - 1), in(turned(at(b)))) - to_position(out(turned(at(a))), b + 1);
        if (gain <= 1) return false;
        for (Index k = a; k <= b; ++k) {
            if (!can_turn(at(k))) return false;
            const std::size_t before = stops_[at(k).stop].after;
            if (before != no_stop && position(before) >= a) return false;
        }
        turn_around(a, b + 1);
        return true;
    }

    void turn_around(Index begin, Index end) {
        std::reverse(order_.begin() + begin, order_.begin() + end);
        for (Index k = begin; k < end; ++k) order_[static_cast<std::size_t>(k)] = turned(at(k));
        number(begin, end);
    }

    /// Moves a run that begins or ends with stop s before or after one of its neighbours.
    bool move_run(std::size_t s) {
        for (Index count = 1; count <= static_cast<Index>(longest_run); ++count)
            for (const Index begin : {position(s), position(s) - count + 1}) {
                const Index end = begin + count;
                if (begin < 0 || end > size()) continue;
                const double saved = distance(left_at(begin - 1), in(at(begin))) + to_position(out(at(end - 1)), end) -
                                     to_position(left_at(begin - 1), end);
                if (saved <= 1) continue;
                for (std::size_t t : near_[s])
                    for (const Index place : {position(t) - 1, position(t)})
                        for (const bool turn : {false, true})
                            if (move(begin, end, place, turn, saved)) return true;
                if (count == 1) break;
            }
        return false;
    }

    /// Moves positions begin .. end - 1, whose absence saves so much, to behind position `place`.
    bool move(Index begin, Index end, Index place, bool turn, double saved) {
        if (place >= begin - 1 && place < end) return false;
        const Point from = left_at(place);
        const Visit first = turn ? turned(at(end - 1)) : at(begin), last = turn ? turned(at(begin)) : at(end - 1);
        const double there = distance(from, in(first));
        const double between = to_position(from, place + 1);
        if (there - between >= saved - 1) return false;
        if (there + to_position(out(last), place + 1) - between >= saved - 1) return false;
        if (turn)
            for (Index k = begin; k < end; ++k)
                if (!can_turn(at(k))) return false;
        const auto after = [&](Index k) { return stops_[at(k).stop].after; };
        if (turn)
            for (Index k = begin; k < end; ++k)
                if (after(k) != no_stop && position(after(k)) >= begin && position(after(k)) < end) return false;
        if (place < begin) {
            for (Index k = begin; k < end; ++k)
                if (after(k) != no_stop && position(after(k)) > place && position(after(k)) < begin) return false;
        } else {
            for (Index k = end; k <= place; ++k)
                if (after(k) != no_stop && position(after(k)) >= begin && position(after(k)) < end) return false;
        }
        if (turn) turn_around(begin, end);
        const Index lo = std::min(begin, place + 1), hi = std::max(end, place + 1);
        std::rotate(order_.begin() + lo, order_.begin() + (place < begin ? begin : end), order_.begin() + hi);
        number(lo, hi);
        return true;
    }

    const std::vector<TourStop>& stops_;
    Point from_;
    std::optional<Point> to_;
    std::vector<Visit> order_;
    std::vector<std::size_t> position_;  ///< of every stop in the order
    std::vector<std::vector<std::size_t>> near_;
};

}  // namespace

std::vector<Visit> short_tour(const std::vector<TourStop>& stops, Point from, std::optional<Point> to) {
    Tour tour(stops, from, to);
    tour.improve();
    return tour.take();
}

}  // namespace ribvault
