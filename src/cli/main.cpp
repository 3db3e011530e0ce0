#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <map>

#include "cli/commands.hpp"
#include "cli/interrupt.hpp"
#include "ribvault/error.hpp"

namespace {

/// Every option of a command, those in groups too.
std::vector<const CLI::Option*> options_of(const CLI::App& command) {
    std::vector<const CLI::Option*> options = command.get_options();
    for (const CLI::App* group : command.get_subcommands([](const CLI::App*) { return true; })) {
        const std::vector<const CLI::Option*> more = options_of(*group);
        options.insert(options.end(), more.begin(), more.end());
    }
    return options;
}

/// What is not expected, and the option that may have been meant: one that begins like it.
std::string not_expected(const CLI::App& command, const std::string& word) {
    if (word.empty() || word.front() != '-') return std::string("'").append(word).append("' is not expected");
    std::string what = "there is no option " + word;
    for (const CLI::Option* option : options_of(command))
        for (const std::string& name : option->get_lnames()) {
            const std::string full = "--" + name;
            if (full.starts_with(word) || word.starts_with(full)) return what + "; do you mean " + full + "?";
        }
    return what;
}

/// What the parser refuses, said as every other error is.
std::string refusal(const CLI::App& app, const CLI::Error& error, const std::string& first_word) {
    const std::vector<CLI::App*> chosen = app.get_subcommands();
    std::string what = error.what(), command = "ribvault";
    if (chosen.empty()) {
        if (first_word.empty() || first_word.front() != '-')
            what = (first_word.empty() ? std::string("no command") : "there is no command '" + first_word + "'") +
                   "; there are generate, verify and page";
    } else {
        command += " " + chosen.front()->get_name();
        const std::vector<std::string> left = chosen.front()->remaining(true);
        const auto option = std::find_if(left.begin(), left.end(), [](const std::string& w) { return w[0] == '-'; });
        if (dynamic_cast<const CLI::ExtrasError*>(&error) && !left.empty())
            what = not_expected(*chosen.front(), option == left.end() ? left.front() : *option);
    }
    return "ribvault: " + what + "; see " + command + " --help\n";
}

/// Whoever starts the program without standard streams gets none of its files mixed up with what it says there.
void open_missing_streams() {
    while (true) {
        const int descriptor = ::open("/dev/null", O_RDWR);  // the lowest that is free
        if (descriptor < 0) return;
        if (descriptor > STDERR_FILENO) {
            ::close(descriptor);
            return;
        }
    }
}

int failed(const std::string& what, ribvault::ErrorKind kind) {
    std::cerr << "ribvault: " << what << '\n';
    return static_cast<int>(kind);
}

/// What was said must have been heard, but by a reader that has gone on purpose (`| head`). Why it was not is known of
/// the last block only.
int heard(int code) {
    errno = 0;
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
    const std::string why = errno != 0 ? std::string(": ") + std::strerror(errno) : std::string();
    pollfd reader{STDOUT_FILENO, POLLOUT, 0};
    if (::poll(&reader, 1, 0) == 1 && (reader.revents & POLLERR) != 0) return code;
    return failed("standard output cannot be written" + why + "; make room, or write it elsewhere",
                  ribvault::ErrorKind::cannot_write);
}

}  // namespace

int main(int argc, char** argv) {
    using namespace ribvault;
    open_missing_streams();
    CLI::App app{
        "ribvault: hollow 3D prints with ribbed support vaults, proved layer by layer.\n"
        "Exit codes: 0 proved (verify: supported), 1 not proved (verify: not supported), 2 wrong option, 3 input "
        "unreadable,\n"
        "4 input is not a solid, 5 does not fit the bed, 6 cannot write, 7 no memory or thread left, 130 interrupted."};
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
        cli::catch_interrupts();
        return heard(run.at(app.get_subcommands().front())());
    } catch (const CLI::Success& e) {
        return app.exit(e);
    } catch (const CLI::ParseError& e) {
        app.exit(e);
        return static_cast<int>(ErrorKind::usage);
    } catch (const Error& e) {
        return failed(e.what(), e.kind());
    } catch (const std::bad_alloc&) {
        return failed("out of memory; try a smaller model or --threads 1", ErrorKind::no_resources);
    } catch (const std::filesystem::filesystem_error& e) {
        return failed(e.what(), ErrorKind::cannot_write);
    } catch (const std::exception& e) {
        return failed(std::string("the run cannot go on: ") + e.what() + "; try --threads 1, or report it",
                      ErrorKind::no_resources);
    }
}
