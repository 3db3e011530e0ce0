// Every support track of a proved print, taken away or shortened: the verifier notices exactly when it matters, as an
// independent subdivision in integers says.
#include <catch2/catch.hpp>
#include <fstream>
#include <iostream>

#include "ribvault/mesh/place_mesh.hpp"
#include "ribvault/mesh/read_mesh.hpp"
#include "ribvault/pipeline/sweep_layers.hpp"
#include "ribvault/verify/verify_printed.hpp"
#include "verify/printed_brute_force.hpp"

using namespace ribvault;
using ribvault::test::GridTrack;
using ribvault::test::Printed;

namespace {

std::vector<std::shared_ptr<const PrintedLayer>> print_of_a_cube(Settings settings, const char* size_mm) {
    Mesh mesh = read_mesh(RIBVAULT_CORPUS "/../../experiments/models/cube20.stl");
    PlacementOptions options;
    options.height_mm = parse_rational(size_mm, "size");
    const Placement placement = place(mesh, options);
    const Slicer slicer(mesh, placement, settings);
    std::vector<std::shared_ptr<const PrintedLayer>> layers(static_cast<std::size_t>(slicer.layer_count()));
    sweep_layers(
        slicer, settings, {}, 1, [](const SweptLayer&, const LayerMaterial*) { return std::shared_ptr<void>(); },
        [&](const SweptLayer& layer, std::shared_ptr<void>) {
            layers[static_cast<std::size_t>(layer.material.layer)] = layer.held.printed;
        },
        [] { return false; });
    return layers;
}

/// In units of 1 nm about a place near the track, so that coordinates stay small; half: half the width, plus ρ below.
GridTrack grid(const PrintedTrack& t, const std::array<Rational, 2>& origin, const Rational& more) {
    const auto nm = [](const Rational& mm) {
        const Rational n = mm * 1000000;
        REQUIRE(n.get_den() == 1);
        return static_cast<std::int64_t>(n.get_num().get_si());
    };
    return {nm(t.a[0] - origin[0]), nm(t.a[1] - origin[1]), nm(t.b[0] - origin[0]), nm(t.b[1] - origin[1]),
            nm(t.width / 2 + more)};
}

double gap(const PrintedTrack& s,
           const PrintedTrack& t) {  // a lower bound of the distance of two centre lines: of their boxes
    const auto apart = [](double a, double b, double c, double d) {
        return std::max(0.0, std::max(std::min(c, d) - std::max(a, b), std::min(a, b) - std::max(c, d)));
    };
    return std::hypot(apart(s.a[0].get_d(), s.b[0].get_d(), t.a[0].get_d(), t.b[0].get_d()),
                      apart(s.a[1].get_d(), s.b[1].get_d(), t.a[1].get_d(), t.b[1].get_d()));
}

struct Count {
    int mutations = 0, noticed = 0, open = 0;
};

void mutate(const Settings& settings, const char* size_mm, Count& count) {
    const Rational rho(settings.support_radius, units_per_mm);
    const auto layers = print_of_a_cube(settings, size_mm);
    PrintedOptions options;
    options.regions = false;
    for (std::size_t i = 0; i + 1 < layers.size(); ++i) {
        const PrintedLayer &below = *layers[i], &above = *layers[i + 1];
        REQUIRE(verify_printed(above, below, rho, options).supported);
        for (std::size_t k = 0; k < below.tracks.size(); ++k) {
            if (below.tracks[k].feature != static_cast<int>(TrackKind::support)) continue;
            for (const bool shorten : {false, true}) {
                PrintedLayer less = below;
                PrintedTrack& track = less.tracks[k];
                if (shorten) {
                    // 2 µm off its second end, along x or y, whichever is longer.
                    const std::size_t axis = abs(track.b[0] - track.a[0]) >= abs(track.b[1] - track.a[1]) ? 0 : 1;
                    const Rational d = track.b[axis] - track.a[axis];
                    if (abs(d) <= Rational(1, 500)) continue;
                    const Rational share = Rational(1, 500) / abs(d);
                    const std::array<Rational, 2> way{track.b[0] - track.a[0], track.b[1] - track.a[1]};
                    for (const std::size_t c : {0, 1}) {
                        // to whole nanometres
                        const mpz_class nm = mpz_class(Rational((way[c] * share) * 1000000));
                        Rational less_by(nm, 1000000);
                        less_by.canonicalize();
                        track.b[c] = track.b[c] - less_by;
                    }
                } else {
                    less.tracks.erase(less.tracks.begin() + static_cast<std::ptrdiff_t>(k));
                }
                const bool supported = verify_printed(above, less, rho, options).supported;
                std::vector<GridTrack> upper, lower;
                const std::array<Rational, 2> origin = rational(below.tracks[k].a);
                for (const PrintedTrack& t : above.tracks)
                    if (gap(t, below.tracks[k]) < 0.7) {
                        upper.push_back(grid(t, origin, 0));
                        for (const PrintedTrack& u : less.tracks)
                            if (gap(t, u) < 0.7) lower.push_back(grid(u, origin, rho));
                    }
                const Printed truth = ribvault::test::printed_areas(upper, lower);
                ++count.mutations, count.noticed += !supported;
                INFO("layer " << i << ", track " << k << (shorten ? ", shortened" : ", taken away"));
                if (truth == Printed::supported) CHECK(supported);
                if (truth == Printed::unsupported) CHECK_FALSE(supported);
                count.open += truth == Printed::open || truth == Printed::tie;
            }
        }
    }
}

}  // namespace

TEST_CASE("a support track of a proved print that is taken away or shortened is noticed exactly when it matters") {
    Settings settings;
    Count count;
    mutate(settings, "4", count);
    settings.propagation = Propagation::shrink, settings.order = Order::doubling, settings.trim = true;
    mutate(settings, "4", count);
    std::cout << count.mutations << " tracks taken away or shortened, " << count.noticed
              << " of them noticed; the subdivision left " << count.open << " open\n";
    CHECK(count.mutations > 300);
    CHECK(count.noticed > 100);
    CHECK(count.noticed < count.mutations);
    CHECK(10 * count.open < count.mutations);
}
