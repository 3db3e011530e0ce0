#include "ribvault/pipeline/check_bed.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "ribvault/error.hpp"
#include "ribvault/exact/rational.hpp"
#include "ribvault/print/gcode_text.hpp"
#include "ribvault/print/skirt.hpp"

namespace ribvault {
namespace {

std::string mm(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2f", value);
    return text;
}

[[noreturn]] void refuse(double needed, double bed, const char* of, double reach) {
    throw Error(ErrorKind::does_not_fit,
                "the print needs " + mm(needed) + " mm" + of + " and the bed has " + mm(bed) + " mm" +
                    (reach > 0 ? " (skirt and brim, and external supports, take " + mm(2 * reach) +
                                     " mm of it); make them smaller, or scale the model down with --scale"
                               : std::string("; scale the model down with --scale")));
}

}  // namespace

Unit reach_of_supports(const Settings& settings) {
    return settings.outside() ? settings.support_gap + settings.pillar_length / 4 + 2 * settings.support_width : 0;
}

Box support_frame(const Mesh& mesh, const Placement& placement, const Settings& settings) {
    Box box;
    const double scale = placement.scale.get_d() * units_per_mm;
    for (Eigen::Index v = 0; v < mesh.vertices.cols(); ++v) {
        const auto along = [&](std::size_t k) {
            return round_to_lattice(scale * placement.sign[k] * mesh.vertices(placement.axis[k], v) +
                                    placement.offset[k].get_d() * units_per_mm);
        };
        box.add({along(0), along(1)});
    }
    box.grow(reach_of_supports(settings) + units_per_mm / 10);
    return box;
}

void check_bed(const Mesh& mesh, const Placement& placement, const Settings& settings, const TrackSettings& tracks,
               const PrinterSettings& printer) {
    const double reach = to_mm(reach_of_skirt_and_brim(settings, tracks) + reach_of_supports(settings));
    const std::array<double, 2> corner = printer.corner_of_bed();
    const double middle_x = corner[0] + printer.bed_x / 2, middle_y = corner[1] + printer.bed_y / 2;
    const double scale = placement.scale.get_d();
    double x = 0, y = 0, radius = 0;
    for (Eigen::Index v = 0; v < mesh.vertices.cols(); ++v) {
        const auto along = [&](std::size_t k) {
            return scale * placement.sign[k] * mesh.vertices(placement.axis[k], v) + placement.offset[k].get_d();
        };
        const double dx = std::fabs(along(0) - middle_x), dy = std::fabs(along(1) - middle_y);
        x = std::max(x, dx), y = std::max(y, dy), radius = std::max(radius, std::hypot(dx, dy));
    }
    constexpr double rounding = 1e-6;  // mm: coordinates here are rounded; nothing is proved by them
    if (printer.round_bed) {
        if (2 * (radius + reach) > printer.bed_x + rounding)
            refuse(2 * (radius + reach), printer.bed_x, " in diameter", reach);
        return;
    }
    if (2 * (x + reach) > printer.bed_x + rounding) refuse(2 * (x + reach), printer.bed_x, " in x", reach);
    if (2 * (y + reach) > printer.bed_y + rounding) refuse(2 * (y + reach), printer.bed_y, " in y", reach);
}

void check_height(int layers, const Settings& settings, const PrinterSettings& printer) {
    if (const Unit top = settings.top_of(layers - 1); top > round_to_lattice(printer.bed_z * units_per_mm))
        throw Error(ErrorKind::does_not_fit, "the last layer ends at " + millimetres(top) + " mm and the printer is " +
                                                 decimal_text(printer.bed_z) +
                                                 " mm high; make the layers thinner, or scale the model down with "
                                                 "--scale or --height");
}

}  // namespace ribvault
