// Progress of work that usually takes less than a second, such as reading or building cells. Nothing is shown until
// then.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "output/progress.hpp"

namespace phasetree::tracer {

class LateProgress {
  public:
    LateProgress(ProgressOutput output, std::string task)
        : output_(std::move(output)), task_(std::move(task)), start_(output_.now()) {}

    /// Reports the completed fraction, from 0 to 1. It never goes back: smaller values are ignored. Call from one
    /// thread at a time.
    void tell(double done) {
        if (output_.stream == nullptr) return;
        if (!shown_) {
            if (done >= 1 || output_.now() - start_ < patience) return;
            shown_.emplace(total, output_, task_);
        }
        const auto now = static_cast<std::uint64_t>(done * static_cast<double>(total));
        if (now > told_) shown_->advance(now - told_);
        told_ = std::max(told_, now);
    }

  private:
    static constexpr std::uint64_t total = 10'000;
    static constexpr std::chrono::seconds patience{1};

    ProgressOutput output_;
    std::string task_;
    ProgressOutput::Clock::time_point start_;
    std::optional<Progress> shown_;
    std::uint64_t told_ = 0;
};

}  // namespace phasetree::tracer
