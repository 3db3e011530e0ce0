#include "cli/progress.hpp"

#include <unistd.h>

#include <cstdio>

namespace ribvault::cli {

Progress::Progress(bool quiet, const char* order)
    : quiet_(quiet), terminal_(isatty(STDERR_FILENO) == 1), order_(order) {}

Progress::~Progress() { clear(); }

void Progress::clear() {
    if (!quiet_ && terminal_ && shown_ >= 0) std::fputs("\r\033[K", stderr);
    shown_ = -1;
}

void Progress::operator()(int done, int total) {
    if (quiet_ || total == 0) return;
    const int percent = 100 * done / total, step = terminal_ ? percent : percent / 10 * 10;
    if (step == shown_) return;
    shown_ = step;
    if (terminal_) {
        constexpr int width = 40;
        char bar[width + 1];
        for (int k = 0; k < width; ++k) bar[k] = k < percent * width / 100 ? '#' : '.';
        bar[width] = 0;
        std::fprintf(stderr, "\r[%s] %3d %%  layer %d of %d", bar, percent, done, total);
        std::fflush(stderr);
    } else if (done == total || step > 0) {
        std::fprintf(stderr, "%d %% (%d of %d layers%s)\n", step, done, total, order_);
    }
}

}  // namespace ribvault::cli
