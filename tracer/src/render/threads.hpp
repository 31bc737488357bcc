// How many threads there can be: a limit on processes may leave fewer than there are cores, and TBB, which would find
// out in the middle of the work, cannot go on then.
#pragma once

#include <tbb/global_control.h>

#include <optional>

namespace phasetree::tracer {

/// While it lives, no more threads work than can be started, and `wanted` at most; 0 wants one a core. To find out it
/// starts as many and lets them go. To be made before anything reads or writes an image. Throws std::runtime_error
/// where there can be none.
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
