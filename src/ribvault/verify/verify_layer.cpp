#include "ribvault/verify/verify_layer.hpp"

#include <CGAL/FPU.h>

#include <algorithm>

#include "ribvault/error.hpp"
#include "ribvault/verify/boundary_match.hpp"
#include "ribvault/verify/cavity_check.hpp"
#include "ribvault/verify/track_cover.hpp"
#include "ribvault/verify/witness.hpp"

namespace ribvault {

using namespace verify;

namespace {

/// The sets of one layer over common vertices.
struct LayerEdges {
    std::vector<Edge> outline;  ///< O on the left
    std::vector<Edge> cavity;   ///< C on the left
    std::vector<Edge> tracks;   ///< without repetitions
};

void add_polygon(const ExactPolygon& polygon, std::vector<Vertex>& vertices, std::vector<Edge>& edges) {
    const int first = static_cast<int>(vertices.size()), n = static_cast<int>(polygon.size());
    for (auto v = polygon.vertices_begin(); v != polygon.vertices_end(); ++v) vertices.push_back(slice_vertex(*v));
    for (int i = 0; i < n; ++i) edges.push_back({first + i, first + (i + 1) % n});
}

// Lattice segments with equal points as one vertex.
std::vector<Edge> add_segments(const std::vector<Segment>& segments, std::vector<Vertex>& vertices) {
    std::vector<Point> points;
    for (const Segment& s : segments) points.push_back(s.a), points.push_back(s.b);
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    for (const Point p : points)
        if (std::abs(p.x) > lattice_bound || std::abs(p.y) > lattice_bound)
            throw Error(ErrorKind::usage, "verify_layer: a point is farther than 10 m from the origin");
    const int first = static_cast<int>(vertices.size());
    for (const Point p : points) vertices.push_back(lattice_vertex(p));
    const auto index = [&](Point p) {
        return first + static_cast<int>(std::lower_bound(points.begin(), points.end(), p) - points.begin());
    };
    std::vector<Edge> edges;
    for (const Segment& s : segments) edges.push_back({index(s.a), index(s.b)});
    return edges;
}

LayerEdges add_layer(const LayerGeometry& layer, std::vector<Vertex>& vertices, std::string& malformed) {
    LayerEdges edges;
    for_each_boundary(*layer.outline,
                      [&](const ExactPolygon& polygon) { add_polygon(polygon, vertices, edges.outline); });
    const CavityBoundary cavity = cavity_boundary(*layer.cavity);
    malformed = cavity.malformed;
    edges.cavity = add_segments(cavity.edges, vertices);
    edges.tracks = add_segments(layer.tracks, vertices);
    for (Edge& e : edges.tracks)
        if (e.b < e.a) std::swap(e.a, e.b);
    const auto order = [](const Edge& e, const Edge& f) { return e.a != f.a ? e.a < f.a : e.b < f.b; };
    const auto same = [](const Edge& e, const Edge& f) { return e.a == f.a && e.b == f.b; };
    std::sort(edges.tracks.begin(), edges.tracks.end(), order);
    edges.tracks.erase(std::unique(edges.tracks.begin(), edges.tracks.end(), same), edges.tracks.end());
    if (malformed.empty()) malformed = check_inside(vertices, edges.cavity, edges.outline);
    return edges;
}

void grow_window(Window& w, const CoverProblem& problem, int vertex, double by) {
    const Vertex& v = problem.vertices[vertex];
    w.lo_x = std::min(w.lo_x, v.x.inf() - by), w.hi_x = std::max(w.hi_x, v.x.sup() + by);
    w.lo_y = std::min(w.lo_y, v.y.inf() - by), w.hi_y = std::max(w.hi_y, v.y.sup() + by);
}

Window window_of(const CoverProblem& problem, const Stadium& piece) {
    Window w = empty_window;
    for (const int end : {piece.a, piece.b}) grow_window(w, problem, end, piece.radius.approx + 1);
    return w;
}

/// Windows that cover the same, for less work: neighbours in the list as one where that costs little, about as high as
/// wide.
std::vector<Window> gathered(const std::vector<Window>& windows, double rho) {
    const double rim = 5 * rho;  // what a window costs beside its area
    const auto cost = [rim](const Window& w) { return (w.hi_x - w.lo_x + rim) * (w.hi_y - w.lo_y + rim); };
    constexpr std::size_t back = 16;
    std::vector<Window> joined, result;
    for (const Window& w : windows) {
        bool entered = false;
        for (std::size_t k = joined.size(); k-- > 0 && k + back >= joined.size() && !entered;) {
            Window& other = joined[k];
            const Window both = united(w, other);
            if (cost(both) > cost(w) + cost(other)) continue;
            other = both;
            entered = true;
        }
        if (!entered) joined.push_back(w);
    }
    for (const Window& w : joined) {
        const double wide = w.hi_x - w.lo_x, high = w.hi_y - w.lo_y;
        const auto parts = [rim](double side, double other) {
            return std::clamp(std::round(side / std::max(other, rim)), 1.0, 64.0);
        };
        const double columns = parts(wide, high), rows = parts(high, wide);
        for (double i = 0; i < columns; ++i)
            for (double j = 0; j < rows; ++j)
                result.push_back({w.lo_x + i / columns * wide, w.lo_y + j / rows * high,
                                  w.lo_x + (i + 1) / columns * wide, w.lo_y + (j + 1) / rows * high});
    }
    return result;
}

/// Windows for M \ K. `moved`: what bounds M's region, or at least a region that agrees with it outside K; `fixed`:
/// what bounds K's. Everything of M's region outside K has another winding number about one than about the other.
std::vector<Window> windows_of(const CoverProblem& problem, const std::vector<Edge>& moved, double rho) {
    std::optional<std::vector<Window>> windows = windows_of_change(problem.vertices, moved, problem.region, rho);
    if (!windows) {
        windows.emplace();
        Window all = empty_window;
        for (const Edge& e : problem.material) grow_window(all, problem, e.a, 1);
        if (!problem.material.empty()) windows->push_back(all);
    }
    for (const Stadium& piece : problem.pieces) windows->push_back(window_of(problem, piece));
    return gathered(*windows, rho);
}

std::optional<Unsupported> decide(const CoverProblem& problem, const std::vector<Window>& windows, double rho,
                                  StageCounts& stages) {
    const std::optional<Uncovered> found = find_uncovered(problem, windows, stages);
    if (!found) return std::nullopt;
    return describe_uncovered(problem, windows, *found, rho);
}

}  // namespace

LayerVerdict verify_layer(int upper_layer, const LayerGeometry& upper, const LayerGeometry& lower,
                          const Settings& settings) {
    if (settings.support_radius <= 0 || settings.support_width <= 0 || settings.support_width % 2 != 0)
        throw Error(ErrorKind::usage,
                    "the verifier needs a positive support radius and a width of supports of an even "
                    "number of lattice units; run Settings::check first");
    if (!upper.outline || !upper.cavity || !lower.outline || !lower.cavity)
        throw Error(ErrorKind::usage, "the verifier needs the outline and the cavity of both layers (layer " +
                                          std::to_string(upper_layer) + "); pass an empty cavity where there is none");
    const CGAL::Protect_FPU_rounding<true> upward;
    const double rho = static_cast<double>(settings.support_radius), r = static_cast<double>(settings.half_width());
    LayerVerdict verdict;
    verdict.layer = upper_layer;
    std::vector<Vertex> vertices;
    std::string malformed_above, malformed_below;
    const LayerEdges above = add_layer(upper, vertices, malformed_above);
    const LayerEdges below = add_layer(lower, vertices, malformed_below);
    if (!malformed_above.empty() || !malformed_below.empty()) {
        verdict.malformed = "layer " + std::to_string(malformed_above.empty() ? upper_layer - 1 : upper_layer) + ": " +
                            (malformed_above.empty() ? malformed_below : malformed_above);
        return verdict;
    }

    // External: M = BS_{i+1}, K = (O_i)^{ρ↑}, with external supports united with the points within r + ρ of a centre
    // line of S_i.
    CoverProblem external;
    external.vertices = vertices;
    external.material = above.outline;
    for (const Edge& e : above.cavity) external.material.push_back({e.b, e.a});
    for (const Edge& t : above.tracks) external.pieces.push_back({t.a, t.b, r});
    external.region = below.outline;
    for (const Edge& e : below.outline) external.sites.push_back({e.a, e.b, rho});
    if (settings.outside())
        for (const Edge& t : below.tracks) external.sites.push_back({t.a, t.b, r + rho});
    const std::vector<Window> outside = windows_of(external, above.outline, rho);
    verdict.external = decide(external, outside, rho, verdict.stages);
    bool held_outside = !settings.outside() || !verdict.external;
    if (!held_outside && settings.reach_of_object() > settings.support_radius) {
        // Within the removal gap: K = (O_i)^{g + r ↑} and the tracks.
        for (std::size_t k = 0; k < external.region.size(); ++k)
            external.sites[k].radius = static_cast<double>(settings.reach_of_object());
        const std::optional<Unsupported> beyond_gap = decide(external, outside, rho, verdict.stages);
        held_outside = !beyond_gap;
        if (beyond_gap) verdict.external = beyond_gap;
    }

    // Internal: K = the points within ρ of the outside of C_i, and within r + ρ of a centre line of S_i.
    if (!below.cavity.empty()) {
        CoverProblem internal;
        internal.vertices = vertices;
        internal.material = external.material;
        for (const Edge& t : uncovered_tracks(vertices, above.tracks, below.tracks, rho, verdict.stages))
            internal.pieces.push_back({t.a, t.b, r});
        internal.region = below.cavity;
        internal.region_outside = true;
        for (const Edge& e : below.cavity) internal.sites.push_back({e.a, e.b, rho});
        for (const Edge& t : below.tracks) internal.sites.push_back({t.a, t.b, r + rho});
        verdict.internal = decide(internal, windows_of(internal, above.cavity, rho), rho, verdict.stages);
    }
    verdict.supported = !verdict.internal && held_outside;
    return verdict;
}

}  // namespace ribvault
