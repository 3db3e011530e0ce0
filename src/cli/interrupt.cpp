#include "cli/interrupt.hpp"

#include <csignal>

namespace ribvault::cli {
namespace {

volatile std::sig_atomic_t flag = 0;

void note(int signal) {
    flag = 1;
    std::signal(signal, SIG_DFL);  // a second Ctrl-C ends the program at once
}

}  // namespace

void catch_interrupts() {
    std::signal(SIGINT, note);
    std::signal(SIGTERM, note);
    std::signal(SIGPIPE, SIG_IGN);
}

bool interrupted() noexcept { return flag != 0; }

}  // namespace ribvault::cli
