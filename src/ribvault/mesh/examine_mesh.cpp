#include "ribvault/mesh/examine_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <span>
#include <vector>

namespace ribvault {
namespace {

/// A triangle's side seen from its vertex of smaller number.
struct Side {
    int far;        ///< the side's other vertex
    int opposite;   ///< the triangle's third vertex
    int triangle;
    bool forward;   ///< the triangle runs from the smaller to the larger number
};

/// Sides grouped by their smaller vertex: those of vertex v are sides[start[v]] .. sides[start[v + 1] - 1].
struct SideTable {
    std::vector<std::size_t> start;
    std::vector<Side> sides;
};

SideTable tabulate(const Mesh& mesh) {
    SideTable table;
    table.start.assign(static_cast<std::size_t>(mesh.vertices.cols()) + 1, 0);
    const auto each_side = [&](auto&& visit) {
        for (int t = 0; t < mesh.triangles.cols(); ++t)
            for (int k = 0; k < 3; ++k)
                visit(mesh.triangles(k, t), mesh.triangles((k + 1) % 3, t), mesh.triangles((k + 2) % 3, t), t);
    };
    each_side([&](int a, int b, int, int) { ++table.start[static_cast<std::size_t>(std::min(a, b)) + 1]; });
    std::partial_sum(table.start.begin(), table.start.end(), table.start.begin());
    table.sides.resize(table.start.back());
    std::vector<std::size_t> next = table.start;
    each_side([&](int a, int b, int c, int t) {
        table.sides[next[static_cast<std::size_t>(std::min(a, b))]++] = {std::max(a, b), c, t, a < b};
    });
    return table;
}

/// Union-find over triangles.
class Parts {
public:
    explicit Parts(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
    int find(int i) {
        while (at(i) != i) i = at(i) = at(at(i));
        return i;
    }
    void join(int a, int b) {
        a = find(a), b = find(b);
        at(std::max(a, b)) = std::min(a, b);
    }

private:
    int& at(int i) { return parent_[static_cast<std::size_t>(i)]; }
    std::vector<int> parent_;
};

/// What is known of a component, in the file's coordinates.
struct Component {
    Eigen::AlignedBox3d box;
    double volume = 0;
    bool closed = true;
};

/// Counts the edge's defects; `sides` are all that lie on one edge. True when the edge is balanced.
bool count_edge(std::span<Side> sides, int near, MeshFacts& facts) {
    std::size_t forward = 0;
    for (const Side& side : sides) forward += side.forward;
    const bool balanced = 2 * forward == sides.size();
    facts.boundary_edges += sides.size() == 1;
    facts.non_manifold_edges += sides.size() > 2;
    facts.unbalanced_edges += !balanced;
    if (sides.size() < 2) return balanced;
    // Equal triangles share all sides; they are counted at the one between their two smallest vertices.
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.opposite < b.opposite; });
    for (std::size_t i = 1; i < sides.size(); ++i)
        facts.duplicate_triangles += sides[i].opposite == sides[i - 1].opposite && near < sides[i].opposite &&
                                     sides[i].far < sides[i].opposite;
    return balanced;
}

/// Visits all edges; joins what they connect and returns for each triangle whether one of its edges is unbalanced.
std::vector<char> survey_edges(const Mesh& mesh, Parts& parts, MeshFacts& facts) {
    SideTable table = tabulate(mesh);
    std::vector<char> open(static_cast<std::size_t>(mesh.triangles.cols()), 0);
    for (std::size_t v = 0; v + 1 < table.start.size(); ++v) {
        const auto begin = table.sides.begin() + static_cast<std::ptrdiff_t>(table.start[v]);
        const auto end = table.sides.begin() + static_cast<std::ptrdiff_t>(table.start[v + 1]);
        std::sort(begin, end, [](const Side& a, const Side& b) { return a.far < b.far; });
        for (auto first = begin; first != end;) {
            auto last = first;
            while (last != end && last->far == first->far) ++last;
            const bool balanced = count_edge({first, last}, static_cast<int>(v), facts);
            for (auto side = first; side != last; ++side) {
                parts.join(first->triangle, side->triangle);
                if (!balanced) open[static_cast<std::size_t>(side->triangle)] = 1;
            }
            first = last;
        }
    }
    return open;
}

std::vector<Component> measure(const Mesh& mesh, Parts& parts, const std::vector<char>& open) {
    std::vector<Component> components;
    std::vector<int> number(open.size(), -1);
    const Eigen::Vector3d centre = (mesh.vertices.rowwise().minCoeff() + mesh.vertices.rowwise().maxCoeff()) / 2;
    for (int t = 0; t < mesh.triangles.cols(); ++t) {
        int& n = number[static_cast<std::size_t>(parts.find(t))];
        if (n < 0) {
            n = static_cast<int>(components.size());
            components.emplace_back();
        }
        Component& component = components[static_cast<std::size_t>(n)];
        Eigen::Matrix3d corners;
        for (int k = 0; k < 3; ++k) {
            corners.col(k) = mesh.vertices.col(mesh.triangles(k, t)) - centre;
            component.box.extend(corners.col(k));
        }
        component.volume += corners.col(0).cross(corners.col(1)).dot(corners.col(2)) / 6;
        if (open[static_cast<std::size_t>(t)]) component.closed = false;
    }
    return components;
}

std::size_t count_inverted(const std::vector<Component>& components) {
    std::vector<const Component*> hosts;
    for (const Component& c : components)
        if (c.volume > 0) hosts.push_back(&c);
    return static_cast<std::size_t>(std::count_if(components.begin(), components.end(), [&](const Component& c) {
        const auto holds = [&](const Component* host) { return host->box.contains(c.box); };
        return c.closed && c.volume < 0 && std::none_of(hosts.begin(), hosts.end(), holds);
    }));
}

}  // namespace

MeshFacts examine(const Mesh& mesh, const Placement& placement) {
    MeshFacts facts;
    facts.triangles = static_cast<std::size_t>(mesh.triangles.cols());
    facts.vertices = static_cast<std::size_t>(mesh.vertices.cols());
    facts.degenerate_triangles = mesh.degenerate_triangles;
    if (facts.triangles == 0) return facts;

    const double scale = placement.scale.get_d();
    for (std::size_t k = 0; k < 3; ++k) {
        const auto row = mesh.vertices.row(placement.axis[k]);
        facts.size_mm[k] = scale * (row.maxCoeff() - row.minCoeff());
    }
    Parts parts(facts.triangles);
    const std::vector<char> open = survey_edges(mesh, parts, facts);
    std::vector<Component> components = measure(mesh, parts, open);
    facts.components = components.size();
    for (Component& component : components) {
        component.volume *= handedness(placement);
        facts.volume_mm3 += component.volume * scale * scale * scale;
    }
    facts.inverted_components = count_inverted(components);
    return facts;
}

}  // namespace ribvault
