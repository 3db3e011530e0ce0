#include "ribvault/pipeline/layer_spool.hpp"

#include <cerrno>
#include <cstring>
#include <string>

#include "ribvault/error.hpp"

namespace ribvault {
namespace {

[[noreturn]] void fail(int reason) {
    throw Error(ErrorKind::cannot_write, std::string("the temporary file for the layers cannot be written (") + std::strerror(reason) +
                                             "); free space in the temporary folder");
}

}  // namespace

LayerSpool::LayerSpool() : file_(std::tmpfile()) {
    if (!file_) fail(errno);
}

void LayerSpool::add(std::string_view text) {
    if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size()) fail(errno);
    ends_.push_back((ends_.empty() ? 0 : ends_.back()) + text.size());
}

void LayerSpool::replay_backwards(const std::function<void(std::string_view)>& take) {
    if (std::fflush(file_.get()) != 0) fail(errno);
    std::string text;
    for (std::size_t k = ends_.size(); k-- > 0;) {
        const std::uint64_t begin = k == 0 ? 0 : ends_[k - 1];
        text.resize(ends_[k] - begin);
        if (fseeko(file_.get(), static_cast<off_t>(begin), SEEK_SET) != 0 ||
            std::fread(text.data(), 1, text.size(), file_.get()) != text.size())
            fail(errno);
        take(text);
    }
}

}  // namespace ribvault
