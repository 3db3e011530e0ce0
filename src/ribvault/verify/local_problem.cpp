#include "ribvault/verify/local_problem.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace ribvault::verify {

namespace {

constexpr double most_integer = 0x1p26;  // squares of sums of two such numbers have no rounding

// The least common denominator of all lengths when it makes them integers that doubles multiply exactly, else a power
// of two.
Rational scale_for(std::span<const Rational* const> lengths, double extent) {
    mpz_class common = 1;
    for (const Rational* length : lengths) {
        mpz_lcm(common.get_mpz_t(), common.get_mpz_t(), length->get_den_mpz_t());
        if (common > most_integer) break;
    }
    const double wanted = 0x1p20;
    if (common.get_d() * extent <= most_integer) {
        Rational scale(common);
        while (scale.get_d() * extent < wanted / 2) scale *= 2;
        return scale;
    }
    int exponent = 0;
    std::frexp(wanted / extent, &exponent);
    Rational scale(1);
    if (exponent > 0)
        mpq_mul_2exp(scale.get_mpq_t(), scale.get_mpq_t(), static_cast<mp_bitcnt_t>(exponent));
    else
        mpq_div_2exp(scale.get_mpq_t(), scale.get_mpq_t(), static_cast<mp_bitcnt_t>(-exponent));
    return scale;
}

Radius radius_of(const Rational& value, std::deque<ExactRadius>& radii) {
    const Interval e = enclosure(value);
    if (e.inf() == e.sup()) return Radius(e.inf());
    for (const ExactRadius& r : radii)
        if (r.value == value) return Radius(r);
    radii.push_back({value, e});
    return Radius(radii.back());
}

}  // namespace

void build_local_problem(std::span<const PrintedTrack> upper, std::span<const int> pieces, const Below& below,
                         const Square& square, double margin, LocalProblem& local) {
    local.pieces.assign(pieces.begin(), pieces.end());
    local.sites.clear();
    for (const int k : below.which) {
        const auto i = static_cast<std::size_t>(k);
        // The root cell is 1.0173 times as large as the window, off its middle by 0.0137.
        const double reach = below.radii[i].get_d() + 1.5 * square.half + window_slack(margin);
        if (centre_distance(below.prepared[i], square.x, square.y) <= reach) local.sites.push_back(k);
    }
    std::vector<const std::array<Rational, 2>*> ends;
    std::vector<Rational> halves;
    for (const int p : pieces) {
        const PrintedTrack& t = upper[static_cast<std::size_t>(p)];
        ends.push_back(&t.a), ends.push_back(&t.b);
        halves.push_back(t.width / 2);
    }
    for (const int k : local.sites) {
        const PrintedTrack& t = below.tracks[static_cast<std::size_t>(k)];
        ends.push_back(&t.a), ends.push_back(&t.b);
    }
    std::vector<const Rational*> lengths;
    double extent = square.half;
    for (const auto* e : ends) {
        lengths.push_back(&(*e)[0]), lengths.push_back(&(*e)[1]);
        extent = std::max({extent, std::abs((*e)[0].get_d() - square.x), std::abs((*e)[1].get_d() - square.y)});
    }
    for (const Rational& h : halves) lengths.push_back(&h), extent = std::max(extent, h.get_d());
    for (const int k : local.sites) {
        const Rational& r = below.radii[static_cast<std::size_t>(k)];
        lengths.push_back(&r), extent = std::max(extent, r.get_d());
    }
    local.origin = *ends.front();
    local.scale = scale_for(lengths, 2 * extent);

    // Equal points as one vertex.
    std::vector<int> order(ends.size()), vertex_of(ends.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
    const auto at = [&](int i) -> const std::array<Rational, 2>& { return *ends[static_cast<std::size_t>(i)]; };
    std::sort(order.begin(), order.end(), [&](int i, int j) {
        const int c = cmp(at(i)[0], at(j)[0]);
        return c != 0 ? c < 0 : at(i)[1] < at(j)[1];
    });
    local.points.clear();
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i == 0 || at(order[i]) != at(order[i - 1]))
            local.points.push_back({Rational((at(order[i])[0] - local.origin[0]) * local.scale),
                                    Rational((at(order[i])[1] - local.origin[1]) * local.scale)});
        vertex_of[static_cast<std::size_t>(order[i])] = static_cast<int>(local.points.size()) - 1;
    }
    local.vertices.clear();
    for (const Vec<Rational>& p : local.points) local.vertices.push_back(rational_vertex(p));

    local.radii.clear();
    local.problem = {};
    local.problem.vertices = local.vertices;
    std::size_t end = 0;
    for (const Rational& half : halves) {
        local.problem.pieces.push_back(
            {vertex_of[end], vertex_of[end + 1], radius_of(Rational(half * local.scale), local.radii)});
        end += 2;
    }
    for (const int k : local.sites) {
        const Rational radius = below.radii[static_cast<std::size_t>(k)] * local.scale;
        local.problem.sites.push_back({vertex_of[end], vertex_of[end + 1], radius_of(radius, local.radii)});
        end += 2;
    }
    // The same track twice, or turned round, is one site.
    for (Stadium& s : local.problem.sites)
        if (s.b < s.a) std::swap(s.a, s.b);
    std::vector<std::tuple<int, int, double, const ExactRadius*>> seen;
    for (const Stadium& s : local.problem.sites) seen.emplace_back(s.a, s.b, s.radius.approx, s.radius.exact);
    std::sort(seen.begin(), seen.end());
    std::vector<char> used(seen.size(), 0);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < local.sites.size(); ++i) {
        const Stadium s = local.problem.sites[i];
        const std::tuple key{s.a, s.b, s.radius.approx, s.radius.exact};
        char& again = used[static_cast<std::size_t>(std::lower_bound(seen.begin(), seen.end(), key) - seen.begin())];
        if (again) continue;
        again = 1;
        local.problem.sites[kept] = s, local.sites[kept] = local.sites[i];
        ++kept;
    }
    local.problem.sites.resize(kept), local.sites.resize(kept);

    const double scale = local.scale.get_d(), ox = local.origin[0].get_d(), oy = local.origin[1].get_d();
    const double half = (square.half + 4 * margin) * scale, x = (square.x - ox) * scale, y = (square.y - oy) * scale;
    local.window = {x - half, y - half, x + half, y + half};
}

}  // namespace ribvault::verify
