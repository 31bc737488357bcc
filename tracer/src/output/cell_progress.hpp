// How far the building of an object's cells is. Most are built in less than a second, and then nothing is shown.
#pragma once

#include <optional>

#include "output/progress.hpp"

namespace phasetree::tracer {

class CellProgress {
  public:
    explicit CellProgress(ProgressOutput output) : output_(std::move(output)), start_(output_.now()) {}

    /// As CellOptions::progress has it: by one thread at a time, from 0 to 1, rising.
    void tell(float done) {
        if (output_.stream == nullptr) return;
        if (!shown_) {
            if (done == 1 || output_.now() - start_ < patience) return;
            shown_.emplace(total, output_, "preparing the object");
        }
        const auto now = static_cast<std::uint64_t>(static_cast<double>(done) * static_cast<double>(total));
        if (now > told_) shown_->advance(now - told_);
        told_ = now;
    }

  private:
    static constexpr std::uint64_t total = 10'000;
    static constexpr std::chrono::seconds patience{1};

    ProgressOutput output_;
    ProgressOutput::Clock::time_point start_;
    std::optional<Progress> shown_;
    std::uint64_t told_ = 0;
};

}  // namespace phasetree::tracer
