#include "ribvault/verify/local_problem.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <tuple>

namespace ribvault::verify {

namespace {

constexpr double most_integer = 0x1p26;  // squares of sums of two such numbers have no rounding

/// All that has a length in a problem: coordinates of the ends of its tracks, and radii.
struct Lengths {
    std::vector<const PrintedPoint*> ends;  ///< of the pieces, then of the sites
    std::vector<Millimetres> radii;         ///< of the pieces, then of the sites
    double extent = 0;  ///< at least all radii, and all ends' distances from the window's middle in x and y
    template <class Visit>
    void visit(const Visit& visit) const {
        for (const PrintedPoint* end : ends) visit((*end)[0]), visit((*end)[1]);
        for (const Millimetres& r : radii) visit(r);
    }
};

/// Doubled until the problem is some 2^20 units wide.
double grown(double scale, double extent) {
    while (scale * extent < 0x1p19) scale *= 2;
    return scale;
}

/// How many picometres a unit is that divides all lengths and makes them integers that doubles multiply exactly; 0:
/// there is none. It is the largest that divides 1 mm too.
std::int64_t common_unit(const Lengths& lengths, double extent) {
    std::int64_t unit = Millimetres::picometres_per_mm;
    bool whole = true;
    lengths.visit([&](const Millimetres& l) {
        whole = whole && l.whole();
        if (whole && l.picometres() % unit != 0) unit = std::gcd(unit, l.picometres());
    });
    return whole && static_cast<double>(Millimetres::picometres_per_mm / unit) * extent <= most_integer ? unit : 0;
}

// The least common denominator of all lengths when it makes them integers that doubles multiply exactly, else a power
// of two.
Rational scale_for(const Lengths& lengths, double extent) {
    mpz_class common = 1;
    lengths.visit([&](const Millimetres& l) {
        if (common > most_integer) return;
        const Rational value(l);
        mpz_lcm(common.get_mpz_t(), common.get_mpz_t(), value.get_den_mpz_t());
    });
    if (common.get_d() * extent <= most_integer) return Rational(grown(common.get_d(), extent));
    int exponent = 0;
    std::frexp(0x1p20 / extent, &exponent);
    return power_of_two(exponent);
}

/// Numbers of equal points, and each point once, in their order.
template <class Point, class Less>
std::vector<Point> distinct_points(const std::vector<Point>& all, const Less& less, std::vector<int>& number) {
    std::vector<int> order(all.size());
    std::iota(order.begin(), order.end(), 0);
    const auto at = [&](int i) -> const Point& { return all[static_cast<std::size_t>(i)]; };
    std::sort(order.begin(), order.end(), [&](int i, int j) { return less(at(i), at(j)); });
    std::vector<Point> points;
    number.resize(all.size());
    for (const int i : order) {
        if (points.empty() || less(points.back(), at(i))) points.push_back(at(i));
        number[static_cast<std::size_t>(i)] = static_cast<int>(points.size()) - 1;
    }
    return points;
}

Radius radius_of(const Rational& value, std::deque<ExactRadius>& radii) {
    const Interval e = enclosure(value);
    if (e.inf() == e.sup()) return Radius(e.inf());
    for (const ExactRadius& r : radii)
        if (r.value == value) return Radius(r);
    radii.push_back({value, e});
    return Radius(radii.back());
}

/// Vertices and radii where integers will do: lattice points. Says no where they will not.
bool place_on_lattice(const Lengths& lengths, LocalProblem& local, std::vector<int>& vertex_of,
                      std::vector<Radius>& radii) {
    const double extent = 2 * lengths.extent;
    const std::int64_t unit = common_unit(lengths, extent);
    if (unit == 0) return false;
    const auto common = static_cast<double>(Millimetres::picometres_per_mm / unit);
    const double scale = grown(common, extent);
    const auto factor = static_cast<Unit>(scale / common);
    const PrintedPoint& origin = *lengths.ends.front();
    std::vector<Point> ends;
    ends.reserve(lengths.ends.size());
    for (const PrintedPoint* end : lengths.ends)
        ends.push_back({((*end)[0].picometres() - origin[0].picometres()) / unit * factor,
                        ((*end)[1].picometres() - origin[1].picometres()) / unit * factor});
    for (const Point p : distinct_points(ends, std::less<Point>(), vertex_of))
        local.vertices.push_back(lattice_vertex(p));
    for (const Millimetres& r : lengths.radii) radii.emplace_back(static_cast<double>(r.picometres() / unit * factor));
    local.origin = rational(origin);
    local.scale = scale;
    return true;
}

void place_exactly(const Lengths& lengths, LocalProblem& local, std::vector<int>& vertex_of,
                   std::vector<Radius>& radii) {
    local.origin = rational(*lengths.ends.front());
    local.scale = scale_for(lengths, 2 * lengths.extent);
    std::vector<RationalPoint> ends;
    for (const PrintedPoint* end : lengths.ends) ends.push_back(rational(*end));
    for (const RationalPoint& p : distinct_points(ends, std::less<RationalPoint>(), vertex_of))
        local.points.push_back(
            {Rational((p[0] - local.origin[0]) * local.scale), Rational((p[1] - local.origin[1]) * local.scale)});
    for (const Vec<Rational>& p : local.points) local.vertices.push_back(rational_vertex(p));
    for (const Millimetres& r : lengths.radii)
        radii.push_back(radius_of(Rational(Rational(r) * local.scale), local.radii));
}

}  // namespace

void build_local_problem(std::span<const PrintedTrack> upper, std::span<const int> pieces, const Below& below,
                         const Square& square, double margin, LocalProblem& local) {
    local.pieces.assign(pieces.begin(), pieces.end());
    local.sites.clear();
    for (const int k : below.which) {
        const auto i = static_cast<std::size_t>(k);
        const double reach = below.radii[i].get_d() + root_cell_reach * square.half + window_slack(margin);
        if (centre_distance(below.prepared[i], square.x, square.y) <= reach) local.sites.push_back(k);
    }
    Lengths lengths;
    lengths.extent = square.half;
    const auto add = [&](const PrintedTrack& t, const Millimetres& radius) {
        for (const PrintedPoint* end : {&t.a, &t.b}) {
            lengths.ends.push_back(end);
            lengths.extent = std::max(
                {lengths.extent, std::abs((*end)[0].get_d() - square.x), std::abs((*end)[1].get_d() - square.y)});
        }
        lengths.radii.push_back(radius);
        lengths.extent = std::max(lengths.extent, radius.get_d());
    };
    for (const int p : pieces) {
        const PrintedTrack& t = upper[static_cast<std::size_t>(p)];
        add(t, half_plus(t.width, Millimetres()));
    }
    for (const int k : local.sites)
        add(below.tracks[static_cast<std::size_t>(k)], below.radii[static_cast<std::size_t>(k)]);

    local.points.clear(), local.vertices.clear(), local.radii.clear();
    std::vector<int> vertex_of;
    std::vector<Radius> radii;
    if (!place_on_lattice(lengths, local, vertex_of, radii)) place_exactly(lengths, local, vertex_of, radii);
    local.problem = {};
    local.problem.vertices = local.vertices;
    for (std::size_t i = 0; i < radii.size(); ++i)
        (i < pieces.size() ? local.problem.pieces : local.problem.sites)
            .push_back({vertex_of[2 * i], vertex_of[2 * i + 1], radii[i]});
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
