#include <cstdio>
#include <memory>
#include <optional>

#include "cli/commands.hpp"
#include "cli/interrupt.hpp"
#include "cli/progress.hpp"
#include "ribvault/pipeline/verify_print.hpp"

namespace ribvault::cli {
namespace {

/// What the user wrote.
struct Written {
    VerifyJob job;
    std::string gcode, report, svg, html;
    bool quiet = false;
};

template <class Target>
CLI::Option* add_number(CLI::App* command, const std::string& name, Target& target, const std::string& help, const std::string& unit = "MM") {
    return command->add_option_function<std::string>(
        name, [&target, name](const std::string& text) { target = parse_rational(text, name); }, help)->type_name(unit);
}

/// Names between commas; blanks around them do not count.
void add_list(CLI::App* command, const std::string& name, std::vector<std::string>& target, const std::string& help) {
    command->add_option_function<std::string>(name, [&target](const std::string& text) {
        for (const std::string& part : CLI::detail::split(text, ','))
            if (std::string entry = CLI::detail::trim_copy(part); !entry.empty()) target.push_back(std::move(entry));
    }, help)->type_name("LIST");
}

int run(Written& w) {
    const auto path = [](const std::string& text) { return text.empty() ? std::nullopt : std::optional<std::filesystem::path>(text); };
    w.job.gcode = w.gcode;
    w.job.report = path(w.report), w.job.svg = path(w.svg), w.job.html = path(w.html);
    Progress progress(w.quiet, "");
    w.job.progress = [&](int done, int total) { progress(done, total); };
    w.job.stop = interrupted;
    w.job.warn = [&](const std::string& text) {
        if (!w.quiet) std::fprintf(stderr, "warning: %s\n", text.c_str());
    };
    const PrintReport report = verify_print(w.job);
    progress.clear();
    if (!w.quiet) std::fputs(summary(report, w.job).c_str(), stdout);
    return report.supported ? 0 : 1;
}

}  // namespace

std::function<int()> add_verify(CLI::App& app) {
    const auto written = std::make_shared<Written>();
    Written& w = *written;
    CLI::App* command = app.add_subcommand("verify", "Judge any slicer's G-code: what has no material within rho in the layer below");
    command->get_formatter()->column_width(38);
    command->add_option("gcode", w.gcode, "PrusaSlicer, OrcaSlicer, Bambu Studio, CuraEngine, Slic3r, Simplify3D, ribvault or plain G-code")->required();
    const auto rule = command->add_option_group("Rule");
    const auto radius = add_number(rule, "--support-radius", w.job.support_radius, "rho of equations (1) and (2) (default: half the nozzle)");
    add_number(rule, "--overlap", w.job.overlap, "share of a line's width that must rest on material; rho = (1 - R) nozzle (default 0.5)", "R")->excludes(radius);
    add_number(rule, "--nozzle", w.job.nozzle, "its diameter (default: as the file says, else 0.4)");
    add_list(rule, "--features", w.job.features, "judge only these feature types: names, or kinds such as infill, perimeter, support");
    add_list(rule, "--ignore-features", w.job.ignored_features, "do not judge these; they are material below all the same");
    add_number(rule, "--allow-bridges", w.job.longest_bridge, "straight spans up to this length between two ends that are held up count as supported");
    add_number(rule, "--min-area", w.job.min_area, "unsupported regions up to this do not count (default 0)", "MM2");
    rule->add_flag("--inside", w.job.inside, "judge only what lies inside the outline (closed outer perimeters) of the layer below, not external overhangs");
    const auto reading = command->add_option_group("Reading");
    add_number(reading, "--filament-diameter", w.job.filament_diameter, "for widths that the file does not give (default: as the file says, else 1.75)");
    add_number(reading, "--layer-height", w.job.layer_height, "where the file does not tell it");
    const auto output = command->add_option_group("Output");
    output->add_option("--report", w.report, "JSON report to write")->type_name("FILE");
    output->add_option("--svg", w.svg, "folder for pictures of the worst layers")->type_name("DIR");
    output->add_option("--pictures", w.job.pictures, "how many of them at most (default 12)")->check(CLI::Range(0, 100000));
    output->add_option("--html", w.html, "page to look at every layer, in one file")->type_name("FILE");
    output->add_option("--threads", w.job.threads, "0: all processors")->check(CLI::Range(0, 1024));
    output->add_flag("--quiet", w.quiet, "print errors only");
    return [written] { return run(*written); };
}

}  // namespace ribvault::cli
