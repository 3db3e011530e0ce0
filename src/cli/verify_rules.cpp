#include "cli/verify_rules.hpp"

#include "cli/commands.hpp"
#include "ribvault/error.hpp"

namespace ribvault::cli {
namespace {

template <class Target>
CLI::Option* add_number(CLI::App* command, const std::string& name, Target& target, const std::string& help,
                        const std::string& unit = "MM") {
    return command->add_option_function<std::string>(
        name, [&target, name](const std::string& text) { target = parse_rational(text, name); }, help)->type_name(unit);
}

/// Names between commas; blanks around them do not count.
void add_list(CLI::App* command, const std::string& name, std::vector<std::string>& target, const std::string& help) {
    command
        ->add_option_function<std::string>(
            name,
            [&target, name](const std::string& text) {
                for (const std::string& part : CLI::detail::split(text, ','))
                    if (std::string entry = CLI::detail::trim_copy(part); !entry.empty())
                        target.push_back(std::move(entry));
                if (target.empty()) throw Error(ErrorKind::usage, name + ": '" + text + "' names nothing");
            },
            help)
        ->type_name("LIST");
}

}  // namespace

void add_rules(CLI::App* command, VerifyJob& job) {
    const auto rule = command->add_option_group("Rule");
    const auto radius = add_number(rule, "--support-radius", job.support_radius,
                                   "rho of equations (1) and (2) (default: half the nozzle)");
    add_number(rule, "--overlap", job.overlap,
               "share of a line's width that must rest on material; rho = (1 - R) nozzle (default 0.5)", "R")
        ->excludes(radius);
    add_number(rule, "--nozzle", job.nozzle, "its diameter (default: as the file says, else 0.4)");
    add_list(rule, "--features", job.features,
             "judge only these feature types: names, or kinds such as infill, perimeter, support");
    add_list(rule, "--ignore-features", job.ignored_features,
             "do not judge these; they are material below all the same");
    add_number(rule, "--allow-bridges", job.longest_bridge,
               "straight spans up to this length between two ends that are held up count as supported");
    add_number(rule, "--min-area", job.min_area, "unsupported regions up to this do not count (default 0)", "MM2");
    rule->add_flag(
        "--inside", job.inside,
        "judge only what lies inside the outline (closed outer perimeters) of the layer below, not external overhangs");
    add_number(rule, "--support-gap", job.support_gap,
               "what lies this far from the object's tracks, and half a nozzle, counts as held up by them");
    add_whole(rule, "--support-gap-layers", job.support_gap_layers,
              "the object may lie on material so many layers farther down (default 0)");
    rule->add_flag("--bed-only", job.bed_only, "supports must lie on supports, not on the object");
    const auto reading = command->add_option_group("Reading");
    add_number(reading, "--filament-diameter", job.filament_diameter,
               "for widths that the file does not give (default: as the file says, else 1.75)");
    add_number(reading, "--layer-height", job.layer_height, "where the file does not tell it");
    add_whole(reading, "--infill-layers", job.infill_layers,
              "how many layers thick infill is, where the file does not tell its height (default 1)");
}

}  // namespace ribvault::cli
