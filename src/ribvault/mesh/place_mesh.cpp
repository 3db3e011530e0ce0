#include "ribvault/mesh/place_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "ribvault/error.hpp"

namespace ribvault {
namespace {

using Size = std::array<Rational, 3>;  // mm

std::string shown(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
}

std::string shown(const Size& size) {
    return shown(size[0].get_d()) + " x " + shown(size[1].get_d()) + " x " + shown(size[2].get_d()) + " mm";
}

void check(const PlacementOptions& options) {
    const auto refuse = [](const std::string& message) { throw Error(ErrorKind::usage, message); };
    if (options.scale && options.height_mm) refuse("--scale and --height exclude each other; give one of them");
    if (options.scale && *options.scale <= 0) refuse("--scale must be greater than 0");
    if (options.height_mm && *options.height_mm <= 0) refuse("--height must be greater than 0 mm");
    if (options.up != 'x' && options.up != 'y' && options.up != 'z')
        refuse(std::string("--up is '") + options.up + "'; it must be x, y or z");
    for (const double length : {options.bed_x, options.bed_y, options.bed_z})
        if (!(length > 0 && length <= to_mm(lattice_bound)))
            refuse("--bed: " + shown(length) + " mm is no size of a printer; it must lie between 0 and 10000 mm");
    for (const auto& [corner, size] :
         {std::pair(options.bed_corner[0], options.bed_x), std::pair(options.bed_corner[1], options.bed_y)})
        if (!(corner >= -to_mm(lattice_bound) && corner + size <= to_mm(lattice_bound)))
            refuse("--bed and --bed-corner: the bed must lie within 10000 mm of x = y = 0");
}

/// Quarter turns of an angle in 0 .. 3, or -1 when it is no multiple of 90 degrees.
int quarter_turns(const Rational& degrees) {
    const Rational turns = degrees / 90;
    if (turns.get_den() != 1) return -1;
    return static_cast<int>(mpz_fdiv_ui(turns.get_num().get_mpz_t(), 4));
}

/// Matrix of a rotation about a coordinate axis; its entries are 0, 1 and -1 exactly for quarter turns.
Eigen::Matrix3d rotation(int axis, const Rational& degrees) {
    static constexpr double sines[] = {0, 1, 0, -1};
    const int quarters = quarter_turns(degrees);
    const Rational turns = degrees / 360;
    mpz_class whole;
    mpz_fdiv_q(whole.get_mpz_t(), turns.get_num_mpz_t(), turns.get_den_mpz_t());
    const double radians = Rational(turns - whole).get_d() * 2 * std::numbers::pi;
    const double sine = quarters >= 0 ? sines[quarters] : std::sin(radians);
    const double cosine = quarters >= 0 ? sines[(quarters + 1) % 4] : std::cos(radians);
    const int next = (axis + 1) % 3, last = (axis + 2) % 3;
    Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
    matrix(next, next) = cosine, matrix(next, last) = -sine;
    matrix(last, next) = sine, matrix(last, last) = cosine;
    return matrix;
}

Eigen::Matrix3d turn(const PlacementOptions& options) {
    const int up = options.up - 'x';
    Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
    for (int k = 0; k < 3; ++k) matrix(k, (k + up + 1) % 3) = 1;
    for (int axis = 0; axis < 3; ++axis)
        matrix = rotation(axis, options.rotate_degrees[static_cast<std::size_t>(axis)]) * matrix;
    return matrix;
}

/// Axes and signs when every angle is a multiple of 90 degrees; otherwise turns the vertices.
Placement orient(Mesh& mesh, const PlacementOptions& options) {
    Placement placement;
    const Eigen::Matrix3d matrix = turn(options);
    if (std::any_of(options.rotate_degrees.begin(), options.rotate_degrees.end(),
                    [](const Rational& angle) { return quarter_turns(angle) < 0; })) {
        mesh.vertices = (matrix * mesh.vertices).eval();
        placement.rotation.emplace();
        for (std::size_t row = 0; row < 3; ++row)
            for (std::size_t column = 0; column < 3; ++column)
                (*placement.rotation)[row][column] =
                    matrix(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column));
        return placement;
    }
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            if (matrix(row, column) != 0) {
                placement.axis[static_cast<std::size_t>(row)] = column;
                placement.sign[static_cast<std::size_t>(row)] = matrix(row, column) > 0 ? 1 : -1;
            }
    return placement;
}

/// `high`: the size was given by --height.
[[noreturn]] void too_large(const Size& size, const Size& bed, const Rational& scale, bool round_bed, bool high) {
    Rational fit = bed[0] / size[0];
    for (std::size_t k = 1; k < 3; ++k) fit = std::min<Rational>(fit, bed[k] / size[k]);
    // On a disc whatever has this box fits when the box does.
    if (round_bed) fit = std::min<Rational>(fit, bed[0] / Rational(std::hypot(size[0].get_d(), size[1].get_d())));
    const double largest = Rational((high ? size[2] : scale) * fit).get_d();
    const double digits = std::pow(10.0, std::floor(std::log10(largest)) - 2);
    throw Error(ErrorKind::does_not_fit, "the model is " + shown(size) + ", the bed " + shown(bed) + "; use " +
                                             (high ? "--height " : "--scale ") +
                                             shown(std::floor(largest / digits) * digits) +
                                             " or less, turn it with --rotate, or give the printer's size with --bed");
}

void check_size(const Size& size, const Size& bed, const Rational& scale, bool round_bed, bool high) {
    if (size[0] == 0 || size[1] == 0 || size[2] == 0)
        throw Error(ErrorKind::does_not_fit, "the model is " + shown(size) +
                                                 ": flat, so that no layer meets it; export the solid's surface");
    if (size[0] > bed[0] || size[1] > bed[1] || size[2] > bed[2]) too_large(size, bed, scale, round_bed, high);
    if (size[0] < 1 && size[1] < 1 && size[2] < 1)
        throw Error(ErrorKind::does_not_fit, "the model is only " + shown(size) + "; if the file is in metres or "
                                             "inches use --scale 1000 or --scale 25.4, otherwise --height");
}

/// A length in mm, which is a decimal rounded to a double, as the decimal again.
Rational on_lattice(double length) {
    Rational value(round_to_lattice(length * static_cast<double>(units_per_mm)), units_per_mm);
    value.canonicalize();
    return value;
}

}  // namespace

Placement place(Mesh& mesh, const PlacementOptions& options) {
    check(options);
    if (mesh.triangles.cols() == 0 || mesh.vertices.cols() == 0)
        throw Error(ErrorKind::bad_geometry, "the mesh holds no triangles; export the solid's surface as triangles");
    constexpr double largest = 1e100;  // squares of such sizes and of their inverses are numbers
    const double size_read = (mesh.vertices.rowwise().maxCoeff() - mesh.vertices.rowwise().minCoeff()).maxCoeff();
    if (!(mesh.vertices.cwiseAbs().maxCoeff() < largest) || (size_read > 0 && size_read < 1 / largest))
        throw Error(ErrorKind::bad_geometry,
                    "the mesh has coordinates up to " + shown(mesh.vertices.cwiseAbs().maxCoeff()) + " and is " +
                        shown(size_read) + " in size: no solid is; export it again in millimetres");
    Placement placement = orient(mesh, options);

    Size low, extent;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto row = mesh.vertices.row(placement.axis[k]);
        const Rational least(row.minCoeff()), most(row.maxCoeff());
        low[k] = placement.sign[k] > 0 ? least : Rational(-most);
        extent[k] = most - least;
    }
    if (options.scale) placement.scale = *options.scale;
    if (options.height_mm && extent[2] != 0) placement.scale = *options.height_mm / extent[2];

    Size size;
    for (std::size_t k = 0; k < 3; ++k) size[k] = placement.scale * extent[k];
    check_size(size, {on_lattice(options.bed_x), on_lattice(options.bed_y), on_lattice(options.bed_z)}, placement.scale,
               options.round_bed, options.height_mm.has_value());

    const std::array<double, 2> middle{options.bed_corner[0] + options.bed_x / 2,
                                       options.bed_corner[1] + options.bed_y / 2};
    for (std::size_t k = 0; k < 2; ++k)
        placement.offset[k] = on_lattice(middle[k]) - placement.scale * low[k] - size[k] / 2;
    placement.offset[2] = -placement.scale * low[2];
    return placement;
}

}  // namespace ribvault
