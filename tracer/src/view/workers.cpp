#include "view/workers.hpp"

#include <utility>

namespace phasetree::tracer::view {

namespace {

thread_local bool refusing = false;

}  // namespace

Workers::Workers() {
    for (std::size_t i = 0; i < threads; ++i) threads_.emplace_back([this] { work(); });
}

bool Workers::is_refusing() {
    return refusing;
}

Workers::Enqueued Workers::enqueue(std::function<void()> task) {
    {
        const std::lock_guard lock(mutex_);
        if (waiting_.size() < most_waiting) {
            waiting_.push_back(std::move(task));
            changed_.notify_one();
            return Enqueued(true);
        }
    }
    refusing = true;
    task();
    refusing = false;
    return Enqueued(true);
}

void Workers::work() {
    while (true) {
        std::function<void()> task;
        {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [&] { return is_over_ || !waiting_.empty(); });
            if (waiting_.empty()) return;
            task = std::move(waiting_.front());
            waiting_.pop_front();
        }
        task();
    }
}

void Workers::shutdown() {
    {
        const std::lock_guard lock(mutex_);
        is_over_ = true;
        changed_.notify_all();
    }
    for (std::thread& thread : threads_) thread.join();
}

}  // namespace phasetree::tracer::view
