#include "render/threads.hpp"

#include <OpenImageIO/imageio.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <latch>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

namespace phasetree::tracer {

namespace {

// The number of threads of this process, or 0 if the system does not report it. Reads a file instead of listing a
// folder because libstdc++ ends the process if memory runs out inside a directory_iterator.
int running() {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;)
        if (int count = 0; word == "Threads:" && status >> count) return count;
    return 0;
}

// The number of threads, up to `wanted`, that can be started in addition to this one.
int startable(int wanted) {
    const int before = running();
    std::vector<std::thread> threads;
    threads.reserve(static_cast<std::size_t>(std::max(wanted, 0)));
    std::latch all_are_counted(1);
    try {
        while (static_cast<int>(threads.size()) < wanted) threads.emplace_back([&] { all_are_counted.wait(); });
    } catch (const std::system_error&) {
        // The limit is reached.
    } catch (const std::bad_alloc&) {
        // The threads that wait must be released and joined in this case, too.
    }
    all_are_counted.count_down();
    for (std::thread& thread : threads) thread.join();
    // A joined thread still counts for a moment, until the system has removed it.
    for (int i = 0; i < 1000 && running() > before; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return static_cast<int>(threads.size());
}

}  // namespace

AvailableThreads::AvailableThreads(int wanted)
    : wanted_(wanted > 0 ? wanted : tbb::this_task_arena::max_concurrency()), count_(wanted_) {
    // OpenImageIO and OpenEXR start one thread per core each, and TBB may start one beyond its limit.
    const int others = 2 * static_cast<int>(std::thread::hardware_concurrency()) + 1;
    const int there = startable(wanted_ - 1 + others);
    if (there == wanted_ - 1 + others) return;
    if (there == 0)
        throw std::runtime_error(
            "cannot start a second thread: the limit on processes has been reached; raise it with ulimit -u");
    count_ = std::min(wanted_, there);
    limit_.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(count_));
    // OpenImageIO and OpenEXR can work on the calling thread only. OpenImageIO reads the environment variable when it
    // first needs its threads; exr_threads = -1 stops OpenEXR from starting any.
    ::setenv("OPENIMAGEIO_THREADS", "1", 1);
    OIIO::attribute("exr_threads", -1);
}

}  // namespace phasetree::tracer
