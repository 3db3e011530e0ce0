// Supports that wait on disk come back as they were, in the same order.
#include "ribvault/pipeline/kept_supports.hpp"

#include <catch2/catch.hpp>

#include <random>

using namespace ribvault;

namespace {

LayerSupports random_supports(std::mt19937_64& random, std::size_t size) {
    LayerSupports supports;
    const auto coordinate = [&] { return static_cast<Unit>(random() % 2000000) - 1000000; };
    const auto coin = [&] { return random() % 2 == 0; };
    for (std::size_t k = 0; k < size; ++k)
        add_vertex(SupportVertex{{coordinate(), coordinate()},
                                 coin(),
                                 coin(),
                                 coin(),
                                 coin(),
                                 static_cast<std::int32_t>(random() % 1000)},
                   supports.forest);
    for (std::size_t k = 1; k < size; ++k)
        if (random() % 4 != 0) {
            // Some edges lead up, some down, and not in the order of their ends.
            const std::size_t other = random() % k;
            add_edge(coin() ? k : other, coin() ? other : k, SupportEdge{coin(), coin()}, supports.forest);
        }
    for (std::size_t k = 0; k < size % 5; ++k) {
        supports.unsupported.emplace_back();
        for (std::size_t n = random() % 20; n > 0; --n)
            supports.unsupported.back().push_back({coordinate(), coordinate()});
    }
    supports.blocked = static_cast<int>(random() % 100), supports.braces = static_cast<int>(random() % 100);
    return supports;
}

/// All that a reader of the graph can tell, in the order in which it tells.
std::vector<std::int64_t> all_of(const LayerSupports& supports) {
    std::vector<std::int64_t> all{supports.blocked, supports.braces};
    const SupportForest& forest = supports.forest;
    for (auto [v, end] = vertices(forest); v != end; ++v) {
        const SupportVertex& at = forest[*v];
        all.insert(all.end(), {at.at.x, at.at.y, at.root, at.free, at.outside, at.wide, at.standing});
        for (auto [e, last] = out_edges(*v, forest); e != last; ++e)
            all.push_back(static_cast<std::int64_t>(target(*e, forest)));
    }
    for (auto [e, end] = edges(forest); e != end; ++e)
        all.insert(all.end(),
                   {static_cast<std::int64_t>(source(*e, forest)), static_cast<std::int64_t>(target(*e, forest)),
                    forest[*e].first_layer, forest[*e].to_junction});
    for (const Contour& contour : supports.unsupported) {
        all.push_back(static_cast<std::int64_t>(contour.size()));
        for (const Point p : contour) all.insert(all.end(), {p.x, p.y});
    }
    return all;
}

}  // namespace

TEST_CASE("what several sweeps made of each layer comes back, graph by graph, in any order") {
    std::mt19937_64 random(3);
    constexpr std::size_t sweeps = 3, layers = 20;
    std::vector<std::vector<LayerSupports>> made;
    KeptSupports kept(sweeps);
    for (std::size_t depth = 0; depth < layers; ++depth) {
        made.emplace_back();
        std::vector<std::string> packed;
        for (std::size_t k = 0; k < sweeps; ++k) {
            made.back().push_back(random_supports(random, depth == 7 ? 0 : 1 + random() % 60));
            packed.push_back(packed_supports(made.back().back()));
        }
        kept.add(packed);
    }
    kept.finish();
    for (int n = 0; n < 200; ++n) {
        const std::size_t sweep = random() % sweeps, depth = random() % layers;
        CHECK(all_of(kept.at(sweep, depth)) == all_of(made[depth][sweep]));
    }
}
