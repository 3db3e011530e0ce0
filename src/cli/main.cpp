#include <iostream>
#include <map>

#include "cli/commands.hpp"
#include "cli/interrupt.hpp"
#include "ribvault/error.hpp"

namespace {

/// What the parser refuses, said as every other error is.
std::string refusal(const CLI::App& app, const CLI::Error& error, const std::string& first_word) {
    const std::vector<CLI::App*> chosen = app.get_subcommands();
    std::string what = error.what(), command = "ribvault";
    if (chosen.empty() && (first_word.empty() || first_word.front() != '-'))
        what = (first_word.empty() ? std::string("no command") : "there is no command '" + first_word + "'") +
               "; there are generate, verify and page";
    if (!chosen.empty()) command += " " + chosen.front()->get_name();
    return "ribvault: " + what + "; see " + command + " --help\n";
}

}  // namespace

int main(int argc, char** argv) {
    using namespace ribvault;
    CLI::App app{
        "ribvault: hollow 3D prints with ribbed support vaults, proved layer by layer.\n"
        "Exit codes: 0 proved (verify: supported), 1 not proved (verify: not supported), 2 wrong option, 3 input "
        "unreadable,\n"
        "4 input is not a solid, 5 does not fit the bed, 6 cannot write, 130 interrupted."};
    app.set_version_flag("--version", std::string("ribvault ") + RIBVAULT_VERSION);
    app.require_subcommand(1);
    app.failure_message([&](const CLI::App* parser, const CLI::Error& error) {
        return refusal(*parser, error, argc > 1 ? argv[1] : "");
    });
    std::map<const CLI::App*, std::function<int()>> run;
    const auto generate = cli::add_generate(app), verify = cli::add_verify(app), page = cli::add_page(app);
    run[app.get_subcommand("generate")] = generate;
    run[app.get_subcommand("verify")] = verify;
    run[app.get_subcommand("page")] = page;
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& e) {
        return app.exit(e);
    } catch (const CLI::ParseError& e) {
        app.exit(e);
        return static_cast<int>(ErrorKind::usage);
    } catch (const Error& e) {
        std::cerr << "ribvault: " << e.what() << '\n';
        return static_cast<int>(e.kind());
    }
    cli::catch_interrupts();
    try {
        return run.at(app.get_subcommands().front())();
    } catch (const Error& e) {
        std::cerr << "ribvault: " << e.what() << '\n';
        return static_cast<int>(e.kind());
    } catch (const std::bad_alloc&) {
        std::cerr << "ribvault: out of memory; try a smaller model or --threads 1\n";
        return static_cast<int>(ErrorKind::bad_geometry);
    }
}
