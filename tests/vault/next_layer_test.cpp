// The sweep over cavities that drift for many layers: rooted, planar, inside, and equation (2) proved between all
// layers.
#include "ribvault/vault/next_layer.hpp"

#include <catch2/catch.hpp>

#include "grown_scene.hpp"
#include "ribvault/slice/exact_polygons.hpp"
#include "ribvault/verify/verify_layer.hpp"

using namespace ribvault;
using namespace ribvault::test;

namespace {

constexpr Unit wide = 20000000;

/// Slices are one large square: all that changes from layer to layer is the cavity.
struct Stack {
    Settings settings;
    Slice slice;
    ExactPolygons exact;
    std::vector<Cavity> cavities;
    std::vector<LayerSupports> supports;

    Stack(const DriftingShapes& shapes, int layers, const Settings& s) : settings(s) {
        slice.rounded = {rectangle(-wide, -wide, wide, wide)};
        ExactPolygon square;
        for (const Point p : slice.rounded.front())
            square.push_back({ExactKernel::FT(to_mm(p.x)), ExactKernel::FT(to_mm(p.y))});  // whole mm
        exact.polygons.emplace_back(square);
        for (int i = 0; i < layers; ++i)
            cavities.push_back(make_cavity(i, i + 1 == layers ? Region{} : shapes.at(i), settings));
        supports.resize(cavities.size());
        for (std::size_t i = cavities.size() - 1; i-- > 0;)
            supports[i] = next_layer(supports[i + 1].forest, cavities[i],
                                     overhang_over_cavity(cavities[i], slice, cavities[i + 1], settings), settings);
    }
    LayerVerdict verdict(std::size_t upper) const {
        const auto view = [&](std::size_t i) {
            return LayerGeometry{&exact, &cavities[i].region, centre_lines(supports[i].forest)};
        };
        return verify_layer(static_cast<int>(upper), view(upper), view(upper - 1), settings);
    }
    std::string tracks() const {
        std::string all;
        for (const LayerSupports& layer : supports)
            for (const Segment& s : centre_lines(layer.forest)) all += text(s);
        return all;
    }
};

void check(const Stack& stack, std::uint64_t seed) {
    for (std::size_t i = 0; i + 1 < stack.cavities.size(); ++i) {
        INFO("seed " << seed << ", layer " << i);
        const SupportForest& forest = stack.supports[i].forest;
        if (stack.cavities[i].region.empty()) {
            CHECK(num_vertices(forest) == 0);
        } else {
            const CavityBoundary boundary = prepare_boundary(stack.cavities[i].region);
            CHECK(forest_fault(forest) == "");
            CHECK(placement_fault(forest, boundary) == "");
            const Crossings crossed = crossings(forest);
            INFO(crossed.first);
            CHECK(crossed.count == 0);
        }
        const LayerVerdict verdict = stack.verdict(i + 1);
        CHECK(verdict.malformed == "");
        CHECK(verdict.supported);
    }
}

}  // namespace

TEST_CASE("supports of drifting cavities: forests on the shell, planar, every layer held up by the one below") {
    for (std::uint64_t seed = 0; seed < 24; ++seed) {
        Random g(seed);
        Settings settings;
        settings.seed = seed;
        settings.straighten = seed % 4 != 1;
        settings.branch_bonus = seed % 5 != 2;
        const Unit drifts[] = {2000, 15000, 40000};
        const DriftingShapes shapes(g, 2, 3, 700000, drifts[seed % 3]);
        check(Stack(shapes, 30, settings), seed);
    }
}

TEST_CASE("the same for other radii and steps") {
    for (std::uint64_t seed = 100; seed < 112; ++seed) {
        Random g(seed);
        Settings settings;
        settings.nozzle = 2 * pick(g, 10000, 30000);
        settings.support_width = seed % 2 ? settings.nozzle : 2 * pick(g, settings.nozzle / 4, settings.nozzle / 2);
        settings.support_radius = pick(g, settings.nozzle / 4, settings.support_width);
        settings.erosion_step = pick(g, 0, settings.support_radius);
        settings.straighten_step = pick(g, 0, settings.support_radius);
        const DriftingShapes shapes(g, 2, 2, 700000, 10000);
        check(Stack(shapes, 20, settings), seed);
    }
}

TEST_CASE("supports under a ceiling shrink and merge into the shell of a box that stays") {
    Random g(7);
    std::vector<Cavity> cavities;
    const Settings settings;
    const Cavity box = make_cavity(0, {rectangle(0, 0, 600000, 600000)}, settings);
    Slice slice;
    slice.rounded = {rectangle(-wide, -wide, wide, wide)};
    SupportForest none;
    SupportForest forest = next_layer(none, box, overhang_over_cavity(box, slice, {}, settings), settings).forest;
    CHECK(length(forest) > 2 * 600000);
    int layers = 0;
    for (; num_vertices(forest) > 0 && layers < 100; ++layers) {
        const double before = length(forest);
        forest = next_layer(forest, box, overhang_over_cavity(box, slice, box, settings), settings).forest;
        CHECK(length(forest) <= before);
    }
    CHECK(layers > 10);
    CHECK(layers < 100);
}

TEST_CASE("branches that do not continue below are marked as starting there") {
    SupportForest above =
        forest_of({{{100000, 0}, {100000, 100000}, {115000, 100000}, {100000, 300000}}, {0}, {{0, 1}, {1, 2}, {1, 3}}});
    const Settings settings;
    const Cavity box = make_cavity(0, {rectangle(0, 0, 600000, 600000)}, settings);
    next_layer(above, box, {}, settings);
    std::vector<char> first;
    for (auto [e, end] = edges(above); e != end; ++e) first.push_back(above[*e].first_layer);
    CHECK(first == std::vector<char>{0, 1, 0});
}

TEST_CASE("the same seed gives the same supports, another seed others") {
    Random g(3);
    const DriftingShapes shapes(g, 2, 2, 700000, 5000);
    Settings settings;
    const std::string first = Stack(shapes, 6, settings).tracks();
    CHECK(first == Stack(shapes, 6, settings).tracks());
    settings.seed = 2;
    CHECK(first != Stack(shapes, 6, settings).tracks());
}
