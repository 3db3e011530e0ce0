#include "ribvault/settings.hpp"

#include <algorithm>

#include "ribvault/error.hpp"
#include "ribvault/exact/rational.hpp"

namespace ribvault {

void Settings::check() const {
    const auto refuse = [](const std::string& message) { throw Error(ErrorKind::usage, message); };
    const auto within = [&](Unit value, Unit lo, Unit hi, const char* name) {
        if (value < lo || value > hi)
            refuse(std::string(name) + " is " + millimetres(value) + " mm; it must lie between " + millimetres(lo) +
                   " and " + millimetres(hi) + " mm");
    };
    within(layer_height, 1000, 1000000, "--layer-height");
    within(first_layer_height, 1000, 1000000, "--first-layer-height");
    within(nozzle, 2000, 1000000, "--nozzle");
    if (nozzle % 2 != 0) refuse("--nozzle: its half must lie on the 10 nm lattice; give at most four decimals");
    within(support_width, (nozzle + 1) / 2, nozzle, "--support-width");
    if (support_width % 2 != 0)
        refuse("--support-width: its half must lie on the 10 nm lattice; give at most four decimals");
    within(support_radius, 1000, nozzle, "--support-radius");
    if (support_width < nozzle && 20 * support_radius + 10 * support_width < 11 * nozzle)
        refuse("--support-width is " + millimetres(support_width) + " mm: a support holds up what lies within " +
               millimetres(reach_of_support()) +
               " mm of its middle (rho and half its width), too little for both sides of a track of " +
               millimetres(nozzle) + " mm; it must be at least " +
               millimetres(std::min(nozzle, (11 * nozzle - 20 * support_radius + 19) / 20 * 2)) + " mm wide");
    if (support_radius > support_width)
        refuse("--support-radius is " + millimetres(support_radius) + " mm; supports are " +
               millimetres(support_width) + " mm wide, and a track must not leave the one below");
    within(erosion_step, 0, support_radius, "--erosion-step");
    within(straighten_step, 0, support_radius, "--straighten-step");
    within(branch_bonus_length, 0, 100 * nozzle, "--branch-bonus");
    within(sampling_pitch, 400, nozzle, "--pitch");
    within(slack, 10, std::min(nozzle / 20, support_radius / 8), "--slack");
    within(max_gap, 0, 1000000, "--max-gap");
    within(support_gap, 0, 500000, "--support-gap");
    within(pillar_length, nozzle, 10000000, "--pillar-length");
    within(leaning_length, nozzle, 10000000, "--leaning-length");
    if (leaning_ratio < 1 || leaning_ratio > 1000) refuse("--leaning-ratio must lie between 1 and 1000");
    within(brace, 0, 100000000, "--brace");
    if (support_gap_layers < 0 || support_gap_layers > 100) refuse("--support-gap-layers must lie between 0 and 100");
    if (support_gap_layers > 0 && support == Support::internal)
        refuse("--support-gap-layers is about external supports; give it with --support external or both");
    if (bed_only && support == Support::internal)
        refuse("--bed-only is about external supports; give it with --support external or both");
    if (support_gap > 0 && support == Support::internal)
        refuse("--support-gap keeps external supports off the object; give it with --support external or both");
    if (pillars && brace > 0)
        refuse("--pillars leaves every tree one root and --brace gives long ones two; choose one of them");
    if (pillars && length_bound)
        refuse(
            "--length-bound counts on trees that are rooted on the shell, which --pillars frees; leave one of them "
            "out");
    if (tries < 1 || tries > 1000) refuse("--tries must lie between 1 and 1000");
    if (perimeters < 1 || perimeters > 100) refuse("--perimeters must lie between 1 and 100");
    if (top_layers < 0 || top_layers > 1000) refuse("--top-layers must lie between 0 and 1000");
    if (bottom_layers < 0 || bottom_layers > 1000) refuse("--bottom-layers must lie between 0 and 1000");
    within(wall_lines_longer, 0, 100000000, "--wall-lines-longer");
    within(wall_lines_taller, 0, 100000000, "--wall-lines-taller");
    if (wall_lines < 1 || wall_lines > 20) refuse("--wall-lines must lie between 1 and 20");
    if (valence_limit < 1) refuse("--valence-limit must be at least 1");
}

}  // namespace ribvault
