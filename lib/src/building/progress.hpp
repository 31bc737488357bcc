#pragma once

#include <atomic>
#include <functional>
#include <mutex>

namespace phasetree::building {

/// Reports how much of a build is done (CellOptions::progress). Any thread may call it.
class BuildProgress {
  public:
    explicit BuildProgress(const std::function<void(float)>& callback) : callback_(callback) {}

    /// This share of the current attempt is done, too.
    void add(double share);
    /// The cells are divided again. What was not yet done of the whole build is now the new attempt's, or this share of
    /// it, if other attempts may follow.
    void start_attempt(double share);
    /// All of the build is done.
    void finish();

  private:
    /// Calls back if enough more is done; 1 is left for finish().
    void report(double done_of_attempt);

    const std::function<void(float)>& callback_;
    std::atomic<double> done_of_attempt_{0};
    std::mutex mutex_;  ///< guards the following members and the calls
    double before_attempt_ = 0, share_of_attempt_ = 1, last_reported_ = 0;
};

}  // namespace phasetree::building
