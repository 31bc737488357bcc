#pragma once

#include <atomic>
#include <functional>
#include <mutex>

namespace phasetree {

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
    /// All of it is done.
    void finish() {
        if (!tell_) return;
        const std::scoped_lock lock(telling_);
        tell_(1.f);
    }

  private:
    static constexpr double step = 1.0 / 1024, last = 1 - step;

    void tell(double done) {
        if (done < told_ + step || done > last) return;
        told_ = done;
        tell_(static_cast<float>(done));
    }

    const std::function<void(float)>& tell_;
    std::atomic<double> done_{0};
    std::mutex telling_;  ///< guards what follows, and the calls
    double told_ = 0;
};

}  // namespace phasetree
