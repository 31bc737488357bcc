// The threads that answer requests: a fixed number, with room for a few connections to wait.
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

    /// Before 0.15 nothing, from then on whether the task was taken; it always is.
    using Enqueued = decltype(std::declval<httplib::TaskQueue&>().enqueue({}));

    Workers();

    /// Where no more may wait, runs the task at once in the caller's thread, with is_refusing().
    Enqueued enqueue(std::function<void()> task) override;
    void shutdown() override;

    /// Whether the calling thread runs a task only to refuse what it stands for.
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
