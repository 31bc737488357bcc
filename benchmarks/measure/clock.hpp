#pragma once

#include <array>
#include <chrono>
#include <ctime>

namespace phasetree::bench {

enum class Clock {
    thread,   // processor time of the calling thread: other load does not count
    process,  // processor time of all threads
    wall,
};
inline constexpr std::array clocks{Clock::thread, Clock::process, Clock::wall};

inline double seconds(Clock clock) {
    if (clock == Clock::wall)
        return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
    timespec t{};
    clock_gettime(clock == Clock::thread ? CLOCK_THREAD_CPUTIME_ID : CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// What make() makes, and the processor time that it took on this thread.
template <class Make>
auto timed(Make&& make, double& taken) {
    const double start = seconds(Clock::thread);
    auto made = make();
    taken = seconds(Clock::thread) - start;
    return made;
}

}  // namespace phasetree::bench
