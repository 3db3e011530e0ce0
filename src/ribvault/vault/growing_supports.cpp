#include "ribvault/vault/growing_supports.hpp"

#include <algorithm>
#include <limits>

#include "ribvault/vault/tree_walk.hpp"

namespace ribvault {
namespace {

/// Trees that are no longer than this, and no farther from another one, are at the same place as that (10 µm: what is
/// printed as two dots would lie on each other).
constexpr Unit same_place = 1000;

Box around(Point p, double reach) {
    const Unit by = static_cast<Unit>(reach) + 1;
    return {{p.x - by, p.y - by}, {p.x + by, p.y + by}};
}

SquaredDistance squared(double distance) {
    const auto whole = static_cast<Int128>(distance);
    return {whole * whole, 1};
}

}  // namespace

GrowingSupports::GrowingSupports(SupportForest forest, const Box& cavity_box, const CavityBoundary& boundary,
                                 const Settings& settings)
    : forest_(std::move(forest)),
      boundary_(boundary),
      settings_(settings),
      grid_(cavity_box, settings.support_width, settings.reach_of_support()) {
    inherited_vertices_ = num_vertices(forest_);
    for (auto [e, end] = edges(forest_); e != end; ++e) enter(source(*e, forest_), target(*e, forest_));
    for (auto [v, end] = vertices(forest_); v != end; ++v)
        if (out_degree(*v, forest_) == 0) enter(*v, *v);
}

void GrowingSupports::enter(std::size_t a, std::size_t b) {
    walls_.push_back({a, b, {forest_[a].at, forest_[b].at}, true});
    const auto id = static_cast<std::uint32_t>(walls_.size() - 1);
    grid_.insert(id, segment(id));
}

void GrowingSupports::connect(std::size_t a, std::size_t b) {
    add_edge(a, b, forest_);
    enter(a, b);
}

bool GrowingSupports::covers(Point p, Unit radius) const {
    return grid_.any_near(
        p, [&](std::uint32_t w) { return walls_[w].alive && compare_distance(p, segment(w), radius) <= 0; });
}

bool GrowingSupports::covers_around(Point p, double size, Unit radius) const {
    const double least = static_cast<double>(radius) - size;
    if (least < 0) return false;
    return grid_.any_near(p, [&](std::uint32_t w) {
        return walls_[w].alive && squared_distance(p, segment(w)).value() <= least * least;
    });
}

template <class Skip>
bool GrowingSupports::walls_bar(const Segment& way, Skip&& skip) const {
    bool barred = false;
    grid_.visit(bounding_box(way), [&](std::uint32_t w) {
        if (barred || !walls_[w].alive || skip(w)) return;
        const Segment& s = segment(w);
        barred = s.a != way.b && s.b != way.b && segments_touch(way, s);
    });
    return barred;
}

bool GrowingSupports::edge_bars(const Segment& way, bool at_root) const {
    bool barred = false;
    boundary_.edges.visit(bounding_box(way), [&](std::uint32_t k) {
        const Segment& e = boundary_.edges.segments()[k];
        if (!barred && segments_touch(way, e)) barred = !at_root || compare_distance(way.b, e, root_tolerance) > 0;
    });
    return barred;
}

bool GrowingSupports::free_way(Point from, Point to, std::uint32_t wall, std::size_t own) const {
    const Segment way{from, to};
    const auto meets = [&](std::uint32_t w) { return w == wall || walls_[w].a == own || walls_[w].b == own; };
    return !walls_bar(way, meets) && !edge_bars(way, false);
}

bool GrowingSupports::free_way(Point from, std::size_t to) const {
    const Segment way{from, forest_[to].at};
    return !walls_bar(way, [&](std::uint32_t w) { return walls_[w].a == to || walls_[w].b == to; }) &&
           !edge_bars(way, forest_[to].root && !forest_[to].free);
}

std::size_t GrowingSupports::split(std::uint32_t wall, Point near) {
    const Wall old = walls_[wall];
    const Point at = nearest_point(near, segment(wall));
    if (at == forest_[old.a].at) return old.a;
    if (at == forest_[old.b].at) return old.b;
    walls_[wall].alive = false;
    remove_edge(old.a, old.b, forest_);
    const std::size_t v = add_vertex(vertex_between(forest_[old.a], forest_[old.b], at), forest_);
    connect(old.a, v);
    connect(v, old.b);
    return v;
}

double GrowingSupports::longest_wall() const {
    if (!boundary_.free_trees) return std::numeric_limits<double>::infinity();
    // A wall of length L loses one step a layer: L² / (2 step) in all, less what the bed cuts off.
    const auto layers = static_cast<double>(boundary_.layers_below),
               step = static_cast<double>(std::max<Unit>(settings_.erosion_step, 1));
    const double pillar = static_cast<double>(pillar_length());
    // A pillar that leans goes one step a layer to where the wall leads.
    if (boundary_.leaning) return std::min(2 * pillar, pillar + layers * step / 2);
    return 2 * pillar < layers * step ? std::sqrt(2 * step * pillar * layers) : pillar + layers * step / 2;
}

std::optional<std::uint32_t> GrowingSupports::nearest_wall(Point p, const SquaredDistance& limit,
                                                           SquaredDistance& distance, std::size_t from,
                                                           const std::vector<char>& own) const {
    std::optional<std::uint32_t> wall;
    const double farthest = std::sqrt(limit.value());
    // Searched in growing squares.
    for (double reach = std::min(farthest, 2.0 * static_cast<double>(settings_.support_width));; reach *= 2) {
        grid_.visit(around(p, reach), [&](std::uint32_t w) {
            if (!walls_[w].alive || (walls_[w].a < own.size() && own[walls_[w].a])) return;
            const SquaredDistance d = squared_distance(p, segment(w));
            const int order = wall ? compare(d, distance) : compare(d, limit);
            if (order > 0 || (order == 0 && (!wall || w >= *wall))) return;
            // Nothing nearer than the shell is behind it.
            if (boundary_.rooted || free_way(p, nearest_point(p, segment(w)), w, from)) wall = w, distance = d;
        });
        if ((wall && std::sqrt(distance.value()) <= reach) || reach >= farthest) return wall;
    }
}

std::optional<Point> GrowingSupports::place_inside(Point p) const {
    if (boundary_.location.locate(p) == Side::inside) return p;
    if (boundary_.edges.empty()) return std::nullopt;
    const Segment& edge = boundary_.edges.segments()[boundary_.edges.nearest(p).index];
    const Point near = nearest_point(p, edge);
    const auto beside = [&](Point at) -> std::optional<Point> {
        for (Unit ring = 1; ring <= 3; ++ring)
            for (Unit dy = -ring; dy <= ring; ++dy)
                for (Unit dx = -ring; dx <= ring; ++dx)
                    if (const Point q{at.x + dx, at.y + dy}; boundary_.location.locate(q) == Side::inside) return q;
        return std::nullopt;
    };
    if (const std::optional<Point> place = beside(near)) return place;
    // At the tip of a spike no lattice point may be inside; along its side, by no more than what is to be held up is
    // within reach with, there may.
    for (const Unit along : {settings_.slack / 4, settings_.slack, 7 * settings_.slack / 4})
        for (const Point end : {edge.a, edge.b})
            if (const double l = length(end - near); l > 0)
                if (const auto place = beside(part_way(near, end, std::min(1.0, static_cast<double>(along) / l))))
                    return place;
    return std::nullopt;
}

void GrowingSupports::add_pillar(Point p) {
    const std::size_t centre = add_vertex(SupportVertex{p, true, true}, forest_);
    enter(centre, centre);
    const Unit arm = pillar_length() / 4;
    for (const Point d : {Point{arm, 0}, Point{0, arm}, Point{-arm, 0}, Point{0, -arm}}) {
        const Point end = p + d;
        if (boundary_.location.locate(end) == Side::inside && free_way(end, centre))
            connect(add_vertex(SupportVertex{end}, forest_), centre);
    }
}

/// Does a wall from the vertex go about the same way, and at least as far?
bool GrowingSupports::runs_along(std::size_t vertex, Point arm) const {
    for (auto [next, end] = adjacent_vertices(vertex, forest_); next != end; ++next) {
        const Point wall = forest_[*next].at - forest_[vertex].at;
        const double along = static_cast<double>(wall.x) * static_cast<double>(arm.x) +
                             static_cast<double>(wall.y) * static_cast<double>(arm.y);
        if (along > 0.7 * length(wall) * length(arm) && length(wall) >= length(arm)) return true;
    }
    return false;
}

void GrowingSupports::mend_free_tree(std::size_t root) {
    const TreeWalk tree = walk_from(root, forest_);
    double track = 0;
    for (std::size_t k = 0; k < tree.order.size(); ++k) track += tree.distance[k] - tree.distance[tree.parent[k]];
    if (2 * track >= static_cast<double>(settings_.pillar_length)) return;
    std::vector<char> own(num_vertices(forest_), 0);
    for (const std::size_t v : tree.order) own[v] = 1;
    Point p = forest_[root].at;
    if (track <= static_cast<double>(same_place)) {
        bool there = false;
        grid_.visit(around(p, static_cast<double>(same_place)), [&](std::uint32_t w) {
            there = there || (walls_[w].alive && !own[walls_[w].a] && compare_distance(p, segment(w), same_place) <= 0);
        });
        if (there) {
            for (Wall& wall : walls_)
                if (own[wall.a]) wall.alive = false;
            for (const std::size_t v : tree.order) clear_vertex(v, forest_), left_out_.push_back(v);
            return;
        }
    }
    // Where rounding put the root beside the region, what is new begins in it: ways outside it would meet no edge.
    std::size_t centre = root;
    if (boundary_.location.locate(p) != Side::inside) {
        const std::optional<Point> inside = place_inside(p);
        if (!inside || squared_length(*inside - p) > root_tolerance * root_tolerance * 4) return;
        p = *inside;
        centre = add_vertex(vertex_between(forest_[root], forest_[root], p), forest_);
        own.push_back(1);
        connect(centre, root);
    }
    SquaredDistance distance{0, 1};
    if (const std::optional<std::uint32_t> wall = nearest_wall(p, squared(longest_wall()), distance, centre, own)) {
        forest_[root].root = forest_[root].free = false;
        connect(centre, split(*wall, p));
        return;
    }
    const Unit arm = settings_.pillar_length / 4;
    for (const Unit reach : {arm, arm / 2, arm / 4})
        for (const Point d : {Point{reach, 0}, Point{0, reach}, Point{-reach, 0}, Point{0, -reach}}) {
            if (track + static_cast<double>(reach) > static_cast<double>(settings_.pillar_length)) return;
            if (runs_along(centre, d) || boundary_.location.locate(p + d) != Side::inside || !free_way(p + d, centre))
                continue;
            connect(add_vertex(SupportVertex{p + d}, forest_), centre);
            track += static_cast<double>(reach);
        }
}

void GrowingSupports::add_wall(Point at, Unit bonus) {
    Point p = at;
    if (boundary_.free_trees) {
        const std::optional<Point> inside = place_inside(at);
        if (!inside || covers(*inside, 0)) return;
        p = *inside;
    }
    const double longest = longest_wall();
    NearestSegment::Hit shell{0, squared(std::min(longest, static_cast<double>(lattice_bound)))};
    bool to_shell = false;
    if (boundary_.has_shell())
        if (const NearestSegment::Hit hit = boundary_.edges.nearest(p); hit.distance.value() <= longest * longest)
            shell = hit, to_shell = true;
    SquaredDistance wall_distance{0, 1};
    const std::optional<std::uint32_t> wall = nearest_wall(p, shell.distance, wall_distance);
    const SquaredDistance plain_distance = wall ? wall_distance : shell.distance;
    const double plain = std::sqrt(plain_distance.value());

    ++added_;
    std::vector<std::pair<SquaredDistance, std::size_t>> junctions;
    if (bonus > 0)
        grid_.visit(around(p, plain + static_cast<double>(bonus)), [&](std::uint32_t w) {
            if (!walls_[w].alive) return;
            for (const std::size_t v : {walls_[w].a, walls_[w].b}) {
                if (out_degree(v, forest_) == 0 ||
                    out_degree(v, forest_) >= static_cast<std::size_t>(settings_.valence_limit))
                    continue;
                const SquaredDistance d{squared_length(forest_[v].at - p), 1};
                if (compare_biased(d, bonus, plain_distance, 0) < 0) junctions.push_back({d, v});
            }
        });
    // The nearest ones first; one of them mostly has a free way, so they are not sorted.
    const auto farther = [](const auto& a, const auto& b) {
        const int order = compare(a.first, b.first);
        return order != 0 ? order > 0 : a.second > b.second;
    };
    std::make_heap(junctions.begin(), junctions.end(), farther);
    std::optional<std::size_t> before;  // each comes once a wall
    for (; !junctions.empty(); junctions.pop_back()) {
        const std::size_t v = junctions.front().second;
        if (v != before && free_way(p, v)) {
            add_tip(p, v);
            return;
        }
        before = v;
        std::pop_heap(junctions.begin(), junctions.end(), farther);
    }
    std::size_t to;
    if (wall) {
        to = split(*wall, p);
    } else if (!to_shell) {
        return add_pillar(p);
    } else {
        const Point foot = nearest_point(p, boundary_.edges.segments()[shell.index]);
        to = add_vertex(SupportVertex{.at = place_root(foot, boundary_), .root = true}, forest_);
    }
    add_tip(p, to);
}

void GrowingSupports::add_tip(Point p, std::size_t joint) {
    const std::size_t tip = add_vertex(SupportVertex{.at = p}, forest_);
    connect(tip, joint);
    new_walls_.push_back({tip, joint, static_cast<std::uint32_t>(walls_.size() - 1)});
}

SupportForest GrowingSupports::take() {
    if (!settings_.trim && left_out_.empty()) return std::move(forest_);
    // Vertices whose walls were taken away again go; dots from above stay.
    SupportForest kept;
    std::vector<std::size_t> place(num_vertices(forest_));
    std::vector<char> left_out(place.size(), 0);
    for (const std::size_t v : left_out_) left_out[v] = 1;
    for (std::size_t v = 0; v < place.size(); ++v)
        if (!left_out[v] && (out_degree(v, forest_) > 0 || v < inherited_vertices_ || forest_[v].free))
            place[v] = add_vertex(forest_[v], kept);
    for (auto [e, end] = edges(forest_); e != end; ++e)
        add_edge(place[source(*e, forest_)], place[target(*e, forest_)], kept);
    return kept;
}

}  // namespace ribvault
