// Progress of a render on standard error: first the learning phase, if the scene uses guiding; then the number of
// samples, or with a deadline the elapsed time.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>

#include "output/late_progress.hpp"
#include "output/progress.hpp"

namespace phasetree::tracer {

class RenderProgress {
  public:
    using TimePoint = ProgressOutput::Clock::time_point;

    /// `total` is the number of samples to render. `samples_begin` is called when learning is complete.
    RenderProgress(ProgressOutput output, std::uint64_t total, std::optional<TimePoint> deadline, bool learns,
                   std::function<void()> samples_begin)
        : output_(std::move(output)), total_(total), deadline_(deadline), samples_begin_(std::move(samples_begin)) {
        if (learns)
            learning_.emplace(output_, "learning where light comes from");
        else
            begin();
    }

    /// For RenderJob::learned.
    void learned(double share) {
        learning_->tell(share);
        if (share < 1) return;
        learning_.reset();
        begin();
    }
    /// For RenderJob::advance.
    void advance(std::uint64_t samples) {
        if (progress_)
            progress_->advance(samples);
        else if (time_progress_)
            time_progress_->tell();
        else
            done_before_ += samples;
    }

  private:
    void begin() {
        if (deadline_)
            time_progress_.emplace(*deadline_, output_, "rendering");
        else
            progress_.emplace(total_, output_).advance(done_before_);
        samples_begin_();
    }

    ProgressOutput output_;
    std::uint64_t total_;
    std::optional<TimePoint> deadline_;
    std::function<void()> samples_begin_;
    std::optional<LateProgress> learning_;
    // Samples that need not be rendered. One thread reports them before `progress_` exists; they are added when it
    // does.
    std::uint64_t done_before_ = 0;
    std::optional<Progress> progress_;
    std::optional<TimeProgress> time_progress_;
};

}  // namespace phasetree::tracer
