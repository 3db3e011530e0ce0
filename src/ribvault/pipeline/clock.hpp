// How long the stages of a run take.
#pragma once

#include <atomic>
#include <chrono>
#include <map>
#include <string>

namespace ribvault {

/// Busy time of each stage in seconds, summed over threads.
using StageTimes = std::map<std::string, double>;

using Time = std::chrono::steady_clock;
inline double seconds_since(Time::time_point start) {
    return std::chrono::duration<double>(Time::now() - start).count();
}

/// Seconds spent in one stage, by all threads.
class Clock {
public:
    template <class Work>
    auto measure(Work&& work) {
        const auto start = Time::now();
        struct Stop {
            Time::time_point start;
            std::atomic<std::int64_t>& total;
            ~Stop() { total += std::chrono::nanoseconds(Time::now() - start).count(); }
        } stop{start, nanoseconds_};
        return work();
    }
    double seconds() const { return 1e-9 * static_cast<double>(nanoseconds_); }

private:
    std::atomic<std::int64_t> nanoseconds_{0};
};

}  // namespace ribvault
