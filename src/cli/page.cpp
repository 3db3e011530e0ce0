#include <cstdio>
#include <memory>

#include "cli/commands.hpp"
#include "cli/interrupt.hpp"
#include "cli/progress.hpp"
#include "cli/verify_rules.hpp"
#include "ribvault/pipeline/make_page.hpp"

namespace ribvault::cli {
namespace {

/// What the user wrote.
struct Written {
    std::string run, beside;
    std::string page;
    VerifyJob rules;
    bool quiet = false;
};

/// The first option of the groups that add_rules makes which was given; empty: none.
std::string rule_given(const CLI::App& command) {
    for (const CLI::App* group : command.get_subcommands([](const CLI::App*) { return true; }))
        for (const CLI::Option* option : group->get_options())
            if (option->count() > 0) return option->get_name();
    return {};
}

int run(const Written& w, const CLI::App& command) {
    PageJob job;
    job.rule_given = rule_given(command);
    job.runs.emplace_back(w.run);
    if (!w.beside.empty()) job.runs.emplace_back(w.beside);
    job.page = w.page;
    job.rules = w.rules;
    Progress progress(w.quiet, "");
    job.rules.progress = [&](int done, int total) { progress(done, total); };
    job.rules.stop = interrupted;
    job.rules.warn = [&](const std::string& text) {
        if (!w.quiet) std::fprintf(stderr, "warning: %s\n", text.c_str());
    };
    make_page(job);
    progress.clear();
    if (!w.quiet) std::printf("page      %s\n", w.page.c_str());
    return 0;
}

}  // namespace

std::function<int()> add_page(CLI::App& app) {
    const auto written = std::make_shared<Written>();
    CLI::App* command = app.add_subcommand("page", "One HTML file to look at a run, or at two side by side");
    command->get_formatter()->column_width(38);
    command
        ->add_option("run", written->run,
                     "a layers file of `generate --layers`, or G-code of any slicer, judged as by `verify`")
        ->required()
        ->type_name("FILE");
    command->add_option("beside", written->beside, "another one, to be shown beside it")->type_name("FILE");
    add_output(command, "-o,--output", written->page, "page to write")->required();
    add_rules(command, written->rules);
    add_whole(command, "--threads", written->rules.threads, "0: all processors", 0, 1024);
    command->add_flag("--quiet", written->quiet, "print errors only");
    return [written, command] { return run(*written, *command); };
}

}  // namespace ribvault::cli
