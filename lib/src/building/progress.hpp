#pragma once

#include <algorithm>
#include <atomic>
#include <functional>
#include <mutex>

namespace phasetree::building {

/// How much of the building is done, told to whoever asked (CellOptions::progress). Any thread adds to it.
class BuildProgress {
  public:
    explicit BuildProgress(const std::function<void(float)>& tell) : tell_(tell) {}

    /// This part of the whole is done, too.
    void add(double part) {
        if (!tell_) return;
        const double done = done_.fetch_add(part, std::memory_order_relaxed) + part;
        // Whoever tells something now tells enough.
        const std::unique_lock lock(telling_, std::try_to_lock);
        if (lock.owns_lock()) tell(done);
    }
    /// Of what was left all is to be done again, or this share of it.
    void start_again(double share) {
        const std::scoped_lock lock(telling_);
        base_ += scale_ * std::min(1.0, done_.load());
        scale_ = (1 - base_) * share;
        done_ = 0;
    }
    /// All of it is done.
    void finish() {
        if (!tell_) return;
        const std::scoped_lock lock(telling_);
        tell_(1.f);
    }

  private:
    static constexpr double step = 1.0 / 1024, last = 1 - step;

    void tell(double done_now) {
        const double done = base_ + scale_ * done_now;
        if (done < told_ + step || done > last) return;
        told_ = done;
        tell_(static_cast<float>(done));
    }

    const std::function<void(float)>& tell_;
    std::atomic<double> done_{0};
    std::mutex telling_;  ///< guards what follows, and the calls
    double base_ = 0, scale_ = 1, told_ = 0;
};

}  // namespace phasetree::building
