#include "carve.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ribvault/slice/cavity.hpp"
#include "ribvault/slice/lattice_clip.hpp"

namespace ribvault::baselines {
namespace {

constexpr double arc = 200;    // lattice units: how far polygons stay inside their arcs
constexpr double clean = 200;  // corners nearer than this are one: else every step adds some

Region grow(const Region& region, double by) {
    if (region.empty()) return region;
    ClipperLib::Paths paths = to_clipper(offset(region, by, ClipperLib::jtRound, arc));
    ClipperLib::CleanPolygons(paths, clean);
    return from_clipper(paths);
}
Region without(const Region& a, const Region& b) {
    return a.empty() || b.empty() ? a : clip(ClipperLib::ctDifference, a, b);
}
Region united(const Region& a, const Region& b) {
    return a.empty() ? b : b.empty() ? a : clip(ClipperLib::ctUnion, a, b);
}

/// The skeleton of a piece, as wide as fits between material within r: what opening takes away from its erosions
/// (Lantuéjoul), without the branches of blunt corners; or only its deepest place. Empty when the piece is narrower
/// than a track.
Region tear_open(const Region& piece, double r, bool deepest_only) {
    const double step = r / 2;
    Region skeleton, level = piece;
    if (grow(piece, -r).empty()) return {};
    while (!level.empty()) {
        const Region next = grow(level, -step);
        const Region rest = next.empty() ? level : grow(grow(without(level, grow(next, step)), -step / 20), step / 20);
        if (deepest_only) skeleton.clear();
        skeleton.insert(skeleton.end(), rest.begin(), rest.end());
        level = next;
    }
    return intersect(grow(skeleton, step), piece);
}

class Sweep {
public:
    Sweep(const Stack& stack, const CarvingRules& rules, const Settings& settings)
        : stack_(stack), rules_(rules), settings_(settings), r_(static_cast<double>(settings.support_radius)),
          step_(r_ - 10 * static_cast<double>(settings.slack)) {
        result_.hollowed.cavities.resize(stack.slices.size());
        result_.hollowed.tracks.resize(stack.slices.size());
    }

    Carving run() {
        double total = 0;
        for (result_.rounds = 1;; ++result_.rounds) {
            const double gain = one_round();
            total += gain;
            if (gain < 0.005 * total || total == 0 || result_.rounds == rules_.rounds) break;
        }
        for (std::size_t i = 0; i < stack_.slices.size(); ++i)
            cavity(i) = make_cavity(static_cast<int>(i), std::move(cavity(i)), settings_).region;
        if (!rules_.columns) bridge_islands();
        return std::move(result_);
    }

private:
    Region& cavity(std::size_t i) { return result_.hollowed.cavities[i]; }

    /// One sweep from top to bottom through the room that is left; the volume gained, in units of area.
    double one_round() {
        double gained = 0;
        Region own, blocked;  // this round's cavity on the layer above; columns
        for (std::size_t i = stack_.slices.size(); i-- > 0;) {
            const Region room =
                without(without(stack_.room[i], grow(cavity(i), static_cast<double>(rules_.wall))), blocked);
            Region grown = room.empty() || own.empty() ? Region{} : intersect(grow(own, step_), room);
            for (const Region& piece : connected_pieces(room)) {
                if (!intersect(piece, grown).empty()) continue;
                const Region tear = tear_open(piece, r_, rules_.columns);
                result_.tears += !tear.empty();
                grown = united(grown, tear);
            }
            if (rules_.columns) {
                // What of the layer above lies farther than r from this layer's material.
                const bool top = i + 1 == stack_.slices.size();
                const Region hanging =
                    top ? Region{} : intersect(without(grow(grown, -r_), cavity(i + 1)), stack_.slices[i + 1].rounded);
                const Region column = grow(hanging, static_cast<double>(settings_.nozzle));
                blocked = united(blocked, column);
                grown = without(grown, column);
            }
            cavity(i) = united(cavity(i), grown);
            gained += signed_area(grown);
            own = std::move(grown);
        }
        return gained;
    }

    /// A straight track under every piece of material that ends over a cavity.
    void bridge_islands() {
        for (std::size_t i = 0; i + 1 < stack_.slices.size(); ++i) {
            if (cavity(i).empty()) continue;
            const Region below = without(stack_.slices[i].rounded, cavity(i));
            for (const Region& piece : connected_pieces(without(stack_.slices[i + 1].rounded, cavity(i + 1)))) {
                if (!intersect(piece, below).empty() || intersect(piece, cavity(i)).empty()) continue;
                const Box box = bounding_box(piece);
                const Segment bridge =
                    shortest_bridge({(box.lo.x + box.hi.x) / 2, (box.lo.y + box.hi.y) / 2}, cavity(i));
                const double mm = length(bridge) / units_per_mm;
                result_.hollowed.tracks[i].push_back(bridge);
                result_.hollowed.track_volume_mm3 += mm * to_mm(settings_.nozzle) * to_mm(settings_.layer_height);
                result_.bridge_mm += mm;
                result_.longest_bridge_mm = std::max(result_.longest_bridge_mm, mm);
                ++result_.bridges;
            }
        }
    }

    static Segment shortest_bridge(Point middle, const Region& cavity) {
        Segment best{middle, middle};
        double least = HUGE_VAL;
        for (int k = 0; k < 36; ++k) {
            const double angle = k * std::numbers::pi / 36, dx = std::cos(angle), dy = std::sin(angle);
            const double ahead = distance_to_edge(middle, dx, dy, cavity),
                         behind = distance_to_edge(middle, -dx, -dy, cavity);
            if (ahead + behind >= least) continue;
            least = ahead + behind;
            const auto at = [&](double t) {
                return Point{middle.x + round_to_lattice(t * dx), middle.y + round_to_lattice(t * dy)};
            };
            best = {at(-behind), at(ahead)};
        }
        return best;
    }
    static double distance_to_edge(Point from, double dx, double dy, const Region& region) {
        double nearest = HUGE_VAL;
        for (const Contour& c : region)
            for (std::size_t j = 0; j < c.size(); ++j) {
                const Point a = c[j] - from, e = c[(j + 1) % c.size()] - c[j];
                const auto ax = static_cast<double>(a.x), ay = static_cast<double>(a.y);
                const auto ex = static_cast<double>(e.x), ey = static_cast<double>(e.y);
                const double det = dx * ey - dy * ex;
                if (det == 0) continue;
                const double t = (ax * ey - ay * ex) / det, s = (ax * dy - ay * dx) / det;
                if (t >= 0 && s >= 0 && s <= 1) nearest = std::min(nearest, t);
            }
        return std::isfinite(nearest) ? nearest : 0;
    }

    const Stack& stack_;
    CarvingRules rules_;
    Settings settings_;
    double r_, step_;
    Carving result_;
};

}  // namespace

Carving carve(const Stack& stack, const CarvingRules& rules, const Settings& settings) {
    return Sweep(stack, rules, settings).run();
}

}  // namespace ribvault::baselines
