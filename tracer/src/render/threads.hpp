// Determines how many threads can be started: a limit on processes may allow fewer than there are cores. TBB would
// discover that in the middle of the work and fail.
#pragma once

#include <tbb/global_control.h>

#include <optional>

namespace phasetree::tracer {

/// During its lifetime, at most `wanted` threads work, and no more than can be started; 0 means one per core. To find
/// the limit, it starts that many and lets them end. Create it before reading or writing images. Throws
/// std::runtime_error if no thread can be started.
class AvailableThreads {
  public:
    explicit AvailableThreads(int wanted = 0);

    int wanted() const { return wanted_; }
    int count() const { return count_; }

  private:
    int wanted_;
    int count_;
    std::optional<tbb::global_control> limit_;
};

}  // namespace phasetree::tracer
