#include "building/progress.hpp"

#include <algorithm>

namespace phasetree::building {

void BuildProgress::add(double share) {
    if (!callback_) return;
    const double done = done_of_attempt_.fetch_add(share, std::memory_order_relaxed) + share;
    // If another thread is reporting, do not wait: the next report includes this share.
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (lock.owns_lock()) report(done);
}

void BuildProgress::start_attempt(double share) {
    const std::scoped_lock lock(mutex_);
    before_attempt_ += share_of_attempt_ * std::min(1.0, done_of_attempt_.load());
    share_of_attempt_ = (1 - before_attempt_) * share;
    done_of_attempt_ = 0;
}

void BuildProgress::finish() {
    if (!callback_) return;
    const std::scoped_lock lock(mutex_);
    callback_(1.f);
}

void BuildProgress::report(double done_of_attempt) {
    constexpr double step = 1.0 / 1024;
    const double done = before_attempt_ + share_of_attempt_ * done_of_attempt;
    if (done < last_reported_ + step || done > 1 - step) return;
    last_reported_ = done;
    callback_(static_cast<float>(done));
}

}  // namespace phasetree::building
