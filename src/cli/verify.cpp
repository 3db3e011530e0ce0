#include <cstdio>
#include <memory>

#include "cli/commands.hpp"
#include "cli/interrupt.hpp"
#include "cli/progress.hpp"
#include "cli/verify_rules.hpp"
#include "ribvault/pipeline/verify_print.hpp"

namespace ribvault::cli {
namespace {

/// What the user wrote.
struct Written {
    VerifyJob job;
    std::string gcode, report, svg, html;
    bool quiet = false;
};

int run(Written& w) {
    const auto path = [](const std::string& text) {
        return text.empty() ? std::nullopt : std::optional<std::filesystem::path>(text);
    };
    w.job.gcode = w.gcode;
    w.job.report = path(w.report), w.job.svg = path(w.svg), w.job.html = path(w.html);
    w.job.distances =
        w.job.report || w.job.html;  // the summary has none; its places are then other points of the same regions
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
    CLI::App* command =
        app.add_subcommand("verify", "Judge any slicer's G-code: what has no material within rho in the layer below");
    command->get_formatter()->column_width(38);
    command
        ->add_option("gcode", w.gcode,
                     "PrusaSlicer, OrcaSlicer, Bambu Studio, CuraEngine, Slic3r, Simplify3D, ribvault or plain G-code")
        ->required();
    add_rules(command, w.job);
    const auto output = command->add_option_group("Output");
    const auto report = add_output(output, "--report", w.report, "JSON report to write");
    output
        ->add_flag("--boundaries", w.job.boundaries,
                   "in the report, the exact boundary of every unsupported region, as lines and arcs")
        ->needs(report);
    add_output(output, "--svg", w.svg, "folder for pictures of the worst layers", "DIR");
    add_whole(output, "--pictures", w.job.pictures, "how many of them at most (default 12)", 0, 100000);
    add_output(output, "--html", w.html, "page to look at every layer, in one file");
    add_whole(output, "--threads", w.job.threads, "0: all processors", 0, 1024);
    output->add_flag("--quiet", w.quiet, "print errors only");
    return [written] { return run(*written); };
}

}  // namespace ribvault::cli
