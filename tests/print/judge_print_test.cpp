// The verdict on a print, and the same after a change below.
#include "ribvault/print/judge_print.hpp"

#include <catch2/catch.hpp>
#include <random>

#include "ribvault/print/printed_tracks.hpp"
#include "ribvault/print/tool_path.hpp"

using namespace ribvault;

namespace {

constexpr Unit mm = units_per_mm;

class Tracks {
public:
    explicit Tracks(unsigned seed) : random_(seed) {}
    Unit between(Unit lo, Unit hi) { return std::uniform_int_distribution<Unit>(lo, hi)(random_); }
    PrintedTrack track() {
        const Point a{between(0, 8 * mm), between(0, 8 * mm)}, b{a.x + between(-mm, mm), a.y + between(-mm, mm)};
        PrintedTrack t;
        t.a = {printed_length(a.x), printed_length(a.y)}, t.b = {printed_length(b.x), printed_length(b.y)};
        t.width = printed_length(between(20000, 60000));
        t.feature = static_cast<int>(between(0, 1) ? TrackKind::support : TrackKind::external_support);
        return t;
    }
    /// A square outline and `n` tracks.
    PrintedLayer layer(int n) {
        PrintedLayer layer;
        const Point corners[]{{mm, mm}, {7 * mm, mm}, {7 * mm, 7 * mm}, {mm, 7 * mm}};
        for (int k = 0; k < 4; ++k) {
            const Point a = corners[k], b = corners[(k + 1) % 4];
            layer.tracks.push_back({{printed_length(a.x), printed_length(a.y)},
                                    {printed_length(b.x), printed_length(b.y)},
                                    printed_length(40000),
                                    static_cast<int>(TrackKind::outer_perimeter),
                                    0,
                                    true});
        }
        while (n-- > 0) layer.tracks.push_back(track());
        return layer;
    }
    /// Some tracks less, some more, in another order; now and then without its outline.
    void change(PrintedLayer& layer) {
        for (Unit k = between(1, 4); k > 0 && layer.tracks.size() > 5; --k)
            layer.tracks.erase(layer.tracks.begin() + between(4, static_cast<Unit>(layer.tracks.size()) - 1));
        for (Unit k = between(0, 4); k > 0; --k) layer.tracks.push_back(track());
        std::swap(layer.tracks[4], layer.tracks.back());
        if (between(0, 9) == 0) layer.tracks.front().outline = !layer.tracks.front().outline;
    }

private:
    std::mt19937 random_;
};

}  // namespace

TEST_CASE("after changes of the layer below the verdict is that of a look at everything") {
    int different = 0;
    for (unsigned seed = 0; seed < 12; ++seed) {
        Settings settings;
        if (seed % 3 == 1) settings.support = Support::both;
        if (seed % 3 == 2) settings.support = Support::both, settings.support_gap = 30000;
        Tracks tracks(seed);
        const PrintedLayer above = tracks.layer(40);
        PrintedLayer below = tracks.layer(120);
        PrintJudgement judgement(above, below, settings);
        std::vector<OpenStretch> before = judgement.open();
        for (int round = 0; round < 12; ++round) {
            tracks.change(below);
            judgement.change_below(below);
            const PrintJudgement anew(above, below, settings);
            // The margin by which stretches are grown depends on the largest coordinate of a look.
            const auto same = [&](const std::vector<OpenStretch>& s, const std::vector<OpenStretch>& t) {
                return std::equal(s.begin(), s.end(), t.begin(), t.end(), [&](const auto& p, const auto& q) {
                    return p.track == q.track && std::fabs(p.from_mm - q.from_mm) < 1e-9 &&
                           std::fabs(p.to_mm - q.to_mm) < 1e-9;
                });
            };
            CHECK(same(judgement.open(), anew.open()));
            different += !same(judgement.open(), before);
            before = judgement.open();
            for (std::size_t k = 0; k < above.tracks.size(); ++k) CHECK(judgement.supported(k) == anew.supported(k));
            const PrintVerdict kept = judgement.verdict(), fresh = anew.verdict();
            CHECK(kept.supported == fresh.supported);
            CHECK(kept.unsupported_mm == fresh.unsupported_mm);
            CHECK(kept.external_mm == fresh.external_mm);
            CHECK(kept.place == fresh.place);
        }
    }
    CHECK(different > 50);
}
