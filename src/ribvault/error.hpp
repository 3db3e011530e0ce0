// The one exception type of the library: what was wrong, where, what to do.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

namespace ribvault {

/// Every error has a kind; the command line's exit code is its number (documented in README.md).
enum class ErrorKind : int {
    usage = 2,         ///< an option or setting that cannot be
    unreadable = 3,    ///< the input file is missing, empty, truncated or in no known format
    bad_geometry = 4,  ///< the file was read, but is not a solid: NaN, open beyond --max-gap, no volume
    does_not_fit = 5,  ///< too large for the bed, or so small that no layer meets it
    cannot_write = 6,  ///< disk full, no permission
    no_resources = 7,  ///< the system has no memory or no thread left
    interrupted = 130  ///< Ctrl-C or SIGTERM
};

class Error : public std::runtime_error {
public:
    Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
    ErrorKind kind() const { return kind_; }

private:
    ErrorKind kind_;
};

/// Throws Error (interrupted) when `stop()` says so.
inline void end_if(const std::function<bool()>& stop) {
    if (stop()) throw Error(ErrorKind::interrupted, "interrupted; nothing was written");
}

}  // namespace ribvault
