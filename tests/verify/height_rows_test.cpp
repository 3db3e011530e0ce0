// Things in rows by height.
#include "ribvault/verify/height_rows.hpp"

#include <catch2/catch.hpp>
#include <random>

using namespace ribvault;

TEST_CASE("rows name all that reaches a range of heights, each once") {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> place(-10, 10), extent(0, 6);
    for (int round = 0; round < 50; ++round) {
        std::vector<std::pair<double, double>> things;
        for (int k = 0; k < 60; ++k) {
            const double low = place(random);
            things.emplace_back(low, low + (k % 3 == 0 ? 0 : extent(random)));
        }
        const HeightRows rows(things.size(), [&](std::size_t k) { return things[k]; });
        for (int query = 0; query < 50; ++query) {
            const double from = 1.2 * place(random), to = from + (query % 2 == 0 ? 0 : extent(random));
            std::vector<int> named(things.size(), 0);
            rows.visit(from, to, [&](std::uint32_t k) { ++named[k]; });
            for (std::size_t k = 0; k < things.size(); ++k) {
                CHECK(named[k] <= 1);
                if (things[k].first <= to && from <= things[k].second) CHECK(named[k] == 1);
            }
        }
    }
    int named = 0;
    HeightRows().visit(0, 1, [&](std::uint32_t) { ++named; });
    CHECK(named == 0);
}
