#pragma once

#include <atomic>
#include <functional>
#include <mutex>

namespace phasetree::building {

/// Reports how much of a build is done (CellOptions::progress). Thread-safe.
class BuildProgress {
  public:
    explicit BuildProgress(const std::function<void(float)>& callback) : callback_(callback) {}

    /// Adds a finished share of the current attempt.
    void add(double share);
    /// Starts another attempt to divide the cells. It receives the unfinished part of the whole build, or this share of
    /// that part if other attempts may follow.
    void start_attempt(double share);
    /// Reports that the build is complete.
    void finish();

  private:
    /// Calls back if progress is large enough; 1 is reserved for finish().
    void report(double done_of_attempt);

    const std::function<void(float)>& callback_;
    std::atomic<double> done_of_attempt_{0};
    std::mutex mutex_;  ///< guards the members below and the callback
    double before_attempt_ = 0, share_of_attempt_ = 1, last_reported_ = 0;
};

}  // namespace phasetree::building
