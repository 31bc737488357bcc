#pragma once

// oneTBB's parallel_for for builds with the thread sanitizer, and for nothing else.
//
// The sanitizer must see every synchronisation. The system's libtbb is not built for it, so with the real parallel_for
// each hand-over of work from thread to thread looks like a race, in our code too, and suppressing these reports would
// suppress the true ones. Here the threads are std::thread and the work is dealt out by an atomic counter, which the
// sanitizer understands. A found race is therefore ours.

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/blocked_range2d.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <concepts>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace phasetree::thread_sanitizer {

// Calls work(k) once for every k < count, on at least two threads so that there is something to see on one core too.
template <typename Work>
void deal(std::size_t count, const Work& work) {
    std::atomic<std::size_t> next{0};
    std::exception_ptr failure;
    std::mutex failure_mutex;
    const auto worker = [&] {
        try {
            for (std::size_t k = next++; k < count; k = next++) {
                work(k);
            }
        } catch (...) {
            next = count;
            const std::scoped_lock lock(failure_mutex);
            failure = std::current_exception();
        }
    };
    std::vector<std::thread> threads;
    const auto helpers = static_cast<std::size_t>(std::max(tbb::this_task_arena::max_concurrency(), 2) - 1);
    for (std::size_t helper = 0; helper < std::min(helpers, count); ++helper) {
        threads.emplace_back(worker);
    }
    worker();
    for (std::thread& thread : threads) {
        thread.join();
    }
    if (failure) {
        std::rethrow_exception(failure);
    }
}

// The pieces TBB's simple_partitioner would make.
template <typename Range>
void split(Range range, std::vector<Range>& pieces) {
    while (range.is_divisible()) {
        split(Range(range, tbb::split{}), pieces);
    }
    if (!range.empty()) {
        pieces.push_back(range);
    }
}

}  // namespace phasetree::thread_sanitizer

namespace tbb {

// The partitioner and the context, where given, change only how the real one schedules.
template <typename Range, typename Body, typename... Scheduling>
requires(!std::integral<Range>) void parallel_for(const Range& range, const Body& body, Scheduling&&...) {
    std::vector<Range> pieces;
    phasetree::thread_sanitizer::split(range, pieces);
    phasetree::thread_sanitizer::deal(pieces.size(), [&](std::size_t k) {
        Range piece = pieces[k];
        body(piece);
    });
}

template <std::integral Index, typename Function, typename... Scheduling>
requires std::invocable<const Function&, Index>
void parallel_for(Index first, Index last, const Function& function, Scheduling&&...) {
    const std::size_t count = first < last ? static_cast<std::size_t>(last - first) : 0;
    phasetree::thread_sanitizer::deal(
        count, [&](std::size_t k) { function(static_cast<Index>(first + static_cast<Index>(k))); });
}

}  // namespace tbb
