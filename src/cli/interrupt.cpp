#include "cli/interrupt.hpp"

#include <atomic>
#include <csignal>

#include "ribvault/output_file.hpp"

namespace ribvault::cli {
namespace {

std::atomic<bool> noted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may take no lock");

void note(int signal) {
    if (!noted.exchange(true)) return;
    discard_pending_files();  // a second one ends the program at once
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

}  // namespace

void catch_interrupts() {
    std::signal(SIGINT, note);
    std::signal(SIGTERM, note);
    if (std::signal(SIGHUP, note) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);  // nohup
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);  // the file may grow no larger: writing says so
}

bool interrupted() noexcept { return noted; }

}  // namespace ribvault::cli
