#include "ribvault/pipeline/layer_spool.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "ribvault/error.hpp"

namespace ribvault {
namespace {

[[noreturn]] void fail(int reason) {
    throw Error(ErrorKind::cannot_write,
                std::string("the temporary file for the layers cannot be written (") + std::strerror(reason) + "); " +
                    (reason == EMFILE || reason == ENFILE ? "raise the limit on open files (ulimit -n)"
                                                          : "free space in the temporary folder"));
}

[[noreturn]] void fail_to_read(int reason) {
    throw Error(ErrorKind::cannot_write, std::string("the temporary file for the layers cannot be read back (") +
                                             std::strerror(reason) + "); run it again");
}

}  // namespace

LayerSpool::LayerSpool() : file_(std::tmpfile()) {
    if (!file_) fail(errno);
}

void LayerSpool::add(std::string_view text) {
    if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size()) fail(errno);
    ends_.push_back((ends_.empty() ? 0 : ends_.back()) + text.size());
}

void LayerSpool::finish() {
    if (std::fflush(file_.get()) != 0) fail(errno);
}

std::string LayerSpool::at(std::size_t k) const {
    const std::uint64_t begin = k == 0 ? 0 : ends_[k - 1];
    std::string text(ends_[k] - begin, '\0');
    for (std::size_t read = 0; read < text.size();) {
        const ssize_t got =
            pread(fileno(file_.get()), text.data() + read, text.size() - read, static_cast<off_t>(begin + read));
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) fail_to_read(got < 0 ? errno : EIO);
        read += static_cast<std::size_t>(got);
    }
    return text;
}

void LayerSpool::replay_backwards(const std::function<void(std::string_view)>& take) {
    finish();
    for (std::size_t k = ends_.size(); k-- > 0;) take(at(k));
}

}  // namespace ribvault
