// How many threads a job may use.
#pragma once

#include <oneapi/tbb/global_control.h>

namespace ribvault {

/// `threads`, or all that TBB allows when it is 0.
inline std::size_t thread_limit(int threads) {
    if (threads > 0) return static_cast<std::size_t>(threads);
    return oneapi::tbb::global_control::active_value(oneapi::tbb::global_control::max_allowed_parallelism);
}

}  // namespace ribvault
