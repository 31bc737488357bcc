// The threads that answer requests: a fixed number, with a queue for a few connections.
#pragma once

#include <httplib.h>

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace phasetree::tracer::view {

class Workers : public httplib::TaskQueue {
  public:
    static constexpr std::size_t threads = 12;
    static constexpr std::size_t most_waiting = 64;

    /// void before 0.15; from then on, whether the task was accepted, which is always true.
    using Enqueued = decltype(std::declval<httplib::TaskQueue&>().enqueue({}));

    Workers();

    /// If the queue is full, runs the task at once in the caller's thread, with is_refusing() true.
    Enqueued enqueue(std::function<void()> task) override;
    void shutdown() override;

    /// Whether the calling thread runs a task only to reject its request.
    static bool is_refusing();

  private:
    void work();

    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::function<void()>> waiting_;
    bool is_over_ = false;
    std::vector<std::thread> threads_;
};

}  // namespace phasetree::tracer::view
