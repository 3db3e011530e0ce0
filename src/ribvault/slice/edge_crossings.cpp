#include "ribvault/slice/edge_crossings.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace ribvault {
namespace {

/// value = odd * 2^exponent; 0 = 0 * 2^0.
struct Binary {
    std::int64_t odd = 0;
    int exponent = 0;
};
Binary binary(double value) {
    if (value == 0) return {};
    int exponent = 0;
    const auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(value, &exponent), 53));
    const int zeros = std::countr_zero(static_cast<std::uint64_t>(mantissa));
    return {mantissa >> zeros, exponent - 53 + zeros};
}

/// numerator / denominator, denominator > 0, in lowest terms.
mpq_class fraction(mpz_class numerator, mpz_class denominator) {
    mpq_class result(std::move(numerator), std::move(denominator));
    result.canonicalize();
    return result;
}

}  // namespace

long mesh_grid_bits(const Mesh& mesh) {
    int least = 0;
    for (Eigen::Index v = 0; v < mesh.vertices.cols(); ++v)
        for (Eigen::Index k = 0; k < 3; ++k) least = std::min(least, binary(mesh.vertices(k, v)).exponent);
    return -least;
}

EdgeCrossings::EdgeCrossings(const Mesh& mesh, const Placement& placement, const Rational& plane, long grid_bits)
    : mesh_(mesh), placement_(placement), grid_bits_(grid_bits) {
    const mpz_class grid = mpz_class(1) << static_cast<mp_bitcnt_t>(grid_bits);
    const Rational height = (plane - placement.offset[2]) / placement.scale * Rational(grid);
    plane_numerator_ = height.get_num(), plane_denominator_ = height.get_den();
    const Rational step = placement.scale / Rational(grid);
    for (std::size_t k = 0; k < 2; ++k) {
        const Rational& offset = placement.offset[k];
        axes_[k] = {step.get_num() * offset.get_den(), offset.get_num() * step.get_den(),
                    step.get_den() * offset.get_den()};
    }
}

double EdgeCrossings::coordinate(std::size_t k, std::int32_t vertex) const {
    return placement_.sign[k] * mesh_.vertices(placement_.axis[k], vertex);
}

mpz_class EdgeCrossings::on_grid(double value) const {
    const Binary b = binary(value);
    mpz_class result(static_cast<long>(b.odd));
    mpz_mul_2exp(result.get_mpz_t(), result.get_mpz_t(), static_cast<mp_bitcnt_t>(b.exponent + grid_bits_));
    return result;
}

ExactKernel::Point_2 EdgeCrossings::at(const std::array<std::int32_t, 2>& ends) const {
    // With heights z0, z1 and the plane at n / d, all in units of the grid, the crossing is at
    // a + (n / d - z0) / (z1 - z0) * (b - a) = (a * run + rise * (b - a)) / run, run = d (z1 - z0), rise = n - d z0.
    const mpz_class z0 = on_grid(coordinate(2, ends[0]));
    mpz_class run = plane_denominator_ * (on_grid(coordinate(2, ends[1])) - z0),
              rise = plane_numerator_ - plane_denominator_ * z0;
    if (run < 0) run = -run, rise = -rise;
    std::array<mpq_class, 2> bed;
    for (std::size_t k = 0; k < 2; ++k) {
        const Axis& axis = axes_[k];
        const double from = coordinate(k, ends[0]), to = coordinate(k, ends[1]);
        const mpz_class a = on_grid(from);
        if (from == to)
            bed[k] = fraction(axis.factor * a + axis.shift, axis.denominator);
        else
            bed[k] =
                fraction(axis.factor * (a * run + rise * (on_grid(to) - a)) + axis.shift * run, axis.denominator * run);
    }
    using Exact = ExactKernel::Exact_kernel::Point_2;
    using Lazy = CGAL::Lazy<ExactKernel::Approximate_kernel::Point_2, Exact, ExactKernel::E2A>;
    return ExactKernel::Point_2(Lazy(Exact(std::move(bed[0]), std::move(bed[1]))));
}

}  // namespace ribvault
