#include "ribvault/verify/boundary_match.hpp"

#include <algorithm>
#include <cmath>

#include "ribvault/verify/prepared_tracks.hpp"

namespace ribvault::verify {

namespace {

struct Spot {
    double x = 0, y = 0;
};
double squared(Spot p, Spot q) { return (p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y); }

/// The point of the stretch from p to q nearest to c, and how far along it is (0 to 1).
struct Foot {
    Spot at;
    double along;
};
Foot foot(Spot p, Spot q, Spot c) {
    const double dx = q.x - p.x, dy = q.y - p.y, norm = dx * dx + dy * dy;
    const double t = norm > 0 ? std::clamp(((c.x - p.x) * dx + (c.y - p.y) * dy) / norm, 0.0, 1.0) : 0;
    return {{p.x + t * dx, p.y + t * dy}, t};
}

void add(Window& w, Spot p) { w = united(w, {p.x, p.y, p.x, p.y}); }

/// A closed chain of points; the first one is not repeated.
using Loop = std::vector<Spot>;

std::optional<std::vector<Loop>> loops_of(std::span<const Vertex> vertices, std::span<const Edge> edges) {
    std::vector<Loop> loops;
    int first = -1;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        if (i == 0 || edges[i].a != edges[i - 1].b) loops.emplace_back(), first = edges[i].a;
        loops.back().push_back({vertices[edges[i].a].cx, vertices[edges[i].a].cy});
        const bool last = i + 1 == edges.size() || edges[i + 1].a != edges[i].b;
        if (last && edges[i].b != first) return std::nullopt;
    }
    return loops;
}

class Matching {
public:
    Matching(std::vector<Loop> moved, std::vector<Loop> fixed, double reach, double margin)
        : moved_(std::move(moved)), fixed_(std::move(fixed)), reach_(reach), margin_(margin), used_(fixed_.size(), 0) {
        for (const Loop& loop : fixed_) boxes_.push_back(box_of(loop));
    }

    std::vector<Window> run() {
        for (const Loop& loop : moved_) match(loop);
        for (std::size_t k = 0; k < fixed_.size(); ++k)
            if (!used_[k]) keep(boxes_[k]);
        return std::move(windows_);
    }

private:
    static Window box_of(const Loop& loop) {
        Window box = empty_window;
        for (const Spot p : loop) add(box, p);
        return box;
    }
    void keep(Window w) {
        w.lo_x -= margin_, w.lo_y -= margin_, w.hi_x += margin_, w.hi_y += margin_;
        windows_.push_back(w);
    }
    bool near(Spot p, Spot q) const { return squared(p, q) <= reach_ * reach_; }

    /// A partner for some vertex of the loop, on an edge of a loop that has none yet.
    struct Start {
        std::size_t vertex, loop, edge;
        Spot at;
    };
    std::optional<Start> start_of(const Loop& loop) const {
        constexpr std::size_t tries = 16;
        const std::size_t step = std::max<std::size_t>(1, loop.size() / tries);
        for (std::size_t i = 0; i < loop.size(); i += step) {
            const Spot p = loop[i];
            double least = reach_ * reach_;
            std::optional<Start> best;
            for (std::size_t k = 0; k < fixed_.size(); ++k) {
                const Window& box = boxes_[k];
                if (used_[k] || p.x < box.lo_x - reach_ || p.x > box.hi_x + reach_ || p.y < box.lo_y - reach_ ||
                    p.y > box.hi_y + reach_)
                    continue;
                const Loop& other = fixed_[k];
                for (std::size_t j = 0; j < other.size(); ++j) {
                    const Foot f = foot(other[j], other[j + 1 < other.size() ? j + 1 : 0], p);
                    if (const double d = squared(p, f.at); d < least) least = d, best = Start{i, k, j, f.at};
                }
            }
            if (best) return best;
        }
        return std::nullopt;
    }

    void match(const Loop& loop) {
        const std::optional<Start> start = start_of(loop);
        if (!start) return keep(box_of(loop));
        used_[start->loop] = 1;
        // Both as open chains that begin and end at the partners.
        a_.clear(), b_.clear();
        a_.insert(a_.end(), loop.begin() + static_cast<std::ptrdiff_t>(start->vertex), loop.end());
        a_.insert(a_.end(), loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(start->vertex) + 1);
        const Loop& other = fixed_[start->loop];
        const auto after = static_cast<std::ptrdiff_t>(start->edge) + 1;
        b_.push_back(start->at);
        b_.insert(b_.end(), other.begin() + after, other.end());
        b_.insert(b_.end(), other.begin(), other.begin() + after);
        b_.push_back(start->at);
        grid_.reset();
        walk();
    }

    /// x is on the edge of a_ that ends at i, y on that of b_ that ends at j.
    void walk() {
        std::size_t i = 1, j = 1;
        Spot x = a_.front(), y = b_.front();
        while (i < a_.size() || j < b_.size()) {
            const bool more_a = i < a_.size(), more_b = j < b_.size();
            if (more_a && more_b) {
                const Foot on_b = foot(y, b_[j], a_[i]);
                if (on_b.along < 1 && near(a_[i], on_b.at)) {
                    x = a_[i++], y = on_b.at;
                    continue;
                }
                const Foot on_a = foot(x, a_[i], b_[j]);
                if (on_a.along < 1 && near(b_[j], on_a.at)) {
                    x = on_a.at, y = b_[j++];
                    continue;
                }
                if (near(a_[i], b_[j])) {
                    x = a_[i++], y = b_[j++];
                    continue;
                }
            }
            if (more_a && near(a_[i], y)) {
                x = a_[i++];
            } else if (more_b && near(x, b_[j])) {
                y = b_[j++];
            } else {
                leap(i, j, x, y);
            }
        }
    }

    /// From partners x and y to the next ones that are found.
    void leap(std::size_t& i, std::size_t& j, Spot& x, Spot& y) {
        Window box = empty_window;
        add(box, x), add(box, y);
        prepare();
        const double from_a = far_a_[i - 1], from_b = far_b_[j - 1];
        for (; i < a_.size(); ++i) {
            add(box, a_[i]);
            std::size_t next = b_.size();
            Spot partner;
            double least = HUGE_VAL;
            grid_->near(a_[i].x, a_[i].y, 0, found_);
            for (const int k : found_) {
                const auto edge = static_cast<std::size_t>(k) + 1;  // ends at b_[edge]
                if (edge < j) continue;
                const Foot f = foot(edge == j ? y : b_[edge - 1], b_[edge], a_[i]);
                if (squared(a_[i], f.at) > reach_ * reach_ / 4) continue;
                const double ahead = std::fabs((far_b_[edge] - from_b) - (far_a_[i] - from_a));
                if (ahead < least) least = ahead, next = edge, partner = f.at;
            }
            if (next == b_.size()) continue;
            for (; j < next; ++j) add(box, b_[j]);
            x = a_[i++], y = partner;
            add(box, partner);
            return keep(box);
        }
        for (; j < b_.size(); ++j) add(box, b_[j]);
        keep(box);
    }

    void prepare() {
        if (grid_) return;
        const auto lengths = [](const std::vector<Spot>& chain, std::vector<double>& far) {
            far.assign(chain.size(), 0);
            for (std::size_t k = 1; k < chain.size(); ++k)
                far[k] = far[k - 1] + std::sqrt(squared(chain[k - 1], chain[k]));
        };
        lengths(a_, far_a_), lengths(b_, far_b_);
        edges_.clear();
        for (std::size_t k = 1; k < b_.size(); ++k) {
            PreparedTrack edge;
            edge.ax = b_[k - 1].x, edge.ay = b_[k - 1].y, edge.bx = b_[k].x, edge.by = b_[k].y;
            edge.dx = edge.bx - edge.ax, edge.dy = edge.by - edge.ay;
            edges_.push_back(edge);
        }
        grid_.emplace(edges_, reach_ / 2);
    }

    std::vector<Loop> moved_, fixed_;
    double reach_, margin_;
    std::vector<char> used_;
    std::vector<Window> boxes_, windows_;
    std::vector<Spot> a_, b_;
    std::vector<double> far_a_, far_b_;  ///< along a_ and b_
    std::vector<PreparedTrack> edges_;   ///< of b_
    std::optional<TrackGrid> grid_;
    std::vector<int> found_;
};

}  // namespace

std::optional<std::vector<Window>> windows_of_change(std::span<const Vertex> vertices, std::span<const Edge> moved,
                                                     std::span<const Edge> fixed, double distance) {
    double c = distance;
    for (const Vertex& v : vertices) c = std::max({c, std::abs(v.cx), std::abs(v.cy)});
    // Vertices are off by 2^-50 c, feet by some times that, squared distances by 2^-50 of themselves and 2^-48 c times
    // the distance.
    const double margin = std::ldexp(c, -34);
    if (distance <= 4 * margin) return std::nullopt;
    std::optional<std::vector<Loop>> a = loops_of(vertices, moved), b = loops_of(vertices, fixed);
    if (!a || !b) return std::nullopt;
    return Matching(std::move(*a), std::move(*b), distance - margin, margin).run();
}

}  // namespace ribvault::verify
